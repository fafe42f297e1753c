"""Level of detail of each 2x2 block of pixels, and the mipmap levels it selects, as in llvmpipe.

A block holds the coordinates of four pixels: the first, its right neighbour, and the two pixels of the next stored row.
The differences to the first pixel tell how many texels lie between neighbouring pixels.

References: GL 2.1 sec. 3.8.8, 3.8.9 (switch-over at level 0); lp_bld_sample.c of Mesa 22.3 (rho, level of detail).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.texture import Sampler

HALF, ONE, ROOT_OF_2 = np.float32(0.5), np.float32(1.0), np.float32(math.sqrt(2))
EXPONENT_BIAS, MANTISSA_BITS, MANTISSA, ONE_BITS = 127, 23, 0x7FFFFF, 0x3F800000
LARGEST_LEVEL = 15  # a larger GL_TEXTURE_MAX_LOD has no effect
BIAS_STEPS, LEAST_BIAS, LARGEST_BIAS = 256, -32.0, 31.0  # Mesa stores biases in steps of 1/256
# minification filter: (filter within a level, filter between levels or GL_NONE)
FILTERS = {
    gl.GL_NEAREST: (gl.GL_NEAREST, gl.GL_NONE),
    gl.GL_LINEAR: (gl.GL_LINEAR, gl.GL_NONE),
    gl.GL_NEAREST_MIPMAP_NEAREST: (gl.GL_NEAREST, gl.GL_NEAREST),
    gl.GL_LINEAR_MIPMAP_NEAREST: (gl.GL_LINEAR, gl.GL_NEAREST),
    gl.GL_NEAREST_MIPMAP_LINEAR: (gl.GL_NEAREST, gl.GL_LINEAR),
    gl.GL_LINEAR_MIPMAP_LINEAR: (gl.GL_LINEAR, gl.GL_LINEAR),
}


class Levels(NamedTuple):
    """Mipmap levels of each block (B,).

    `minified` is whether the minification filter applies; `lower` and `upper` are the levels below and above the level
    of detail, counted from the base level; `weight` (float32) is the weight of `upper`.
    """

    minified: np.ndarray
    lower: np.ndarray
    upper: np.ndarray
    weight: np.ndarray


def squared_texels_per_pixel(coordinates: np.ndarray, *sides: int) -> np.ndarray:
    """Return each block's larger squared step (B,), in texels, to the next column or row.

    The texture has two or three `sides`, and as many of the coordinates (4 B, 2 or more) count. Those of a rectangle
    are multiplied by its sides, too, although they are in texels already.
    """
    return squared_length(steps_in_blocks(coordinates, len(sides)), *sides)


def texels_per_pixel(coordinates: np.ndarray, width: int) -> np.ndarray:
    """Return each block's larger step (B,), in texels of a 1-D texture, to the next column or row."""
    steps: np.ndarray = abs(steps_in_blocks(coordinates, 1)[..., 0]).max(axis=1)
    return steps * steps.dtype.type(width)


def steps_in_blocks(coordinates: np.ndarray, n: int) -> np.ndarray:
    """Return the steps (B, 2, n) of the first n coordinates to the next column and to the next row."""
    blocks = coordinates[:, :n].reshape(-1, 4, n)
    steps: np.ndarray = blocks[:, 1:3] - blocks[:, :1]
    return steps


def squared_length(steps: np.ndarray, *sides: int) -> np.ndarray:
    """Return the larger squared length (B,), in texels, of two steps (B, 2, n) in texture coordinates."""
    texels = steps * np.array(sides, steps.dtype)
    texels = texels * texels
    total = texels[..., 0] + texels[..., 1]
    if len(sides) > 2:
        total = total + texels[..., 2]
    larger: np.ndarray = total.max(axis=1)
    return larger


def select_levels(squared: np.ndarray, sampler: Sampler, last: int, lengths: np.ndarray | None = None) -> Levels:
    """Return the mipmap levels of blocks with squared steps (B,), in texels; `last` is the smallest image's level.

    `lengths` are the steps themselves: the nearest level of a 1-D texture is computed from them.
    """
    squared = squared.astype(np.float32)
    between = FILTERS[sampler.min_filter][1]
    least, most, bias = max(sampler.min_lod, 0.0), sampler.max_lod, bias_of(sampler)
    nothing = np.zeros(len(squared), np.float32)
    if least != most and bias == 0 and least == 0 and most >= LARGEST_LEVEL and between != gl.GL_LINEAR:
        if lengths is not None:
            lengths = lengths.astype(np.float32)
            exponents = ((lengths * ROOT_OF_2).view(np.int32) >> MANTISSA_BITS & 0xFF) - EXPONENT_BIAS
            nearest = exponents.clip(0, last)
            return Levels(~(lengths <= ONE), nearest, nearest, nothing)
        exponents = (squared.view(np.int32) >> MANTISSA_BITS & 0xFF) - (EXPONENT_BIAS - 1)
        nearest = (exponents >> 1).clip(0, last)
        return Levels(~(squared <= ONE), nearest, nearest, nothing)
    level = _level_of_detail(squared, least, most, bias)
    minified = level > 0
    if between != gl.GL_LINEAR:
        nearest = np.rint(level).clip(0, last).astype(np.int32)
        return Levels(minified, nearest, nearest, nothing)
    floor = np.floor(level)
    inside = (floor >= 0) & (floor < last)
    lower = floor.clip(0, last).astype(np.int32)
    return Levels(minified, lower, lower + inside, np.where(inside, level - floor, nothing))


def truncated_levels(squared: np.ndarray, sampler: Sampler, last: int) -> np.ndarray:
    """Return the level of each block (B,) with an anisotropic filter; `squared` are its shorter squared steps."""
    level = _level_of_detail(squared.astype(np.float32), max(sampler.min_lod, 0.0), sampler.max_lod, bias_of(sampler))
    levels: np.ndarray = np.trunc(level).clip(0, last).astype(np.int32)
    return levels


def _level_of_detail(squared: np.ndarray, least: float, most: float, bias: float) -> np.ndarray:
    if least == most:
        return np.full(len(squared), least, np.float32)
    level = HALF * coarse_log2(squared) + np.float32(bias)
    return np.maximum(np.minimum(level, np.float32(most)), np.float32(least)) if _limits(least, most) else level


def _limits(least: float, most: float) -> bool:
    return least > 0 or most < LARGEST_LEVEL


def bias_of(sampler: Sampler) -> float:
    """Return the sum of the biases of the texture and of its unit, as Mesa applies them."""
    return quantized_bias(sampler.lod_bias) + quantized_bias(sampler.unit_lod_bias)


def quantized_bias(bias: float) -> float:
    """Return GL_TEXTURE_LOD_BIAS as Mesa applies it: clamped, and rounded to steps of 1/256, halves away from zero."""
    steps = min(max(bias, LEAST_BIAS), LARGEST_BIAS) * BIAS_STEPS
    return math.copysign(math.floor(abs(steps) + 0.5), steps) / BIAS_STEPS


def coarse_log2(x: np.ndarray) -> np.ndarray:
    """Return exponent + mantissa - 1: exact log2 at powers of two, linear between them."""
    bits = x.view(np.int32)
    mantissa = (bits & MANTISSA | ONE_BITS).view(np.float32)
    return ((bits >> MANTISSA_BITS) - (EXPONENT_BIAS + 1)).astype(np.float32) + mantissa
