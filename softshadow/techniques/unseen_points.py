"""Points of the camera's picture that lie outside the map of any of a light's many points: what is in them is unknown.

The frustum of a map is convex. So the picture is divided into tiles, and where a camera sees the corners of the box
round a tile's points, it sees all of them; only in other tiles each point is tested.
"""

from collections.abc import Iterable

import numpy as np

from softshadow.techniques.light_camera import LightCamera

TILE = 16  # pixels on a side
ROOM = 1e-9  # by which boxes are larger, as a share of the coordinates: far more than rounding errors
CORNERS = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], bool)


def unseen_points(cameras: Iterable[LightCamera], points: np.ndarray, valid: np.ndarray) -> np.ndarray:
    """Return which of the valid points lie outside the four sides of the map of at least one camera.

    Parameters
    ----------
    points : (h, w, 3) float64   finite, also where they are not valid
    valid : (h, w) bool

    Returns
    -------
    (h, w) bool                  as the union of ``valid & ~camera.sees(points)``
    """
    tiles, unseen = in_tiles(points), ~in_tiles(valid)  # with those that are not valid: a tile is finished when all are
    low = np.where(unseen[..., None], np.inf, tiles).min(axis=1)
    high = np.where(unseen[..., None], -np.inf, tiles).max(axis=1)
    empty = low > high  # tiles without a valid point
    low[empty] = high[empty] = 0
    room = ROOM * np.maximum(np.abs(low), np.abs(high)).max(axis=1, keepdims=True)
    corners = np.where(CORNERS, (high + room)[:, None], (low - room)[:, None])
    for camera in cameras:
        todo = np.flatnonzero(~unseen.all(axis=1))
        todo = todo[~camera.sees(corners[todo]).all(axis=1)]
        unseen[todo] |= ~camera.sees(tiles[todo])
    return valid & from_tiles(unseen, valid.shape)


def in_tiles(pixels: np.ndarray) -> np.ndarray:
    """Return pixels (h, w[, k]) by tiles (T, TILE², [k]); the missing ones at the borders are zeros."""
    rows, columns = (-(-side // TILE) for side in pixels.shape[:2])
    padded = np.zeros((rows * TILE, columns * TILE, *pixels.shape[2:]), pixels.dtype)
    padded[: pixels.shape[0], : pixels.shape[1]] = pixels
    blocks = padded.reshape(rows, TILE, columns, TILE, *pixels.shape[2:]).swapaxes(1, 2)
    return blocks.reshape(rows * columns, TILE * TILE, *pixels.shape[2:])


def from_tiles(tiles: np.ndarray, shape: tuple[int, ...]) -> np.ndarray:
    """Return the pixels (h, w) of tiles (T, TILE²)."""
    rows, columns = (-(-side // TILE) for side in shape)
    pixels = tiles.reshape(rows, columns, TILE, TILE).swapaxes(1, 2).reshape(rows * TILE, columns * TILE)
    return pixels[: shape[0], : shape[1]]
