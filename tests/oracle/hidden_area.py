"""The area that triangles hide of a rectangular light, by vertical strips instead of by cutting polygons."""

from itertools import pairwise

import numpy as np


def hidden_share(point: np.ndarray, corners: np.ndarray, triangles: np.ndarray) -> float:
    """Return the share of a light that triangles (T, 3, 3) hide from a point.

    The triangles lie between the point's and the light's plane. Their images on the light are cut at every corner and
    crossing into strips, in which the hidden height is linear, so that its value in the middle gives the area.

    Parameters
    ----------
    corners : (4, 3)             of the light, in order
    """
    origin, u, v = corners[0], corners[1] - corners[0], corners[3] - corners[0]
    normal = np.cross(u, v)
    rays = triangles - point
    images = point + rays * (((origin - point) @ normal) / (rays @ normal))[..., None] - origin
    polygons = np.stack([images @ u / (u @ u), images @ v / (v @ v)], axis=-1)
    edges = np.concatenate([polygons, np.roll(polygons, -1, axis=1)], axis=2).reshape(-1, 2, 2)
    walls = np.array([[[0, 0], [1, 0]], [[0, 1], [1, 1]]], float)
    cuts = np.unique(np.clip([0, 1, *polygons[..., 0].ravel(), *crossings(np.concatenate([edges, walls]))], 0, 1))
    area = 0.0
    for left, right in pairwise(cuts):
        area += (right - left) * hidden_height((left + right) / 2, polygons)
    return area


def cross(a: np.ndarray, b: np.ndarray) -> float:
    """Return the cross product of two vectors in the plane."""
    return float(a[0] * b[1] - a[1] * b[0])


def crossings(edges: np.ndarray) -> list[float]:
    """Return the x at which edges (E, 2, 2) cross each other."""
    places = []
    for i, (a, b) in enumerate(edges):
        for c, d in edges[:i]:
            across = cross(b - a, d - c)
            if across:
                t = cross(c - a, d - c) / across
                s = cross(c - a, b - a) / across
                if 0 <= t <= 1 and 0 <= s <= 1:
                    places.append(a[0] + t * (b - a)[0])
    return places


def hidden_height(x: float, polygons: np.ndarray) -> float:
    """Return the length of the union of triangles (T, 3, 2) on the line at x, between y = 0 and y = 1."""
    intervals = []
    for polygon in polygons:
        heights = [
            a[1] + (x - a[0]) / (b[0] - a[0]) * (b[1] - a[1])
            for a, b in zip(polygon, np.roll(polygon, -1, axis=0), strict=True)
            if min(a[0], b[0]) < x < max(a[0], b[0])
        ]
        if heights:
            intervals.append((max(min(heights), 0.0), min(max(heights), 1.0)))
    total, end = 0.0, 0.0
    for low, high in sorted(intervals):
        total += max(high - max(low, end), 0.0)
        end = max(end, high)
    return total
