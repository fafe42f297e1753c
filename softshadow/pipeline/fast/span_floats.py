"""Textures filtered in float for a block of fragments; equals `shade.shading.shade`, see fast/test_span_shading.py.

The nearest depth is compared in a few loops (`compare_nearest_depths`). Filters that are the same for all fragments of
the block take a few loops, too (`read_nearest`, `span_linear`). Everything else goes texel by texel, with the functions
of `softshadow.programs.wrapping`.
"""

import numpy as np

from softshadow.jit import kernel
from softshadow.pipeline.constants import ONE, ZERO
from softshadow.pipeline.fast.fragment_block import (
    FILTERED,
    FIRST,
    LENGTH,
    LEVEL,
    LINEAR,
    NEXT,
    OFFSET,
    PITCH,
    R_AXIS,
    ROW,
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
from softshadow.pipeline.fast.span_bytes import BYTE
from softshadow.pipeline.fast.span_cubes import FACE
from softshadow.pipeline.fast.span_linear import (
    CODES,
    begin_upper_level_in_float,
    code_of,
    filter_linearly,
    mix_levels,
)
from softshadow.pipeline.fast.span_places import NOTHING, ONE_TEXEL, move_by_slices, nearest_places, write_places
from softshadow.pipeline.fast.span_state import (
    BORDER,
    CLAMPED,
    COMPARISON,
    HEIGHT,
    IS_CUBE,
    IS_DEPTH,
    IS_WIDE,
    LEVEL_OFFSETS,
    PACKED_LEVELS,
    ROW_LENGTH,
    SLICES,
    STEP,
    WIDTH,
    WRAP_R,
    WRAP_S,
    WRAP_T,
)
from softshadow.programs.wrapping import linear_texels, linear_texels_at, nearest_texel, nearest_texel_at

FOUR_NUMBERS = np.uint64(4)  # of a texel of floats
OUTSIDE_IMAGE = np.int32(-1)  # as a place


@kernel
def find_nearest(switches, unit, count, room, whole):
    """Write FILTERED: where the nearest texels are stored, or OUTSIDE_IMAGE."""
    write_places(switches, unit, count, whole)
    if switches[unit + IS_CUBE]:
        move_by_slices(FACE, count, whole)
    nearest_places(S, np.uint64(0), switches[unit + WRAP_S], FIRST, count, room, whole)
    nearest_places(T, T_AXIS, switches[unit + WRAP_T], FIRST, count, room, whole)
    if switches[unit + SLICES]:
        nearest_places(R, R_AXIS, switches[unit + WRAP_R], FIRST, count, room, whole)
        move_by_slices(R_AXIS + FIRST, count, whole)
        for n in range(np.uint64(count)):  # a row outside, if the slice is
            is_inside = np.uint32(whole[R_AXIS + FIRST + n]) < np.uint32(whole[R_AXIS + LENGTH + n])
            whole[T_AXIS + FIRST + n] = whole[T_AXIS + FIRST + n] if is_inside else OUTSIDE_IMAGE
    for n in range(np.uint64(count)):
        i, j = whole[FIRST + n], whole[T_AXIS + FIRST + n]
        inside = (np.uint32(i) < np.uint32(whole[LENGTH + n])) & (np.uint32(j) < np.uint32(whole[T_AXIS + LENGTH + n]))
        place = np.int32(np.int32(whole[OFFSET + n] + np.int32(j * whole[PITCH + n])) + i)
        whole[FILTERED + n] = place if inside else OUTSIDE_IMAGE


@kernel
def compare_nearest_depths(switches, numbers, unit, number, count, texels, room, whole):
    """Write 0 or 1 for R compared with the nearest depth, as `filtering.compare_depth`."""
    find_nearest(switches, unit, count, room, whole)
    depths, border, step = texels.view(np.float32), numbers[number + BORDER], numbers[number + STEP]
    largest = np.uint32(len(texels) - 1)
    for n in range(np.uint64(count)):
        room[W + n] = depths[np.uint64(min(np.uint32(whole[FILTERED + n]), largest))]
    clamped, wanted = switches[unit + CLAMPED] != 0, np.int32(switches[unit + COMPARISON]) & CODES
    for n in range(np.uint64(count)):
        depth = room[W + n] * step if whole[FILTERED + n] != OUTSIDE_IMAGE else border
        r = room[R + n]
        if clamped:
            r = r if r > ZERO else ZERO
            r = r if r < ONE else ONE
        room[TEXEL + n] = ONE if code_of(r, depth) & wanted else ZERO


@kernel
def sample_in_float(switches, numbers, unit, number, count, texels, room, whole):
    """Write the texels, filtered in float, with borders and comparisons of depths."""
    all_linear, none_linear = have_all(count, LINEAR, ONE_TEXEL, whole), have_all(count, LINEAR, NOTHING, whole)
    if all_linear or (none_linear and not switches[unit + IS_DEPTH]):
        filter_alike(all_linear, switches, numbers, unit, number, count, texels, room, whole)
        if begin_upper_level_in_float(count, room, whole):
            filter_alike(all_linear, switches, numbers, unit, number, count, texels, room, whole)
            mix_levels(count, room)
        return
    for m in range(count):
        n = np.uint64(m)
        level, linear = whole[LEVEL + n], whole[LINEAR + n] != 0
        s, t, r = room[S + n], room[T + n], room[R + n]
        red, green, blue, alpha = texel_of_level(switches, numbers, unit, number, level, linear, s, t, r, texels)
        weight = room[WEIGHT + n]
        if weight > ZERO:
            level = np.int32(level + ONE_TEXEL)
            a, b, c, d = texel_of_level(switches, numbers, unit, number, level, linear, s, t, r, texels)
            red, green = weight * (a - red) + red, weight * (b - green) + green
            blue, alpha = weight * (c - blue) + blue, weight * (d - alpha) + alpha
        room[TEXEL + n], room[TEXEL_GREEN + n], room[TEXEL_BLUE + n], room[TEXEL_ALPHA + n] = red, green, blue, alpha


@kernel
def have_all(count, row, value, whole):
    """Return whether all fragments have a value in a row."""
    differs = NOTHING
    for n in range(np.uint64(count)):
        differs |= whole[row + n] ^ value
    return differs == NOTHING


@kernel
def filter_alike(is_linear, switches, numbers, unit, number, count, texels, room, whole):
    """Write the texels of one level each, by linear filters, or the nearest colours."""
    if is_linear:
        filter_linearly(switches, numbers, unit, number, count, texels, room, whole)
    else:
        read_nearest(switches, numbers, unit, number, count, texels, room, whole)


@kernel
def read_nearest(switches, numbers, unit, number, count, texels, room, whole):
    """Write the nearest colours of one level each, as `filtering.gather_texels`."""
    find_nearest(switches, unit, count, room, whole)
    is_wide = switches[unit + IS_WIDE] != 0
    largest = np.uint32((len(texels) >> 2 if is_wide else len(texels)) - 1)
    for n in range(np.uint64(count)):
        whole[FIRST + n] = np.int32(min(np.uint32(whole[FILTERED + n]), largest))
    values, step = texels.view(np.float32), numbers[number + STEP]
    for c in range(4):
        row, border, channel = TEXEL + np.uint64(c) * ROW, numbers[number + BORDER + c], np.uint64(c)
        if is_wide:
            for n in range(np.uint64(count)):
                value = values[np.uint64(whole[FIRST + n]) * FOUR_NUMBERS + channel]
                room[row + n] = value if whole[FILTERED + n] != OUTSIDE_IMAGE else border
        else:
            shift = np.int32(8 * c)
            for n in range(np.uint64(count)):
                texel = np.int32(texels[np.uint64(whole[FIRST + n])] >> shift)
                room[row + n] = np.float32(texel & BYTE) * step if whole[FILTERED + n] != OUTSIDE_IMAGE else border


@kernel
def texel_of_level(switches, numbers, unit, number, level, linear, s, t, r, texels):
    """Return the four stored channels of one level at (s, t), filtered; of depths, only the first one counts."""
    width, height, pitch = switches[unit + WIDTH], switches[unit + HEIGHT], switches[unit + ROW_LENGTH]
    offset = 0
    if switches[unit + PACKED_LEVELS]:
        width, height = max(width >> level, 1), max(height >> level, 1)
        pitch, offset = width, switches[unit + LEVEL_OFFSETS + level]
    if switches[unit + CLAMPED] != 0 and switches[unit + COMPARISON]:
        r = r if r > ZERO else ZERO
        r = r if r < ONE else ONE
    wrap_s, wrap_t = switches[unit + WRAP_S], switches[unit + WRAP_T]
    if not linear:
        if wrap_s < 0:
            i, j = nearest_texel_at(s, width, -wrap_s), nearest_texel_at(t, height, -wrap_t)
        else:
            i, j = nearest_texel(s, width, wrap_s), nearest_texel(t, height, wrap_t)
        place = place_of(np.int64(i), np.int64(j), width, height, pitch, offset, texels)
        return channels_of(switches, numbers, unit, number, place, r, ONE, texels)
    if wrap_s < 0:
        i0, i1, x = linear_texels_at(s, width, -wrap_s)
        j0, j1, y = linear_texels_at(t, height, -wrap_t)
    else:
        i0, i1, x = linear_texels(s, width, wrap_s)
        j0, j1, y = linear_texels(t, height, wrap_t)
    at_00 = place_of(np.int64(i0), np.int64(j0), width, height, pitch, offset, texels)
    at_10 = place_of(np.int64(i1), np.int64(j0), width, height, pitch, offset, texels)
    at_01 = place_of(np.int64(i0), np.int64(j1), width, height, pitch, offset, texels)
    at_11 = place_of(np.int64(i1), np.int64(j1), width, height, pitch, offset, texels)
    if switches[unit + COMPARISON]:
        rest = ONE - x
        lower = channels_of(switches, numbers, unit, number, at_00, r, rest, texels)[0]
        lower = channels_of(switches, numbers, unit, number, at_10, r, x, texels)[0] + lower
        upper = channels_of(switches, numbers, unit, number, at_01, r, rest, texels)[0]
        upper = channels_of(switches, numbers, unit, number, at_11, r, x, texels)[0] + upper
        lit = y * (upper - lower) + lower
        return lit, lit, lit, lit
    a0, a1, a2, a3 = channels_of(switches, numbers, unit, number, at_00, r, ONE, texels)
    b0, b1, b2, b3 = channels_of(switches, numbers, unit, number, at_10, r, ONE, texels)
    a0, a1, a2, a3 = x * (b0 - a0) + a0, x * (b1 - a1) + a1, x * (b2 - a2) + a2, x * (b3 - a3) + a3
    c0, c1, c2, c3 = channels_of(switches, numbers, unit, number, at_01, r, ONE, texels)
    d0, d1, d2, d3 = channels_of(switches, numbers, unit, number, at_11, r, ONE, texels)
    c0, c1, c2, c3 = x * (d0 - c0) + c0, x * (d1 - c1) + c1, x * (d2 - c2) + c2, x * (d3 - c3) + c3
    return y * (c0 - a0) + a0, y * (c1 - a1) + a1, y * (c2 - a2) + a2, y * (c3 - a3) + a3


@kernel
def place_of(i, j, width, height, pitch, offset, texels):
    """Return where a texel is stored, -1 outside the image."""
    if i >= 0 and i < width and j >= 0 and j < height:
        return min(offset + j * pitch + i, len(texels) - 1)
    return np.int64(-1)


@kernel
def channels_of(switches, numbers, unit, number, place, r, share, texels):
    """Return the channels of a texel, or of the border; with a comparison, `share` where it holds, else 0."""
    step = numbers[number + STEP]
    if not switches[unit + IS_DEPTH]:
        if place < 0:
            at = number + BORDER
            return numbers[at], numbers[at + 1], numbers[at + 2], numbers[at + 3]
        if switches[unit + IS_WIDE]:
            values, at = texels.view(np.float32), np.uint64(min(4 * place, len(texels) - 4))
            return values[at], values[at + NEXT], values[at + NEXT + NEXT], values[at + NEXT + NEXT + NEXT]
        texel = np.int64(texels[np.uint64(place)])
        red, green = np.float32(np.int32(texel & 255)) * step, np.float32(np.int32(texel >> 8 & 255)) * step
        blue, alpha = np.float32(np.int32(texel >> 16 & 255)) * step, np.float32(np.int32(texel >> 24 & 255)) * step
        return red, green, blue, alpha
    depth = numbers[number + BORDER]
    if place >= 0:
        depth = texels.view(np.float32)[np.uint64(place)] * step
    if switches[unit + COMPARISON]:
        depth = share if code_of(r, depth) & np.int32(switches[unit + COMPARISON]) & CODES else ZERO
    return depth, depth, depth, depth
