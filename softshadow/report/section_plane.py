"""The plane of a section: coordinates in it, what it cuts out of a light, and how much of that a point sees."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from softshadow.report.cut import cut_triangles
from softshadow.scene import Disc, Light, Rectangle, Segment

NEARLY = 1e-9  # sine of an angle that counts as 0, and a share of a line that does


@dataclass(frozen=True)
class SectionPlane:
    """The plane of a section.

    Attributes
    ----------
    origin : (3,) float64        of the coordinates, world space
    axes : (2, 3) float64        the directions x and y in world space
    normal : (3,) float64        unit length
    """

    origin: np.ndarray
    axes: np.ndarray
    normal: np.ndarray

    def project(self, points: np.ndarray) -> np.ndarray:
        """Return the coordinates (..., 2) of world points (..., 3)."""
        projected: np.ndarray = (points - self.origin) @ self.axes.T
        return projected

    def cut(self, triangles: np.ndarray) -> np.ndarray:
        """Return the segments (N, 2, 2) in which the plane cuts world triangles (T, 3, 3)."""
        return self.project(cut_triangles(triangles, self.origin, self.normal))


def ends_of_light(light: Light, plane: SectionPlane, middle: np.ndarray) -> np.ndarray:
    """Return the ends (2, 2) of what the plane cuts out of a light; of a sphere its diameter across the view."""
    center, shape = np.zeros(2), light.shape
    if shape is None:
        return np.stack([center, center])
    if isinstance(shape, Segment):
        in_plane = abs(shape.edge @ plane.normal) <= NEARLY * np.linalg.norm(shape.edge)
        return plane.project(light.position[:3] + shape.corners) if in_plane else np.stack([center, center])
    if isinstance(shape, Rectangle | Disc):
        u, v = shape.half_axes
        direction = np.cross(np.cross(u, v), plane.normal)
        if np.linalg.norm(direction) > NEARLY * np.linalg.norm(u) * np.linalg.norm(v):
            direction /= np.linalg.norm(direction)
            a, b = direction @ u / (u @ u), direction @ v / (v @ v)
            half = 1 / max(abs(a), abs(b)) if isinstance(shape, Rectangle) else shape.radius
            return plane.project(light.position[:3] + np.outer([-half, half], direction))
    across = plane.project(middle) @ np.array([[0.0, 1.0], [-1.0, 0.0]])
    half = shape.bounding_radius / np.linalg.norm(across) if across.any() else 0.0
    return np.stack([-half * across, half * across])


def visible_share(place: np.ndarray, ends: np.ndarray, blockers: np.ndarray) -> float:
    """Return the share of a line light that a point of the plane sees past blockers, exactly.

    Parameters
    ----------
    place : (2,)
    ends : (2, 2)                of the light; both equal for a point, whose share is 0 or 1
    blockers : (N, 2, 2)         segments
    """
    axis = ends[1] - ends[0]
    if not axis.any():
        axis = 1e-9 * np.array([-(ends[0] - place)[1], (ends[0] - place)[0]])  # a point, as a very short line
        ends = np.stack([ends[0] - axis / 2, ends[0] + axis / 2])
    across = np.array([-axis[1], axis[0]])
    height = float((ends[0] - place) @ across)
    if height == 0 or not len(blockers):
        return 1.0
    # heights of the blockers' ends: 0 at the place, 1 at the light's line; what is not in between hides nothing
    heights = (blockers - place) @ across / height
    hidden = []
    for (a, b), (low, high) in zip(blockers, heights, strict=True):
        if low > high:
            a, b, low, high = b, a, high, low
        if high <= NEARLY or low >= 1 or (high == low and not NEARLY < low < 1):
            continue
        slope = (b - a) / (high - low) if high > low else np.zeros(2)
        first, last = max(low, NEARLY), min(high, 1.0)
        pair = [a + (first - low) * slope, a + (last - low) * slope] if high > low else [a, b]
        levels = [first, last] if high > low else [low, low]
        along = [
            float((place + (end - place) / level - ends[0]) @ axis / (axis @ axis))
            for end, level in zip(pair, levels, strict=True)
        ]
        hidden.append((max(min(along), 0.0), min(max(along), 1.0)))
    covered, reached = 0.0, 0.0
    for start, end in sorted(hidden):
        covered += max(0.0, end - max(start, reached))
        reached = max(reached, end)
    return 1.0 - covered
