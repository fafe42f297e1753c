"""Textures of bytes, filtered for a block of fragments; equals `shade.shading.shade`, see fast/test_span_shading.py.

As llvmpipe does it, in integers: two channels in each of two 32-bit numbers.
"""

import numpy as np

from softshadow.jit import kernel
from softshadow.pipeline.fast.fragment_block import (
    CORNER_00,
    CORNER_01,
    CORNER_10,
    CORNER_11,
    FILTERED,
    FIRST,
    FRACTION,
    LEVEL,
    LINEAR,
    LOWER,
    NEXT,
    OFFSET,
    PITCH,
    R_AXIS,
    SECOND,
    SLICE,
    STEPS,
    T_AXIS,
    TEXEL,
    TEXEL_ALPHA,
    TEXEL_BLUE,
    TEXEL_GREEN,
    WEIGHT,
    R,
    S,
    T,
)
from softshadow.pipeline.fast.span_cubes import FACE
from softshadow.pipeline.fast.span_places import (
    NOTHING,
    ONE_TEXEL,
    linear_places,
    move_by_slices,
    nearest_places,
    write_corners,
    write_places,
)
from softshadow.pipeline.fast.span_state import (
    IS_CUBE,
    LOD_MODE,
    MAG_LINEAR,
    MIN_LINEAR,
    NO_LEVELS,
    PACKED_LEVELS,
    SLICES,
    WRAP_R,
    WRAP_S,
    WRAP_T,
)
from softshadow.programs.filtering import UNORM8_STEP

BYTE = np.int32(255)
EVEN, HALVES = np.int32(0x00FF00FF), np.int32(0x00800080)  # two bytes of a pixel, and the rounding of both
WEIGHT_STEPS = np.float32(256.0)
# rows of pairs of texels, 64 bits each, in the place of two rows of `whole`
UPPER_PAIRS, LOWER_PAIRS, HALF_OF_PAIR = CORNER_00 >> np.uint64(1), CORNER_01 >> np.uint64(1), np.uint64(32)


@kernel
def filter_block(switches, unit, count, texels, room, whole):
    """Write FILTERED: the four bytes of each fragment, those of two levels mixed."""
    filter_level(switches, unit, count, texels, room, whole)
    if switches[unit + PACKED_LEVELS] and begin_upper_level(count, room, whole):
        filter_level(switches, unit, count, texels, room, whole)
        for n in range(np.uint64(count)):
            whole[FILTERED + n] = mix_bytes_of(whole[STEPS + n], whole[LOWER + n], whole[FILTERED + n])


@kernel
def filter_level(switches, unit, count, texels, room, whole):
    """Write FILTERED: the four bytes of each fragment's LEVEL, linear where LINEAR is 1, else nearest."""
    write_places(switches, unit, count, whole)
    if switches[unit + IS_CUBE]:
        move_by_slices(FACE, count, whole)
    wrap_s, wrap_t = switches[unit + WRAP_S], switches[unit + WRAP_T]
    small, large = switches[unit + MIN_LINEAR], switches[unit + MAG_LINEAR]
    if switches[unit + LOD_MODE] == NO_LEVELS:
        small = large
    if not small and not large:
        nearest_places(S, np.uint64(0), wrap_s, FIRST, count, room, whole)
        nearest_places(T, T_AXIS, wrap_t, FIRST, count, room, whole)
        if switches[unit + SLICES]:
            nearest_places(R, R_AXIS, switches[unit + WRAP_R], FIRST, count, room, whole)
            move_by_slices(R_AXIS + FIRST, count, whole)
        for n in range(np.uint64(count)):
            j = np.int32(whole[T_AXIS + FIRST + n] * whole[PITCH + n])
            whole[FILTERED + n] = np.int32(whole[OFFSET + n] + j) + whole[FIRST + n]
        gather(texels, FILTERED, count, whole)
        return
    linear_places(S, np.uint64(0), wrap_s, count, room, whole)
    linear_places(T, T_AXIS, wrap_t, count, room, whole)
    if switches[unit + SLICES]:
        linear_places(R, R_AXIS, switches[unit + WRAP_R], count, room, whole)
    if small != large:  # the nearest texel is the mixture of this texel with itself
        nearest_places(S, np.uint64(0), wrap_s, CORNER_00, count, room, whole)
        nearest_places(T, T_AXIS, wrap_t, CORNER_00, count, room, whole)
        take_nearest(np.uint64(0), CORNER_00, count, whole)
        take_nearest(T_AXIS, T_AXIS + CORNER_00, count, whole)
        if switches[unit + SLICES]:
            nearest_places(R, R_AXIS, switches[unit + WRAP_R], SLICE - R_AXIS, count, room, whole)
            take_nearest(R_AXIS, SLICE, count, whole)
    if not switches[unit + SLICES]:
        mix_corners(count, texels, whole)
        return
    for n in range(np.uint64(count)):
        whole[R_AXIS + SECOND + n] -= whole[R_AXIS + FIRST + n]
    move_by_slices(R_AXIS + FIRST, count, whole)
    mix_corners(count, texels, whole)
    for n in range(np.uint64(count)):
        whole[SLICE + n] = whole[FILTERED + n]
    move_by_slices(R_AXIS + SECOND, count, whole)
    mix_corners(count, texels, whole)
    for n in range(np.uint64(count)):
        whole[FILTERED + n] = mix_bytes_of(whole[R_AXIS + FRACTION + n], whole[SLICE + n], whole[FILTERED + n])


@kernel
def take_nearest(axis, nearest, count, whole):
    """Replace FIRST and SECOND of an axis by the row `nearest`, where LINEAR is 0."""
    for n in range(np.uint64(count)):
        is_linear, texel = whole[LINEAR + n] != NOTHING, whole[nearest + n]
        whole[axis + FIRST + n] = whole[axis + FIRST + n] if is_linear else texel
        whole[axis + SECOND + n] = whole[axis + SECOND + n] if is_linear else texel
        whole[axis + FRACTION + n] = whole[axis + FRACTION + n] if is_linear else NOTHING


@kernel
def mix_corners(count, texels, whole):
    """Write FILTERED: the mixture of the texels at FIRST and SECOND of s and t."""
    if are_side_by_side(count, whole):
        mix_pairs(count, texels, whole)
        return
    write_corners(count, whole)
    gather(texels, CORNER_00, count, whole)
    gather(texels, CORNER_10, count, whole)
    gather(texels, CORNER_01, count, whole)
    gather(texels, CORNER_11, count, whole)
    for n in range(np.uint64(count)):
        x, y = whole[FRACTION + n], whole[T_AXIS + FRACTION + n]
        first = mix_bytes_of(x, whole[CORNER_00 + n], whole[CORNER_10 + n])
        whole[FILTERED + n] = mix_bytes_of(y, first, mix_bytes_of(x, whole[CORNER_01 + n], whole[CORNER_11 + n]))


@kernel
def are_side_by_side(count, whole):
    """Return whether SECOND of s is the texel after FIRST for all fragments: no coordinate is wrapped or clamped."""
    differs = NOTHING
    for n in range(np.uint64(count)):
        differs |= np.int32(np.int32(whole[SECOND + n] - whole[FIRST + n]) ^ ONE_TEXEL)
    return differs == NOTHING


@kernel
def mix_pairs(count, texels, whole):
    """Do what `mix_corners` does where the two texels of a row lie side by side: they are loaded together."""
    pairs = whole.view(np.uint64)
    gather_pairs(texels, T_AXIS + FIRST, UPPER_PAIRS, count, whole, pairs)
    gather_pairs(texels, T_AXIS + SECOND, LOWER_PAIRS, count, whole, pairs)
    for n in range(np.uint64(count)):
        x, y = whole[FRACTION + n], whole[T_AXIS + FRACTION + n]
        upper, lower = pairs[UPPER_PAIRS + n], pairs[LOWER_PAIRS + n]
        first = mix_bytes_of(x, np.int32(upper), np.int32(upper >> HALF_OF_PAIR))
        second = mix_bytes_of(x, np.int32(lower), np.int32(lower >> HALF_OF_PAIR))
        whole[FILTERED + n] = mix_bytes_of(y, first, second)


@kernel
def gather_pairs(texels, row, target, count, whole, pairs):
    """Write the texels at FIRST and SECOND of s, and at `row` of t, to `pairs` (uint64, the memory of `whole`)."""
    largest = np.uint32(len(texels) - 2)
    for n in range(np.uint64(count)):  # a loop of its own, see `gather`; FILTERED is not in use yet
        place = np.int32(np.int32(whole[OFFSET + n] + np.int32(whole[row + n] * whole[PITCH + n])) + whole[FIRST + n])
        whole[FILTERED + n] = np.int32(min(np.uint32(place), largest))
    for n in range(np.uint64(count)):
        at = np.uint64(np.uint32(whole[FILTERED + n]))
        left, right = np.uint64(np.uint32(texels[at])), np.uint64(np.uint32(texels[at + NEXT]))
        pairs[target + n] = left | right << HALF_OF_PAIR


@kernel
def gather(texels, row, count, whole):
    """Replace the places in a row by the texels there."""
    largest = np.uint32(len(texels) - 1)
    for n in range(np.uint64(count)):  # a loop of its own, since the loads of the next one are not vectorised
        whole[row + n] = np.int32(min(np.uint32(whole[row + n]), largest))
    for n in range(np.uint64(count)):
        whole[row + n] = texels[np.uint64(np.uint32(whole[row + n]))]


@kernel
def begin_upper_level(count, room, whole):
    """Write STEPS, and let LEVEL be the upper level where its weight is not 0; return whether it is anywhere."""
    mixed = NOTHING
    for n in range(np.uint64(count)):
        steps = np.int32(room[WEIGHT + n] * WEIGHT_STEPS)
        whole[STEPS + n] = steps
        mixed |= steps
    if mixed:
        for n in range(np.uint64(count)):
            whole[LOWER + n] = whole[FILTERED + n]
            whole[LEVEL + n] += ONE_TEXEL if whole[STEPS + n] > NOTHING else NOTHING
    return mixed != NOTHING


@kernel
def unpack_texels(count, room, whole):
    """Write the filtered bytes as floats."""
    for n in range(np.uint64(count)):
        texel = whole[FILTERED + n]
        room[TEXEL + n] = np.float32(texel & BYTE) * UNORM8_STEP
        room[TEXEL_GREEN + n] = np.float32(np.int32(texel >> 8) & BYTE) * UNORM8_STEP
        room[TEXEL_BLUE + n] = np.float32(np.int32(texel >> 16) & BYTE) * UNORM8_STEP
        room[TEXEL_ALPHA + n] = np.float32(np.int32(texel >> 24) & BYTE) * UNORM8_STEP


@kernel
def mix_bytes_of(weight, a, b):
    """Return `filtering.mix_fixed_point` of four bytes: a * (256 - weight) + b * weight + 128, divided by 256."""
    even, odd = np.int32(a & EVEN), np.int32(np.int32(a >> 8) & EVEN)
    more_even, more_odd = np.int32(b & EVEN), np.int32(np.int32(b >> 8) & EVEN)
    even = np.int32(np.int32(np.int32(np.int32(more_even - even) * weight) + np.int32(even << 8)) + HALVES)
    odd = np.int32(np.int32(np.int32(np.int32(more_odd - odd) * weight) + np.int32(odd << 8)) + HALVES)
    return np.int32(np.int32(np.int32(even >> 8) & EVEN) | np.int32(odd & ~EVEN))
