"""Packed pixel types of small floats: three mantissas with one exponent, or three floats of 11, 11 and 10 bits.

References: EXT_texture_shared_exponent, EXT_packed_float; format_rgb9e5.h and format_r11g11b10f.h of Mesa 22.3.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

F32 = np.float32
MANTISSA, EXPONENT, BIAS = 9, 5, 15
LARGEST_SHARED = F32(511 / 512 * 65536)
INFINITY = 0x7F800000


@dataclass(frozen=True)
class SharedExponent:
    """GL_UNSIGNED_INT_5_9_9_9_REV: mantissas of 9 bits from the lowest bit on, then the exponent of all."""

    def floats(self, words: np.ndarray) -> np.ndarray:
        """Return the colours (..., 3) float32 of words (...)."""
        scale = np.exp2((words >> np.uint32(27)).astype(F32) - F32(BIAS + MANTISSA)).astype(F32)
        mantissas = [(words >> np.uint32(shift) & np.uint32(511)).astype(F32) for shift in (0, MANTISSA, 2 * MANTISSA)]
        return np.stack([mantissa * scale for mantissa in mantissas], axis=-1)

    def words(self, floats: np.ndarray) -> np.ndarray:
        """Return colours (..., 3) as words (...) uint32; what is not positive becomes 0."""
        colors = np.where(floats > 0, np.minimum(floats.astype(F32), LARGEST_SHARED), F32(0))
        largest = np.ascontiguousarray(colors.max(axis=-1)).view(np.uint32).astype(np.int64)
        largest += largest & 1 << 23 - MANTISSA  # rounds, and carries into the exponent
        exponents = np.maximum(largest >> 23, 127 - BIAS - 1) + 1 + BIAS - 127
        scale = np.exp2((BIAS + MANTISSA + 1 - exponents).astype(F32)).astype(F32)
        doubled = (colors * scale[..., np.newaxis]).astype(np.int64)
        mantissas = (doubled & 1) + (doubled >> 1)
        words = exponents << 27 | mantissas[..., 2] << 18 | mantissas[..., 1] << 9 | mantissas[..., 0]
        return words.astype(np.uint32)


@dataclass(frozen=True)
class SmallFloats:
    """GL_UNSIGNED_INT_10F_11F_11F_REV: floats without sign, exponents of 5 bits and mantissas of 6, 6 and 5 bits."""

    def floats(self, words: np.ndarray) -> np.ndarray:
        """Return the colours (..., 3) float32 of words (...)."""
        return np.stack([_small_to_float(words, shift, n_bits) for shift, n_bits in PLACES], axis=-1)

    def words(self, floats: np.ndarray) -> np.ndarray:
        """Return colours (..., 3) as words (...) uint32; mantissas are cut off, negative numbers become 0."""
        words = np.zeros(floats.shape[:-1], np.uint32)
        for channel, (shift, n_bits) in enumerate(PLACES):
            words |= _float_to_small(np.ascontiguousarray(floats[..., channel], F32), n_bits) << np.uint32(shift)
        return words


PLACES = ((0, 6), (11, 6), (22, 5))  # lowest bit, and number of bits of the mantissa


def _small_to_float(words: np.ndarray, shift: int, n_bits: int) -> np.ndarray:
    codes = (words >> np.uint32(shift)).astype(np.int64) & (32 << n_bits) - 1
    exponents, mantissas = codes >> n_bits, codes & (1 << n_bits) - 1
    scale = np.exp2((np.maximum(exponents, 1) - BIAS - n_bits).astype(F32)).astype(F32)
    finite = ((exponents > 0) * (1 << n_bits) + mantissas).astype(F32) * scale
    special = (INFINITY | mantissas).astype(np.uint32).view(F32)
    return np.where(exponents == 31, special, finite)


def _float_to_small(values: np.ndarray, n_bits: int) -> np.ndarray:
    bits = values.view(np.uint32).astype(np.int64)
    exponents, mantissas = (bits >> 23 & 255) - 127, bits & 0x7FFFFF
    largest = F32((2 - 2.0**-n_bits) * 2.0**15)
    codes = np.where(exponents > -BIAS, exponents + BIAS << n_bits | mantissas >> 23 - n_bits, 0)
    codes = np.where(values > largest, 31 << n_bits, codes) - (values > largest)
    is_special, is_negative = exponents == 128, bits >> 31 > 0
    codes = np.where(is_negative, 0, codes)
    codes = np.where(is_special & (mantissas == 0) & ~is_negative, 31 << n_bits, codes)
    return np.where(is_special & (mantissas != 0), 31 << n_bits | 1, codes).astype(np.uint32)
