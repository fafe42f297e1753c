"""Triangulation of a polygon in space."""

from collections.abc import Sequence

import numpy as np


def triangulate(corners: Sequence[Sequence[float]]) -> list[tuple[int, int, int]]:
    """Return len(corners) - 2 triangles of corner numbers, wound like the polygon.

    A convex polygon becomes a fan around its first corner; any other is triangulated by ear clipping (Meisters 1975,
    "Polygons have ears"). The triangles of a polygon that crosses itself overlap, but its outline, and therefore its
    shadow volume, is right.

    Examples
    --------
    >>> triangulate([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)])
    [(0, 1, 2), (0, 2, 3)]
    >>> triangulate([(0, 0, 0), (2, -1, 0), (0, 2, 0), (0.5, 0, 0)])
    [(1, 2, 3), (0, 1, 3)]
    """
    points = np.asarray(corners, dtype=np.float64)
    with np.errstate(all="ignore"):  # Mesh reports corners that are not finite, with the vertex
        normal = np.cross(points, np.roll(points, -1, axis=0)).sum(axis=0)  # Newell: twice the area
        # projected along the largest component of the normal, whose sign gives the winding
        axis = int(np.abs(normal).argmax())
        flat = points[:, [(axis + 1) % 3, (axis + 2) % 3]]
        sign = 1.0 if normal[axis] >= 0 else -1.0
        remaining = list(range(len(points)))
        triangles = []
        while len(remaining) > 3:
            ear = _ear(flat, remaining, sign)
            triangles.append((remaining[ear - 1], remaining[ear], remaining[(ear + 1) % len(remaining)]))
            del remaining[ear]
    triangles.append((remaining[0], remaining[1], remaining[2]))
    return triangles


def quads_are_fans(quads: np.ndarray) -> np.ndarray:
    """Return for quadrilaterals (N, 4, 3) float64 whether `triangulate` cuts them into (0, 1, 2) and (0, 2, 3).

    The same operations as there, for all at a time: corner 1 is an ear, the first that is tried.
    """
    with np.errstate(all="ignore"):
        crosses = np.cross(quads, np.roll(quads, -1, axis=1))
        normal = crosses[:, 0] + crosses[:, 1] + crosses[:, 2] + crosses[:, 3]
        axis, row = np.abs(normal).argmax(axis=1), np.arange(len(quads))
        sign = np.where(normal[row, axis] >= 0, 1.0, -1.0)
        x, y = (np.take_along_axis(quads, ((axis + n) % 3)[:, None, None], axis=2)[..., 0] for n in (1, 2))

        def turn(a: int, b: int, c: int) -> np.ndarray:
            doubled = (x[:, b] - x[:, a]) * (y[:, c] - y[:, a]) - (y[:, b] - y[:, a]) * (x[:, c] - x[:, a])
            return np.asarray(sign * doubled)

        within = (turn(0, 1, 3) >= 0) & (turn(1, 2, 3) >= 0) & (turn(2, 0, 3) >= 0)
        twice = ((x[:, 3:] == x[:, :3]) & (y[:, 3:] == y[:, :3])).any(axis=1)
        # not `> 0`: where there is no ear at all, or areas are NaN, the same corner is cut off
        first: np.ndarray = ~(turn(0, 1, 2) <= 0) & (~within | twice)
    return first


def _doubled_areas(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> np.ndarray:
    """Return twice the signed areas of triangles, the corners (..., 2)."""
    areas: np.ndarray = (b[..., 0] - a[..., 0]) * (c[..., 1] - a[..., 1]) - (b[..., 1] - a[..., 1]) * (
        c[..., 0] - a[..., 0]
    )
    return areas


def _ear(flat: np.ndarray, remaining: list[int], sign: float) -> int:
    """Return the index in `remaining` of a convex corner whose triangle contains none of the other corners."""
    points = flat[remaining]
    before, after = np.roll(points, 1, axis=0), np.roll(points, -1, axis=0)
    is_convex = ~(sign * _doubled_areas(before, points, after) <= 0)
    # starts at the second corner, so that a convex polygon becomes a fan around the first
    for place in np.roll(np.flatnonzero(is_convex), -int(is_convex[0])).tolist():
        a, b, c = before[place], points[place], after[place]
        # a bridge to a hole visits a point twice: its copy lies on the triangle, but not inside
        is_corner = (points == a).all(axis=1) | (points == b).all(axis=1) | (points == c).all(axis=1)
        within = (
            (sign * _doubled_areas(a, b, points) >= 0)
            & (sign * _doubled_areas(b, c, points) >= 0)
            & (sign * _doubled_areas(c, a, points) >= 0)
        )
        if not (within & ~is_corner).any():
            return int(place)
    return 1
