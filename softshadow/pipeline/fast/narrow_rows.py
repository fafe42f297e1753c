"""Tiles in which a triangle is narrow; equals `raster.fill.fill_rows`, see fast/test_stencil_tiles.py.

The side of a shadow volume at one edge of a fine mesh is often a few pixels wide and hundreds of rows tall. Its rows
begin at other columns each, so a chunk of the tile that contains all of them would be mostly empty.
"""

import numpy as np

from softshadow.jit import kernel
from softshadow.pipeline.fast.fragment_numbers import NONE, depth_of, depth_passes, updated
from softshadow.pipeline.raster.fragment_ops import INCR_WRAP

WIDEST = 16  # columns of the widest row: as many floats are one vector


@kernel
def extent_of_rows(first, end, left, right, lefts, rights):
    """Return four columns and a width: from the first to the last one, those that all rows cover, and of the widest.

    Of the rows [first, end); `left` and `right` are those of the triangle. An empty row changes none of the first two:
    with the value so far in its place, the compiler would see no minimum, and look at one row after the other.
    """
    beyond_left, beyond_right = np.int32(right), np.int32(left)
    outer_left, outer_right = beyond_left, beyond_right
    inner_left, inner_right, widest = np.int32(left), np.int32(right), np.int32(0)
    for row in range(np.uint64(first), np.uint64(end)):
        row_left, row_right = lefts[row], rights[row]
        inner_left, inner_right = max(inner_left, row_left), min(inner_right, row_right)
        outer_left = min(outer_left, row_left if row_left < row_right else beyond_left)
        outer_right = max(outer_right, row_right if row_left < row_right else beyond_right)
        widest = max(widest, np.int32(row_right - row_left))
    return outer_left, outer_right, inner_left, inner_right, widest


@kernel
def fill_narrow(
    op, first, end, left, right, pitch, lefts, rights, passing, failing, most, depth_test, z0, dz, dz_row, offset,
    depth_range, largest, depth, stencil,
):  # fmt: skip
    """Test and update a triangle's rows [first, end) in the columns [left, right) of a tile.

    WIDEST columns from the first one of each row on are one vector. `op` is the `common_op`, `pitch` the columns of the
    buffers. Outside of the triangle, the stored values are written back.
    """
    for row in range(np.int64(first), np.int64(end)):
        j, row_at = np.uint64(row), np.float32(np.int32(row))
        row_left, row_right = max(np.int64(lefts[j]), np.int64(left)), min(np.int64(rights[j]), np.int64(right))
        at = min(row_left, pitch - WIDEST)
        begin, stop, start_at = np.int32(row_left - at), np.int32(row_right - at), np.float32(np.int32(at))
        if op == INCR_WRAP:
            for k in range(WIDEST):
                i, column = np.uint64(at) + np.uint64(k), start_at + np.float32(np.int32(k))
                z = depth_of(z0, dz, dz_row, offset, column, row_at, depth_range, largest)
                step = passing.step if depth_passes(depth_test, z, depth[j, i]) != 0 else failing.step
                step = step if (np.int32(k) >= begin) & (np.int32(k) < stop) else NONE
                stencil[j, i] = np.uint8(np.uint8(stencil[j, i] + step) & most)
            continue
        for k in range(WIDEST):
            i, column = np.uint64(at) + np.uint64(k), start_at + np.float32(np.int32(k))
            z = depth_of(z0, dz, dz_row, offset, column, row_at, depth_range, largest)
            s, hit = stencil[j, i], depth_passes(depth_test, z, depth[j, i]) != 0
            after, other = updated(passing, s, most), updated(failing, s, most)
            after = after if hit else other
            stencil[j, i] = after if (np.int32(k) >= begin) & (np.int32(k) < stop) else s
