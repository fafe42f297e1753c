"""The fill stage for draws that only count in the stencil buffer, tile by tile (`tiles.py`).

What a tile's depth bounds do not decide goes row by row, in chunks of 32 columns.
"""

import numpy as np

from softshadow.jit import inlined
from softshadow.pipeline.boxes import WIDEST, columns_of, fill_columns
from softshadow.pipeline.coverage import bounds, row_spans
from softshadow.pipeline.facing import EITHER
from softshadow.pipeline.fragment_ops import DECR_WRAP, process_fragment
from softshadow.pipeline.spans import depth_units
from softshadow.pipeline.tiles import (
    COLUMNS,
    COLUMNS_LOG2,
    MIXED,
    NOTHING,
    PASS,
    ROWS_LOG2,
    advance,
    apply_waiting,
    columns_of_tile,
    common_op,
    outcome,
    rows_of,
    tiles_of,
)  # fmt: skip

CHUNK_LOG2 = 5  # columns processed in one go, 32: what rows are padded to (`image.PITCH`)
CHUNK = 1 << CHUNK_LOG2


@inlined
def fill_chunk(ops, plane, row_z, depth_range, columns, left, right, chunk, depth, stencil):
    """Process the fragments of one row of a triangle, [left, right), that lie in a chunk.

    The same number of columns every time, those outside left as they are: all of them are vectorised, and no remainder
    has to be gone through one by one.
    """
    z0, dz, offset = plane[0], plane[1], plane[3]
    for k in range(CHUNK):
        i = np.uint64((chunk << CHUNK_LOG2) + k)
        inside = (columns[i] >= left) & (columns[i] < right)
        z = depth_units(((dz * columns[i] + z0) + row_z) + offset, depth_range, ops.depth_largest)
        _, stencil[i], _ = process_fragment(ops, inside, 0, z, depth[i], stencil[i])


@inlined
def advance_chunk(op, step, ref, largest, columns, left, right, chunk, stencil):
    """Do the same where it is known what the depth test says."""
    for k in range(CHUNK):
        i = np.uint64((chunk << CHUNK_LOG2) + k)
        inside = (columns[i] >= left) & (columns[i] < right)
        stencil[i] = advance(op, stencil[i], step, ref, largest) if inside else stencil[i]


@inlined
def fill_in_tiles(ops, facing, triangles, numbers, region, depth_range, planes):
    """Do what `binding.generic` does for the triangles of one facing, FRONT, BACK or EITHER.

    The state is one that `commutes`.
    """
    columns = planes.columns
    op, ref, largest = common_op(ops), np.uint8(ops.ref), np.uint8(ops.stencil_largest)
    tiles = tiles_of(region, columns.dtype)
    scratch = np.empty((3, COLUMNS), columns.dtype)
    lefts, rights = np.empty(region.end_row, np.int64), np.empty(region.end_row, np.int64)
    for n in range(numbers.shape[0]):
        t = int(numbers[n])
        first, end = bounds(triangles.corners, t)
        first, end = max(first, region.first_row), min(end, region.end_row)
        box_left, box_right = columns_of(triangles.corners, t)
        box_left, box_right = max(box_left, region.left), min(box_right, region.right)
        if first >= end or box_left >= box_right or (facing != EITHER and triangles.front[t] != facing):
            continue
        plane = triangles.depth[t]
        is_small = box_right - box_left <= WIDEST and end - first <= WIDEST
        if not is_small:
            row_spans(triangles.corners, t, first, end, region.downwards, region.left, region.right, lefts, rights)
        for tile_row in range((first - region.first_row) >> ROWS_LOG2, ((end - 1 - region.first_row) >> ROWS_LOG2) + 1):
            top, bottom = rows_of(tile_row, region)
            first_here, end_here = max(first, top), min(end, bottom)
            # outer: from the first to the last column; inner: the columns that all rows have
            outer_left, outer_right, inner_left, inner_right = box_left, box_right, box_right, box_left
            if not is_small:
                outer_left, outer_right, inner_left, inner_right = box_right, box_left, box_left, box_right
                for row in range(first_here, end_here):
                    inner_left, inner_right = max(inner_left, lefts[row]), min(inner_right, rights[row])
                    if lefts[row] < rights[row]:
                        outer_left, outer_right = min(outer_left, lefts[row]), max(outer_right, rights[row])
            has_all_rows = first_here == top and end_here == bottom
            if outer_left >= outer_right:
                continue
            for tile in range(outer_left >> COLUMNS_LOG2, ((outer_right - 1) >> COLUMNS_LOG2) + 1):
                tile_left, tile_right = columns_of_tile(tile, region)
                left, right = max(outer_left, tile_left), min(outer_right, tile_right)
                what = outcome(
                    ops, plane, depth_range, columns, left, right, first_here, end_here, planes.depth, region, tiles,
                    tile_row, tile, scratch,
                )  # fmt: skip
                if what == NOTHING:
                    continue
                if is_small:
                    fill_columns(
                        ops, 0, triangles.corners, plane, region.downwards, left, right, first_here, end_here,
                        depth_range, columns, t, planes.depth, planes.stencil, planes.ids, 0,
                    )  # fmt: skip
                    continue
                step = -1 if (ops.zpass if what == PASS else ops.zfail) == DECR_WRAP else 1
                if what != MIXED and has_all_rows and inner_left <= tile_left and inner_right >= tile_right:
                    tiles.waiting[tile_row, tile] += step
                    continue
                for row in range(first_here, end_here):
                    left, right = max(lefts[row], tile_left), min(rights[row], tile_right)
                    if left >= right:
                        continue
                    depth, stencil, row_z = planes.depth[row], planes.stencil[row], plane[2] * columns[row]
                    for chunk in range(left >> CHUNK_LOG2, ((right - 1) >> CHUNK_LOG2) + 1):
                        if what == MIXED:
                            fill_chunk(ops, plane, row_z, depth_range, columns, left, right, chunk, depth, stencil)
                        else:
                            advance_chunk(op, step, ref, largest, columns, left, right, chunk, stencil)
    apply_waiting(ops, tiles, region, planes.stencil)
