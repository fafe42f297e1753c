"""Blocks of one channel made from bytes: the two numbers and the codes that Mesa chooses.

Three ways are tried: seven steps between the extremes; five steps between the extremes that are neither 0 nor 255; and
five steps between numbers that are improved by the mean error. The last two are tried only if the errors are large.

References: texcompress_s3tc_tmp.h and texcompress_rgtc_tmp.h of Mesa 22.3.
"""

from __future__ import annotations

import numpy as np

NO_ERROR_YET = 0xFFFFFFFF
SMALL, MEDIUM = 32, 96  # errors from which the second and the third way are tried
STEPS_TO_CODES = {7: np.array([0, 2, 3, 4, 5, 6, 7, 1]), 5: np.array([0, 2, 3, 4, 5, 1])}
BELOW, ABOVE = 6, 7  # codes for 0 and 255


def channel_blocks(values: np.ndarray, valid: np.ndarray, is_alpha: bool = False) -> np.ndarray:
    """Return blocks (N, 8) uint8 of numbers (N, 16), 0 to 255; `valid` (N, 16) says which texels the image has.

    `is_alpha`: of S3TC, where Mesa looks for the best codes also if all numbers are equal.
    """
    is_middle = valid & (values != 0) & (values != 255)
    has_least, has_most = ((valid & (values == extreme)).any(axis=1) for extreme in (0, 255))
    low = np.where(is_middle, values, 255).min(axis=1)
    high = np.where(is_middle, values, 0).max(axis=1)
    is_constant = (low > high) & ~(has_least & has_most)
    if not is_alpha:
        is_constant |= (low == high) & ~has_least & ~has_most

    least, most = np.where(has_least, 0, low), np.where(has_most, 255, high)
    steps = _steps(values, most, least, 7)
    codes, error = STEPS_TO_CODES[7][steps], _error(values - _mixed(most, least, steps, 7), valid)
    ends = np.stack([most, least], axis=1)

    second = _with_limits(values, low, high, values == 0, values == 255)
    error2 = np.where(error >= SMALL, _error(second[1], valid), NO_ERROR_YET)
    low3, high3 = _improved(values, valid, low, high)
    below, above = values <= (low3 // 2)[:, np.newaxis], values > ((255 + high3) // 2)[:, np.newaxis]
    third = _with_limits(values, low3, high3, below, above & ~below, values, 255 - values)
    is_large = (error2 > MEDIUM) & (error2 != NO_ERROR_YET) & (error > MEDIUM)
    error3 = np.where(is_large, _error(third[1], valid), NO_ERROR_YET)

    is_first = ((error <= error2) & (error <= error3))[:, np.newaxis]
    is_second = (error2 <= error3)[:, np.newaxis]
    codes = np.where(is_first, codes, np.where(is_second, second[0], third[0]))
    others = np.where(is_second, np.stack([low, high], axis=1), np.stack([low3, high3], axis=1))
    ends = np.where(is_first, ends, others)
    only = np.stack([values[:, 0], np.zeros_like(low)], axis=1)
    ends, codes = np.where(is_constant[:, np.newaxis], only, ends), np.where(is_constant[:, np.newaxis], 0, codes)
    return np.concatenate([ends.astype(np.uint8), _packed(np.where(valid, codes, 0))], axis=1)


def _packed(codes: np.ndarray) -> np.ndarray:
    """Return codes (N, 16) of 3 bits as six bytes (N, 6)."""
    bits = codes[..., np.newaxis] >> np.arange(3) & 1
    return np.packbits(bits.reshape(len(codes), 48).astype(np.uint8), axis=1, bitorder="little")


def _mixed(first: np.ndarray, last: np.ndarray, steps: np.ndarray, n: int) -> np.ndarray:
    """Return the numbers that are so many of n steps away from the first one."""
    mixed: np.ndarray = (first[:, np.newaxis] * (n - steps) + last[:, np.newaxis] * steps) // n
    return mixed


def _steps(values: np.ndarray, first: np.ndarray, last: np.ndarray, n: int) -> np.ndarray:
    """Return how many of n steps from the first number to the last one the values are away."""
    odd = 2 * np.arange(n) + 1
    cuts = (first[:, np.newaxis] * (2 * n - odd) + last[:, np.newaxis] * odd) // (2 * n)
    falls = n == 7
    over = values[..., np.newaxis] <= cuts[:, np.newaxis] if falls else values[..., np.newaxis] > cuts[:, np.newaxis]
    return np.asarray(over.sum(axis=2))


def _error(distances: np.ndarray, valid: np.ndarray) -> np.ndarray:
    return np.asarray(np.where(valid, distances * distances, 0).sum(axis=1))


def _with_limits(
    values: np.ndarray, low: np.ndarray, high: np.ndarray, below: np.ndarray, above: np.ndarray, *distances: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return (codes, distances) where five steps lie between the ends, and some values become 0 or 255."""
    steps = _steps(values, low, high, 5)
    to_least, to_most = distances or (np.zeros_like(values), np.zeros_like(values))
    codes = np.where(below, BELOW, np.where(above, ABOVE, STEPS_TO_CODES[5][steps]))
    between = values - _mixed(low, high, steps, 5)
    return codes, np.where(below, to_least, np.where(above, to_most, between))


def _improved(
    values: np.ndarray, valid: np.ndarray, low: np.ndarray, high: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return better ends: without values near 0 and 255, and moved by the mean error of what they have a part in."""
    margin = np.sign(high - low) * (np.abs(high - low) // 28)
    margin = margin[:, np.newaxis]
    first = np.where(valid & (values > margin), values, 255).min(axis=1)
    last = np.where(valid & (values < 255 - margin), values, 0).max(axis=1)
    is_degenerate = last <= first
    first, last = np.where(is_degenerate, 1, first), np.where(is_degenerate, 254, last)
    steps = _steps(values, first, last, 5)
    errors = values - _mixed(first, last, steps, 5)
    is_inside = valid & (values > (first // 2)[:, np.newaxis]) & (values <= ((255 + last) // 2)[:, np.newaxis])
    moved = []
    for end, has_part in ((first, is_inside & (steps < 5)), (last, is_inside & (steps > 0))):
        total, count = np.where(has_part, errors, 0).sum(axis=1), np.maximum(has_part.sum(axis=1), 1)
        moved.append(np.clip(end + np.sign(total) * (np.abs(total) // count), 0, 255))
    return moved[0], moved[1]
