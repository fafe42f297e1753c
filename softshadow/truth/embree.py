"""Visibility of a light by Intel's Embree: other code, in float32, as a check of this package's own rays."""

import numpy as np

from softshadow.scene import Light, Sphere
from softshadow.truth.triangle_tree import TriangleTree

RAYS = 1 << 20  # at once: some 100 MB


def visible_samples(
    points: np.ndarray, light: Light, tree: TriangleTree, own: np.ndarray, viewer: np.ndarray | None, sets: np.ndarray
) -> np.ndarray:
    """Return the share of the samples that each point sees, (N,) float64.

    Rays go from the light to the point. The point sees the sample if they hit nothing, or first of all its own face or
    one in its plane: no distance from the point is involved.

    Parameters
    ----------
    own : (N,) int               leaf of the triangle that each point lies on, -1 for none
    sets : (S, n, 2) float64     places on the light from -1 to 1; point i sees set i modulo S

    Raises
    ------
    ModuleNotFoundError          embreex is not installed
    """
    try:
        from embreex.mesh_construction import TriangleMesh
        from embreex.rtcore_scene import EmbreeScene
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError(
            "method=\"embree\" needs embreex: pip install 'softshadow[truth]'", name=error.name
        ) from None
    scene = EmbreeScene()
    TriangleMesh(scene, tree.corners.astype(np.float32))
    n_samples = sets.shape[1]
    share = np.empty(len(points))
    for first in range(0, len(points), max(1, RAYS // n_samples)):
        part = slice(first, first + max(1, RAYS // n_samples))
        a, b = np.moveaxis(sets[np.arange(first, first + len(points[part])) % len(sets)], 2, 0)[..., None]
        center, u, v = (axis[:, None] for axis in _seen_axes(points[part], light))
        to_light = np.asarray(center + a * u + b * v).reshape(-1, 3)
        target = np.repeat(points[part], n_samples, axis=0)
        ends = np.ones(len(target), np.float32)
        hits = scene.run((target + to_light).astype(np.float32), (-to_light).astype(np.float32), ends)
        leaves = np.repeat(own[part], n_samples)
        sees = (hits < 0) | _in_plane(hits, leaves, tree)
        if viewer is not None:
            sees &= ~_is_behind_own_face(target, to_light, viewer, leaves, tree)
        share[part] = sees.reshape(-1, n_samples).mean(axis=1)
    return share


def _seen_axes(points: np.ndarray, light: Light) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the directions (N, 3) from each point to the centre of the light, and its axes u and v (N, 3)."""
    assert light.shape is not None
    center = light.position[:3] - points
    if not isinstance(light.shape, Sphere):
        u, v = light.shape.half_axes
        return center, np.broadcast_to(u, center.shape), np.broadcast_to(v, center.shape)
    distance = np.linalg.norm(center, axis=1, keepdims=True)
    # the disc of the ball's outline; a point inside the ball gets one without size, and sees the centre
    is_outside = distance > light.shape.radius
    square = np.where(is_outside, distance**2 - light.shape.radius**2, np.inf)
    outline = light.shape.radius * distance / np.sqrt(square)
    u = np.cross(np.eye(3)[np.abs(center).argmin(axis=1)], center)
    u *= outline / np.linalg.norm(u, axis=1, keepdims=True)
    return center, u, np.cross(center, u) / distance


def _in_plane(hits: np.ndarray, own: np.ndarray, tree: TriangleTree) -> np.ndarray:
    """Return whether each ray hits the point's own face or one in its plane."""
    found = (hits >= 0) & (own >= 0)
    a, b, c = tree.corners[own[found]].transpose(1, 0, 2)
    normals = np.cross(b - a, c - a)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    heights = np.einsum("nkc,nc->nk", tree.corners[hits[found]] - a[:, None], normals)
    is_in = np.zeros(len(hits), bool)
    is_in[found] = (hits[found] == own[found]) | (np.abs(heights).max(axis=1) <= tree.flatness[own[found]])
    return is_in


def _is_behind_own_face(
    points: np.ndarray, to_light: np.ndarray, viewer: np.ndarray, own: np.ndarray, tree: TriangleTree
) -> np.ndarray:
    """Return whether each point's own face casts and lies between the light and the side that the viewer sees."""
    a, b, c = tree.corners[own].transpose(1, 0, 2)
    normals = np.cross(b - a, c - a)
    light_side = (normals * to_light).sum(axis=1)
    viewer_side = (normals * (viewer - points)).sum(axis=1)
    return (own >= 0) & (light_side * viewer_side < 0) & ((light_side > 0) | ~tree.closed[own])
