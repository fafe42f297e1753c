"""Mipmap levels of the fragments of a block; equals `shade.shading.shade`, see fast/test_span_shading.py.

The steps of the texture coordinates to the neighbours in a 2x2 block of pixels are evaluated from the planes of the
triangle, once for every block of pixels that a span meets; so fragments need not be sorted into blocks.
"""

import numpy as np

from softshadow.jit import copied_kernel, kernel
from softshadow.pipeline.constants import HALF, ONE, ZERO
from softshadow.pipeline.fast.fragment_block import (
    LEVEL,
    LINEAR,
    NEXT,
    QUADS,
    SPAN_LEFT,
    SPAN_PLACE,
    SPAN_ROW,
    SPAN_START,
    SQUARED,
    WEIGHT,
    whole_portions,
)
from softshadow.pipeline.fast.span_state import (
    BETWEEN,
    BIAS,
    BY_EXPONENT,
    CONSTANT_LEVEL,
    IS_LINE,
    LAST_LEVEL,
    LEAST,
    LOD_MODE,
    MAG_LINEAR,
    MIN_LINEAR,
    MOST,
    NO_LEVELS,
)
from softshadow.programs.level_of_detail import EXPONENT_BIAS, MANTISSA, MANTISSA_BITS, ONE_BITS, ROOT_OF_2
from softshadow.tokens import GL_LINEAR, GL_NONE

ODD = np.uint64(1)
BEYOND = 4  # blocks of pixels that two spans in the same blocks may have more than the longer one
NO_LEVEL = np.int32(0)
NOT_A_NUMBER = np.float32(np.nan)  # positive, as that of NumPy's maximum


@kernel
def write_squared_steps(planes, spans, n_spans, column, is_flat, is_line, width, height, room):
    """Write SQUARED, `level_of_detail.squared_texels_per_pixel` of the block of pixels that each fragment lies in.

    `column` is the number of the coordinate s; t and q are the next one and the third next. For a 1-D texture it is
    `level_of_detail.texels_per_pixel`, which is not squared.
    """
    k, wide, high = np.uint64(planes.shape[2] - 1), np.float32(width), np.float32(height)
    c, d, e = np.uint64(column), np.uint64(column + 1), np.uint64(column + 3)
    m, n_all = np.uint64(0), np.uint64(n_spans)
    while m < n_all:
        row, begin = spans[SPAN_ROW, m] & ~1, m
        even, n_quads = quads_of(spans, m)
        m += NEXT
        if m < n_all and spans[SPAN_PLACE, m] == spans[SPAN_PLACE, begin] and spans[SPAN_ROW, m] & ~1 == row:
            # the span in the other row of the same blocks of pixels
            other_even, n_others = quads_of(spans, m)
            left = min(even, other_even)
            n_both = (max(even + 2 * n_quads, other_even + 2 * n_others) - left) >> 1
            if n_both <= max(n_quads, n_others) + BEYOND:
                even, n_quads, m = left, n_both, m + NEXT
        p, upper, lower = np.uint64(spans[SPAN_PLACE, begin]), np.float32(row), np.float32(row + 1)
        w0, dw, w_upper, w_lower = planes[p, 0, k], planes[p, 1, k], planes[p, 2, k] * upper, planes[p, 2, k] * lower
        s0, ds, s_upper, s_lower = planes[p, 0, c], planes[p, 1, c], planes[p, 2, c] * upper, planes[p, 2, c] * lower
        t0, dt, t_upper, t_lower = planes[p, 0, d], planes[p, 1, d], planes[p, 2, d] * upper, planes[p, 2, d] * lower
        q0, dq, q_upper, q_lower = planes[p, 0, e], planes[p, 1, e], planes[p, 2, e] * upper, planes[p, 2, e] * lower
        for b in range(whole_portions(n_quads)):
            if is_flat:
                over_q = ONE / q0
                step_s, step_t = s0 * over_q - s0 * over_q, t0 * over_q - t0 * over_q
                down_s, down_t = step_s, step_t
            else:
                at = np.int32(np.int32(b) * 2 + even)
                i, next_i = np.float32(at), np.float32(np.int32(at + 1))
                w = ONE / ((dw * i + w0) + w_upper)
                over_q = ONE / (((dq * i + q0) + q_upper) * w)
                s, t = ((ds * i + s0) + s_upper) * w * over_q, ((dt * i + t0) + t_upper) * w * over_q
                w = ONE / ((dw * next_i + w0) + w_upper)
                over_q = ONE / (((dq * next_i + q0) + q_upper) * w)
                step_s = ((ds * next_i + s0) + s_upper) * w * over_q - s
                step_t = ((dt * next_i + t0) + t_upper) * w * over_q - t
                w = ONE / ((dw * i + w0) + w_lower)
                over_q = ONE / (((dq * i + q0) + q_lower) * w)
                down_s = ((ds * i + s0) + s_lower) * w * over_q - s
                down_t = ((dt * i + t0) + t_lower) * w * over_q - t
            step_s, step_t, down_s, down_t = step_s * wide, step_t * high, down_s * wide, down_t * high
            if is_line:
                step, down = abs(step_s), abs(down_s)
            else:
                step, down = step_s * step_s + step_t * step_t, down_s * down_s + down_t * down_t
            larger = step if step > down else down
            room[QUADS + b] = larger if step == step else NOT_A_NUMBER  # whose sign decides about the level
        for s in range(begin, m):
            first, end = spans[SPAN_START, s], spans[SPAN_START, s + NEXT]
            before = np.uint64(spans[SPAN_LEFT, s] - even)
            for n in range(whole_portions(end - first)):
                room[SQUARED + np.uint64(first) + n] = room[QUADS + ((n + before) >> ODD)]


@copied_kernel
def quads_of(spans, s):
    """Return the first column of the blocks of pixels that a span meets, and how many they are."""
    left, length = spans[SPAN_LEFT, s], spans[SPAN_START, s + NEXT] - spans[SPAN_START, s]
    return left & ~1, ((left + length - 1) >> 1) - (left >> 1) + 1


@copied_kernel
def level_of_detail(squared, bias, least, most):
    """Return the level of detail of squared texels per pixel, between the least and the most one."""
    bits = np.float32(squared).view(np.int32)
    mantissa = np.int32(bits & MANTISSA | ONE_BITS).view(np.float32)
    level = HALF * (np.float32(np.int32((bits >> MANTISSA_BITS) - (EXPONENT_BIAS + 1))) + mantissa) + bias
    level = level if level < most else most
    return level if level > least else least


@kernel
def select_levels_of_block(switches, numbers, unit, number, count, room, whole):
    """Write LEVEL (the lower one), WEIGHT of the next one, and LINEAR; as `level_of_detail.select_levels`.

    `unit` and `number` are where the unit's switches and numbers begin.
    """
    mode, between, last = switches[unit + LOD_MODE], switches[unit + BETWEEN], np.float32(switches[unit + LAST_LEVEL])
    small, large = np.int32(switches[unit + MIN_LINEAR]), np.int32(switches[unit + MAG_LINEAR])
    if mode == NO_LEVELS:
        for n in range(np.uint64(count)):
            whole[LEVEL + n], whole[LINEAR + n], room[WEIGHT + n] = 0, large, ZERO
        return
    is_line, top = switches[unit + IS_LINE], np.int32(switches[unit + LAST_LEVEL])
    if mode == BY_EXPONENT and is_line:
        for n in range(np.uint64(count)):
            length = room[SQUARED + n]
            bits = np.float32(length * ROOT_OF_2).view(np.int32)
            level = np.int32(((bits >> MANTISSA_BITS) & 0xFF) - EXPONENT_BIAS)
            level = level if level > NO_LEVEL else NO_LEVEL
            whole[LEVEL + n] = level if level < top else top
            whole[LINEAR + n] = large if length <= ONE else small  # which NaN takes
            room[WEIGHT + n] = ZERO
    elif mode == BY_EXPONENT:
        for n in range(np.uint64(count)):
            squared = room[SQUARED + n]
            exponent = np.int32((np.float32(squared).view(np.int32) >> MANTISSA_BITS) & 0xFF) - (EXPONENT_BIAS - 1)
            level = np.int32(exponent >> 1)
            level = level if level > NO_LEVEL else NO_LEVEL
            whole[LEVEL + n] = level if level < top else top
            whole[LINEAR + n] = large if squared <= ONE else small  # which NaN takes
            room[WEIGHT + n] = ZERO
    else:
        least, most, bias = numbers[number + LEAST], numbers[number + MOST], numbers[number + BIAS]
        if mode == CONSTANT_LEVEL:
            for n in range(np.uint64(count)):
                room[SQUARED + n] = least
        else:
            if is_line:
                for n in range(np.uint64(count)):
                    room[SQUARED + n] = room[SQUARED + n] * room[SQUARED + n]
            for n in range(np.uint64(count)):
                room[SQUARED + n] = level_of_detail(room[SQUARED + n], bias, least, most)
        for n in range(np.uint64(count)):
            level = room[SQUARED + n]
            floor = np.floor(level) if between == GL_LINEAR else np.rint(level)
            inside = between == GL_LINEAR and floor >= ZERO and floor < last
            room[WEIGHT + n] = level - floor if inside else ZERO
            floor = floor if floor > ZERO else ZERO
            whole[LEVEL + n] = np.int32(floor if floor < last else last)
            whole[LINEAR + n] = small if level > ZERO else large
    if between == GL_NONE:
        for n in range(np.uint64(count)):
            whole[LEVEL + n] = 0
    elif small != large:  # where the texture is magnified, level 0 with the other filter
        for n in range(np.uint64(count)):
            is_small = whole[LINEAR + n] == small
            whole[LEVEL + n] = whole[LEVEL + n] if is_small else 0
            room[WEIGHT + n] = room[WEIGHT + n] if is_small else ZERO
