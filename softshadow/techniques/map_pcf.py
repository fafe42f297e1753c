"""Percentage-closer filtering: the share of shadow map texels round a point that are lit.

A shadow map's depths cannot be filtered: the mean of two depths is the depth of nothing. The results of comparisons
can. So a point is compared with each texel of a square round its place in the map, and it sees as much of the light as
the share of texels that are not nearer.

Paper: Reeves, Salesin & Cook 1987, "Rendering antialiased shadows with depth maps".
Slides: Andújar, Shadow mapping (GL_LINEAR); Moldoveanu "umbre 2"; Zimányi & Valient.

With `bilinear` the square is centred on the point, and the share changes continuously; without it the square is made of
whole texels, and the share has as many steps as there are texels. On a slope, a texel farther away differs more in
depth, so the slope offset grows with the square: factor 2 r + 1 for (2 r + 1)² texels, 2 r + 2 with `bilinear`.

Known failures: the ramp is no penumbra, it is as wide as the square everywhere, near the caster and far from it; the
larger offset takes shadows off their casters (factor = 1 leaves acne instead); points that the light does not see are
unknown, as with a single comparison; where faces nearly lie along the light, grey veins remain on their lit side.
"""

from typing import Annotated, Any

import numpy as np

from softshadow.scene import Light, Scene
from softshadow.techniques import depth_maps, drawing
from softshadow.techniques.light_camera import LightCamera, light_camera
from softshadow.techniques.map_lookups import set_map_coordinates
from softshadow.techniques.technique import Range, Steps
from softshadow.techniques.visibility_buffer import add_light_times, draw_visibility, set_uniforms


def steps(
    gl: Any,
    scene: Scene,
    *,
    size: tuple[int, int],
    map_size: depth_maps.MapSize = 512,
    map_format: depth_maps.MapFormat = "d24",
    factor: Annotated[
        float | None, "slope offset: first argument of glPolygonOffset; by default the kernel, one more if bilinear"
    ] = None,
    units: depth_maps.Units = 1.0,
    bias: depth_maps.Bias = 0.0,
    normal_bias: depth_maps.NormalBias = 0.0,
    outside: depth_maps.Outside = "lit",
    kernel: Annotated[int, "texels on a side of the square, an odd number", Range(1, 31)] = 3,
    bilinear: Annotated[bool, "centre the square on the point, and weight texels by the part inside"] = False,
) -> Steps:
    """Draw the scene with percentage-closer filtered shadow maps.

    Raises
    ------
    ValueError                   an even kernel, which has no middle
    """
    if kernel % 2 == 0:
        raise ValueError(f"option kernel={kernel}: expected an odd number")
    if factor is None:
        factor = farthest_texel(kernel, bilinear)
    drawing.begin_frame(gl, scene)
    cameras = [light_camera(scene, light) for light in scene.lights]
    depth_maps.warn_of_casters_outside(scene, cameras)

    # pass 1: the depth of the casters, seen from the light
    shadow_maps = []
    for light, camera in zip(scene.lights, cameras, strict=True):
        shadow_map = depth_maps.depth_texture(gl, map_size, gl.GL_NEAREST, outside, map_format)
        with depth_maps.polygon_offset(gl, factor, units):
            depth_maps.draw_into(gl, scene, camera, shadow_map, map_size)
        shadow_maps.append(shadow_map)
        yield (
            drawing.title("draw the depth map from the light", scene, light),
            {drawing.title("ZS", scene, light): depth_maps.read_depths(gl, shadow_map)},
        )

    # pass 2: the camera's picture, first as if all of it were in shadow
    drawing.begin_frame(gl, scene)
    drawing.set_camera(gl, scene.camera, size)
    drawing.light_ambient_only(gl, scene)
    drawing.draw_objects(gl, scene.objects)
    depth = drawing.read_depth(gl, size)
    valid = depth < 1
    yield "draw the scene without the light"

    # then how much of the light each pixel sees, and that much of the light
    lit = []
    points = drawing.world_points(scene, depth, size)
    program = gl.program("map-visibility-bilinear" if bilinear else "map-visibility")
    for light, camera, shadow_map in zip(scene.lights, cameras, shadow_maps, strict=True):

        def look_up(light: Light = light, camera: LightCamera = camera, shadow_map: int = shadow_map) -> None:
            gl.glBindTexture(gl.GL_TEXTURE_2D, shadow_map)
            set_map_coordinates(gl, camera, 0.0)
            set_uniforms(gl, program, side=float(map_size), radius=kernel // 2, bias=bias)
            set_uniforms(gl, program, behind=behind(light, outside), cone=disc(light, camera))

        visibility, values = draw_visibility(gl, scene, size, program, look_up, normal_bias)
        lit.append(values[..., 3])
        yield (
            drawing.title("compare with the texels round each point", scene, light),
            {drawing.title("unknown", scene, light): valid & depth_maps.unknown(scene, light, camera, points)},
        )

        add_light_times(gl, scene, size, light, visibility)
        gl.glDeleteTextures([visibility])
        yield drawing.title("add the share of the light", scene, light), drawing.visibility_maps(scene, lit, valid)
    gl.glDeleteTextures(shadow_maps)


def farthest_texel(kernel: int, bilinear: bool) -> float:
    """Return the slope factor that ends acne: twice the distance to the farthest texel centre on an axis, in texels.

    On a plane that rises by a and b per texel, a comparison with a texel whose centre is at most d texels away errs by
    at most d (|a| + |b|) <= 2 d max(|a|, |b|), and the slope in glPolygonOffset is that maximum. In a square of whole
    texels round the point's own d = r + 1/2; in a square centred on the point d = r + 1.
    """
    return float(kernel + 1 if bilinear else kernel)


def behind(light: Light, outside: str) -> float:
    """Return the visibility of points beside or behind the light."""
    return 0.0 if light.is_spot or outside == "shadow" else 1.0


def disc(light: Light, camera: LightCamera) -> float:
    """Return the squared radius of a spot light's cone in its map, whose side is 1; infinite for other lights."""
    return float((0.5 * np.tan(np.radians(light.cutoff)) / camera.half) ** 2) if light.is_spot else float("inf")
