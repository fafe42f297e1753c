"""Tiles in which a triangle is a few pixels wide; equals `raster.fill.fill_rows`, see fast/test_stencil_tiles.py.

The side of a shadow volume at one edge of a fine mesh is often less than a pixel wide and hundreds of rows tall. A
vector of 32 columns for each of its rows would hold one fragment. So the fragments are counted one by one, a column of
the triangle at a time: no branch depends on how wide a row is.
"""

import numpy as np

from softshadow.jit import kernel
from softshadow.pipeline.fast.fragment_numbers import NONE, depth_of, depth_passes, updated
from softshadow.pipeline.fast.hierarchical_z import MIXED, PASS
from softshadow.pipeline.raster.fragment_ops import INCR_WRAP

WIDEST = 4  # columns of the widest row; measured, from 6 on vectors are the faster


@kernel
def extent_of_rows(first, end, left, right, lefts, rights):
    """Return four columns and a width: from the first to the last one, those that all rows cover, and of the widest.

    Of the rows [first, end); `left` and `right` are those of the triangle. Without branches: 16 rows are one vector.
    """
    outer_left, outer_right = np.int32(right), np.int32(left)
    inner_left, inner_right, widest = np.int32(left), np.int32(right), np.int32(0)
    for row in range(np.uint64(first), np.uint64(end)):
        row_left, row_right = lefts[row], rights[row]
        inner_left, inner_right = max(inner_left, row_left), min(inner_right, row_right)
        outer_left = min(outer_left, row_left if row_left < row_right else outer_left)
        outer_right = max(outer_right, row_right if row_left < row_right else outer_right)
        widest = max(widest, np.int32(row_right - row_left))
    return outer_left, outer_right, inner_left, inner_right, widest


@kernel
def fill_narrow(
    what, op, widest, first, end, lefts, rights, last, passing, failing, most, depth_test, z0, dz, dz_row, offset,
    depth_range, largest, depth, stencil,
):  # fmt: skip
    """Update the stencil values of a triangle's rows [first, end), of at most `widest` columns in each row.

    `what` is the `hierarchical_z.outcome` of all these fragments: PASS, FAIL or MIXED; `op` the `common_op`; `last` the
    last column of the buffers. Outside of the triangle, the stored value is written back.
    """
    last_column, decided = np.int64(last), passing if what == PASS else failing
    for k in range(np.int64(widest)):
        if what == MIXED:
            for row in range(np.int64(first), np.int64(end)):
                j = np.uint64(row)
                column = np.int64(lefts[j]) + k
                inside = column < rights[j]
                i, row_at = np.uint64(min(column, last_column)), np.float32(np.int32(row))
                z = depth_of(z0, dz, dz_row, offset, np.float32(np.int32(column)), row_at, depth_range, largest)
                s, hit = stencil[j, i], depth_passes(depth_test, z, depth[j, i]) != 0
                after, other = updated(passing, s, most), updated(failing, s, most)
                after = after if hit else other
                stencil[j, i] = after if inside else s
        elif op == INCR_WRAP:
            step = decided.step
            for row in range(np.int64(first), np.int64(end)):
                j = np.uint64(row)
                column = np.int64(lefts[j]) + k
                more = step if column < rights[j] else NONE
                i = np.uint64(min(column, last_column))
                stencil[j, i] = np.uint8(np.uint8(stencil[j, i] + more) & most)
        else:
            for row in range(np.int64(first), np.int64(end)):
                j = np.uint64(row)
                column = np.int64(lefts[j]) + k
                i = np.uint64(min(column, last_column))
                s = stencil[j, i]
                after = updated(decided, s, most)
                stencil[j, i] = after if column < rights[j] else s
