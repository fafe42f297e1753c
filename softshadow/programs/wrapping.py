"""Texture coordinates to texels of one axis: GL's wrap modes, bit for bit as llvmpipe computes them.

A texel index outside [0, size) stands for the border colour. All arithmetic is in the type of the coordinate.

References: GL 2.1 sec. 3.8.7, 3.8.8; GL_TEXTURE_2D of llvmpipe 22.3 (wrap functions of its sampler).
"""

import numpy as np

from softshadow.jit import inlined, kernel
from softshadow.tokens import GL_CLAMP, GL_CLAMP_TO_BORDER, GL_CLAMP_TO_EDGE, GL_MIRRORED_REPEAT, GL_REPEAT

ZERO, ONE, HALF = np.float32(0.0), np.float32(1.0), np.float32(0.5)
BELOW_ONE = np.float32(1.0) - np.float32(2.0**-24)
INT_LIMIT = np.float32(2.0**31)
FIXED_ONE = np.float32(256.0)
OUT_OF_RANGE = -(2**31)  # what the CPU's float-to-integer conversion answers beyond 32 bits, and for NaN
LOWEST_INT32, NO_TEXELS = np.int32(OUT_OF_RANGE), np.int32(0)

# GL_REPEAT of a texture whose first level has a power of two as size: llvmpipe masks texel indices. All its levels go
# by the first: the 4 texels below 9 repeat as 9 would.
REPEAT_BY_MASK = 1
FIXED_POINT_WRAPS = (GL_REPEAT, REPEAT_BY_MASK, GL_CLAMP_TO_EDGE)
# modes as numbers of one type: of literals, each would have a `nearest_texel` compiled for itself
BY_MASK, REPEAT, TO_BORDER, MIRRORED, TO_EDGE = (
    np.int64(wrap) for wrap in (REPEAT_BY_MASK, GL_REPEAT, GL_CLAMP_TO_BORDER, GL_MIRRORED_REPEAT, GL_CLAMP_TO_EDGE)
)
WRAPS = (GL_REPEAT, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_BORDER, GL_CLAMP, GL_MIRRORED_REPEAT)


@kernel
def to_integer(value):
    """Return the value truncated to a 32-bit integer, as the CPU's vector instruction does it."""
    if value >= -INT_LIMIT and value < INT_LIMIT:
        return int(value)
    return OUT_OF_RANGE


def wrap_code(wrap: int, size: int) -> int:
    """Return what the kernels take for a wrap mode of a texture whose first level has `size` texels on the axis."""
    return REPEAT_BY_MASK if wrap == GL_REPEAT and size & (size - 1) == 0 else wrap


@inlined
def mirrored(coordinate):
    """Return the distance in [0, 1] to the nearest even integer."""
    half = coordinate * HALF
    part = half - np.rint(half)
    distance = abs(part + part)
    return distance if distance > ZERO else ZERO  # NaN becomes 0


@kernel
def to_int32(value):
    """Return `to_integer` as 32 bits, of which a vector has twice as many."""
    return np.int32(value) if value >= -INT_LIMIT and value < INT_LIMIT else LOWEST_INT32


@kernel
def nearest_texel(coordinate, size, wrap):
    """Return the index of the texel that contains a normalized coordinate."""
    length, last = np.float32(size), np.int32(size - 1)
    if wrap == REPEAT_BY_MASK:
        return to_int32(np.floor(coordinate * length)) & last
    if wrap == GL_REPEAT:
        part = coordinate - np.floor(coordinate)
        return to_int32((part if part < BELOW_ONE else BELOW_ONE) * length)
    if wrap == GL_CLAMP_TO_BORDER:
        return to_int32(np.floor(coordinate * length))
    if wrap == GL_MIRRORED_REPEAT:
        return min(to_int32(mirrored(coordinate) * length), last)
    return min(
        max(to_int32(coordinate * length), NO_TEXELS), last
    )  # GL_CLAMP too: half a border texel is never nearest


@kernel
def nearest_texels(coordinates, size, wrap, texels):
    """Write `nearest_texel` of coordinates (N,) to `texels` (N,) int32.

    A loop for each mode: with the choice inside, a loop is not vectorised and takes 20 times as long.
    """
    if wrap == REPEAT_BY_MASK:
        for n in range(len(coordinates)):
            texels[n] = nearest_texel(coordinates[n], size, BY_MASK)
    elif wrap == GL_REPEAT:
        for n in range(len(coordinates)):
            texels[n] = nearest_texel(coordinates[n], size, REPEAT)
    elif wrap == GL_CLAMP_TO_BORDER:
        for n in range(len(coordinates)):
            texels[n] = nearest_texel(coordinates[n], size, TO_BORDER)
    elif wrap == GL_MIRRORED_REPEAT:
        for n in range(len(coordinates)):
            texels[n] = nearest_texel(coordinates[n], size, MIRRORED)
    else:
        for n in range(len(coordinates)):
            texels[n] = nearest_texel(coordinates[n], size, TO_EDGE)


@kernel
def linear_texels(coordinate, size, wrap):
    """Return (first texel, second texel, weight of the second) for a linear filter in float."""
    length, last = np.float32(size), size - 1
    if wrap == REPEAT_BY_MASK:
        u = coordinate * length - HALF
        first = to_integer(np.floor(u))
        return first & last, (first + 1) & last, u - np.floor(u)
    if wrap == GL_REPEAT:
        u = (coordinate - np.floor(coordinate)) * length - HALF
        first = last if u < ZERO else to_integer(np.floor(u))
        return first, 0 if first == last else first + 1, u - np.floor(u)
    if wrap == GL_CLAMP_TO_EDGE:
        u = coordinate * length
        u = (u if u < length else length) - HALF
        u = u if u > ZERO else ZERO
        first = to_integer(u)
        return first, min(first + 1, last), u - np.floor(u)
    if wrap == GL_MIRRORED_REPEAT:
        u = mirrored(coordinate) * length - HALF
        first = to_integer(np.floor(u))
        return max(first, 0), min(first + 1, last), u - np.floor(u)
    u = coordinate * length
    if wrap == GL_CLAMP:
        u = u if u < length else length  # NaN too
        u = u if u > ZERO else ZERO
    u = u - HALF
    first = to_integer(np.floor(u))
    return first, first + 1, u - np.floor(u)


@kernel
def fixed_point_texels(coordinate, size, wrap):
    """Return (first texel, second texel, weight of the second in 1/256); wrap is one of `FIXED_POINT_WRAPS`."""
    last = size - 1
    if wrap == GL_REPEAT:
        part = (coordinate - np.floor(coordinate)) * np.float32(size)
        position = to_integer(np.rint(part * FIXED_ONE)) - 128
        first = position >> 8
        first = last if first < 0 else min(first, last)
        return first, 0 if first == last else first + 1, position & 255
    position = to_integer(np.rint(coordinate * np.float32(256 * size))) - 128
    if position < OUT_OF_RANGE:
        position += 2**32
    first = position >> 8
    if wrap == REPEAT_BY_MASK:
        return first & last, (first + 1) & last, position & 255
    return min(max(first, 0), last), min(max(first + 1, 0), last), position & 255
