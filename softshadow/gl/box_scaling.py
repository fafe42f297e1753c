"""Three-dimensional images made larger or smaller by box filters, in the arithmetic of libGLU (libutil, mipmap.c).

All arrays are (depth, height, width, components).
"""

from __future__ import annotations

import numpy as np

from softshadow.gl.image_scaling import F32, halve, taps


def scale_box(image: np.ndarray, width: int, height: int, depth: int) -> np.ndarray:
    """Return 16-bit images in other sizes; boxes that reach over an edge wrap."""
    slices, rows, columns = taps(image.shape[0], depth), taps(image.shape[1], height), taps(image.shape[2], width)
    values = image.astype(F32)
    totals = np.zeros((depth, height, width, image.shape[3]), F32)
    volume = np.zeros((depth, height, width, 1), F32)
    for k in range(slices.places.shape[1]):
        for i in range(rows.places.shape[1]):
            for j in range(columns.places.shape[1]):
                area = columns.shares[None, :, j] * rows.shares[:, None, i]
                share = (area * slices.shares[:, None, None, k])[..., None]
                volume += share
                chosen = values[slices.places[:, k]][:, rows.places[:, i]][:, :, columns.places[:, j]]
                totals += chosen * share
    return ((totals.astype(np.float64) + 0.5) / volume).astype(np.uint16)


def halve_box(image: np.ndarray) -> np.ndarray:
    """Return images of half the sizes: the mean of each 2 x 2 x 2 pixels, of fewer where a side is 1."""
    depth, height, width, _ = image.shape
    if depth == 1:
        return halve(image[0])[np.newaxis]
    total, count = np.zeros(1), 0
    for k in range(2):
        for i in range(min(height, 2)):
            for j in range(min(width, 2)):
                total = total + image[k : depth & ~1 : 2, i::2, j::2][:, : height // 2 or 1, : width // 2 or 1]
                count += 1
    mean = total / count
    return mean.astype(F32) if image.dtype == F32 else np.trunc(mean).astype(image.dtype)
