"""The image of a texture in another size, before its mipmaps are made, in the arithmetic of libGLU (libutil, mipmap.c).

Photographs seldom have powers of two as sides, so most programs that make mipmaps by GLU come here.
"""

from __future__ import annotations

from math import floor
from typing import NamedTuple

import numpy as np

from softshadow.jit import kernel, read_only
from softshadow.pipeline.constants import ONE

F32 = np.float32


class Boxes(NamedTuple):
    """The box of input rows or columns of each output one: from `low` + `low_share` to `high` + `high_share`."""

    low: np.ndarray
    low_share: np.ndarray
    high: np.ndarray
    high_share: np.ndarray


def scale(image: np.ndarray, width: int, height: int) -> np.ndarray:
    """Return an image (height, width, components) in another size, in its own type; libGLU halves it in another way."""
    height_in, width_in, components = image.shape
    rows, columns = _boxes(height_in, height, height_in - 1), _boxes(width_in, width, width_in)
    totals = np.zeros((height, width, components), F32)
    add_boxes(read_only(image.reshape(-1, components).astype(F32)), width_in, rows, columns, totals)
    scaled = totals / ((F32(width_in) / F32(width)) * (F32(height_in) / F32(height)))
    if image.dtype == np.float32:
        return scaled
    limit = np.iinfo(image.dtype)
    return np.clip(np.trunc(scaled.astype(np.float64)), limit.min, limit.max).astype(image.dtype)


@kernel
def add_boxes(pixels, pitch, rows, columns, totals):
    """Add to each of the totals (h, w, components) the pixels of its box, each times its share, in libGLU's order.

    pixels (n, components) float32, with `pitch` of them in a row; rows, columns: `Boxes`.
    """
    for i in range(totals.shape[0]):
        top, bottom, below, above = rows.low[i], rows.high[i], rows.low_share[i], rows.high_share[i]
        is_tall = bottom > top
        first_row = ONE - below if is_tall else above - below
        for j in range(totals.shape[1]):
            left, right, before, after = columns.low[j], columns.high[j], columns.low_share[j], columns.high_share[j]
            is_wide, total = right > left, totals[i, j]
            first_column = ONE - before if is_wide else after - before
            add_pixel(pixels, top * pitch + left, first_row * first_column, total)
            for column in range(left + 1, right):
                add_pixel(pixels, top * pitch + column, first_row, total)
            if is_wide:
                add_pixel(pixels, top * pitch + right, first_row * after, total)
            else:
                for row in range(top + 1, bottom):
                    add_pixel(pixels, row * pitch + left, first_column, total)
            if not is_tall:
                continue
            add_pixel(pixels, bottom * pitch + left, first_column * above, total)
            for column in range(left + 1, right):
                add_pixel(pixels, bottom * pitch + column, above, total)
            if not is_wide:
                continue
            add_pixel(pixels, bottom * pitch + right, above * after, total)
            for row in range(top + 1, bottom):
                aside = row - top - 1  # libGLU moves on by a pixel in each row here
                one, other = row * pitch + left + aside, row * pitch + right + aside
                add_two_pixels(pixels, one, ONE - before, other, after, total)
            for row in range(top + 1, bottom):
                for column in range(left + 1, right):
                    add_pixel(pixels, row * pitch + column, ONE, total)


@kernel
def add_pixel(pixels, place, share, total):
    """Add a pixel times a share; behind the last one, the last one."""
    own = min(place, pixels.shape[0] - 1)
    for c in range(pixels.shape[1]):
        total[c] += pixels[own, c] * share


@kernel
def add_two_pixels(pixels, place, share, other_place, other_share, total):
    """Add the sum of two pixels, each times its share."""
    own, other = min(place, pixels.shape[0] - 1), min(other_place, pixels.shape[0] - 1)
    for c in range(pixels.shape[1]):
        total[c] += pixels[own, c] * share + pixels[other, c] * other_share


def _boxes(size_in: int, size_out: int, highest: int) -> Boxes:
    """Return the boxes of `size_out` rows or columns, none above `highest`; their bounds add up in single precision."""
    step = F32(size_in) / F32(size_out)
    whole = floor(step)
    share = step - F32(whole)
    low, low_share, high, high_share = 0, F32(0), whole, share
    boxes: list[tuple[int, np.float32, int, np.float32]] = []
    for _ in range(size_out):
        high = min(high, highest)
        boxes.append((low, low_share, high, high_share))
        low, low_share = high, high_share
        high, high_share = high + whole, high_share + share
        if high_share > 1:
            high, high_share = high + 1, high_share - ONE
    lows, low_shares, highs, high_shares = zip(*boxes, strict=True)
    return Boxes(np.array(lows), np.array(low_shares, F32), np.array(highs), np.array(high_shares, F32))
