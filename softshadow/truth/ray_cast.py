"""How many casting faces lie between a point and the light: the oracle every shadow technique is compared with.

The number, not just a flag, is what a stencil buffer holds after a volume technique. A segment through an edge that
two faces share crosses exactly one of them: both evaluate the same edge function, once with each sign, and a tie goes
to the face that runs along the edge in ascending order of its end points.
"""

from collections.abc import Sequence
from typing import Literal

import numpy as np

from softshadow.jit import kernel
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
    """Return how many faces of the casters the open segment from each point to the light crosses.

    Parameters
    ----------
    points : (N, 3) float64      world space
    light : (4,) float64         homogeneous, world space; with w = 0 the segment is a ray towards the light
    exclude : (N,), (N,) int     caster and triangle that each point lies on, -1 for none: that face and every face in
                                 its plane do not count (by number: no distance from the point is compared)
    viewer : (3,) float64        the point that all points are seen from. What it sees of an open body may be the side
                                 that looks away from the light: then the point's own face does count
    faces : str                  "casting": of closed bodies the faces that look to the light, of open ones all;
                                 "all"; "front": of all casters the faces that look to the light

    Returns
    -------
    (N,) int32

    Raises
    ------
    ValueError                   wrong shapes, an unknown kind of faces
    """
    if faces not in FACES:
        raise ValueError(f"faces: expected one of {', '.join(FACES)}, got {faces!r}")
    start = _points("points", points)
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
    own = _own_places(exclude, len(start), tree)
    counts = np.zeros(len(start), dtype=np.int32)
    kind = FACES.index(faces)
    _count(start, toward, reach, own, kind, *_arrays(tree), tree.closed, counts)
    if viewer is not None:
        counts += _seen_from_behind(start, toward, np.asarray(viewer, dtype=np.float64), own, kind, tree)
    return counts


def first_faces(
    origins: np.ndarray, directions: np.ndarray, objects: Sequence[SceneObject]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return what each ray meets first.

    Parameters
    ----------
    origins, directions : (N, 3) float64     world space

    Returns
    -------
    objects, triangles : (N,) int32          -1 where the ray meets nothing
    distances : (N,) float64                 in units of the direction, infinite where the ray meets nothing
    """
    start, toward = _points("origins", origins), _points("directions", directions)
    tree = build_tree(objects)
    places = np.full(len(start), NONE, dtype=np.int32)
    distances = np.full(len(start), np.inf)
    _first(start, toward, *_arrays(tree), places, distances)
    met = places != NONE
    return np.where(met, tree.objects[places], NONE), np.where(met, tree.triangles[places], NONE), distances


def _points(key: str, value: np.ndarray) -> np.ndarray:
    array = np.ascontiguousarray(value, dtype=np.float64)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{key}: expected shape (N, 3), got {array.shape}")
    return array


def _arrays(tree: TriangleTree) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    return tree.corners, tree.boxes, tree.flatness


def _own_places(exclude: tuple[np.ndarray, np.ndarray] | None, count: int, tree: TriangleTree) -> np.ndarray:
    """Return the tree place of the face that each point lies on, -1 for none."""
    own = np.full(count, NONE, dtype=np.int32)
    if exclude is not None:
        objects, triangles = (np.asarray(part, dtype=np.int64) for part in exclude)
        if objects.shape != (count,) or triangles.shape != (count,):
            raise ValueError(f"exclude: expected two arrays of shape ({count},)")
        known = objects >= 0
        own[known] = tree.places[tree.starts[objects[known]] + triangles[known]]
    return own


def _seen_from_behind(
    points: np.ndarray, toward: np.ndarray, viewer: np.ndarray, own: np.ndarray, kind: int, tree: TriangleTree
) -> np.ndarray:
    """Return (N,) bool: whether each point's own face casts, and is between the light and the side that is seen."""
    a, b, c = tree.corners[own].transpose(1, 0, 2)  # of points without a face some other face, left out below
    normals = np.cross(b - a, c - a)
    to_light = (normals * toward).sum(axis=1)
    to_viewer = (normals * (viewer - points)).sum(axis=1)
    casts = (to_light > 0) | (kind == ALL) | ((kind == CASTING) & ~tree.closed[own])
    return (own != NONE) & casts & (to_light * to_viewer < 0)


@kernel
def _box_is_met(box, origin, direction, reach):
    """Whether the segment from origin to origin + reach * direction passes the box."""
    if box[0, 0] > box[1, 0]:
        return False  # a leaf without a triangle, or a node above such leaves only
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
def _cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@kernel
def _dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@kernel
def _minus(a, b):
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@kernel
def _ascends(a, b):
    """Whether a comes before b in the order of x, then y, then z."""
    for axis in range(3):
        if a[axis] != b[axis]:
            return a[axis] < b[axis]
    return False


@kernel
def _side(direction, a, b):
    """On which side of the edge a to b the ray from 0 passes: +1 or -1; exactly the opposite for b to a."""
    value = _dot(direction, _cross(a, b))
    if value != 0:
        return 1 if value > 0 else -1
    return 1 if _ascends(a, b) else -1


@kernel
def _crossing(corners, origin, direction):
    """Return (sign, t): +1 for a face that looks along the direction, -1 against it, 0 for a miss."""
    a = _minus(corners[0], origin)
    b = _minus(corners[1], origin)
    c = _minus(corners[2], origin)
    side = _side(direction, a, b)
    if side != _side(direction, b, c) or side != _side(direction, c, a):
        return 0, 0.0
    normal = _cross(_minus(b, a), _minus(c, a))
    slope = _dot(normal, direction)
    if slope == 0:
        return 0, 0.0
    return 1 if slope > 0 else -1, _dot(normal, a) / slope


@kernel
def _in_one_plane(own, corners, flatness):
    """Whether all corners of a face lie in the plane of the face that the point is on."""
    normal = _cross(_minus(own[1], own[0]), _minus(own[2], own[0]))
    limit = flatness * np.sqrt(_dot(normal, normal))
    for corner in range(3):  # noqa: SIM110 - kernels spell out their loops
        if abs(_dot(normal, _minus(corners[corner], own[0]))) > limit:
            return False
    return True


@kernel
def _count(origins, directions, reach, own, faces, corners, boxes, flatness, closed, counts):
    leaves = len(boxes) // 2
    stack = np.empty(128, dtype=np.int64)
    for ray in range(len(origins)):
        origin, direction = origins[ray], directions[ray]
        stack[0] = 1
        top = 1
        while top > 0:
            top -= 1
            node = stack[top]
            if not _box_is_met(boxes[node], origin, direction, reach):
                continue
            if node < leaves:
                stack[top] = 2 * node
                stack[top + 1] = 2 * node + 1
                top += 2
                continue
            face = node - leaves
            sign, t = _crossing(corners[face], origin, direction)
            if sign == 0 or not 0 < t < reach:
                continue
            if sign < 0 and (faces == FRONT or (faces == CASTING and closed[face])):
                continue
            mine = own[ray]
            if mine >= 0 and (face == mine or _in_one_plane(corners[mine], corners[face], flatness[mine])):
                continue
            counts[ray] += 1


@kernel
def _first(origins, directions, corners, boxes, flatness, places, distances):
    leaves = len(boxes) // 2
    stack = np.empty(128, dtype=np.int64)
    for ray in range(len(origins)):
        origin, direction = origins[ray], directions[ray]
        stack[0] = 1
        top = 1
        while top > 0:
            top -= 1
            node = stack[top]
            if not _box_is_met(boxes[node], origin, direction, distances[ray]):
                continue
            if node < leaves:
                stack[top] = 2 * node
                stack[top + 1] = 2 * node + 1
                top += 2
                continue
            sign, t = _crossing(corners[node - leaves], origin, direction)
            if sign != 0 and 0 < t < distances[ray]:
                places[ray] = node - leaves
                distances[ray] = t
