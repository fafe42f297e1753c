"""Casters flattened onto a receiver's plane: the matrix, what is cut away before, the casters themselves after.

A point casts properly only between the receiver's plane and the light. What is behind the plane would cast a false
shadow, what is behind the light an anti-shadow.
"""

from typing import Any

import numpy as np

from softshadow import matrices
from softshadow.scene import Light, Scene, SceneObject
from softshadow.techniques.clipping import clip_to_planes
from softshadow.techniques.drawing import (
    column_major,
    draw_mesh,
    draw_objects,
    draw_polygons,
    light_by,
    object_space,
    read_depth,
    visibility_maps,
    within_cone,
)
from softshadow.techniques.technique import Steps


def shadow_matrix(receiver: SceneObject, light: Light) -> np.ndarray | None:
    """Return the matrix (4, 4) that flattens the world onto a receiver, or None where the light lies in its plane."""
    if receiver.plane is None:
        raise ValueError(f"{receiver.name!r} is not flat: there is no plane to flatten casters onto")
    if receiver.plane @ light.position == 0:
        return None
    return matrices.planar_shadow(receiver.plane, light.position)


def flattened_points(points: np.ndarray, plane: np.ndarray, light: np.ndarray) -> np.ndarray:
    """Return where the rays of a light (4,) through points (..., 3) that cast properly meet a plane (4,)."""
    matrix = matrices.planar_shadow(plane, light)
    homogeneous = points @ matrix[:, :3].T + matrix[:, 3]
    return homogeneous[..., :3] / homogeneous[..., 3:]


def proper_planes(receiver_plane: np.ndarray, light: np.ndarray) -> np.ndarray:
    """Return the planes between which a point casts properly on a receiver: 0 ≤ π·P and, for a point light, π·P ≤ π·Λ.

    Parameters
    ----------
    receiver_plane : (4,)        either orientation
    light : (4,)                 homogeneous, in the same space

    Returns
    -------
    (1 or 2, 4) float64          positive where proper: c₁ = π·P, and c₂ = n·(L − P)
    """
    plane = receiver_plane * np.sign(receiver_plane @ light)
    if light[3] == 0:
        return plane[None]
    return np.array([plane, [*-plane[:3], plane[:3] @ light[:3] / light[3]]])


def draw_flattened(gl: Any, scene: Scene, receiver: SceneObject, light: Light, clip: bool) -> None:
    """Draw all casters flattened onto a receiver, by position alone; `clip` cuts away what does not cast properly."""
    matrix = shadow_matrix(receiver, light)
    if matrix is None:
        return
    gl.glPushMatrix()
    gl.glMultMatrixd(column_major(matrix))
    for caster in scene.casters:
        if caster is receiver:
            continue
        with object_space(gl, caster):
            kept = proper_part(caster, receiver, light) if clip else None
            if kept is None:
                draw_mesh(gl, caster, shaded=False)
            else:
                draw_polygons(gl, kept)
    gl.glPopMatrix()


def proper_part(caster: SceneObject, receiver: SceneObject, light: Light) -> np.ndarray | None:
    """Return the triangles (N, 3, 3) float32 of a caster that cast properly, in its own space; None for all of it."""
    assert receiver.plane is not None
    planes = proper_planes(receiver.plane, light.position) @ caster.object_to_world
    mesh = caster.mesh
    if (mesh.positions @ planes[:, :3].T + planes[:, 3] >= 0).all():
        return None
    triangles = mesh.positions[mesh.triangles].astype(np.float64)
    return np.ascontiguousarray(clip_to_planes(triangles, planes), np.float32)


def draw_the_casters(
    gl: Any, scene: Scene, size: tuple[int, int], on_receiver: np.ndarray, lit: list[np.ndarray]
) -> Steps:
    """Draw everything that is no receiver, lit; visibility is defined on the receivers that are still seen after it."""
    before = read_depth(gl, size)
    light_by(gl, scene, scene.lights, ambient=True)
    draw_objects(gl, others(scene))
    # a nearer caster has changed the depth of its pixels
    valid = on_receiver & (read_depth(gl, size) == before)
    reached = [one * within_cone(scene, light, before, size) for light, one in zip(scene.lights, lit, strict=True)]
    yield "draw the casters", visibility_maps(scene, reached, valid)


def others(scene: Scene) -> list[SceneObject]:
    """Return what is drawn after the shadows: every object that is not a receiver."""
    receivers = scene.receivers
    return [thing for thing in scene.objects if not any(thing is receiver for receiver in receivers)]
