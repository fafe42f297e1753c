"""Linear filters in float for a block of fragments; equals `shade.shading.shade`, see fast/test_span_shading.py.

llvmpipe filters depths in float, and colours whose wrap modes are not those of `span_bytes`: GL_CLAMP,
GL_CLAMP_TO_BORDER and GL_MIRRORED_REPEAT.
"""

import numpy as np

from softshadow.jit import kernel
from softshadow.pipeline.constants import HALF, ONE, ZERO
from softshadow.pipeline.fast.fragment_block import (
    CORNER_00,
    CORNER_01,
    CORNER_10,
    CORNER_11,
    FILTERED,
    FIRST,
    LENGTH,
    LEVEL,
    LOWER_TEXEL,
    QUADS,
    R_AXIS,
    ROW,
    SECOND,
    SLICE_TEXEL,
    SQUARED,
    T_AXIS,
    TEXEL,
    TEXEL_ALPHA,
    TEXEL_BLUE,
    TEXEL_GREEN,
    WEIGHT,
    R,
    S,
    T,
    W,
)
from softshadow.pipeline.fast.span_bytes import BYTE, gather
from softshadow.pipeline.fast.span_cubes import FACE
from softshadow.pipeline.fast.span_places import NOTHING, ONE_TEXEL, move_by_slices, write_corners, write_places
from softshadow.pipeline.fast.span_state import (
    BORDER,
    CLAMPED,
    COMPARISON,
    IS_CUBE,
    IS_DEPTH,
    IS_LINE,
    IS_WIDE,
    SLICES,
    STEP,
    WRAP_R,
    WRAP_S,
    WRAP_T,
)
from softshadow.programs.wrapping import REPEAT_BY_MASK, mirror, to_int32
from softshadow.tokens import GL_CLAMP, GL_CLAMP_TO_EDGE, GL_MIRRORED_REPEAT, GL_REPEAT

LESS, EQUAL, GREATER, UNORDERED, CODES = np.int32(1), np.int32(2), np.int32(4), np.int32(8), np.int32(15)
OUT_00, OUT_10, OUT_01, OUT_11 = np.int32(1), np.int32(2), np.int32(4), np.int32(8)  # corners outside the image
ALL_OUT = OUT_00 | OUT_10 | OUT_01 | OUT_11
X_WEIGHT, Y_WEIGHT, Z_WEIGHT, OUTSIDE = W, SQUARED, QUADS, FILTERED  # rows that nothing else needs any more, or not yet
TIMES_FOUR = np.uint32(2)  # as a shift


@kernel
def begin_upper_level_in_float(count, room, whole):
    """Keep the texels as those of the lower level, and let LEVEL be the upper one; return whether any is mixed."""
    heaviest = ZERO
    for n in range(np.uint64(count)):
        heaviest = room[WEIGHT + n] if room[WEIGHT + n] > heaviest else heaviest
    if heaviest == ZERO:
        return False
    for n in range(np.uint64(count)):
        whole[LEVEL + n] += ONE_TEXEL if room[WEIGHT + n] > ZERO else NOTHING
    copy_texels_to(LOWER_TEXEL, count, room)
    return True


@kernel
def mix_levels(count, room):
    """Mix the texels of two levels by WEIGHT, where it is not 0."""
    for channel in range(4):
        row = np.uint64(channel) * ROW
        for n in range(np.uint64(count)):
            weight, lower = room[WEIGHT + n], room[LOWER_TEXEL + row + n]
            mixed = weight * (room[TEXEL + row + n] - lower) + lower
            room[TEXEL + row + n] = mixed if weight > ZERO else lower


@kernel
def filter_linearly(switches, numbers, unit, number, count, texels, room, whole):
    """Write the texels of linear filters on one level each; of depths, only the first channel."""
    write_places(switches, unit, count, whole)
    if switches[unit + IS_CUBE]:
        move_by_slices(FACE, count, whole)
    linear_places_in_float(S, np.uint64(0), switches[unit + WRAP_S], X_WEIGHT, count, room, whole)
    linear_places_in_float(T, T_AXIS, switches[unit + WRAP_T], Y_WEIGHT, count, room, whole)
    note_outside(count, whole)
    if not switches[unit + SLICES]:
        filter_image(switches, numbers, unit, number, count, texels, room, whole)
        return
    linear_places_in_float(R, R_AXIS, switches[unit + WRAP_R], Z_WEIGHT, count, room, whole)
    move_by_slices(R_AXIS + FIRST, count, whole)
    note_outside_of_slices(R_AXIS + FIRST, count, whole)
    filter_image(switches, numbers, unit, number, count, texels, room, whole)
    copy_texels_to(SLICE_TEXEL, count, room)
    for n in range(np.uint64(count)):  # how far the second slice is from the first one
        whole[R_AXIS + FIRST + n] = whole[R_AXIS + SECOND + n] - whole[R_AXIS + FIRST + n]
    move_by_slices(R_AXIS + FIRST, count, whole)
    note_outside(count, whole)
    note_outside_of_slices(R_AXIS + SECOND, count, whole)
    filter_image(switches, numbers, unit, number, count, texels, room, whole)
    for channel in range(4):
        row = np.uint64(channel) * ROW
        for n in range(np.uint64(count)):
            lower = room[SLICE_TEXEL + row + n]
            room[TEXEL + row + n] = room[Z_WEIGHT + n] * (room[TEXEL + row + n] - lower) + lower


@kernel
def copy_texels_to(rows, count, room):
    """Copy the rows from TEXEL on."""
    for channel in range(4):
        row = np.uint64(channel) * ROW
        for n in range(np.uint64(count)):
            room[rows + row + n] = room[TEXEL + row + n]


@kernel
def filter_image(switches, numbers, unit, number, count, texels, room, whole):
    """Write the texels of linear filters on the image that begins at OFFSET."""
    write_corners(count, whole)
    if switches[unit + IS_WIDE]:
        mix_floats(switches[unit + IS_LINE] != 0, numbers, number, count, texels.view(np.float32), room, whole)
        return
    if not switches[unit + IS_DEPTH]:
        mix_colors(numbers, number, count, texels, room, whole)
        return
    gather_depths(numbers, number, count, texels.view(np.float32), room, whole)
    if switches[unit + COMPARISON]:
        wanted = np.int32(switches[unit + COMPARISON]) & CODES
        compare_and_mix(wanted, switches[unit + CLAMPED] != 0, count, room)
    else:
        for n in range(np.uint64(count)):
            x, y = room[X_WEIGHT + n], room[Y_WEIGHT + n]
            lower = x * (room[TEXEL_GREEN + n] - room[TEXEL + n]) + room[TEXEL + n]
            upper = x * (room[TEXEL_ALPHA + n] - room[TEXEL_BLUE + n]) + room[TEXEL_BLUE + n]
            room[TEXEL + n] = y * (upper - lower) + lower


@kernel
def linear_places_in_float(coordinate, axis, wrap, weight, count, room, whole):
    """Write FIRST and SECOND of an axis and the row `weight`, as `wrapping.linear_texels`."""
    length, first, second = axis + LENGTH, axis + FIRST, axis + SECOND
    if wrap == REPEAT_BY_MASK:
        for n in range(np.uint64(count)):
            u, last = room[coordinate + n] * np.float32(whole[length + n]) - HALF, np.int32(whole[length + n] - 1)
            i = to_int32(np.floor(u))
            whole[first + n], whole[second + n] = i & last, np.int32(i + 1) & last
            room[weight + n] = u - np.floor(u)
    elif wrap == GL_REPEAT:
        for n in range(np.uint64(count)):
            c, last = room[coordinate + n], np.int32(whole[length + n] - 1)
            u = (c - np.floor(c)) * np.float32(whole[length + n]) - HALF
            i = last if u < ZERO else to_int32(np.floor(u))
            whole[first + n], whole[second + n] = i, NOTHING if i == last else np.int32(i + 1)
            room[weight + n] = u - np.floor(u)
    elif wrap == GL_MIRRORED_REPEAT:
        for n in range(np.uint64(count)):
            last = np.int32(whole[length + n] - 1)
            u = mirror(room[coordinate + n]) * np.float32(whole[length + n]) - HALF
            i = to_int32(np.floor(u))
            whole[first + n], whole[second + n] = max(i, NOTHING), min(np.int32(i + 1), last)
            room[weight + n] = u - np.floor(u)
    elif abs(wrap) == GL_CLAMP_TO_EDGE:
        in_texels = wrap < 0
        for n in range(np.uint64(count)):
            size, last = np.float32(whole[length + n]), np.int32(whole[length + n] - 1)
            u = room[coordinate + n] * (ONE if in_texels else size)
            u = (u if u < size else size) - HALF
            u = u if u > ZERO else ZERO
            i = to_int32(u)
            whole[first + n], whole[second + n] = i, min(np.int32(i + 1), last)
            room[weight + n] = u - np.floor(u)
    else:
        clamps, in_texels = abs(wrap) == GL_CLAMP, wrap < 0
        for n in range(np.uint64(count)):
            size = np.float32(whole[length + n])
            u = room[coordinate + n] * (ONE if in_texels else size)
            if clamps:
                u = u if u < size else size  # NaN too
                u = u if u > ZERO else ZERO
            u = u - HALF
            i = to_int32(np.floor(u))
            whole[first + n], whole[second + n] = i, np.int32(i + 1)
            room[weight + n] = u - np.floor(u)


@kernel
def note_outside(count, whole):
    """Write OUTSIDE: which of the four texels around each fragment are outside the image."""
    for n in range(np.uint64(count)):
        i0, i1, j0, j1 = whole[FIRST + n], whole[SECOND + n], whole[T_AXIS + FIRST + n], whole[T_AXIS + SECOND + n]
        width, height = np.uint32(whole[LENGTH + n]), np.uint32(whole[T_AXIS + LENGTH + n])
        left = NOTHING if np.uint32(i0) < width else np.int32(OUT_00 | OUT_01)
        right = NOTHING if np.uint32(i1) < width else np.int32(OUT_10 | OUT_11)
        low = NOTHING if np.uint32(j0) < height else np.int32(OUT_00 | OUT_10)
        high = NOTHING if np.uint32(j1) < height else np.int32(OUT_01 | OUT_11)
        whole[OUTSIDE + n] = left | right | low | high


@kernel
def note_outside_of_slices(slices, count, whole):
    """Add to OUTSIDE all texels of those slices, in the row `slices`, which are outside the image."""
    for n in range(np.uint64(count)):
        is_inside = np.uint32(whole[slices + n]) < np.uint32(whole[R_AXIS + LENGTH + n])
        whole[OUTSIDE + n] |= NOTHING if is_inside else ALL_OUT


@kernel
def mix_colors(numbers, number, count, texels, room, whole):
    """Write the four channels of a colour texture."""
    step = numbers[number + STEP]
    gather(texels, CORNER_00, count, whole)
    gather(texels, CORNER_10, count, whole)
    gather(texels, CORNER_01, count, whole)
    gather(texels, CORNER_11, count, whole)
    for channel in range(4):
        border, shift = numbers[number + BORDER + channel], np.int32(8 * channel)
        row = TEXEL + np.uint64(channel) * ROW
        for n in range(np.uint64(count)):
            x, y, out = room[X_WEIGHT + n], room[Y_WEIGHT + n], whole[OUTSIDE + n]
            a = np.float32(np.int32(whole[CORNER_00 + n] >> shift) & BYTE) * step
            b = np.float32(np.int32(whole[CORNER_10 + n] >> shift) & BYTE) * step
            c = np.float32(np.int32(whole[CORNER_01 + n] >> shift) & BYTE) * step
            d = np.float32(np.int32(whole[CORNER_11 + n] >> shift) & BYTE) * step
            a, b = border if out & OUT_00 else a, border if out & OUT_10 else b
            c, d = border if out & OUT_01 else c, border if out & OUT_11 else d
            a, c = x * (b - a) + a, x * (d - c) + c
            room[row + n] = y * (c - a) + a


@kernel
def mix_floats(is_line, numbers, number, count, values, room, whole):
    """Write the four channels of a colour texture of floats, four `values` for each texel; infinite ones stay."""
    largest = np.uint32((len(values) >> 2) - 1)
    for n in range(np.uint64(count)):
        whole[CORNER_00 + n] = np.int32(min(np.uint32(whole[CORNER_00 + n]), largest) << TIMES_FOUR)
        whole[CORNER_10 + n] = np.int32(min(np.uint32(whole[CORNER_10 + n]), largest) << TIMES_FOUR)
        whole[CORNER_01 + n] = np.int32(min(np.uint32(whole[CORNER_01 + n]), largest) << TIMES_FOUR)
        whole[CORNER_11 + n] = np.int32(min(np.uint32(whole[CORNER_11 + n]), largest) << TIMES_FOUR)
    for c in range(4):
        channel, border = np.uint64(c), numbers[number + BORDER + c]
        for n in range(np.uint64(count)):
            x, y, out = room[X_WEIGHT + n], room[Y_WEIGHT + n], whole[OUTSIDE + n]
            a, b = values[np.uint64(whole[CORNER_00 + n]) + channel], values[np.uint64(whole[CORNER_10 + n]) + channel]
            e, f = values[np.uint64(whole[CORNER_01 + n]) + channel], values[np.uint64(whole[CORNER_11 + n]) + channel]
            a, b = border if out & OUT_00 else a, border if out & OUT_10 else b
            e, f = border if out & OUT_01 else e, border if out & OUT_11 else f
            a, e = x * (b - a) + a, x * (f - e) + e
            room[TEXEL + channel * ROW + n] = a if is_line else y * (e - a) + a


@kernel
def gather_depths(numbers, number, count, depths, room, whole):
    """Write the depths of the four corners to the rows of the channels."""
    largest, step, border = np.uint32(len(depths) - 1), numbers[number + STEP], numbers[number + BORDER]
    for n in range(np.uint64(count)):
        out = whole[OUTSIDE + n]
        a = depths[np.uint64(min(np.uint32(whole[CORNER_00 + n]), largest))] * step
        b = depths[np.uint64(min(np.uint32(whole[CORNER_10 + n]), largest))] * step
        c = depths[np.uint64(min(np.uint32(whole[CORNER_01 + n]), largest))] * step
        d = depths[np.uint64(min(np.uint32(whole[CORNER_11 + n]), largest))] * step
        room[TEXEL + n] = border if out & OUT_00 else a
        room[TEXEL_GREEN + n] = border if out & OUT_10 else b
        room[TEXEL_BLUE + n] = border if out & OUT_01 else c
        room[TEXEL_ALPHA + n] = border if out & OUT_11 else d


@kernel
def compare_and_mix(wanted, clamped, count, room):
    """Write the share of the four corners' depths that compare with R as `wanted`."""
    if clamped:
        for n in range(np.uint64(count)):
            r = room[R + n] if room[R + n] > ZERO else ZERO
            room[R + n] = r if r < ONE else ONE
    for n in range(np.uint64(count)):
        r, x, y = room[R + n], room[X_WEIGHT + n], room[Y_WEIGHT + n]
        rest = ONE - x
        lower = rest if code_of(r, room[TEXEL + n]) & wanted else ZERO
        lower = (x if code_of(r, room[TEXEL_GREEN + n]) & wanted else ZERO) + lower
        upper = rest if code_of(r, room[TEXEL_BLUE + n]) & wanted else ZERO
        upper = (x if code_of(r, room[TEXEL_ALPHA + n]) & wanted else ZERO) + upper
        room[TEXEL + n] = y * (upper - lower) + lower


@kernel
def code_of(r, depth):
    """Return the result of a comparison, as in `span_state.COMPARISONS`."""
    return LESS if r < depth else EQUAL if r == depth else GREATER if r > depth else UNORDERED
