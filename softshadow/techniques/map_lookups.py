"""Pass 2 of every shadow map: how a point in the camera's picture finds its place in the map.

World positions are sent as texture coordinates, and the texture matrix takes them into the map: s and t are the place
in the map, r is the depth to be compared, all divided by q.

References: Segal et al. 1992, "Fast shadows and lighting effects using texture mapping".
"""

from collections.abc import Iterable
from typing import Any

import numpy as np

from softshadow.scene import SceneObject
from softshadow.techniques import drawing
from softshadow.techniques.depth_maps import multiply_light_camera
from softshadow.techniques.light_camera import LightCamera


def set_maps(gl: Any, maps: list[int], cameras: list[LightCamera], bias: float) -> None:
    """Bind a map in each of the first texture units, and set the unit's texture matrix."""
    for unit, (shadow_map, camera) in enumerate(zip(maps, cameras, strict=True)):
        gl.glActiveTexture(gl.GL_TEXTURE0 + unit)
        gl.glBindTexture(gl.GL_TEXTURE_2D, shadow_map)
        set_map_coordinates(gl, camera, bias)
    gl.glActiveTexture(gl.GL_TEXTURE0)


def set_map_coordinates(gl: Any, camera: LightCamera, bias: float) -> None:
    """Set the texture matrix: world space to the map's s, t and depth r, less the bias."""
    gl.glMatrixMode(gl.GL_TEXTURE)
    gl.glLoadIdentity()
    gl.glTranslated(0.5, 0.5, 0.5 - bias)
    gl.glScaled(0.5, 0.5, 0.5)
    multiply_light_camera(gl, camera)
    gl.glMatrixMode(gl.GL_MODELVIEW)


def clear_coordinates(gl: Any, units: int = 1) -> None:
    """Set the texture matrices of the first units back to the identity, their initial value."""
    gl.glMatrixMode(gl.GL_TEXTURE)
    for unit in reversed(range(units)):
        select_unit(gl, unit, units)
        gl.glLoadIdentity()
    gl.glMatrixMode(gl.GL_MODELVIEW)


def select_unit(gl: Any, unit: int, units: int) -> None:
    """Select a texture unit if several are in use."""
    if units > 1:
        gl.glActiveTexture(gl.GL_TEXTURE0 + unit)


def draw_looked_up(
    gl: Any, objects: Iterable[SceneObject], normal_bias: float = 0.0, shaded: bool = False, units: int = 1
) -> None:
    """Draw objects with their world positions as texture coordinates, moved along the normals by `normal_bias`.

    With `shaded`, a light is added: the objects emit nothing. `units`: how many texture units have a matrix that takes
    world positions.
    """
    for thing in objects:
        gl.glMatrixMode(gl.GL_TEXTURE)
        for unit in reversed(range(units)):
            select_unit(gl, unit, units)
            gl.glPushMatrix()
            gl.glMultMatrixd(drawing.column_major(thing.object_to_world))
        gl.glMatrixMode(gl.GL_MODELVIEW)
        with drawing.object_space(gl, thing):
            if shaded:
                drawing.set_material(gl, thing, emission=False)
            drawing.draw_mesh(gl, thing, shaded, texture_coordinates=moved_along_normals(thing, normal_bias))
        gl.glMatrixMode(gl.GL_TEXTURE)
        for unit in reversed(range(units)):
            select_unit(gl, unit, units)
            gl.glPopMatrix()
        gl.glMatrixMode(gl.GL_MODELVIEW)


def moved_along_normals(thing: SceneObject, distance: float) -> np.ndarray:
    """Return an object's vertices (V, 3) float32, in its own space, moved along the normals by a world distance."""
    if distance == 0:
        return thing.mesh.positions
    world_to_object = np.linalg.inv(thing.object_to_world[:3, :3])
    normals = thing.mesh.normals.astype(np.float64) @ world_to_object  # row vectors: the inverse transposed
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return (thing.mesh.positions + distance * normals @ world_to_object.T).astype(np.float32)
