"""Blocks of fragments in the first-level cache; equals `shade.interpolate.interpolate`, see fast/test_span_shading.py.

A block is up to `SIZE` fragments of spans, which go through all steps of shading before the next block: interpolation,
textures, fog, bytes, blending. A step is a few loops over the block, and the state decides which loops run, so no
loop contains a branch, and all are vectorised.

The values of a block are rows of `SIZE` numbers in two arrays, `room` (float32) and `whole` (int32). Rows lie at
constant distances: so the compiler knows that they do not overlap. Row numbers are unsigned: no wrap-around of negative
indices is compiled in.
"""

import threading

import numpy as np

from softshadow.jit import copied_kernel, kernel
from softshadow.pipeline.constants import ONE

SIZE = 192  # numbers in a row; 12 to 20 rows, which are in use by one step, fit into 32 KB
PORTION = np.uint64(16)  # numbers in a vector: loops over whole portions leave no rest that is computed one by one
FRAGMENTS = SIZE - int(PORTION)  # at most: the last portion goes on behind them
# interpolated at most: two colours, coordinates of four units, fog, the primary colour again, place in a smooth line
COLUMNS = 33


def _rows(first: int, count: int) -> list[np.uint64]:
    return [np.uint64((first + n) * SIZE) for n in range(count)]


# rows of `room`: the inputs of the fragment stage, of which the first four become the colour, and then
W, COLUMN, LINE, S, T, R, SQUARED, QUADS, WEIGHT, DEPTH = _rows(COLUMNS, 10)
TEXEL, TEXEL_GREEN, TEXEL_BLUE, TEXEL_ALPHA = _rows(COLUMNS + 10, 4)  # red, green, blue, alpha
ROW = np.uint64(SIZE)
OTHER_TEXEL, PRIMARY = _rows(COLUMNS + 14, 8)[::4]  # for GL_COMBINE: the other unit's texel, and the primary colour
LOWER_TEXEL, SLICE_TEXEL = _rows(COLUMNS + 22, 8)[::4]  # of the lower of two levels, and of the first of two slices
FLOAT_ROWS = COLUMNS + 30
# rows of `whole`; those of the s axis, then of the t axis, and after all others those of the r axis
LENGTH, FIRST, SECOND, FRACTION = _rows(0, 4)
T_AXIS = np.uint64(4 * SIZE)
LEVEL, LINEAR, STEPS, PITCH, OFFSET = _rows(8, 5)
CORNER_00, CORNER_10, CORNER_01, CORNER_11, FILTERED, LOWER = _rows(13, 6)
PACKED, MASK, TARGET, SOURCE_FACTOR, TARGET_FACTOR, OTHER = _rows(19, 6)
R_AXIS, SLICE = _rows(25, 8)[::4]
WHOLE_ROWS = 30
# a list of spans is an array (4, SIZE + 1) int32: row, first column, place of the triangle's planes, first fragment
SPAN_ROW, SPAN_LEFT, SPAN_PLACE, SPAN_START = range(4)
NEXT = np.uint64(1)
RED, ALPHA = _rows(0, 4)[::3]
FOUR_COLUMNS = 15


class BlockMemory(threading.local):
    """The memory of a block, for each thread: `room`, `whole`, its list of spans and their triangles (SIZE,)."""

    def __init__(self) -> None:
        self.arrays = (
            np.empty(FLOAT_ROWS * SIZE, np.float32), np.empty(WHOLE_ROWS * SIZE, np.int32),
            np.zeros((4, SIZE + 1), np.int32), np.empty(SIZE, np.int32),
        )  # fmt: skip


block_memory = BlockMemory()


@copied_kernel
def whole_portions(count):
    """Return a number of fragments or more, as many as fill whole portions."""
    return (np.uint64(count) + PORTION - NEXT) & ~(PORTION - NEXT)


@kernel
def interpolate_block(planes, spans, n_spans, flat, needed, room):
    """Write W, COLUMN, LINE and the columns whose bits are set in `needed`; planes (P, 3, k + 1) as `attribute_planes`.

    COLUMN and LINE are the pixel's column and row. The spans of one triangle, one after the other, get their values
    together, in whole portions.
    """
    k, n_all, s = np.uint64(flat.shape[0]), np.uint64(n_spans), np.uint64(0)
    write_pixels(spans, n_all, room)
    while s < n_all:
        place, first, s = spans[SPAN_PLACE, s], np.uint64(spans[SPAN_START, s]), end_of_triangle(spans, s, n_all)
        p, count = np.uint64(place), whole_portions(np.uint64(spans[SPAN_START, s]) - first)
        write_w(planes, p, k, first, count, room)
        for c in range(k):
            if (needed >> np.int64(c)) & 1:
                write_values(planes, p, c, flat[c], first, count, room)


@copied_kernel
def end_of_triangle(spans, s, n_spans):
    """Return the end of the spans that belong to the triangle of span `s` and follow it."""
    place = spans[SPAN_PLACE, s]
    while s < n_spans and spans[SPAN_PLACE, s] == place:
        s += NEXT
    return s


@kernel
def write_pixels(spans, n_spans, room):
    """Write COLUMN and LINE."""
    for s in range(n_spans):
        first, count = np.uint64(spans[SPAN_START, s]), spans[SPAN_START, s + NEXT] - spans[SPAN_START, s]
        left, j = spans[SPAN_LEFT, s], np.float32(spans[SPAN_ROW, s])
        for n in range(whole_portions(count)):
            room[COLUMN + first + n], room[LINE + first + n] = np.float32(np.int32(left + np.int32(n))), j


@copied_kernel
def write_w(planes, p, k, first, count, room):
    """Write W of the fragments of one triangle, from `first` on; its plane is the last one."""
    start, slope, slope_down = planes[p, 0, k], planes[p, 1, k], planes[p, 2, k]
    for n in range(count):
        over_w = (slope * room[COLUMN + first + n] + start) + slope_down * room[LINE + first + n]
        room[W + first + n] = ONE / over_w


@copied_kernel
def write_values(planes, p, c, is_flat, first, count, room):
    """Write the values of column `c` of the fragments of one triangle, from `first` on."""
    start, slope, slope_down = planes[p, 0, c], planes[p, 1, c], planes[p, 2, c]
    at = c * ROW + first
    if is_flat:
        for n in range(count):
            room[at + n] = start
    else:
        for n in range(count):
            over_w = (slope * room[COLUMN + first + n] + start) + slope_down * room[LINE + first + n]
            room[at + n] = over_w * room[W + first + n]
