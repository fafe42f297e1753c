"""Points: the square of pixels that each becomes.

GL 2.1, sec. 3.3.1: an aliased point of size n is a square of n by n pixels, around the pixel it lies in for an odd n,
around the nearest pixel corner for an even one. As for lines, the square is two triangles.
"""

import numpy as np

from softshadow.pipeline.constants import HALF, SUBPIXEL_BITS, SUBPIXELS
from softshadow.pipeline.geometry.clip import Clipped
from softshadow.pipeline.geometry.facing import REACH
from softshadow.pipeline.geometry.triangle_setup import half_away
from softshadow.pipeline.records import NO_VERTEX, Setup

PIXEL = 1 << SUBPIXEL_BITS
LARGEST_SIZE = 255.0


def clip_points(
    clip: np.ndarray, values: np.ndarray, points: np.ndarray, codes: np.ndarray, user_planes: np.ndarray
) -> Clipped:
    """Return the points (P, 1) whose centre is inside the frustum and the user planes, as `clip_triangles` does."""
    visible = np.flatnonzero((codes[points[:, 0]] == 0) & np.isfinite(clip[points[:, 0]]).all(axis=1)).astype(np.int32)
    return Clipped(clip, values, np.ascontiguousarray(points[visible]), visible)


def set_up_points(window: np.ndarray, points: np.ndarray, ids: np.ndarray, sizes: np.ndarray, flipped: bool) -> Setup:
    """Return the two triangles of each point.

    Parameters
    ----------
    window : (V, 4) window x, y (stored rows), z, 1/w
    points : (P,) int32
    ids : (P,) int32, copied to the triangles
    sizes : (P,) in pixels, rounded to whole numbers, a half down; NaN counts as 1, as in Mesa
    """
    positions = window[points]
    finite = np.isfinite(positions[:, 2]) & (np.abs(positions[:, :2]) < REACH).all(axis=1)
    points, ids, positions, sizes = points[finite], ids[finite], positions[finite], sizes[finite]
    width = np.maximum(1, _fixed_widths(sizes) + PIXEL // 2 - 1 >> SUBPIXEL_BITS)[:, None]
    # on the border of two rows the upper one (in GL's sense) is covered, as along the edges of triangles
    snapped = half_away(positions[:, :2] * SUBPIXELS).astype(np.int64) - (0, int(flipped))
    center = np.where(width % 2 == 1, snapped, snapped + PIXEL // 2)
    first = (center >> SUBPIXEL_BITS) - width // 2
    # corners half a pixel outside the first and last samples, which lie on multiples of 256
    low = first * PIXEL - PIXEL // 2
    return _squares(points, ids, positions[:, 2], low, low + width * PIXEL)


def set_up_sprites(
    window: np.ndarray, points: np.ndarray, ids: np.ndarray, sizes: np.ndarray
) -> tuple[Setup, np.ndarray]:
    """Return the two triangles of each point sprite, as `set_up_points` does, and the widths (P,) of the sprites.

    A sprite is a square of that size around its point: it covers the pixels whose centres lie in it (GL 2.1, sec.
    3.3.1).
    """
    fixed = np.maximum(PIXEL, _fixed_widths(sizes))
    positions = window[points]
    finite = np.isfinite(positions[:, 2]) & (np.abs(positions[:, :2]) < REACH).all(axis=1)
    points, ids, positions = points[finite], ids[finite], positions[finite]
    low = half_away((positions[:, :2] - HALF) * SUBPIXELS).astype(np.int64) - fixed[finite, None] // 2
    return _squares(points, ids, positions[:, 2], low, low + fixed[finite, None]), fixed / PIXEL


def _fixed_widths(sizes: np.ndarray) -> np.ndarray:
    """Return sizes (P,) in 1/256 pixel; NaN and what is not positive count as 1 pixel."""
    limited = np.where(sizes > 0, np.minimum(sizes, sizes.dtype.type(LARGEST_SIZE)), sizes.dtype.type(1))
    return half_away(limited * SUBPIXELS).astype(np.int64)


def _squares(points: np.ndarray, ids: np.ndarray, z: np.ndarray, low: np.ndarray, high: np.ndarray) -> Setup:
    """Return two triangles for each point with depth `z` (P,), from corner `low` (P, 2) to corner `high` (P, 2)."""
    x0, y0, x1, y1 = low[:, 0], low[:, 1], high[:, 0], high[:, 1]
    n_points = len(points)
    corners = (
        np.stack([x1, y0, x0, y0, x0, y1, x1, y0, x0, y1, x1, y1], axis=1).reshape(2 * n_points, 6).astype(np.int32)
    )
    vertices = np.full((2 * n_points, 3), NO_VERTEX, np.int32)
    vertices[:, 0] = np.repeat(points, 2)
    depth = np.zeros((2 * n_points, 4), z.dtype)
    depth[:, 0] = np.repeat(z, 2)
    return Setup(corners, vertices, depth, np.ones(2 * n_points, np.uint8), np.repeat(ids, 2))
