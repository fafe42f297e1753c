"""Variance shadow maps: from mean and variance of the depths round a point, a bound of the share that is lit.

Depths may not be filtered before they are compared, but moments may: the mean of the depths d round a point, and that
of their squares. They tell the variance, and Chebyshev's inequality then bounds the share of texels at least as far as
a receiver at depth t behind the mean: variance / (variance + (t - mean)²). The map is blurred once, whatever the number
of points that look it up, and the lookup is a single one with GL_LINEAR.

Paper: Donnelly & Lauritzen 2006, "Variance shadow maps"; the bleeding reduction is that of Lauritzen 2007, "Summed-area
variance shadow maps".
Slides: none; Andújar, Shadow mapping, has the comparison that it replaces.

With one flat blocker parallel to a flat receiver, the bound is the share itself: the picture is that of `map-pcf`,
bilinear, with a kernel of 2 blur + 1. On slopes the variance is that of the slope, so no slope offset is needed; a
least variance stands in for the rounding of the moments, and takes the place of a bias.

Known failures: light bleeding (where two blockers at different depths overlap, the bound is far above the share: the
upper blocker's penumbra shows as a light band in the lower one's shadow; `bleed` cuts the bound off and makes penumbrae
narrower); the ramp is no penumbra; where the far plane of the light's camera cuts a receiver, a line is up to a tenth
darker; a receiver that casts no shadow casts one on what lies behind it; and shadows that are nearer to their caster
than the square root of the least variance fade.
"""

from typing import Annotated, Any

from softshadow.scene import Light, Scene
from softshadow.techniques import depth_maps, drawing, filterable_maps
from softshadow.techniques.light_by_program import draw_lit_by_program
from softshadow.techniques.light_camera import LightCamera, light_camera
from softshadow.techniques.map_pcf import behind, disc
from softshadow.techniques.technique import Range, Steps
from softshadow.techniques.visibility_buffer import set_uniforms

FAR = (1.0, 1.0, 0.0, 1.0)  # the moments of depth 1


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
    least_variance: Annotated[float, "smaller variances of the linear depth count as this one", Range(0, 1)] = 1e-5,
    bleed: Annotated[float, "bounds up to this one count as 0, and the others are stretched", Range(0, 0.99)] = 0.0,
) -> Steps:
    """Draw the scene with variance shadow maps."""
    drawing.begin_frame(gl, scene)
    cameras = [light_camera(scene, light) for light in scene.lights]
    depth_maps.warn_of_casters_outside(scene, cameras)

    # pass 1: depth and squared depth, seen from the light, and their means
    maps = []
    for light, camera in zip(scene.lights, cameras, strict=True):

        def use_program() -> None:
            gl.glUseProgram(gl.program("depth-moments"))

        moments = filterable_maps.draw_filterable(gl, scene, camera, map_size, FAR, outside, use_program)
        yield (
            drawing.title("draw depth and squared depth from the light", scene, light),
            {drawing.title("moments", scene, light): filterable_maps.read_texels(gl, moments, 2)},
        )
        moments = filterable_maps.blur(gl, moments, map_size, blur, FAR, outside)
        maps.append(moments)
        yield (
            drawing.title("blur the map", scene, light),
            {drawing.title("blurred moments", scene, light): filterable_maps.read_texels(gl, moments, 2)},
        )

    # pass 2: the bound by Chebyshev's inequality
    program = gl.program("variance-visibility")

    def look_up(number: int, light: Light, camera: LightCamera) -> None:
        gl.glBindTexture(gl.GL_TEXTURE_2D, maps[number])
        filterable_maps.set_linear_coordinates(gl, camera)
        set_uniforms(gl, program, leastVariance=least_variance, bleed=bleed, bias=bias)
        set_uniforms(gl, program, behind=behind(light, outside), cone=disc(light, camera))

    yield from draw_lit_by_program(gl, scene, size, cameras, program, look_up, ("mean depth", "variance"), normal_bias)
    gl.glDeleteTextures(maps)
