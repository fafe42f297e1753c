"""Exponential shadow maps: the comparison of two depths as the quotient of their powers, which may be filtered.

A comparison is 1 if the stored depth z is at least the receiver's d, else 0. If no z is greater than d, e^(c (z - d))
is nearly that: 1 where they are equal, and small where z is less, the smaller the greater c. It is a product of e^(c
z), which does not depend on the receiver and is therefore stored in a map and blurred, and of e^(-c d). So a single
lookup of the mean gives the share of the texels at the receiver's own depth.

Paper: Annen, Mertens, Seidel, Flerackers & Kautz 2008, "Exponential shadow maps".
Slides: none; Andújar, Shadow mapping, has the comparison that it replaces.

Where texels lie behind the receiver, as beside an edge of a caster that is itself in shadow, the quotient is greater
than 1 and no share of anything; the map "quotient" shows it. The paper then compares one by one; here it counts as lit.

Known failures: light bleeds in where caster and receiver touch, because e^(c (z - d)) is near 1 if z is near d: with an
exponent c, shadows fade within 1 / c of the depth range behind their caster. A large c mends that, but e^c has to be a
float: an exponent that overflows is refused. The ramp is no penumbra; on a slope the mean of powers is greater than the
power of the mean, so that edges of shadows grow lighter; texels behind the receiver make it lit; and where the far
plane of the light's camera cuts a receiver, a line is up to a tenth darker.
"""

import math
from typing import Annotated, Any

from softshadow.scene import Light, Scene
from softshadow.techniques import depth_maps, drawing, filterable_maps
from softshadow.techniques.light_by_program import draw_lit_by_program
from softshadow.techniques.light_camera import LightCamera, light_camera
from softshadow.techniques.map_pcf import behind, disc
from softshadow.techniques.technique import Range, Steps
from softshadow.techniques.visibility_buffer import set_uniforms

# float32: powers of two from 2^128 on are infinite, and 2^-126 is the smallest with full precision
INFINITE, SMALLEST = 128, -126
ROUNDING = 1e-3  # of the largest exponent: depths are rounded, and may be a little beyond 1


def steps(
    gl: Any,
    scene: Scene,
    *,
    size: tuple[int, int],
    map_size: depth_maps.MapSize = 512,
    bias: filterable_maps.LinearBias = 0.0,
    normal_bias: depth_maps.NormalBias = 0.0,
    outside: depth_maps.Outside = "lit",
    blur: filterable_maps.Blur = 2,
    exponent: Annotated[float, "c in e^(c d), for depths d from 0 (near) to 1 (far)", Range(1)] = 80.0,
) -> Steps:
    """Draw the scene with exponential shadow maps.

    Raises
    ------
    ValueError                   an exponent with which the blur's sums overflow float32
    """
    if exponent > largest_exponent(blur):
        raise ValueError(
            f"option exponent={exponent:g}: expected at most {largest_exponent(blur):.1f} with blur={blur}; beyond it "
            "e^exponent, or the sum of the blur's powers, overflows float32"
        )
    steepness = exponent * math.log2(math.e)  # e^(c d) as a power of two
    farthest = (2.0**steepness, 0.0, 0.0, 1.0)
    drawing.begin_frame(gl, scene)
    cameras = [light_camera(scene, light) for light in scene.lights]
    depth_maps.warn_of_casters_outside(scene, cameras)

    # pass 1: the powers of the depths, seen from the light, and their means
    maps = []
    for light, camera in zip(scene.lights, cameras, strict=True):

        def use_program() -> None:
            program = gl.program("depth-exponential")
            gl.glUseProgram(program)
            set_uniforms(gl, program, steepness=steepness)

        powers = filterable_maps.draw_filterable(gl, scene, camera, map_size, farthest, outside, use_program)
        yield (
            drawing.title("draw the powers of the depths from the light", scene, light),
            {drawing.title("powers", scene, light): filterable_maps.read_texels(gl, powers, 1)[..., 0]},
        )
        powers = filterable_maps.blur(gl, powers, map_size, blur, farthest, outside)
        maps.append(powers)
        yield (
            drawing.title("blur the map", scene, light),
            {drawing.title("blurred powers", scene, light): filterable_maps.read_texels(gl, powers, 1)[..., 0]},
        )

    # pass 2: the quotient with the receiver's own power
    program = gl.program("exponential-visibility")

    def look_up(number: int, light: Light, camera: LightCamera) -> None:
        gl.glBindTexture(gl.GL_TEXTURE_2D, maps[number])
        filterable_maps.set_linear_coordinates(gl, camera)
        set_uniforms(gl, program, steepness=steepness, bias=bias)
        set_uniforms(gl, program, behind=behind(light, outside), cone=disc(light, camera))

    yield from draw_lit_by_program(gl, scene, size, cameras, program, look_up, ("mean power", "quotient"), normal_bias)
    gl.glDeleteTextures(maps)


def largest_exponent(blur: int) -> float:
    """Return the largest exponent: e^exponent times the texels that the blur adds up, and e^-exponent, are floats."""
    return math.log(2) * min(INFINITE - math.log2(2 * blur + 1), -SMALLEST) * (1 - ROUNDING)
