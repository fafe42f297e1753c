"""Blocks of colours made from pixels: the two colours and the codes that Mesa chooses.

The colours that are farthest apart are improved once: each moves by the mean error of the texels that it has a part in.
All blocks are made at the same time.

References: texcompress_s3tc_tmp.h of Mesa 22.3 (libtxc_dxtn).
"""

from __future__ import annotations

import numpy as np

WEIGHTS = np.array([4, 16, 1])  # of errors in red, green and blue
LARGEST_TRANSPARENT = 127  # alpha, in DXT1
MASK = np.array([0xF8, 0xFC, 0xF8])  # the bits that a block stores
PARTS = np.array([[3, 0], [0, 3], [2, 1], [1, 2]])  # of the two colours in each of the four, in thirds
CLOSE = np.array([8, 4, 8])  # colours nearer than this may become equal


def color_blocks(rgb: np.ndarray, valid: np.ndarray, transparent: np.ndarray, is_dxt1: bool) -> np.ndarray:
    """Return blocks (N, 8) uint8 of texels.

    Parameters
    ----------
    rgb : (N, 16, 3) integers, 0 to 255
    valid : (N, 16) bool         which texels the image has
    transparent : (N, 16) bool   which texels of DXT1 become transparent black
    is_dxt1 : whether blocks may have three colours
    """
    ends = _improved(_ends(rgb, valid, transparent), rgb, valid) & MASK
    words = _packed(ends)
    ends = np.where((words[:, 0] < words[:, 1])[:, np.newaxis, np.newaxis], ends[:, ::-1], ends)
    words = np.sort(words, axis=1)[:, ::-1]
    codes, errors = _nearest(rgb, _mixtures(ends))
    total = np.where(valid, errors, 0).sum(axis=1)
    if is_dxt1:
        three = np.stack([ends[:, 0], ends[:, 1], (ends[:, 0] + ends[:, 1]) // 2], axis=1)
        codes3, errors3 = _nearest(rgb, three)
        codes3 = np.where(transparent, 3, np.array([1, 0, 2])[codes3])
        total3 = np.where(valid & ~transparent, errors3, 0).sum(axis=1)
        is_three = (total > total3) | (transparent & valid).any(axis=1)
        codes = np.where(is_three[:, np.newaxis], codes3, codes)
        words = np.where(is_three[:, np.newaxis], words[:, ::-1], words)
    bits = (np.where(valid, codes, 0) << 2 * np.arange(16)).sum(axis=1)
    return np.concatenate([_bytes(words, "<u2"), _bytes(bits[:, np.newaxis], "<u4")], axis=1)


def _bytes(numbers: np.ndarray, dtype: str) -> np.ndarray:
    return np.ascontiguousarray(numbers.astype(dtype)).view(np.uint8)


def _packed(colors: np.ndarray) -> np.ndarray:
    """Return colours (..., 3) as words of 5, 6 and 5 bits."""
    red, green, blue = (colors[..., channel] & MASK[channel] for channel in range(3))
    words: np.ndarray = red << 8 | green << 3 | blue >> 3
    return words


def _mixtures(ends: np.ndarray) -> np.ndarray:
    """Return the four colours (N, 4, 3) of two (N, 2, 3)."""
    return PARTS @ ends // 3


def _nearest(rgb: np.ndarray, colors: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return (code of the nearest colour, its error) of texels, (N, 16) each."""
    distances = rgb[:, :, np.newaxis] - colors[:, np.newaxis]
    errors = (distances * distances) @ WEIGHTS
    codes = errors.argmin(axis=2)
    return codes, np.take_along_axis(errors, codes[..., np.newaxis], axis=2)[..., 0]


def _ends(rgb: np.ndarray, valid: np.ndarray, transparent: np.ndarray) -> np.ndarray:
    """Return the darkest and the lightest colour (N, 2, 3), in the order in which Mesa improves them."""
    lightness = (rgb * rgb) @ WEIGHTS
    is_candidate = valid & ~transparent
    is_candidate[:, 0] = True
    darkest = np.where(is_candidate, lightness, np.iinfo(np.int64).max).argmin(axis=1)
    lightest = np.where(is_candidate, lightness, -1).argmax(axis=1)
    ends = np.take_along_axis(rgb, np.stack([darkest, lightest], axis=1)[..., np.newaxis], axis=1)
    words = _packed(ends)
    return np.where((words[:, 0] < words[:, 1])[:, np.newaxis, np.newaxis], ends, ends[:, ::-1])


def _improved(ends: np.ndarray, rgb: np.ndarray, valid: np.ndarray) -> np.ndarray:
    """Return better ends (N, 2, 3)."""
    colors = _mixtures(ends)
    codes, _ = _nearest(rgb, colors)
    errors = rgb - np.take_along_axis(colors, codes[..., np.newaxis], axis=1)
    parts = PARTS[codes] * valid[..., np.newaxis]  # (N, 16, 2)
    sums = np.einsum("nte,ntc->nec", parts, errors)
    counts = np.maximum(parts.sum(axis=1), 1)[..., np.newaxis]
    moved = np.clip(ends + np.sign(sums) * (np.abs(sums) // counts), 0, 255)
    moved = _apart(moved)
    first = _packed(moved[:, 0])
    red, green, blue = (moved[:, 1, channel] for channel in range(3))
    second = ((red & 0xF8) << 8 | (green & 0xFC) << 3 | blue) >> 3  # all of it is shifted, in Mesa
    return np.where((first < second)[:, np.newaxis, np.newaxis], moved, moved[:, ::-1])


def _apart(ends: np.ndarray) -> np.ndarray:
    """Return ends that are further apart where they would become equal."""
    distances = np.abs(ends[:, 0] - ends[:, 1])
    differences = distances * np.array([1, 2, 1])
    largest = differences.max(axis=1)
    factor = np.where(largest > 4, 2, np.where(largest > 2, 3, 4))
    more = differences * factor[:, np.newaxis]
    n = np.arange(len(ends))
    upper = (ends[:, 1, 1] >= ends[:, 0, 1]).astype(np.int64)  # the end with more green
    moved = ends.copy()
    moved[n, upper, 1] += more[:, 1]
    red = np.where(ends[n, upper, 0] > ends[n, 1 - upper, 1], upper, 1 - upper)  # Mesa compares red with green
    moved[n, red, 0] += more[:, 0]
    blue = np.where(ends[n, upper, 2] > ends[n, 1 - upper, 2], upper, 1 - upper)
    moved[n, blue, 2] += more[:, 2]
    is_close = (distances < CLOSE).all(axis=1) & (largest > 0)
    return np.where(is_close[:, np.newaxis, np.newaxis], np.minimum(moved, 255), ends)
