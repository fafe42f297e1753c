"""Casters flattened onto a receiver's plane: the matrix, the clipping before, and the casters themselves after.

Only points between the receiver's plane and the light cast properly. Points behind the plane would cast a false shadow,
points behind the light an anti-shadow.
"""

from typing import Any

import numpy as np

from softshadow import matrices
from softshadow.scene import Light, Scene, SceneObject
from softshadow.techniques import drawing
from softshadow.techniques.clipping import clip_to_planes_with_sources
from softshadow.techniques.technique import Steps


def shadow_matrix(receiver: SceneObject, light: Light) -> np.ndarray | None:
    """Return the matrix (4, 4) that flattens the world onto a receiver, or None if the light lies in its plane."""
    if receiver.plane is None:
        raise ValueError(f"{receiver.name!r} is not flat: expected a receiver with a plane to flatten casters onto")
    if receiver.plane @ light.position == 0:
        return None
    return matrices.planar_shadow(receiver.plane, light.position)


def flattened_points(points: np.ndarray, plane: np.ndarray, light: np.ndarray) -> np.ndarray:
    """Return where rays from a light (4,) through points (..., 3) that cast properly meet a plane (4,)."""
    matrix = matrices.planar_shadow(plane, light)
    homogeneous = points @ matrix[:, :3].T + matrix[:, 3]
    return homogeneous[..., :3] / homogeneous[..., 3:]


def proper_planes(receiver_plane: np.ndarray, light: np.ndarray) -> np.ndarray:
    """Return the planes between which points cast properly: 0 ≤ π·P and, for a point light, π·P ≤ π·Λ.

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
    """Draw all casters flattened onto a receiver; `clip` cuts away the parts that do not cast properly."""
    matrix = shadow_matrix(receiver, light)
    if matrix is None:
        return
    gl.glPushMatrix()
    gl.glMultMatrixd(drawing.column_major(matrix))
    for caster in scene.casters:
        if caster is receiver:
            continue
        with drawing.object_space(gl, caster):
            proper = proper_part(caster, receiver, light) if clip else None
            triangles, faces = (None, None) if proper is None else proper
            with drawing.made_of(gl, "flattened face", "face", faces, [caster]):
                if triangles is None:
                    drawing.draw_mesh(gl, caster, shaded=False)
                else:
                    drawing.draw_polygons(gl, triangles)
    gl.glPopMatrix()


def proper_part(caster: SceneObject, receiver: SceneObject, light: Light) -> tuple[np.ndarray, np.ndarray] | None:
    """Return the part of a caster that casts properly, None if all of it does.

    Returns
    -------
    (N, 3, 3) float32            in its own space
    (N,) int                     the face that each triangle is a part of
    """
    assert receiver.plane is not None
    planes = proper_planes(receiver.plane, light.position) @ caster.object_to_world
    mesh = caster.mesh
    if (mesh.positions @ planes[:, :3].T + planes[:, 3] >= 0).all():
        return None
    triangles = mesh.positions[mesh.triangles].astype(np.float64)
    parts, faces = clip_to_planes_with_sources(triangles, planes)
    return np.ascontiguousarray(parts, np.float32), faces


def draw_the_casters(
    gl: Any, scene: Scene, size: tuple[int, int], on_receiver: np.ndarray, lit: list[np.ndarray]
) -> Steps:
    """Draw all objects but the receivers, with all lights.

    Visibility is defined where a receiver is still seen afterwards.
    """
    before = drawing.read_depth(gl, size)
    drawing.light_by(gl, scene, scene.lights, ambient=True)
    drawing.draw_objects(gl, others(scene))
    # a nearer caster has changed the depth of its pixels
    valid = on_receiver & (drawing.read_depth(gl, size) == before)
    cones = [drawing.within_cone(scene, light, before, size) for light in scene.lights]
    yield (
        "draw the casters",
        drawing.visibility_maps(scene, [pixels * cone for pixels, cone in zip(lit, cones, strict=True)], valid),
    )


def others(scene: Scene) -> list[SceneObject]:
    """Return the objects that are drawn after the shadows, which are not receivers."""
    receivers = scene.receivers
    return [thing for thing in scene.objects if not any(thing is receiver for receiver in receivers)]
