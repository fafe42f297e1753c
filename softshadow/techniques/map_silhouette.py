"""Shadow silhouette maps: a shadow map that knows where, within its texels, the silhouette runs.

The steps of a shadow's edge are those of the texels: within one, all that is known is one comparison. So the silhouette
of the casters is stored beside the depths, one point for each cell between four texel centres. Lines between the points
of neighbouring cells follow the silhouette, and say which of the four texels a place belongs to.

Paper: Sen, Cammarano & Hanrahan 2003, "Shadow silhouette maps".
Slides: none; Andújar, Shadow mapping, has the steps that it does away with.

A straight silhouette is reproduced exactly. Where no point is stored, a cell's middle stands for it, and the answer is
that of the nearest texel: the map "fall-back" says which pixels' cells have none though their corners differ.

Known failures: one point for each cell, so where two silhouettes cross one of them has steps again; edges of the mesh
have to be known; four texels are compared, so the slope offset is twice that of a single comparison.
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
from softshadow.techniques.map_pcf import behind, disc
from softshadow.techniques.silhouette_points import MIDDLE, silhouette_points
from softshadow.techniques.technique import Option, Steps
from softshadow.techniques.visibility_buffer import add_light_times, draw_visibility, set_uniforms

OPTIONS = depth_maps.OPTIONS | {
    # the farthest corner of a cell is one texel away on each axis, and glPolygonOffset counts in the larger slope
    "factor": Option(2.0, float, "slope offset: first argument of glPolygonOffset while the map is drawn"),
}


def steps(
    gl: Any,
    scene: Scene,
    *,
    size: tuple[int, int],
    map_size: int = 512,
    factor: float = 2.0,
    units: float = 1.0,
    bias: float = 0.0,
    normal_bias: float = 0.0,
    outside: str = "lit",
) -> Steps:
    """Draw the scene with one shadow silhouette map per light; see `OPTIONS`."""
    begin_frame(gl, scene)
    cameras = [light_camera(scene, light) for light in scene.lights]
    warn_of_casters_outside(scene, cameras)

    # pass 1: the depth of the casters, seen from the light, and the silhouette in its texels
    maps_of_lights = []
    for light, camera in zip(scene.lights, cameras, strict=True):
        shadow_map = depth_texture(gl, map_size, gl.GL_NEAREST, outside)
        with offset_and_culled(gl, factor, units):
            draw_into(gl, scene, camera, shadow_map, map_size)
        stored = read_depths(gl, shadow_map)
        yield title_of("draw the depth map from the light", scene, light), {title_of("ZS", scene, light): stored}
        points = silhouette_points(scene, light, camera, stored)
        maps_of_lights.append((shadow_map, silhouette_texture(gl, points)))
        yield title_of("store the silhouette", scene, light), {title_of("silhouette points", scene, light): points}

    # pass 2: the camera's picture, first as if all were in shadow
    begin_frame(gl, scene)
    set_camera(gl, scene.camera, size)
    light_ambient_only(gl, scene)
    draw_objects(gl, scene.objects)
    depth = read_depth(gl, size)
    valid = depth < 1
    yield "draw the scene without the light"

    # then whether each pixel sees the light, and the light there
    seen = []
    points = world_points(scene, depth, size)
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
        seen.append(values[..., 3])
        yield (
            title_of("find the quarter of its cell that each point is in", scene, light),
            {
                title_of("quadrants", scene, light): values[..., 0].astype(np.uint8),
                title_of("fall-back", scene, light): valid & (values[..., 1] == 1),
                title_of("unknown", scene, light): valid & unknown(scene, light, camera, points),
            },
        )

        add_light_times(gl, scene, size, light, visibility)
        gl.glDeleteTextures([visibility])
        yield title_of("add the light where the map is not nearer", scene, light), visibility_maps(scene, seen, valid)
    gl.glDeleteTextures([name for names in maps_of_lights for name in names])


def silhouette_texture(gl: Any, points: np.ndarray) -> int:
    """Return a texture of silhouette points (n, n, 3) float32; outside it the middle stands for none."""
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
