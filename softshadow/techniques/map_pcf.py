"""Percentage-closer filtering: the share of shadow map texels round a point that are lit.

A shadow map's depths cannot be filtered: the mean of two depths is the depth of nothing. But the answers can. So a
point is compared with each texel of a square round its place, and sees as much of the light as the share of those that
are not nearer than it.

Paper: Reeves, Salesin & Cook 1987, "Rendering antialiased shadows with depth maps".
Slides: Andújar, Shadow mapping (GL_LINEAR); Moldoveanu "umbre 2"; Zimányi & Valient.

With `bilinear` the square moves along with the place, and the share changes continuously; without, it has as many steps
as the square has texels. A texel farther away on a slope is farther off in depth, so the slope offset grows with the
square: factor 2 r + 1 for (2 r + 1)² texels, 2 r + 2 with `bilinear`.

Known failures: the ramp is no penumbra, it is as wide as the square everywhere, near the caster and far from it; the
larger offset takes shadows off their casters (factor = 1 leaves acne instead); what the light does not see is unknown,
as with a single comparison.
"""

from typing import Any

import numpy as np

from softshadow.scene import Light, Scene
from softshadow.techniques import depth_maps
from softshadow.techniques.depth_maps import (
    depth_texture,
    draw_into,
    offset_and_culled,
    read_depths,
    unknown,
    warn_of_casters_outside,
)
from softshadow.techniques.drawing import (
    begin_frame,
    draw_objects,
    light_ambient_only,
    read_depth,
    set_camera,
    title_of,
    visibility_maps,
    world_points,
)
from softshadow.techniques.light_camera import LightCamera, light_camera
from softshadow.techniques.map_lookups import set_map_coordinates
from softshadow.techniques.technique import Option, Steps
from softshadow.techniques.visibility_buffer import add_light_times, draw_visibility, set_uniforms

OPTIONS = depth_maps.OPTIONS | {
    "factor": Option(
        None, float, "slope offset: first argument of glPolygonOffset; by default the kernel, one more if bilinear"
    ),
    "kernel": Option(3, int, "texels on a side of the square, an odd number", minimum=1, maximum=31),
    "bilinear": Option(False, bool, "let the square move with the place, and weight texels by their part of it"),
}


def steps(
    gl: Any,
    scene: Scene,
    *,
    size: tuple[int, int],
    map_size: int = 512,
    factor: float | None = None,
    units: float = 1.0,
    bias: float = 0.0,
    normal_bias: float = 0.0,
    outside: str = "lit",
    kernel: int = 3,
    bilinear: bool = False,
) -> Steps:
    """Draw the scene with percentage-closer filtered shadow maps; see `OPTIONS`.

    Raises
    ------
    ValueError                   an even kernel, which has no middle
    """
    if kernel % 2 == 0:
        raise ValueError(f"option kernel={kernel}: expected an odd number")
    begin_frame(gl, scene)
    cameras = [light_camera(scene, light) for light in scene.lights]
    warn_of_casters_outside(scene, cameras)

    # pass 1: the depth of the casters, seen from the light
    shadow_maps = []
    for light, camera in zip(scene.lights, cameras, strict=True):
        shadow_map = depth_texture(gl, map_size, gl.GL_NEAREST, outside)
        with offset_and_culled(gl, farthest_texel(kernel, bilinear) if factor is None else factor, units):
            draw_into(gl, scene, camera, shadow_map, map_size)
        shadow_maps.append(shadow_map)
        stored = read_depths(gl, shadow_map)
        yield title_of("draw the depth map from the light", scene, light), {title_of("ZS", scene, light): stored}

    # pass 2: the camera's picture, first as if all were in shadow
    begin_frame(gl, scene)
    set_camera(gl, scene.camera, size)
    light_ambient_only(gl, scene)
    draw_objects(gl, scene.objects)
    depth = read_depth(gl, size)
    valid = depth < 1
    yield "draw the scene without the light"

    # then how much of the light each pixel sees, and that much of the light
    seen = []
    points = world_points(scene, depth, size)
    program = gl.program("map-visibility-bilinear" if bilinear else "map-visibility")
    for light, camera, shadow_map in zip(scene.lights, cameras, shadow_maps, strict=True):

        def look_up(light: Light = light, camera: LightCamera = camera, shadow_map: int = shadow_map) -> None:
            gl.glBindTexture(gl.GL_TEXTURE_2D, shadow_map)
            set_map_coordinates(gl, camera, 0.0)
            set_uniforms(gl, program, side=float(map_size), radius=kernel // 2, bias=bias)
            set_uniforms(gl, program, behind=behind(light, outside), cone=disc(light, camera))

        visibility, values = draw_visibility(gl, scene, size, program, look_up, normal_bias)
        seen.append(values[..., 3])
        yield (
            title_of("compare with the texels round each point", scene, light),
            {title_of("unknown", scene, light): valid & unknown(scene, light, camera, points)},
        )

        add_light_times(gl, scene, size, light, visibility)
        gl.glDeleteTextures([visibility])
        yield title_of("add the share of the light", scene, light), visibility_maps(scene, seen, valid)
    gl.glDeleteTextures(shadow_maps)


def farthest_texel(kernel: int, bilinear: bool) -> float:
    """Return the slope factor that ends acne: twice the distance to the farthest texel centre on an axis, in texels.

    On a plane that rises by a and b per texel a comparison with a texel whose centre is at most d texels away errs by
    at most d (|a| + |b|) <= 2 d max(|a|, |b|), and glPolygonOffset takes that maximum. Of a square of texels round the
    place's own, d is r + 1/2; one that moves along reaches d = r + 1.
    """
    return float(kernel + 1 if bilinear else kernel)


def behind(light: Light, outside: str) -> float:
    """Return the visibility of what is not before the light."""
    return 0.0 if light.is_spot or outside == "shadow" else 1.0


def disc(light: Light, camera: LightCamera) -> float:
    """Return the squared radius of a spot light's cone in its map, whose side is 1; infinite for other lights."""
    return float((0.5 * np.tan(np.radians(light.cutoff)) / camera.half) ** 2) if light.is_spot else float("inf")
