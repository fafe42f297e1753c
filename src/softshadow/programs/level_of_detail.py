"""Whether a texture is minified or magnified, for each 2x2 block of pixels, as llvmpipe decides it.

A block holds the coordinates of its four pixels: the first, the one right of it, the one in the next stored row, and
the one right of that. The differences to the first tell how many texels a step of one pixel crosses.

References: GL 2.1 sec. 3.8.8, 3.8.9 (switch-over at level 0); lp_bld_sample.c of Mesa 22.3 (rho, level of detail).
"""

from __future__ import annotations

import numpy as np

from softshadow.texture import Sampler

HALF, ONE = np.float32(0.5), np.float32(1.0)
EXPONENT_BIAS, MANTISSA_BITS, MANTISSA, ONE_BITS = 127, 23, 0x7FFFFF, 0x3F800000
LARGEST_LEVEL = 15  # a larger GL_TEXTURE_MAX_LOD limits nothing


def squared_texels_per_pixel(coordinates: np.ndarray, width: int, height: int) -> np.ndarray:
    """Return the larger of the squared steps (B,) to the right and to the next row; coordinates (4 B, 2 or more)."""
    blocks = coordinates[:, :2].reshape(-1, 4, 2)
    size = np.array((width, height), coordinates.dtype)
    steps = (blocks[:, 1:3] - blocks[:, :1]) * size
    steps = steps * steps
    larger: np.ndarray = (steps[..., 0] + steps[..., 1]).max(axis=1)
    return larger


def minified(coordinates: np.ndarray, width: int, height: int, sampler: Sampler) -> np.ndarray:
    """Return for each block (B,) of coordinates (4 B, 2 or more) whether its level of detail is above 0."""
    squared = squared_texels_per_pixel(coordinates, width, height)
    least, most = max(sampler.min_lod, 0.0), sampler.max_lod
    if least == most:
        return np.full(len(squared), least > 0)
    if sampler.lod_bias == 0 and least == 0 and most >= LARGEST_LEVEL:
        above: np.ndarray = squared > ONE
        return above
    level = HALF * coarse_log2(squared.astype(np.float32)) + np.float32(sampler.lod_bias)
    above = np.maximum(np.minimum(level, np.float32(most)), np.float32(least)) > 0
    return above


def coarse_log2(x: np.ndarray) -> np.ndarray:
    """Return the exponent plus the mantissa, less one: log2 at the powers of two, a straight line between them."""
    bits = x.view(np.int32)
    mantissa = (bits & MANTISSA | ONE_BITS).view(np.float32)
    return ((bits >> MANTISSA_BITS) - (EXPONENT_BIAS + 1)).astype(np.float32) + mantissa
