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

from softshadow.jit import kernel
from softshadow.pipeline.constants import ONE

SIZE = 192  # fragments; with 12 to 20 rows in use by one step, they fit into 32 KB
LONG_RUN = 8  # fragments of one triangle; from this number on, a loop per column pays
# interpolated at most: two colours, coordinates of four units, fog, the primary colour again, place in a smooth line
COLUMNS = 33


def _rows(first: int, count: int) -> list[np.uint64]:
    return [np.uint64((first + n) * SIZE) for n in range(count)]


# rows of `room`: the inputs of the fragment stage, of which the first four become the colour, and then
W, COLUMN, LINE, S, T, R, SQUARED, QUADS, WEIGHT, DEPTH = _rows(COLUMNS, 10)
TEXEL, TEXEL_GREEN, TEXEL_BLUE, TEXEL_ALPHA = _rows(COLUMNS + 10, 4)  # red, green, blue, alpha
ROW = np.uint64(SIZE)
OTHER_TEXEL, PRIMARY = _rows(COLUMNS + 14, 8)[::4]  # for GL_COMBINE: the other unit's texel, and the primary colour
FLOAT_ROWS = COLUMNS + 22
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
RED, GREEN, BLUE, ALPHA = _rows(0, 4)
FOUR_COLUMNS, ONE_COLOR = 15, np.uint64(4)


class BlockMemory(threading.local):
    """The memory of a block, for each thread: `room`, `whole`, its list of spans and their triangles (SIZE,)."""

    def __init__(self) -> None:
        self.arrays = (
            np.empty(FLOAT_ROWS * SIZE, np.float32), np.empty(WHOLE_ROWS * SIZE, np.int32),
            np.zeros((4, SIZE + 1), np.int32), np.empty(SIZE, np.int32),
        )  # fmt: skip


block_memory = BlockMemory()


@kernel
def interpolate_block(planes, spans, n_spans, flat, needed, room):
    """Write W, COLUMN, LINE and the columns whose bits are set in `needed`; planes (P, 3, k + 1) as `attribute_planes`.

    COLUMN and LINE are the pixel's column and row. The spans of one triangle, one after the other, go together.
    """
    k, s, n_all = np.uint64(flat.shape[0]), np.uint64(0), np.uint64(n_spans)
    while s < n_all:
        place, first = spans[SPAN_PLACE, s], np.uint64(spans[SPAN_START, s])
        end = first
        while s < n_all and spans[SPAN_PLACE, s] == place:
            begin, end, j = end, np.uint64(spans[SPAN_START, s + NEXT]), np.float32(spans[SPAN_ROW, s])
            shift = np.int32(spans[SPAN_LEFT, s] - spans[SPAN_START, s])
            for n in range(begin, end):
                room[COLUMN + n], room[LINE + n] = np.float32(np.int32(np.int32(n) + shift)), j
            s += NEXT
        p = np.uint64(place)
        start, slope, slope_down = planes[p, 0, k], planes[p, 1, k], planes[p, 2, k]
        for n in range(first, end):
            room[W + n] = ONE / ((slope * room[COLUMN + n] + start) + slope_down * room[LINE + n])
        if end - first < LONG_RUN:
            for n in range(first, end):
                i, j, w = room[COLUMN + n], room[LINE + n], room[W + n]
                if needed == FOUR_COLUMNS and k == ONE_COLOR and not (flat[0] | flat[1] | flat[2] | flat[3]):
                    room[RED + n] = ((planes[p, 1, 0] * i + planes[p, 0, 0]) + planes[p, 2, 0] * j) * w
                    room[GREEN + n] = ((planes[p, 1, 1] * i + planes[p, 0, 1]) + planes[p, 2, 1] * j) * w
                    room[BLUE + n] = ((planes[p, 1, 2] * i + planes[p, 0, 2]) + planes[p, 2, 2] * j) * w
                    room[ALPHA + n] = ((planes[p, 1, 3] * i + planes[p, 0, 3]) + planes[p, 2, 3] * j) * w
                    continue
                for c in range(k):
                    value = planes[p, 0, c]
                    room[c * ROW + n] = value if flat[c] else ((planes[p, 1, c] * i + value) + planes[p, 2, c] * j) * w
            continue
        for c in range(k):
            if not (needed >> np.int64(c)) & 1:
                continue
            start, slope, slope_down, row = planes[p, 0, c], planes[p, 1, c], planes[p, 2, c], c * ROW
            if flat[c]:
                for n in range(first, end):
                    room[row + n] = start
            else:
                for n in range(first, end):
                    value = (slope * room[COLUMN + n] + start) + slope_down * room[LINE + n]
                    room[row + n] = value * room[W + n]
