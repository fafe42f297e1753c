"""Triangles that clipping has cut away at a pixel: the line of sight meets them outside the near or the far plane.

The other planes of the frustum need not be asked: a pixel inside the viewport is inside them.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from softshadow.framebuffer import Framebuffer
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.geometry.draw_primitives import triangles_of
from softshadow.pipeline.geometry.geometry import positions_of
from softshadow.pipeline.geometry.lines import LINES
from softshadow.pipeline.mesa.polygon_rules import passes_stages
from softshadow.state import Viewport
from softshadow.tokens import GL_POINTS

NEAR = 4  # the first bit of the clip codes that says something about depth; the bits of the user's planes follow


class CutTriangles(NamedTuple):
    """The triangles of a draw with a corner outside the near, the far or one of the user's planes.

    numbers (T,): in the draw, before clipping; clip (T, 3, 4) float64; planes (P, 4): the planes, by `names`.
    """

    numbers: np.ndarray
    clip: np.ndarray
    planes: np.ndarray
    names: tuple[str, ...]


class CutAway(NamedTuple):
    """A triangle that is cut away at a pixel, by its number in the draw, and the plane that does it."""

    triangle: int
    plane: str


def cut_triangles(command: Draw, target: Framebuffer) -> CutTriangles | None:
    """Return the triangles of a draw that may be cut away at some pixel; None if there are none."""
    if command.mode in (GL_POINTS, *LINES) or passes_stages(command.state):
        return None
    with np.errstate(all="ignore"):
        positions = positions_of(command, target)
        outside = positions.codes >> NEAR != 0
        if not outside.any():
            return None
        corners = triangles_of(command, target, positions.codes, positions.planes, False).corners
    numbers = np.flatnonzero(outside[corners].any(axis=1))
    planes = {} if command.state.depth.clamp else {"near plane": (0, 0, 1, 1), "far plane": (0, 0, -1, 1)}
    planes |= {f"clip plane {number}": tuple(plane) for number, plane in enumerate(positions.planes)}
    clip = positions.clip[corners[numbers]].astype(np.float64)
    return CutTriangles(numbers, clip, np.array(list(planes.values()), np.float64).reshape(-1, 4), tuple(planes))


def cut_away_at(
    triangles: CutTriangles, viewport: Viewport, target: Framebuffer, row: int, column: int
) -> list[CutAway]:
    """Return the triangles that are cut away at a pixel of the stored rows, in drawing order."""
    x, y = ndc_of_pixel(viewport, target, row, column)
    if max(abs(x), abs(y)) > 1:
        return []
    with np.errstate(all="ignore"):
        weights = weights_at(triangles.clip, x, y)
        point = np.einsum("ti,tij->tj", weights, triangles.clip)
        met = (weights >= 0).all(axis=1) & (point[:, 3] > 0)  # in front of the eye
        outside = (point @ triangles.planes.T < 0) & met[:, None]
    cut = np.flatnonzero(outside.any(axis=1))
    return [CutAway(int(triangles.numbers[t]), triangles.names[int(outside[t].argmax())]) for t in cut]


def ndc_of_pixel(viewport: Viewport, target: Framebuffer, row: int, column: int) -> tuple[float, float]:
    """Return x and y of a pixel's centre in normalized device coordinates."""
    from_bottom = target.size[1] - row - 0.5 if target.flipped else row + 0.5
    across, up = column + 0.5 - viewport.x, from_bottom - viewport.y
    return 2 * across / max(viewport.width, 1) - 1, 2 * up / max(viewport.height, 1) - 1


def weights_at(clip: np.ndarray, x: float, y: float) -> np.ndarray:
    """Return the weights (T, 3) of the corners, clip (T, 3, 4), that sum up to a point on the line of sight.

    Their sum is 1. They are not negative where the line meets the triangle, and NaN where it runs along its plane.
    """
    on_line = clip[..., :2] - np.array([x, y]) * clip[..., 3:]
    weights = np.cross(on_line[..., 0], on_line[..., 1])
    return weights / weights.sum(axis=1, keepdims=True)
