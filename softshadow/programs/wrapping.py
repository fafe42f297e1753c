"""GL's wrap modes: from a texture coordinate to texel indices on one axis, bit for bit as llvmpipe.

A texel index outside [0, size) means the border colour. All arithmetic is in the type of the coordinate.

References: GL 2.1 sec. 3.8.7, 3.8.8; GL_TEXTURE_2D of llvmpipe 22.3 (wrap functions of its sampler).
"""

import numpy as np

from softshadow.jit import inlined, kernel
from softshadow.tokens import GL_CLAMP, GL_CLAMP_TO_BORDER, GL_CLAMP_TO_EDGE, GL_MIRRORED_REPEAT, GL_REPEAT

ZERO, ONE, HALF = np.float32(0.0), np.float32(1.0), np.float32(0.5)
BELOW_ONE = np.float32(1.0) - np.float32(2.0**-24)
INT_LIMIT = np.float32(2.0**31)
FIXED_ONE = np.float32(256.0)
OUT_OF_RANGE = -(2**31)  # result of the CPU's float-to-integer conversion beyond 32 bits, and for NaN
LOWEST_INT32, NO_TEXELS = np.int32(OUT_OF_RANGE), np.int32(0)

# GL_REPEAT of a texture whose level 0 has a power of two as size: llvmpipe masks texel indices. Level 0 decides for all
# levels: a level of 4 texels below one of 9 is not masked.
REPEAT_BY_MASK = 1
FIXED_POINT_WRAPS = (GL_REPEAT, REPEAT_BY_MASK, GL_CLAMP_TO_EDGE)
# modes as int64 values: with literals, `nearest_texel` would be compiled once for each mode
BY_MASK, REPEAT, TO_BORDER, MIRRORED, TO_EDGE = (
    np.int64(wrap) for wrap in (REPEAT_BY_MASK, GL_REPEAT, GL_CLAMP_TO_BORDER, GL_MIRRORED_REPEAT, GL_CLAMP_TO_EDGE)
)
WRAPS = (GL_REPEAT, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_BORDER, GL_CLAMP, GL_MIRRORED_REPEAT)


@kernel
def to_integer(value):
    """Return the value truncated to a 32-bit integer, as the CPU's vector instruction does."""
    if value >= -INT_LIMIT and value < INT_LIMIT:
        return int(value)
    return OUT_OF_RANGE


def wrap_code(wrap: int, size: int) -> int:
    """Return the kernels' code for a wrap mode of a texture whose level 0 has `size` texels on this axis."""
    return REPEAT_BY_MASK if wrap == GL_REPEAT and size & (size - 1) == 0 else wrap


@inlined
def mirror(coordinate):
    """Return the distance of a coordinate to the nearest even integer, in [0, 1]."""
    half = coordinate * HALF
    part = half - np.rint(half)
    distance = abs(part + part)
    return distance if distance > ZERO else ZERO  # NaN becomes 0


@kernel
def to_int32(value):
    """Return `to_integer` as int32: twice as many values fit in a vector register."""
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
        return min(to_int32(mirror(coordinate) * length), last)
    # GL_CLAMP_TO_EDGE, and GL_CLAMP, where the border is never nearest
    return min(max(to_int32(coordinate * length), NO_TEXELS), last)


@kernel
def nearest_texel_at(u, size, wrap):
    """Return the index of the texel that contains a position in texels; wrap is one of the clamp modes."""
    if wrap == GL_CLAMP_TO_BORDER:
        return to_int32(np.floor(u))
    return min(max(to_int32(u), NO_TEXELS), np.int32(size - 1))


@kernel
def nearest_texels(coordinates, size, wrap, texels):
    """Write `nearest_texel` of coordinates (N,) to `texels` (N,) int32.

    Each mode has its own loop: with the branch inside, the loop would not be vectorised and be 20 times as slow.
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
    if wrap == GL_MIRRORED_REPEAT:
        u = mirror(coordinate) * length - HALF
        first = to_integer(np.floor(u))
        return max(first, 0), min(first + 1, last), u - np.floor(u)
    return linear_texels_at(coordinate * length, size, wrap)


@kernel
def linear_texels_at(u, size, wrap):
    """Return what `linear_texels` does for a position in texels; wrap is one of the clamp modes."""
    length, last = np.float32(size), size - 1
    if wrap == GL_CLAMP_TO_EDGE:
        u = (u if u < length else length) - HALF
        u = u if u > ZERO else ZERO
        first = to_integer(u)
        return first, min(first + 1, last), u - np.floor(u)
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
