"""Blocks of fragments in the first-level cache; equals `shade.interpolate.interpolate`, see fast/test_span_shading.py.

A block is up to `SIZE` fragments of spans, which go through all steps of shading before the next block: interpolation,
textures, fog, bytes, blending. A step is a few loops over the block, and the state decides which loops run, so no
loop contains a branch, and all are vectorised.

The values of a block are rows of `SIZE` numbers in two arrays, `room` (float32) and `whole` (int32). Rows lie at
constant distances: so the compiler knows that they do not overlap. Row numbers are unsigned: no wrap-around of negative
indices is compiled in.
"""

import numpy as np

from softshadow.jit import kernel
from softshadow.pipeline.constants import ONE

SIZE = 192  # fragments; with 12 to 20 rows in use by one step, they fit into 32 KB
LONG_SPAN = 8  # fragments; from this length on, a loop per column pays
COLUMNS = 16  # interpolated at most: two colours, coordinates of two units, fog


def _rows(first: int, count: int) -> list[np.uint64]:
    return [np.uint64((first + n) * SIZE) for n in range(count)]


# rows of `room`: the inputs of the fragment stage, of which the first four become the colour, and then
W, COLUMN, S, T, R, SQUARED, QUADS, WEIGHT, DEPTH = _rows(COLUMNS, 9)
TEXEL, TEXEL_GREEN, TEXEL_BLUE, TEXEL_ALPHA = _rows(COLUMNS + 9, 4)  # red, green, blue, alpha
ROW = np.uint64(SIZE)
FLOAT_ROWS = COLUMNS + 13
# rows of `whole`; those of the s axis, and then of the t axis
LENGTH, FIRST, SECOND, FRACTION = _rows(0, 4)
T_AXIS = np.uint64(4 * SIZE)
LEVEL, LINEAR, STEPS, PITCH, OFFSET = _rows(8, 5)
CORNER_00, CORNER_10, CORNER_01, CORNER_11, FILTERED, LOWER = _rows(13, 6)
PACKED, MASK, TARGET, SOURCE_FACTOR, TARGET_FACTOR, OTHER = _rows(19, 6)
WHOLE_ROWS = 25
# a list of spans is an array (4, SIZE + 1) int32: row, first column, place of the triangle's planes, first fragment
SPAN_ROW, SPAN_LEFT, SPAN_PLACE, SPAN_START = range(4)
NEXT = np.uint64(1)


@kernel
def interpolate_block(planes, spans, n_spans, flat, needed, room):
    """Write W, COLUMN and the columns whose bits are set in `needed`; planes (P, 3, k + 1) as `attribute_planes`."""
    k = flat.shape[0]
    for s in range(np.uint64(n_spans)):
        first, end = np.uint64(spans[SPAN_START, s]), np.uint64(spans[SPAN_START, s + NEXT])
        own, j = planes[np.uint64(spans[SPAN_PLACE, s])], np.float32(spans[SPAN_ROW, s])
        at_origin, per_column, per_row = own[0], own[1], own[2]
        shift = np.int32(spans[SPAN_LEFT, s] - spans[SPAN_START, s])
        if end - first < LONG_SPAN:
            for n in range(first, end):
                i = np.float32(np.int32(n) + shift)
                room[COLUMN + n] = i
                w = ONE / ((per_column[k] * i + at_origin[k]) + per_row[k] * j)
                room[W + n] = w
                for c in range(k):
                    value = at_origin[c] if flat[c] else ((per_column[c] * i + at_origin[c]) + per_row[c] * j) * w
                    room[np.uint64(c) * ROW + n] = value
            continue
        start, slope, row_term = at_origin[k], per_column[k], per_row[k] * j
        for n in range(first, end):
            i = np.float32(np.int32(np.int32(n) + shift))
            room[COLUMN + n] = i
            room[W + n] = ONE / ((slope * i + start) + row_term)
        for c in range(k):
            if not (needed >> c) & 1:
                continue
            start, slope, row_term, row = at_origin[c], per_column[c], per_row[c] * j, np.uint64(c) * ROW
            if flat[c]:
                for n in range(first, end):
                    room[row + n] = start
            else:
                for n in range(first, end):
                    room[row + n] = ((slope * room[COLUMN + n] + start) + row_term) * room[W + n]
