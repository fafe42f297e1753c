"""Texture lookups of a block of fragments; equals `shade.shading.shade`, see fast/test_span_shading.py.

Bytes are filtered as llvmpipe does it, in integers (`filter_level`), two channels in each of two 32-bit numbers. The
nearest depth is compared in a few loops (`compare_nearest_depths`); everything else goes texel by texel
(`sample_in_float`), with the functions of `softshadow.programs.wrapping`.
"""

import numpy as np

from softshadow.jit import inlined, kernel
from softshadow.pipeline.constants import ONE, ZERO
from softshadow.pipeline.fast.fragment_block import (
    CORNER_00,
    CORNER_01,
    CORNER_10,
    CORNER_11,
    FILTERED,
    FIRST,
    FRACTION,
    LENGTH,
    LEVEL,
    LINEAR,
    LOWER,
    OFFSET,
    PITCH,
    ROW,
    SECOND,
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
    W,
)
from softshadow.pipeline.fast.span_levels import select_levels_of_block, write_squared_steps
from softshadow.pipeline.fast.span_state import (
    BORDER,
    CHANNELS,
    CLAMPED,
    COMPARISON,
    HEIGHT,
    IN_BYTES,
    IN_FLOAT,
    IS_DEPTH,
    IS_SPREAD,
    LEVEL_OFFSETS,
    LOD_MODE,
    MAG_LINEAR,
    MIN_LINEAR,
    NEAREST_DEPTH,
    NO_LEVELS,
    PACKED_LEVELS,
    PATH,
    ROW_LENGTH,
    S_COLUMN,
    STEP,
    WIDTH,
    WRAP_S,
    WRAP_T,
)
from softshadow.programs.filtering import CONSTANT_ZERO, UNORM8_STEP
from softshadow.programs.wrapping import (
    BELOW_ONE,
    FIXED_ONE,
    REPEAT_BY_MASK,
    linear_texels,
    mirror,
    nearest_texel,
    to_int32,
)
from softshadow.tokens import GL_CLAMP_TO_BORDER, GL_MIRRORED_REPEAT, GL_REPEAT

BYTE = np.int32(255)
EVEN, HALVES = np.int32(0x00FF00FF), np.int32(0x00800080)  # two bytes of a pixel, and the rounding of both
HALF_TEXEL, STEPS_PER_TEXEL = np.int32(128), np.int32(256)
NOTHING, ONE_TEXEL = np.int32(0), np.int32(1)
WEIGHT_STEPS = np.float32(256.0)
LESS, EQUAL, GREATER, UNORDERED, CODES = np.int32(1), np.int32(2), np.int32(4), np.int32(8), np.int32(15)
NO_BORDER = np.int32(-1)  # as a place: outside the image


@inlined
def sample_block(planes, spans, n_spans, count, flat, switches, numbers, unit, number, texels, room, whole):
    """Write the colours of a unit's texture to the rows from TEXEL on, for all fragments of a block.

    `unit` and `number` are where the unit's switches and numbers begin.
    """
    column, path, has_levels = switches[unit + S_COLUMN], switches[unit + PATH], switches[unit + LOD_MODE] != NO_LEVELS
    if has_levels:
        write_squared_steps(
            planes, spans, n_spans, column, flat[column], switches[unit + WIDTH], switches[unit + HEIGHT], room
        )
    if has_levels or path == IN_FLOAT:
        select_levels_of_block(switches, numbers, unit, number, count, room, whole)
    project_block(column, count, switches[unit + COMPARISON] != 0, room)
    if path == IN_BYTES:
        filter_level(switches, unit, count, texels, room, whole)
        mixed = False
        if switches[unit + PACKED_LEVELS]:
            mixed = begin_upper_level(count, room, whole)
        if mixed:
            filter_level(switches, unit, count, texels, room, whole)
        unpack_texels(mixed, count, room, whole)
    elif path == NEAREST_DEPTH:
        compare_nearest_depths(switches, numbers, unit, number, count, texels, room, whole)
    else:
        sample_in_float(switches, numbers, unit, number, count, texels, room, whole)
    if switches[unit + IS_SPREAD]:
        spread_channels(switches, unit, count, room)


@kernel
def project_block(column, count, with_reference, room):
    """Write S, T and, for a comparison, R: the coordinates from `column` on, divided by q; W is overwritten."""
    s = np.uint64(column) * ROW
    for n in range(np.uint64(count)):
        over_q = ONE / room[s + ROW + ROW + ROW + n]
        room[S + n] = room[s + n] * over_q
        room[T + n] = room[s + ROW + n] * over_q
    if with_reference:
        for n in range(np.uint64(count)):
            room[R + n] = room[s + ROW + ROW + n] * (ONE / room[s + ROW + ROW + ROW + n])


@kernel
def write_places(switches, unit, count, whole):
    """Write LENGTH of both axes, OFFSET and PITCH: the sizes of each fragment's LEVEL and where it begins."""
    width, height, pitch = (
        np.int32(switches[unit + WIDTH]),
        np.int32(switches[unit + HEIGHT]),
        switches[unit + ROW_LENGTH],
    )
    if not switches[unit + PACKED_LEVELS]:
        for n in range(np.uint64(count)):
            whole[LENGTH + n], whole[T_AXIS + LENGTH + n] = width, height
            whole[OFFSET + n], whole[PITCH + n] = 0, pitch
        return
    for n in range(np.uint64(count)):
        wide, high = np.int32(width >> whole[LEVEL + n]), np.int32(height >> whole[LEVEL + n])
        wide, high = max(wide, ONE_TEXEL), max(high, ONE_TEXEL)
        whole[LENGTH + n], whole[T_AXIS + LENGTH + n], whole[PITCH + n] = wide, high, wide
    for n in range(np.uint64(count)):
        whole[OFFSET + n] = switches[unit + LEVEL_OFFSETS + whole[LEVEL + n]]


@kernel
def linear_places(coordinate, axis, wrap, count, room, whole):
    """Write FIRST, SECOND and FRACTION of an axis, as `wrapping.fixed_point_texels`."""
    length, first, second, fraction = axis + LENGTH, axis + FIRST, axis + SECOND, axis + FRACTION
    if wrap == GL_REPEAT:
        for n in range(np.uint64(count)):
            c, last = room[coordinate + n], np.int32(whole[length + n] - 1)
            part = (c - np.floor(c)) * np.float32(whole[length + n])
            position = np.int32(to_int32(np.rint(part * FIXED_ONE)) - HALF_TEXEL)
            i = np.int32(position >> 8)
            i = last if i < NOTHING or i > last else i
            whole[first + n] = i
            whole[second + n] = NOTHING if i == last else np.int32(i + 1)
            whole[fraction + n] = position & 255
    elif wrap == REPEAT_BY_MASK:
        for n in range(np.uint64(count)):
            last, steps = np.int32(whole[length + n] - 1), np.float32(np.int32(whole[length + n] * STEPS_PER_TEXEL))
            position = np.int32(to_int32(np.rint(room[coordinate + n] * steps)) - HALF_TEXEL)
            i = np.int32(position >> 8)
            whole[first + n] = i & last
            whole[second + n] = np.int32(i + 1) & last
            whole[fraction + n] = position & 255
    else:
        for n in range(np.uint64(count)):
            last, steps = np.int32(whole[length + n] - 1), np.float32(np.int32(whole[length + n] * STEPS_PER_TEXEL))
            position = np.int32(to_int32(np.rint(room[coordinate + n] * steps)) - HALF_TEXEL)
            i = np.int32(position >> 8)
            after = np.int32(i + 1)
            whole[first + n] = min(max(i, NOTHING), last)
            whole[second + n] = min(max(after, NOTHING), last)
            whole[fraction + n] = position & 255


@kernel
def nearest_places(coordinate, axis, wrap, place, count, room, whole):
    """Write the nearest texels of an axis to the row `place` of the axis, as `wrapping.nearest_texel`."""
    length, nearest = axis + LENGTH, axis + place
    if wrap == REPEAT_BY_MASK:
        for n in range(np.uint64(count)):
            last = np.int32(whole[length + n] - 1)
            whole[nearest + n] = to_int32(np.floor(room[coordinate + n] * np.float32(whole[length + n]))) & last
    elif wrap == GL_REPEAT:
        for n in range(np.uint64(count)):
            part = room[coordinate + n] - np.floor(room[coordinate + n])
            whole[nearest + n] = to_int32((part if part < BELOW_ONE else BELOW_ONE) * np.float32(whole[length + n]))
    elif wrap == GL_CLAMP_TO_BORDER:
        for n in range(np.uint64(count)):
            whole[nearest + n] = to_int32(np.floor(room[coordinate + n] * np.float32(whole[length + n])))
    elif wrap == GL_MIRRORED_REPEAT:
        for n in range(np.uint64(count)):
            last, distance = np.int32(whole[length + n] - 1), mirror(room[coordinate + n])
            whole[nearest + n] = min(to_int32(distance * np.float32(whole[length + n])), last)
    else:
        for n in range(np.uint64(count)):
            last, texel = (
                np.int32(whole[length + n] - 1),
                to_int32(room[coordinate + n] * np.float32(whole[length + n])),
            )
            whole[nearest + n] = min(max(texel, NOTHING), last)


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
def unpack_texels(mixed, count, room, whole):
    """Write the filtered bytes as floats; `mixed`: first those of two levels are mixed."""
    if mixed:
        for n in range(np.uint64(count)):
            whole[FILTERED + n] = mix_bytes_of(whole[STEPS + n], whole[LOWER + n], whole[FILTERED + n])
    for n in range(np.uint64(count)):
        texel = whole[FILTERED + n]
        room[TEXEL + n] = np.float32(texel & BYTE) * UNORM8_STEP
        room[TEXEL_GREEN + n] = np.float32(np.int32(texel >> 8) & BYTE) * UNORM8_STEP
        room[TEXEL_BLUE + n] = np.float32(np.int32(texel >> 16) & BYTE) * UNORM8_STEP
        room[TEXEL_ALPHA + n] = np.float32(np.int32(texel >> 24) & BYTE) * UNORM8_STEP


@kernel
def filter_level(switches, unit, count, texels, room, whole):
    """Write FILTERED: the four bytes of each fragment's LEVEL, linear where LINEAR is 1, else nearest."""
    write_places(switches, unit, count, whole)
    wrap_s, wrap_t = switches[unit + WRAP_S], switches[unit + WRAP_T]
    small, large = switches[unit + MIN_LINEAR], switches[unit + MAG_LINEAR]
    if switches[unit + LOD_MODE] == NO_LEVELS:
        small = large
    if not small and not large:
        nearest_places(S, np.uint64(0), wrap_s, FIRST, count, room, whole)
        nearest_places(T, T_AXIS, wrap_t, FIRST, count, room, whole)
        for n in range(np.uint64(count)):
            j = np.int32(whole[T_AXIS + FIRST + n] * whole[PITCH + n])
            whole[FILTERED + n] = np.int32(whole[OFFSET + n] + j) + whole[FIRST + n]
        gather(texels, FILTERED, count, whole)
        return
    linear_places(S, np.uint64(0), wrap_s, count, room, whole)
    linear_places(T, T_AXIS, wrap_t, count, room, whole)
    if small != large:  # the nearest texel is the mixture of this texel with itself
        nearest_places(S, np.uint64(0), wrap_s, CORNER_00, count, room, whole)
        nearest_places(T, T_AXIS, wrap_t, CORNER_00, count, room, whole)
        for axis in (np.uint64(0), T_AXIS):
            for n in range(np.uint64(count)):
                is_linear, texel = whole[LINEAR + n] != NOTHING, whole[axis + CORNER_00 + n]
                whole[axis + FIRST + n] = whole[axis + FIRST + n] if is_linear else texel
                whole[axis + SECOND + n] = whole[axis + SECOND + n] if is_linear else texel
                whole[axis + FRACTION + n] = whole[axis + FRACTION + n] if is_linear else NOTHING
    for n in range(np.uint64(count)):
        upper = np.int32(whole[OFFSET + n] + np.int32(whole[T_AXIS + FIRST + n] * whole[PITCH + n]))
        lower = np.int32(whole[OFFSET + n] + np.int32(whole[T_AXIS + SECOND + n] * whole[PITCH + n]))
        whole[CORNER_00 + n], whole[CORNER_10 + n] = upper + whole[FIRST + n], upper + whole[SECOND + n]
        whole[CORNER_01 + n], whole[CORNER_11 + n] = lower + whole[FIRST + n], lower + whole[SECOND + n]
    gather(texels, CORNER_00, count, whole)
    gather(texels, CORNER_10, count, whole)
    gather(texels, CORNER_01, count, whole)
    gather(texels, CORNER_11, count, whole)
    for n in range(np.uint64(count)):
        x, y = whole[FRACTION + n], whole[T_AXIS + FRACTION + n]
        first = mix_bytes_of(x, whole[CORNER_00 + n], whole[CORNER_10 + n])
        whole[FILTERED + n] = mix_bytes_of(y, first, mix_bytes_of(x, whole[CORNER_01 + n], whole[CORNER_11 + n]))


@kernel
def gather(texels, row, count, whole):
    """Replace the places in a row by the texels there."""
    largest = np.uint32(len(texels) - 1)
    for n in range(np.uint64(count)):
        whole[row + n] = texels[np.uint64(min(np.uint32(whole[row + n]), largest))]


@kernel
def mix_bytes_of(weight, a, b):
    """Return `filtering.mix_fixed_point` of four bytes: a * (256 - weight) + b * weight + 128, divided by 256."""
    even, odd = np.int32(a & EVEN), np.int32(np.int32(a >> 8) & EVEN)
    more_even, more_odd = np.int32(b & EVEN), np.int32(np.int32(b >> 8) & EVEN)
    even = np.int32(np.int32(np.int32(np.int32(more_even - even) * weight) + np.int32(even << 8)) + HALVES)
    odd = np.int32(np.int32(np.int32(np.int32(more_odd - odd) * weight) + np.int32(odd << 8)) + HALVES)
    return np.int32(np.int32(np.int32(even >> 8) & EVEN) | np.int32(odd & ~EVEN))


@kernel
def compare_nearest_depths(switches, numbers, unit, number, count, texels, room, whole):
    """Write 0 or 1 for R compared with the nearest depth, as `filtering.compare_depth`."""
    write_places(switches, unit, count, whole)
    wrap_s, wrap_t = switches[unit + WRAP_S], switches[unit + WRAP_T]
    nearest_places(S, np.uint64(0), wrap_s, FIRST, count, room, whole)
    nearest_places(T, T_AXIS, wrap_t, FIRST, count, room, whole)
    for n in range(np.uint64(count)):
        i, j = whole[FIRST + n], whole[T_AXIS + FIRST + n]
        inside = (np.uint32(i) < np.uint32(whole[LENGTH + n])) & (np.uint32(j) < np.uint32(whole[T_AXIS + LENGTH + n]))
        whole[FILTERED + n] = np.int32(np.int32(j * whole[PITCH + n]) + i) if inside else NO_BORDER
    depths, border, step = texels.view(np.float32), numbers[number + BORDER], numbers[number + STEP]
    largest = np.uint32(len(texels) - 1)
    for n in range(np.uint64(count)):
        room[W + n] = depths[np.uint64(min(np.uint32(whole[FILTERED + n]), largest))]
    clamped, wanted = switches[unit + CLAMPED] != 0, np.int32(switches[unit + COMPARISON]) & CODES
    for n in range(np.uint64(count)):
        depth = room[W + n] * step if whole[FILTERED + n] != NO_BORDER else border
        r = room[R + n]
        if clamped:
            r = r if r > ZERO else ZERO
            r = r if r < ONE else ONE
        code = LESS if r < depth else EQUAL if r == depth else GREATER if r > depth else UNORDERED
        room[TEXEL + n] = ONE if code & wanted else ZERO


@kernel
def spread_channels(switches, unit, count, room):
    """Replace the stored channels in the rows from TEXEL on by the sources of the texture's format.

    No source comes after its channel, so the last channel is first.
    """
    for c in range(3, -1, -1):
        source, row = switches[unit + CHANNELS + c], TEXEL + np.uint64(c) * ROW
        if source >= CONSTANT_ZERO:
            value = ZERO if source == CONSTANT_ZERO else ONE
            for n in range(np.uint64(count)):
                room[row + n] = value
        elif source != c:
            other = TEXEL + np.uint64(source) * ROW
            for n in range(np.uint64(count)):
                room[row + n] = room[other + n]


@kernel
def sample_in_float(switches, numbers, unit, number, count, texels, room, whole):
    """Write the texels fragment by fragment, filtered in float, with borders and comparisons of depths."""
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
    if not linear:
        i, j = nearest_texel(s, width, switches[unit + WRAP_S]), nearest_texel(t, height, switches[unit + WRAP_T])
        place = place_of(np.int64(i), np.int64(j), width, height, pitch, offset, texels)
        return channels_of(switches, numbers, unit, number, place, r, ONE, texels)
    i0, i1, x = linear_texels(s, width, switches[unit + WRAP_S])
    j0, j1, y = linear_texels(t, height, switches[unit + WRAP_T])
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
        texel = np.int64(texels[np.uint64(place)])
        red, green = np.float32(np.int32(texel & 255)) * step, np.float32(np.int32(texel >> 8 & 255)) * step
        blue, alpha = np.float32(np.int32(texel >> 16 & 255)) * step, np.float32(np.int32(texel >> 24 & 255)) * step
        return red, green, blue, alpha
    depth = numbers[number + BORDER]
    if place >= 0:
        depth = texels.view(np.float32)[np.uint64(place)] * step
    if switches[unit + COMPARISON]:
        code = LESS if r < depth else EQUAL if r == depth else GREATER if r > depth else UNORDERED
        depth = share if code & np.int32(switches[unit + COMPARISON]) & CODES else ZERO
    return depth, depth, depth, depth
