"""A polygon in space cut into triangles."""

from collections.abc import Sequence

import numpy as np


def cut_into_triangles(corners: Sequence[Sequence[float]]) -> list[tuple[int, int, int]]:
    """Return len(corners) - 2 triangles of corner numbers that run the way the polygon runs.

    A quad or a convex polygon becomes a fan around its first corner; of another one, ears are cut off (Meisters 1975,
    "Polygons have ears"). A polygon that crosses itself is cut anyway: its outline, hence its volume, stays right.

    Examples
    --------
    >>> cut_into_triangles([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)])
    [(0, 1, 2), (0, 2, 3)]
    >>> cut_into_triangles([(0, 0, 0), (2, -1, 0), (0, 2, 0), (0.5, 0, 0)])
    [(1, 2, 3), (0, 1, 3)]
    """
    points = np.asarray(corners, dtype=np.float64)
    with np.errstate(all="ignore"):  # corners that are not finite are named later, where their vertex is known
        normal = np.cross(points, np.roll(points, -1, axis=0)).sum(axis=0)  # Newell: twice the area
        # seen along the largest component of the normal the polygon is flat, and turns the way its sign says
        axis = int(np.abs(normal).argmax())
        flat = points[:, [(axis + 1) % 3, (axis + 2) % 3]]
        sign = 1.0 if normal[axis] >= 0 else -1.0
        left = list(range(len(points)))
        triangles = []
        while len(left) > 3:
            ear = _ear(flat, left, sign)
            triangles.append((left[ear - 1], left[ear], left[(ear + 1) % len(left)]))
            del left[ear]
    triangles.append((left[0], left[1], left[2]))
    return triangles


def _turn(flat: np.ndarray, a: int, b: int, c: int) -> float:
    (ax, ay), (bx, by), (cx, cy) = flat[a], flat[b], flat[c]
    return float((bx - ax) * (cy - ay) - (by - ay) * (cx - ax))


def _ear(flat: np.ndarray, left: list[int], sign: float) -> int:
    """Return the place in `left` of a corner whose triangle holds none of the other corners."""
    # from the second corner on: a convex polygon becomes the fan that every reader makes
    for place in [*range(1, len(left)), 0]:
        a, b, c = left[place - 1], left[place], left[(place + 1) % len(left)]
        if sign * _turn(flat, a, b, c) <= 0:
            continue
        # a bridge to a hole passes twice through the same point, which is on the triangle but not inside
        others = [p for p in left if not any((flat[p] == flat[q]).all() for q in (a, b, c))]
        if not any(
            sign * _turn(flat, a, b, p) >= 0 and sign * _turn(flat, b, c, p) >= 0 and sign * _turn(flat, c, a, p) >= 0
            for p in others
        ):
            return place
    return 1
