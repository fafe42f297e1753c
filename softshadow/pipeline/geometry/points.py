"""Points: the square of pixels that each becomes.

GL 2.1, sec. 3.3.1: an aliased point of size n is a square of n by n pixels, around the pixel it lies in for an odd n,
around the nearest pixel corner for an even one. As for lines, the square is two triangles.
"""

import numpy as np

from softshadow.jit import inlined, kernel
from softshadow.pipeline.constants import HALF, ONE, SUBPIXEL_BITS, ZERO
from softshadow.pipeline.geometry.clip import NO_STARTS, Clipped
from softshadow.pipeline.geometry.facing import REACH
from softshadow.pipeline.geometry.triangle_setup import empty_setup, snap_away
from softshadow.pipeline.records import NO_VERTEX, Setup

PIXEL = 1 << SUBPIXEL_BITS
LARGEST_SIZE = np.float32(255)
ALL_TRUE = np.ones(4, np.bool_).view(np.uint32)[0]


def clip_points(
    clip: np.ndarray,
    values: np.ndarray,
    points: np.ndarray,
    codes: np.ndarray,
    user_planes: np.ndarray,
    starts: np.ndarray = NO_STARTS,
) -> Clipped:
    """Return the points (P, 1) whose centre is inside the frustum and the user planes, as `clip_triangles` does.

    Nothing is cut, so the codes are enough.
    """
    # four truth values are compared as one number: `all(axis=1)` would take ten times as long
    are_finite = np.isfinite(clip, order="C").view(np.uint32)[:, 0] == ALL_TRUE
    visible = np.flatnonzero(((codes == 0) & are_finite)[points[:, 0]]).astype(np.int32)
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
    return _squares(window, points, ids, sizes, int(flipped), np.empty(0, sizes.dtype))


def set_up_sprites(
    window: np.ndarray, points: np.ndarray, ids: np.ndarray, sizes: np.ndarray
) -> tuple[Setup, np.ndarray]:
    """Return the two triangles of each point sprite, as `set_up_points` does, and the widths (P,) of the sprites.

    A sprite is a square of that size around its point: it covers the pixels whose centres lie in it (GL 2.1, sec.
    3.3.1).
    """
    widths = np.empty(len(points), sizes.dtype)
    return _squares(window, points, ids, sizes, 0, widths), widths


def _squares(
    window: np.ndarray, points: np.ndarray, ids: np.ndarray, sizes: np.ndarray, flipped: int, widths: np.ndarray
) -> Setup:
    """Return the two triangles of each point; sprites have `widths` (P,), which are written."""
    setup = empty_setup(2 * len(points), window.dtype)
    points, ids = np.ascontiguousarray(points), np.ascontiguousarray(ids)
    n_triangles = write_squares(window, points, ids, sizes, flipped, widths, *setup)
    return Setup(*(array[:n_triangles] for array in setup))


@kernel
def write_squares(window, points, ids, sizes, flipped, widths, corners, vertices, depth, front, triangle_ids):
    """Write the two triangles of each point; return how many they are. The arguments: see `_squares` and `Setup`."""
    t, are_sprites = 0, len(widths) > 0
    for n in range(points.shape[0]):
        v = points[n]
        x, y, z = window[v, 0], window[v, 1], window[v, 2]
        width = fixed_width(sizes[n])
        if are_sprites:
            width = max(PIXEL, width)
            widths[n] = widths.dtype.type(width) / widths.dtype.type(PIXEL)
        if not (np.isfinite(z) and abs(x) < REACH and abs(y) < REACH):
            continue
        if are_sprites:
            left, low = snap_away(x - HALF) - width // 2, snap_away(y - HALF) - width // 2
        else:
            # on the border of two rows the upper one (in GL's sense) is covered, as along the edges of triangles
            n_pixels = max(1, (width + PIXEL // 2 - 1) >> SUBPIXEL_BITS)
            left, low = low_side(snap_away(x), n_pixels), low_side(snap_away(y) - flipped, n_pixels)
            width = n_pixels << SUBPIXEL_BITS
        right, high = left + width, low + width
        corners[t, 0], corners[t, 1], corners[t, 2], corners[t, 3] = right, low, left, low
        corners[t, 4], corners[t, 5] = left, high
        corners[t + 1, 0], corners[t + 1, 1], corners[t + 1, 2], corners[t + 1, 3] = right, low, left, high
        corners[t + 1, 4], corners[t + 1, 5] = right, high
        for half in range(t, t + 2):
            vertices[half, 0], vertices[half, 1], vertices[half, 2] = v, NO_VERTEX, NO_VERTEX
            depth[half, 0], depth[half, 1], depth[half, 2], depth[half, 3] = z, ZERO, ZERO, ZERO
            front[half], triangle_ids[half] = 1, ids[n]
        t += 2
    return t


@inlined
def low_side(snapped, n_pixels):
    """Return the lower side of a square of whole pixels: half a pixel below its first samples, multiples of 256."""
    center = snapped if n_pixels % 2 == 1 else snapped + PIXEL // 2
    return (((center >> SUBPIXEL_BITS) - n_pixels // 2) << SUBPIXEL_BITS) - PIXEL // 2


@inlined
def fixed_width(size):
    """Return a size in 1/256 pixel; NaN and what is not positive count as 1 pixel."""
    return snap_away(min(size, LARGEST_SIZE) if size > ZERO else ONE)
