"""The plane that a polygon is tessellated in, and polygons that need no sweep (libtess, normal.c and render.c)."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from softshadow.tessellation.half_edges import Mesh

Vector = tuple[float, float, float]
NO_NORMAL: Vector = (0.0, 0.0, 0.0)
Coordinates = Sequence[Sequence[float]]


def project(mesh: Mesh, normal: Vector) -> None:
    """Set s and t of all vertices: two of their coordinates, without the longest one of the normal.

    Without a normal it is computed, and the plane is turned so that the contours have a positive area.
    """
    is_given = normal != NO_NORMAL
    if not is_given:
        normal = _plane_normal([vertex.coords for vertex in mesh.all_vertices()])
    axis = _long_axis(normal)
    across, up = (axis + 1) % 3, (axis + 2) % 3
    sign = 1.0 if normal[axis] > 0 else -1.0
    for vertex in mesh.all_vertices():
        vertex.s, vertex.t = vertex.coords[across], sign * vertex.coords[up]
    if is_given:
        return
    area = 0.0
    for face in mesh.all_faces():
        if face.edge.winding > 0:
            for edge in face.edge.around_left_face():
                area += (edge.org.s - edge.dst.s) * (edge.org.t + edge.dst.t)
    if area < 0:
        for vertex in mesh.all_vertices():
            vertex.t = -vertex.t


def _long_axis(v: Sequence[float]) -> int:
    axis = 1 if abs(v[1]) > abs(v[0]) else 0
    return 2 if abs(v[2]) > abs(v[axis]) else axis


def _plane_normal(points: Coordinates) -> Vector:
    """Return the normal of the largest triangle of the two points that are farthest apart on an axis, and a third."""
    if not points:
        return 0.0, 0.0, 1.0
    lowest = [min(points, key=lambda point, i=axis: point[i]) for axis in range(3)]  # type: ignore[misc]
    highest = [max(points, key=lambda point, i=axis: point[i]) for axis in range(3)]  # type: ignore[misc]
    extents = [highest[axis][axis] - lowest[axis][axis] for axis in range(3)]
    axis = 1 if extents[1] > extents[0] else 0
    axis = 2 if extents[2] > extents[axis] else axis
    if extents[axis] <= 0:
        return 0.0, 0.0, 1.0
    low, high = lowest[axis], highest[axis]
    first = _difference(low, high)
    largest, normal = 0.0, NO_NORMAL
    for point in points:
        candidate = _cross(first, _difference(point, high))
        length = candidate[0] * candidate[0] + candidate[1] * candidate[1] + candidate[2] * candidate[2]
        if length > largest:
            largest, normal = length, candidate
    if largest <= 0:  # all points lie on a line
        long = _long_axis(first)
        return (float(long == 0), float(long == 1), float(long == 2))
    return normal


def convex_sign(points: Coordinates, normal: Vector) -> int | None:
    """Return 1 for a contour that turns counter-clockwise, seen along the normal, -1 clockwise, 0 without area.

    None if it turns both ways, seen from its first point.
    """
    steps = [_difference(point, points[0]) for point in points[1:]]
    turns = [_cross(before, after) for before, after in pairwise(steps)]
    if normal == NO_NORMAL:
        x = y = z = 0.0
        for turn in turns:
            sign = 1.0 if turn[0] * x + turn[1] * y + turn[2] * z >= 0 else -1.0
            x, y, z = x + sign * turn[0], y + sign * turn[1], z + sign * turn[2]
        normal = x, y, z
    dots = [turn[0] * normal[0] + turn[1] * normal[1] + turn[2] * normal[2] for turn in turns]
    if any(dot > 0 for dot in dots):
        return None if any(dot < 0 for dot in dots) else 1
    return -1 if any(dot < 0 for dot in dots) else 0


def _difference(a: Sequence[float], b: Sequence[float]) -> Vector:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def _cross(a: Vector, b: Vector) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
