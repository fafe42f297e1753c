"""Shadow silhouette maps: a shadow map that knows where, within its texels, the silhouette runs.

A shadow's edge has the steps of the map's texels, because there is one comparison for all of a texel. So the silhouette
of the casters is stored beside the depths, as one point for each cell between four texel centres. Lines between the
points of neighbouring cells follow the silhouette, and decide which of the four texels a place in the cell belongs to.

Paper: Sen, Cammarano & Hanrahan 2003, "Shadow silhouette maps".
Slides: none; Andújar, Shadow mapping, shows the steps that this technique removes.

A straight silhouette is reproduced exactly. In a cell without a point, the middle takes its place, and the result is
that of the nearest texel; the map "fall-back" shows the pixels in such cells whose corners differ.

Known failures: a cell holds one point, so where two silhouettes cross one of them has steps again; the edges of the
mesh have to be known; four texels are compared, so the slope offset is twice that of a single comparison; on casters
their own silhouette leaves teeth of acne along convex edges: there a plain map of 2048 texels is better, while on the
floor this one with 128 texels has a fifteenth of its errors.
"""

from typing import Any

import numpy as np

from softshadow.scene import Light, Scene
from softshadow.techniques import depth_maps, drawing
from softshadow.techniques.light_camera import LightCamera, light_camera
from softshadow.techniques.map_lookups import set_map_coordinates
from softshadow.techniques.map_pcf import behind, disc
from softshadow.techniques.silhouette_points import MIDDLE, silhouette_points
from softshadow.techniques.technique import Steps
from softshadow.techniques.visibility_buffer import add_light_times, draw_visibility, set_uniforms


def steps(
    gl: Any,
    scene: Scene,
    *,
    size: tuple[int, int],
    map_size: depth_maps.MapSize = 512,
    map_format: depth_maps.MapFormat = "d24",
    # the farthest corner of a cell is one texel away on each axis, and glPolygonOffset uses the larger slope of the two
    factor: depth_maps.Factor = 2.0,
    units: depth_maps.Units = 1.0,
    bias: depth_maps.Bias = 0.0,
    normal_bias: depth_maps.NormalBias = 0.0,
    outside: depth_maps.Outside = "lit",
) -> Steps:
    """Draw the scene with one shadow silhouette map per light."""
    drawing.begin_frame(gl, scene)
    cameras = [light_camera(scene, light) for light in scene.lights]
    depth_maps.warn_of_casters_outside(scene, cameras)

    # pass 1: the depth of the casters, seen from the light, and the silhouette in its texels
    maps_of_lights = []
    for light, camera in zip(scene.lights, cameras, strict=True):
        shadow_map = depth_maps.depth_texture(gl, map_size, gl.GL_NEAREST, outside, map_format)
        with depth_maps.polygon_offset(gl, factor, units):
            depth_maps.draw_into(gl, scene, camera, shadow_map, map_size)
        stored = depth_maps.read_depths(gl, shadow_map)
        yield (
            drawing.title("draw the depth map from the light", scene, light),
            {drawing.title("ZS", scene, light): stored},
        )
        points = silhouette_points(scene, light, camera, stored)
        maps_of_lights.append((shadow_map, silhouette_texture(gl, points)))
        yield (
            drawing.title("store the silhouette", scene, light),
            {drawing.title("silhouette points", scene, light): points},
        )

    # pass 2: the camera's picture, first as if all of it were in shadow
    drawing.begin_frame(gl, scene)
    drawing.set_camera(gl, scene.camera, size)
    drawing.light_ambient_only(gl, scene)
    drawing.draw_objects(gl, scene.objects)
    depth = drawing.read_depth(gl, size)
    valid = depth < 1
    yield "draw the scene without the light"

    # then whether each pixel sees the light, and the light there
    lit = []
    points = drawing.world_points(scene, depth, size)
    program = gl.program("silhouette-visibility")
    for light, camera, (shadow_map, silhouette_map) in zip(scene.lights, cameras, maps_of_lights, strict=True):

        def look_up(
            light: Light = light, camera: LightCamera = camera, maps: tuple[int, int] = (shadow_map, silhouette_map)
        ) -> None:
            gl.glActiveTexture(gl.GL_TEXTURE1)
            gl.glBindTexture(gl.GL_TEXTURE_2D, maps[1])
            gl.glActiveTexture(gl.GL_TEXTURE0)
            gl.glBindTexture(gl.GL_TEXTURE_2D, maps[0])
            set_map_coordinates(gl, camera, 0.0)
            set_uniforms(gl, program, shadowMap=0, silhouetteMap=1, side=float(map_size), bias=bias)
            set_uniforms(gl, program, behind=behind(light, outside), cone=disc(light, camera))

        visibility, values = draw_visibility(gl, scene, size, program, look_up, normal_bias)
        lit.append(values[..., 3])
        yield (
            drawing.title("find the quarter of its cell that each point is in", scene, light),
            {
                drawing.title("quadrants", scene, light): values[..., 0].astype(np.uint8),
                drawing.title("fall-back", scene, light): valid & (values[..., 1] == 1),
                drawing.title("unknown", scene, light): valid & depth_maps.unknown(scene, light, camera, points),
            },
        )

        add_light_times(gl, scene, size, light, visibility)
        gl.glDeleteTextures([visibility])
        yield (
            drawing.title("add the light where the map is not nearer", scene, light),
            drawing.visibility_maps(scene, lit, valid),
        )
    gl.glDeleteTextures([name for names in maps_of_lights for name in names])


def silhouette_texture(gl: Any, points: np.ndarray) -> int:
    """Return a texture of silhouette points (n, n, 3) float32; its border means that no point is stored."""
    name: int = gl.glGenTextures(1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, name)
    for parameter, value in (
        (gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST),
        (gl.GL_TEXTURE_MAG_FILTER, gl.GL_NEAREST),
        (gl.GL_TEXTURE_WRAP_S, gl.GL_CLAMP_TO_BORDER),
        (gl.GL_TEXTURE_WRAP_T, gl.GL_CLAMP_TO_BORDER),
    ):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, parameter, value)
    gl.glTexParameterfv(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_BORDER_COLOR, (MIDDLE, MIDDLE, 0.0, 0.0))
    height, width = points.shape[:2]
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGB32F, width, height, 0, gl.GL_RGB, gl.GL_FLOAT, points)
    return name
