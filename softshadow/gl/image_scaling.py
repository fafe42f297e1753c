"""Images made larger or smaller by box filters, in the arithmetic of libGLU (libutil, mipmap.c).

GLU has two filters: gluScaleImage works on 16-bit numbers and wraps at the edges of the image; mipmaps are scaled
(`mipmap_scaling`) and halved in the type of the image. All arrays are (height, width, components).
"""

from __future__ import annotations

from math import floor
from typing import NamedTuple

import numpy as np

F32 = np.float32


# -- gluScaleImage -----------------------------------------------------------------------------------------------------
def to_shorts(image: np.ndarray, is_index: bool) -> np.ndarray:
    """Return an image as 16-bit numbers over the whole range; indices keep their values."""
    if image.dtype == np.float32:
        return (image if is_index else image * F32(65535)).astype(np.int64).astype(np.uint16)
    wide = image.astype(np.int64)
    if is_index:
        return wide.astype(np.uint16)
    scaled = {
        np.uint8: lambda: wide * 257, np.int8: lambda: wide * 516, np.uint16: lambda: wide, np.int16: lambda: wide * 2,
        np.uint32: lambda: wide >> 16, np.int32: lambda: wide >> 15,
    }[image.dtype.type]()  # fmt: skip
    return scaled.astype(np.uint16)


def from_shorts(shorts: np.ndarray, dtype: np.dtype, is_index: bool) -> np.ndarray:
    """Return 16-bit numbers as an image of a type."""
    if dtype == np.float32:
        return shorts.astype(F32) if is_index else (shorts / 65535.0).astype(F32)
    wide = shorts.astype(np.int64)
    if is_index:
        return wide.astype(dtype)
    scaled = {
        np.uint8: lambda: wide >> 8, np.int8: lambda: wide >> 9, np.uint16: lambda: wide, np.int16: lambda: wide >> 1,
        np.uint32: lambda: wide * 65537, np.int32: lambda: wide * 65537 // 2,
    }[dtype.type]()  # fmt: skip
    return scaled.astype(dtype)


class Taps(NamedTuple):
    """Which input rows or columns each output one reads (n, k), and their shares (n, k) float32, 0 for none."""

    places: np.ndarray
    shares: np.ndarray


def scale_shorts(image: np.ndarray, width: int, height: int) -> np.ndarray:
    """Return a 16-bit image in another size."""
    if image.shape[:2] == (2 * height, 2 * width):
        return halve(image)
    rows, columns = taps(image.shape[0], height), taps(image.shape[1], width)
    values = image.astype(F32)
    totals, area = np.zeros((height, width, image.shape[2]), F32), np.zeros((height, width, 1), F32)
    for i in range(rows.places.shape[1]):
        for j in range(columns.places.shape[1]):
            share = (rows.shares[:, None, i] * columns.shares[None, :, j])[..., None]
            area += share
            totals += values[rows.places[:, i]][:, columns.places[:, j]] * share
    return ((totals.astype(np.float64) + 0.5) / area).astype(np.uint16)


def taps(size_in: int, size_out: int) -> Taps:
    """Return what each of `size_out` rows or columns reads of `size_in`; places beyond the edges wrap."""
    step = F32(size_in) / F32(size_out)
    reach = float(step / F32(2)) if size_in > size_out else 0.5
    places: list[list[int]] = []
    shares: list[list[np.float32]] = []
    for number in range(size_out):
        center = F32(float(step) * (number + 0.5))
        low, high = F32(float(center) - reach), F32(float(center) + reach)
        place, here = floor(low), low
        places.append([])
        shares.append([])
        while here < high:
            places[-1].append((place + size_in) % size_in)
            shares[-1].append(high - here if high < place + 1 else F32(place + 1) - here)
            place += 1
            here = F32(place)
    longest = max(map(len, places))
    return Taps(
        np.array([[*row, *[0] * (longest - len(row))] for row in places]),
        np.array([[*row, *[F32(0)] * (longest - len(row))] for row in shares], F32),
    )


# -- mipmaps -----------------------------------------------------------------------------------------------------------
def halve(image: np.ndarray) -> np.ndarray:
    """Return an image of half the size: the mean of each 2 x 2 pixels, or of each two if a side is 1."""
    height, width = image.shape[:2]
    a, b = (image[0 : height & ~1 : 2], image[1::2]) if height > 1 else (image, None)
    if height > 1 and width > 1:
        assert b is not None
        even = slice(0, width & ~1, 2)
        return _mean([a[:, even], a[:, 1::2], b[:, even], b[:, 1::2]])
    if width > 1:
        return _mean([np.ascontiguousarray(image[:, place : width & ~1 : 2]) for place in (0, 1)])
    assert b is not None
    return _mean([a, b])


def _mean(parts: list[np.ndarray]) -> np.ndarray:
    """Return the mean of two or four images; integers are rounded as libGLU does for their type."""
    dtype, count = parts[0].dtype, len(parts)
    if dtype == np.float32:
        total = parts[0].copy()
        for part in parts[1:]:
            total += part
        return total / F32(count)
    if dtype == np.int32:
        return _mean_of_ints(parts)
    if dtype == np.uint8:
        total = parts[0].astype(np.uint16)
        for part in parts[1:]:
            total += part
        return ((total + np.uint16(2)) >> 2 if count == 4 else total >> 1).astype(np.uint8)
    whole = sum(part.astype(np.int64) for part in parts) + (2 if count == 4 else 0)
    return np.trunc(np.asarray(whole) / count).astype(dtype)


def _mean_of_ints(parts: list[np.ndarray]) -> np.ndarray:
    """Return the mean of 32-bit integers, in single precision; libGLU takes those of a single row for unsigned."""
    if len(parts) == 4:
        total = sum(part.astype(F32) for part in parts)
        return np.trunc((total / F32(4)).astype(np.float64) + 0.5).astype(np.int32)
    mean = (parts[0].view(np.uint32).astype(F32) + parts[1].view(np.uint32).astype(F32)).astype(np.float64) / 2
    fits = mean < -float(np.iinfo(np.int32).min)
    return np.where(fits, mean, np.iinfo(np.int32).min).astype(np.int32)  # as the processor converts what does not fit
