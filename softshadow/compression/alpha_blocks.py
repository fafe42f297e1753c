"""Blocks of one channel: two numbers and, for each of 16 texels, a weight between them. S3TC's alpha, RGTC and LATC.

References: EXT_texture_compression_rgtc; `s3tc_dxt5_alpha_channel` in lp_bld_format_s3tc.c of Mesa.
"""

from __future__ import annotations

import numpy as np

TEXELS = 16
# llvmpipe's weights of the second number in 1/256: the rounded quotient times the place, without its fraction
WEIGHTS_OF_7 = np.array([(255 * 64 // 7 * place) >> 6 for place in range(7)])
WEIGHTS_OF_5 = np.array([(255 * 64 // 5 * place) >> 6 for place in range(7)])
SMALLEST_SIGNED, LARGEST_SIGNED = -127, 127


def channel(blocks: np.ndarray, is_signed: bool = False) -> np.ndarray:
    """Return the numbers (..., 16) int64 of blocks (..., 8) uint8: 0 to 255, or -128 to 127 if they are signed."""
    kind = np.int8 if is_signed else np.uint8
    ends = np.ascontiguousarray(blocks[..., :2]).view(kind).astype(np.int64)
    first, second = ends[..., :1], ends[..., 1:]
    codes = _codes(blocks[..., 2:])
    places = np.maximum(codes - 1, 0)
    weights = np.where(first > second, WEIGHTS_OF_7[places], WEIGHTS_OF_5[places])
    between = (first + ((second - first) * weights >> 8) & 255).astype(np.uint8).view(kind).astype(np.int64)
    numbers = np.where(codes == 0, first, np.where(codes == 1, second, between))
    smallest, largest = (SMALLEST_SIGNED, LARGEST_SIGNED) if is_signed else (0, 255)
    has_limits = first <= second
    numbers = np.where(has_limits & (codes == 6), smallest, numbers)
    return np.where(has_limits & (codes == 7), largest, numbers)


def channel_as_read(blocks: np.ndarray, is_signed: bool = False) -> np.ndarray:
    """Return the numbers of blocks as `channel` does, as Mesa computes them for glGetTexImage: quotients, cut off."""
    ends = np.ascontiguousarray(blocks[..., :2]).view(np.int8 if is_signed else np.uint8).astype(np.int64)
    first, second = ends[..., :1], ends[..., 1:]
    codes = _codes(blocks[..., 2:])
    n_steps = np.where(first > second, 7, 5)
    weight = codes - 1
    sums = first * (n_steps - weight) + second * weight
    between = np.sign(sums) * (np.abs(sums) // n_steps)
    numbers = np.where(codes == 0, first, np.where(codes == 1, second, between))
    smallest, largest = (-128, 127) if is_signed else (0, 255)
    numbers = np.where((first <= second) & (codes == 6), smallest, numbers)
    return np.where((first <= second) & (codes == 7), largest, numbers)


def _codes(codes: np.ndarray) -> np.ndarray:
    """Return the codes (..., 16) of 3 bits in six bytes (..., 6), the lowest bits first."""
    bits = np.unpackbits(np.ascontiguousarray(codes), axis=-1, bitorder="little")
    groups = bits.reshape(*codes.shape[:-1], TEXELS, 3).astype(np.int64)
    return groups @ np.array([1, 2, 4])
