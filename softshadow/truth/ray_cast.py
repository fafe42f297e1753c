"""Count the casting faces between a point and the light: the oracle that every shadow technique is compared with.

The result is a number, as in the stencil buffer after a volume technique. A segment through an edge that two faces
share crosses exactly one of them: both evaluate the same edge function with opposite signs. If it is 0, the segment's
direction counts as turned by an infinitesimal towards x, and by smaller ones towards y and z. As this is the same turn
for all edges, a segment that runs along a face, from edge to edge, also crosses exactly one of the faces beside it.

References
----------
Edelsbrunner & Mücke 1990, "Simulation of simplicity".
"""

from collections.abc import Sequence
from typing import Literal

import numpy as np

from softshadow.jit import allocating_kernel, kernel
from softshadow.scene import SceneObject
from softshadow.truth.triangle_tree import TriangleTree, build_tree

Faces = Literal["casting", "all", "front"]
FACES: tuple[Faces, ...] = ("casting", "all", "front")
CASTING, ALL, FRONT = range(3)
NONE = -1


def casting_faces_between(
    points: np.ndarray,
    light: np.ndarray,
    casters: Sequence[SceneObject],
    *,
    exclude: tuple[np.ndarray, np.ndarray] | None = None,
    viewer: np.ndarray | None = None,
    faces: Faces = "casting",
) -> np.ndarray:
    """Return the number of casters' faces that the open segment from each point to the light crosses.

    Parameters
    ----------
    points : (N, 3) float64      world space
    light : (4,) float64         homogeneous, world space; with w = 0 the segment is a ray towards the light
    exclude : (N,), (N,) int     caster and triangle that each point lies on, -1 for none: that triangle, and all in
                                 its plane, are not counted (no distance from the point is involved)
    viewer : (3,) float64        the eye. If it sees the side of an open body that faces away from the light, the
                                 point's own face is counted
    faces : str                  "casting": faces of closed bodies that face the light, and all faces of open bodies;
                                 "all": all faces; "front": all faces that face the light

    Returns
    -------
    (N,) int32

    Raises
    ------
    ValueError                   wrong shapes, an unknown value of `faces`
    """
    if faces not in FACES:
        raise ValueError(f"faces: expected one of {', '.join(FACES)}, got {faces!r}")
    start = checked_points("points", points)
    homogeneous = np.asarray(light, dtype=np.float64)
    if homogeneous.shape != (4,):
        raise ValueError(f"light: expected four numbers x, y, z, w, got shape {homogeneous.shape}")
    if not casters:
        return np.zeros(len(start), dtype=np.int32)
    if homogeneous[3]:
        toward = homogeneous[:3] / homogeneous[3] - start
        reach = 1.0
    else:
        toward = np.tile(homogeneous[:3], (len(start), 1))
        reach = np.inf
    tree = build_tree(casters)
    own = own_leaves(exclude, len(start), tree)
    counts = np.zeros(len(start), dtype=np.int32)
    kind = FACES.index(faces)
    _count_faces(start, toward, reach, own, kind, *_arrays(tree), tree.closed, counts)
    if viewer is not None:
        counts += _own_face_counts(start, toward, np.asarray(viewer, dtype=np.float64), own, kind, tree)
    return counts


def first_faces(
    origins: np.ndarray, directions: np.ndarray, objects: Sequence[SceneObject]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the first face that each ray hits.

    Parameters
    ----------
    origins, directions : (N, 3) float64     world space

    Returns
    -------
    objects, triangles : (N,) int32          -1 if the ray hits nothing
    distances : (N,) float64                 in units of the direction's length, infinite if the ray hits nothing
    """
    start, toward = checked_points("origins", origins), checked_points("directions", directions)
    tree = build_tree(objects)
    leaves = np.full(len(start), NONE, dtype=np.int32)
    distances = np.full(len(start), np.inf)
    _find_first_faces(start, toward, *_arrays(tree), leaves, distances)
    hit = leaves != NONE
    return np.where(hit, tree.objects[leaves], NONE), np.where(hit, tree.triangles[leaves], NONE), distances


def checked_points(key: str, value: np.ndarray) -> np.ndarray:
    """Return points (N, 3) as float64, or raise a ValueError that names them.

    A read-only array is copied: kernels would be compiled for it once more.
    """
    array = np.require(value, np.float64, ["C", "W"])
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{key}: expected shape (N, 3), got {array.shape}")
    return array


def _arrays(tree: TriangleTree) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    return tree.corners, tree.boxes, tree.flatness


def own_leaves(exclude: tuple[np.ndarray, np.ndarray] | None, n_points: int, tree: TriangleTree) -> np.ndarray:
    """Return (N,) int32: the leaf of the triangle that each point lies on, -1 for none."""
    own = np.full(n_points, NONE, dtype=np.int32)
    if exclude is not None:
        objects, triangles = (np.asarray(part, dtype=np.int64) for part in exclude)
        if objects.shape != (n_points,) or triangles.shape != (n_points,):
            raise ValueError(
                f"exclude: expected two arrays of shape ({n_points},), got {objects.shape} and {triangles.shape}"
            )
        is_on_face = objects >= 0
        own[is_on_face] = tree.leaves[tree.starts[objects[is_on_face]] + triangles[is_on_face]]
    return own


def _own_face_counts(
    points: np.ndarray, toward: np.ndarray, viewer: np.ndarray, own: np.ndarray, kind: int, tree: TriangleTree
) -> np.ndarray:
    """Return (N,) bool: whether each point's own face casts and lies between the light and the side that is seen."""
    a, b, c = tree.corners[own].transpose(1, 0, 2)  # points without a face get any face, and are masked below
    normals = np.cross(b - a, c - a)
    to_light = (normals * toward).sum(axis=1)
    to_viewer = (normals * (viewer - points)).sum(axis=1)
    casts = (to_light > 0) | (kind == ALL) | ((kind == CASTING) & ~tree.closed[own])
    return (own != NONE) & casts & (to_light * to_viewer < 0)


@kernel
def _segment_meets_box(box, origin, direction, reach):
    """Return whether the segment from origin to origin + reach * direction meets the box."""
    if box[0, 0] > box[1, 0]:
        return False  # an empty leaf, or a node with empty leaves only
    near, far = 0.0, reach
    for axis in range(3):
        if direction[axis] == 0:
            if origin[axis] < box[0, axis] or origin[axis] > box[1, axis]:
                return False
        else:
            t0 = (box[0, axis] - origin[axis]) / direction[axis]
            t1 = (box[1, axis] - origin[axis]) / direction[axis]
            near = max(near, min(t0, t1))
            far = min(far, max(t0, t1))
    return near <= far


@kernel
def cross(a, b):
    """Return the cross product of two vectors as a tuple."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@kernel
def dot(a, b):
    """Return the dot product of two vectors."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@kernel
def difference(a, b):
    """Return a - b as a tuple."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@kernel
def is_before(a, b):
    """Return whether a comes before b in the order of x, then y, then z."""
    for axis in range(3):
        if a[axis] != b[axis]:
            return a[axis] < b[axis]
    return False


@kernel
def is_turned_inside(normal, a, b):
    """Return whether a ray through the edge a to b counts as passing on the side where a x b is positive.

    `normal` is a x b. It is 0 where the ray's origin is in line with the edge: there the order of the points decides.
    """
    for axis in range(3):
        if normal[axis] != 0:
            return normal[axis] > 0
    return is_before(a, b)


@kernel
def _side(direction, a, b):
    """Return on which side of the edge a to b the ray from 0 passes, +1 or -1; always the opposite for b to a."""
    normal = cross(a, b)
    value = dot(direction, normal)
    if value != 0:
        return 1 if value > 0 else -1
    return 1 if is_turned_inside(normal, a, b) else -1


@kernel
def _crossing(corners, origin, direction):
    """Return (sign, t): +1 if the face's normal points along the direction, -1 if against it, 0 for a miss."""
    a = difference(corners[0], origin)
    b = difference(corners[1], origin)
    c = difference(corners[2], origin)
    side = _side(direction, a, b)
    if side != _side(direction, b, c) or side != _side(direction, c, a):
        return 0, 0.0
    normal = cross(difference(b, a), difference(c, a))
    slope = dot(normal, direction)
    if slope == 0:
        return 0, 0.0
    return 1 if slope > 0 else -1, dot(normal, a) / slope


@kernel
def in_one_plane(own, corners, flatness):
    """Return whether all corners of a face lie in the plane of the point's own face."""
    normal = cross(difference(own[1], own[0]), difference(own[2], own[0]))
    limit = flatness * np.sqrt(dot(normal, normal))
    for corner in range(3):  # noqa: SIM110 - kernels spell out their loops
        if abs(dot(normal, difference(corners[corner], own[0]))) > limit:
            return False
    return True


@allocating_kernel
def _count_faces(origins, directions, reach, own, faces, corners, boxes, flatness, closed, counts):
    first_leaf = len(boxes) // 2
    stack = np.empty(128, dtype=np.int64)
    for ray in range(len(origins)):
        origin, direction = origins[ray], directions[ray]
        stack[0] = 1
        top = 1
        while top > 0:
            top -= 1
            node = stack[top]
            if not _segment_meets_box(boxes[node], origin, direction, reach):
                continue
            if node < first_leaf:
                stack[top] = 2 * node
                stack[top + 1] = 2 * node + 1
                top += 2
                continue
            face = node - first_leaf
            sign, t = _crossing(corners[face], origin, direction)
            if sign == 0 or not 0 < t < reach:
                continue
            if sign < 0 and (faces == FRONT or (faces == CASTING and closed[face])):
                continue
            own_face = own[ray]
            if own_face >= 0 and (
                face == own_face or in_one_plane(corners[own_face], corners[face], flatness[own_face])
            ):
                continue
            counts[ray] += 1


@allocating_kernel
def _find_first_faces(origins, directions, corners, boxes, flatness, leaves, distances):
    first_leaf = len(boxes) // 2
    stack = np.empty(128, dtype=np.int64)
    for ray in range(len(origins)):
        origin, direction = origins[ray], directions[ray]
        stack[0] = 1
        top = 1
        while top > 0:
            top -= 1
            node = stack[top]
            if not _segment_meets_box(boxes[node], origin, direction, distances[ray]):
                continue
            if node < first_leaf:
                stack[top] = 2 * node
                stack[top + 1] = 2 * node + 1
                top += 2
                continue
            sign, t = _crossing(corners[node - first_leaf], origin, direction)
            if sign != 0 and 0 < t < distances[ray]:
                leaves[ray] = node - first_leaf
                distances[ray] = t
