"""Steps of three coordinates between pixels; equals `shade.shading.shade`, see fast/test_span_shading.py.

What `span_levels.write_squared_steps` is for 2-D textures: for 3-D textures, and for cube maps, where the step of a
direction is projected onto the face that it hits.
"""

import numpy as np

from softshadow.jit import kernel
from softshadow.pipeline.constants import ONE, ZERO
from softshadow.pipeline.fast.fragment_block import NEXT, SPAN_LEFT, SPAN_PLACE, SPAN_ROW, SPAN_START, SQUARED
from softshadow.pipeline.fast.span_levels import NOT_A_NUMBER
from softshadow.pipeline.fast.span_state import BY_PIXEL, HEIGHT, IS_CUBE, S_COLUMN, SLICES, WIDTH
from softshadow.programs.cube_maps import component, major_axis, squared_step

NOWHERE = (ZERO, ZERO, ZERO)


@kernel
def write_squared_steps_in_space(planes, spans, n_spans, is_flat, switches, unit, room):
    """Write SQUARED, the larger squared step in texels to the next column or row in the fragment's block of pixels.

    Of a 3-D texture as `level_of_detail.squared_texels_per_pixel`; of a cube map as `cube_maps`, for each pixel if it
    is mipmapped, else for the first one of the block.
    """
    column = np.uint64(switches[unit + S_COLUMN])
    is_cube, by_pixel = switches[unit + IS_CUBE], switches[unit + BY_PIXEL]
    wide, high = np.float32(switches[unit + WIDTH]), np.float32(switches[unit + HEIGHT])
    deep = np.float32(switches[unit + SLICES])
    for m in range(np.uint64(n_spans)):
        first, end, place = spans[SPAN_START, m], spans[SPAN_START, m + NEXT], np.uint64(spans[SPAN_PLACE, m])
        left, row = spans[SPAN_LEFT, m], spans[SPAN_ROW, m]
        upper, lower = np.float32(row & ~1), np.float32(row | 1)
        first_up = second_up = first_down = second_down = NOWHERE
        for n in range(first, end):
            at = left + n - first
            if n == first or at & 1 == 0:
                i, next_i = np.float32(at & ~1), np.float32(at | 1)
                first_up = coordinates_at(planes, place, column, is_flat, i, upper)
                second_up = coordinates_at(planes, place, column, is_flat, next_i, upper)
                first_down = coordinates_at(planes, place, column, is_flat, i, lower)
                second_down = coordinates_at(planes, place, column, is_flat, next_i, lower)
            if not is_cube:
                across = squared_length(first_up, second_up, wide, high, deep)
                down = squared_length(first_up, first_down, wide, high, deep)
                larger = across if across > down else down
                larger = larger if across == across else NOT_A_NUMBER
            elif not by_pixel:
                larger = larger_step(first_up, first_up, second_up, first_up, first_down, wide)
            else:
                on_left, on_right = (first_down, second_down) if row & 1 else (first_up, second_up)
                above, below = (second_up, second_down) if at & 1 else (first_up, first_down)
                own = on_right if at & 1 else on_left
                larger = larger_step(own, on_left, on_right, above, below, wide)
            room[SQUARED + np.uint64(n)] = larger


@kernel
def coordinates_at(planes, place, column, is_flat, i, j):
    """Return s, t and r of a triangle at a pixel, divided by q."""
    c, d, e, f = column, column + NEXT, column + NEXT + NEXT, column + NEXT + NEXT + NEXT
    if is_flat:
        over_q = ONE / planes[place, 0, f]
        return planes[place, 0, c] * over_q, planes[place, 0, d] * over_q, planes[place, 0, e] * over_q
    k = np.uint64(planes.shape[2] - 1)
    w = ONE / plane_at(planes, place, k, i, j)
    over_q = ONE / (plane_at(planes, place, f, i, j) * w)
    s, t = plane_at(planes, place, c, i, j) * w * over_q, plane_at(planes, place, d, i, j) * w * over_q
    return s, t, plane_at(planes, place, e, i, j) * w * over_q


@kernel
def plane_at(planes, place, c, i, j):
    """Return the value of a plane at a pixel."""
    return (planes[place, 1, c] * i + planes[place, 0, c]) + planes[place, 2, c] * j


@kernel
def squared_length(start, end, wide, high, deep):
    """Return the squared distance of two places in a 3-D texture, in texels."""
    x, y, z = (end[0] - start[0]) * wide, (end[1] - start[1]) * high, (end[2] - start[2]) * deep
    return (x * x + y * y) + z * z


@kernel
def larger_step(direction, left, right, above, below, size):
    """Return the larger squared step on the face of a direction, as `cube_maps.write_squared_steps`."""
    axis = major_axis(direction[0], direction[1], direction[2])
    negative = np.signbit(component(axis, direction[0], direction[1], direction[2]))
    x = squared_step(axis, negative, direction, left, right, size)
    y = squared_step(axis, negative, direction, above, below, size)
    larger = x if x > y else y
    return larger if np.isfinite(larger) else ZERO
