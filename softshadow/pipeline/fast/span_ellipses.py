"""Anisotropic filters for a block of fragments; equals `shade.shading.shade`, see fast/test_span_shading.py.

All bytes in the box around an ellipse count, those outside the ellipse with weight 0: so their loop has no branch.
The steps are those of `softshadow.programs.anisotropy`.
"""

import numpy as np

from softshadow.jit import copied_kernel, kernel
from softshadow.pipeline.constants import HALF, ONE, ZERO
from softshadow.pipeline.fast.fragment_block import (
    FIRST,
    LENGTH,
    NEXT,
    QUADS,
    SIZE,
    SPAN_LEFT,
    SPAN_PLACE,
    SPAN_ROW,
    SPAN_START,
    T_AXIS,
    TEXEL,
    TEXEL_ALPHA,
    TEXEL_BLUE,
    TEXEL_GREEN,
    S,
    T,
    whole_portions,
)
from softshadow.pipeline.fast.span_floats import texel_of_level
from softshadow.pipeline.fast.span_levels import NOT_A_NUMBER, level_of_detail
from softshadow.pipeline.fast.span_places import nearest_places
from softshadow.pipeline.fast.span_state import (
    BIAS,
    CONSTANT_LEVEL,
    HEIGHT,
    IS_WIDE,
    LAST_LEVEL,
    LEAST,
    LEVEL_OFFSETS,
    LOD_MODE,
    MOST,
    PACKED_LEVELS,
    ROW_LENGTH,
    S_COLUMN,
    WIDTH,
    WRAP_S,
    WRAP_T,
)
from softshadow.pipeline.fast.span_steps import coordinates_at
from softshadow.programs.anisotropy import LAST_WEIGHT, TWO, WEIGHTS, box_of, ellipse_of, weight_at
from softshadow.programs.box_filtering import nearest_on_axis
from softshadow.programs.filtering import UNORM8_STEP

OUTSIDE = np.float32(LAST_WEIGHT + 1)
WEIGHTS_IN_BOX = np.append(WEIGHTS, ZERO)  # that of all texels outside the ellipse is the last one
VALUES = np.arange(256, dtype=np.float32) * UNORM8_STEP  # of bytes
BYTE = np.int32(255)
FAR = 1 << 30  # from the image; nearer texels are counted in 32 bits
STEEP = np.float32(2.0**31 / (SIZE + 1) ** 2)  # coefficients with this sum may give distances beyond 32 bits


@kernel
def average_ellipses_of_block(
    planes, spans, n_spans, is_flat, switches, numbers, unit, number, texels, room, whole
):  # fmt: skip
    """Write the means of the texels around S and T, weighted by their distance."""
    column = np.uint64(switches[unit + S_COLUMN])
    wide, high = np.float32(switches[unit + WIDTH]), np.float32(switches[unit + HEIGHT])
    for m in range(np.uint64(n_spans)):
        first, end, place = spans[SPAN_START, m], spans[SPAN_START, m + NEXT], np.uint64(spans[SPAN_PLACE, m])
        left, row = spans[SPAN_LEFT, m], spans[SPAN_ROW, m]
        upper, lower = np.float32(row & ~1), np.float32(row | 1)
        level, ellipse = 0, (ZERO, ZERO, ZERO, ZERO, ZERO)
        for n in range(first, end):
            at = left + n - first
            if n == first or at & 1 == 0:  # the next block of pixels
                i, next_i = np.float32(at & ~1), np.float32(at | 1)
                s, t, _ = coordinates_at(planes, place, column, is_flat, i, upper)
                right_s, right_t, _ = coordinates_at(planes, place, column, is_flat, next_i, upper)
                low_s, low_t, _ = coordinates_at(planes, place, column, is_flat, i, lower)
                ux, vx, uy, vy = right_s - s, right_t - t, low_s - s, low_t - t
                level = level_of(ux * wide, vx * high, uy * wide, vy * high, switches, numbers, unit, number)
                part = np.float32(ONE / np.float32(1 << level))
                ellipse = ellipse_of(ux * wide * part, vx * high * part, uy * wide * part, vy * high * part)
            average_ellipse(level, ellipse, np.uint64(n), switches, numbers, unit, number, texels, room, whole)


@kernel
def level_of(ux, vx, uy, vy, switches, numbers, unit, number):
    """Return the level of a block of pixels with these steps in texels, as `level_of_detail.truncated_levels`."""
    across, down = ux * ux + vx * vx, uy * uy + vy * vy
    shorter = across if across < down else down
    level = least = numbers[number + LEAST]
    if switches[unit + LOD_MODE] != CONSTANT_LEVEL:
        squared = shorter if across == across else NOT_A_NUMBER
        level = level_of_detail(squared, numbers[number + BIAS], least, numbers[number + MOST])
    last = np.float32(switches[unit + LAST_LEVEL])
    level = level if level < last else last
    return np.int64(level) if level > ZERO else 0


@kernel
def average_ellipse(level, ellipse, n, switches, numbers, unit, number, texels, room, whole):
    """Write the texel of fragment `n`."""
    a, b, c, half_width, half_height = ellipse
    width, height = max(switches[unit + WIDTH] >> level, 1), max(switches[unit + HEIGHT] >> level, 1)
    pitch, offset = switches[unit + ROW_LENGTH], 0
    if switches[unit + PACKED_LEVELS]:
        pitch, offset = width, switches[unit + LEVEL_OFFSETS + level]
    part = ONE / np.float32(1 << level)
    u = room[S + n] * (np.float32(switches[unit + WIDTH]) * part) - HALF
    v = room[T + n] * (np.float32(switches[unit + HEIGHT]) * part) - HALF
    u0, v0, columns, rows = box_of(u, v, half_width, half_height)
    left = np.float32(u0) - u
    first_step, first_q, twice = (TWO * left + ONE) * a, (left * left) * a, a * TWO
    wrap_s, wrap_t, is_wide = switches[unit + WRAP_S], switches[unit + WRAP_T], switches[unit + IS_WIDE] != 0
    sums = (ZERO, ZERO, ZERO, ZERO, ZERO)
    # no columns or rows, if the end of the box is beyond 32 bits
    is_near = 0 <= columns < SIZE and 0 <= rows < SIZE and abs(u0) < FAR and abs(v0) < FAR
    if is_near and abs(b) + a + c < STEEP:  # no if one of them is not a number
        for axis in range(np.uint64(2)):
            first, count, size = (v0, rows + 1, height) if axis else (u0, columns + 1, width)
            find_texels(axis * T_AXIS, first, count, size, wrap_t if axis else wrap_s, room, whole)
        for j in range(rows + 1):
            up = np.float32(v0 + j) - v
            step, q = up * b + first_step, (c * up + b * left) * up + first_q
            begin = offset + pitch * np.int64(whole[T_AXIS + FIRST + np.uint64(j)])
            if is_wide:
                sums = add_floats(columns, begin, q, step, twice, texels.view(np.float32), whole, sums)
            else:
                sums = add_bytes(columns, begin, q, step, twice, texels, whole, sums)
    else:
        for j in range(rows + 1):
            up = np.float32(v0 + j) - v
            step, q = up * b + first_step, (c * up + b * left) * up + first_q
            begin = offset + pitch * texel_on_axis(v0 + j, height, wrap_t)
            sums = add_any_row(u0, columns, begin, q, step, twice, width, wrap_s, is_wide, texels, sums)
    total, red, green, blue, alpha = sums
    if total != ZERO:
        red, green, blue, alpha = red / total, green / total, blue / total, alpha / total
    else:
        s, t = room[S + n], room[T + n]
        red, green, blue, alpha = texel_of_level(switches, numbers, unit, number, level, True, s, t, ZERO, texels)
    room[TEXEL + n], room[TEXEL_GREEN + n], room[TEXEL_BLUE + n], room[TEXEL_ALPHA + n] = red, green, blue, alpha


@kernel
def find_texels(axis, first, count, size, wrap, room, whole):
    """Write FIRST of an axis: where the texels from `first` on are found."""
    side, length, n = np.float32(size), np.int32(size), whole_portions(count)
    for i in range(n):
        room[QUADS + i] = np.float32(np.int32(np.int32(first) + np.int32(i))) / side
        whole[axis + LENGTH + i] = length
    nearest_places(QUADS, axis, wrap, FIRST, n, room, whole)


@kernel
def texel_on_axis(i, size, wrap):
    """Return where texel `i` of an axis is found."""
    return nearest_on_axis(np.float32(i) / np.float32(size), size, abs(wrap), wrap > 0)


@copied_kernel
def add_bytes(columns, begin, q, step, twice, texels, whole, sums):
    """Return `sums` with a row added; texels are four bytes."""
    for i in range(np.uint64(columns + 1)):
        weight = weight_in_box(q)
        sums = with_bytes(sums, weight, texels[np.uint64(begin + whole[FIRST + i])])
        q, step = q + step, step + twice
    return sums


@copied_kernel
def add_floats(columns, begin, q, step, twice, values, whole, sums):
    """Return `sums` with a row added; texels are four of the `values`."""
    for i in range(np.uint64(columns + 1)):
        weight = weight_in_box(q)
        if weight != ZERO:  # texels outside the ellipse may be infinite
            sums = with_floats(sums, weight, values, np.uint64(4 * (begin + whole[FIRST + i])))
        q, step = q + step, step + twice
    return sums


@kernel
def add_any_row(u0, columns, begin, q, step, twice, width, wrap, is_wide, texels, sums):
    """Return `sums` with a row added, of any length and with any coefficients."""
    for i in range(u0, u0 + columns + 1):
        weight = weight_at(WEIGHTS, q)
        if weight != ZERO:
            place = begin + texel_on_axis(i, width, wrap)
            if is_wide:
                sums = with_floats(sums, weight, texels.view(np.float32), np.uint64(4 * place))
            else:
                sums = with_bytes(sums, weight, texels[np.uint64(place)])
        q, step = q + step, step + twice
    return sums


@copied_kernel
def weight_in_box(q):
    """Return `weight_at` without a branch."""
    q = q if q > ZERO else ZERO
    return WEIGHTS_IN_BOX[np.uint64(np.int64(q if q < OUTSIDE else OUTSIDE))]


@copied_kernel
def with_bytes(sums, weight, texel):
    """Return the sums of weights and of weighted channels with those of a texel added."""
    total, red, green, blue, alpha = sums
    red += VALUES[np.uint64(texel & BYTE)] * weight
    green += VALUES[np.uint64(np.int32(texel >> 8) & BYTE)] * weight
    blue += VALUES[np.uint64(np.int32(texel >> 16) & BYTE)] * weight
    alpha += VALUES[np.uint64(np.int32(texel >> 24) & BYTE)] * weight
    return total + weight, red, green, blue, alpha


@copied_kernel
def with_floats(sums, weight, values, at):
    """Return the sums of weights and of weighted channels with those of the texel at `at` added."""
    total, red, green, blue, alpha = sums
    red += values[at] * weight
    green += values[at + NEXT] * weight
    blue += values[at + NEXT + NEXT] * weight
    alpha += values[at + NEXT + NEXT + NEXT] * weight
    return total + weight, red, green, blue, alpha
