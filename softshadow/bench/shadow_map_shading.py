"""Shading workload: a mesh and a ground, lit per pixel with a shadow map drawn beforehand.

It measures the work per visible pixel: interpolation, map lookups, lighting.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow.bench.depth_maps import DepthMap
from softshadow.bench.meshes import TRIANGLES, torus_over_ground
from softshadow.scene import Scene
from softshadow.techniques.drawing import draw_mesh, object_space, set_camera
from softshadow.testing.timing import DrawFrame

MAP_SIZE = 2048


def prepare(
    gl: Any, size: tuple[int, int], *, program: str, triangles: int = TRIANGLES, map_size: int = MAP_SIZE
) -> DrawFrame:
    """Draw the shadow map; a frame clears the window and draws all objects with the program.

    Parameters
    ----------
    program : "blinn-phong-shadowed" or "blinn-phong-shadowed-5x5"
    """
    scene = torus_over_ground(triangles)
    depth_map = DepthMap(gl, map_size)
    gl.glEnable(gl.GL_DEPTH_TEST)
    depth_map.draw(gl, scene, scene.lights[0])
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
    set_camera(gl, scene.camera, size)
    gl.glClearColor(*scene.background, 1.0)
    gl.glUseProgram(gl.program(program))
    set_light(gl, scene, 1 / map_size)

    def frame() -> None:
        gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
        draw_under_map(gl, scene, depth_map.world_to_map)

    return frame


def set_light(gl: Any, scene: Scene, texel: float) -> None:
    """Set the program's light and map uniforms; the modelview matrix must be the view matrix."""
    world_to_eye = np.asarray(gl.glGetDoublev(gl.GL_MODELVIEW_MATRIX)).T
    gl.glUniform4f(location(gl, "lightPosition"), *map(float, world_to_eye @ scene.lights[0].position))
    gl.glUniform3f(location(gl, "ambient"), *map(float, scene.ambient))
    gl.glUniform3f(location(gl, "diffuse"), 0.8, 0.8, 0.8)
    gl.glUniform3f(location(gl, "specular"), 0.4, 0.4, 0.4)
    for uniform, value in (("shininess", 40.0), ("texel", texel), ("bias", 0.0005)):
        gl.glUniform1f(location(gl, uniform), value)


def draw_under_map(gl: Any, scene: Scene, world_to_map: np.ndarray) -> None:
    """Draw all objects, each with its own matrix from object space to the map."""
    light_matrix = location(gl, "lightMatrix")
    for thing in scene.objects:
        object_to_map = np.ascontiguousarray((world_to_map @ thing.object_to_world).T, np.float32)
        gl.glUniformMatrix4fv(light_matrix, 1, gl.GL_FALSE, object_to_map)
        gl.glColor3f(*map(float, thing.material.color))
        with object_space(gl, thing):
            draw_mesh(gl, thing, shaded=True)


def location(gl: Any, uniform: str) -> int:
    """Return the location of a uniform of the program in use."""
    return int(gl.glGetUniformLocation(int(gl.glGetIntegerv(gl.GL_CURRENT_PROGRAM)), uniform))
