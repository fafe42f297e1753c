"""Fill stencil-only draws tile by tile; equals `raster.fill.fill_triangles`, see fast/test_stencil_tiles.py.

Tiles that their depth bounds (`hierarchical_z.py`) do not decide are filled row by row, in chunks of 32 columns.
"""

import numpy as np

from softshadow.jit import inlined
from softshadow.pipeline.fast.hierarchical_z import (
    COLUMNS,
    COLUMNS_LOG2,
    MIXED,
    NOTHING,
    PASS,
    ROWS_LOG2,
    advance,
    apply_pending_updates,
    columns_of_tile,
    common_op,
    find_bounds,
    outcome,
    rows_of,
    tiles_of,
)  # fmt: skip
from softshadow.pipeline.fast.small_triangles import columns_of, common_pitch, fill_small
from softshadow.pipeline.raster.coverage import bounds, row_spans
from softshadow.pipeline.raster.depth import depth_at, depth_units
from softshadow.pipeline.raster.fragment_ops import DECR_WRAP, NO_ALPHA, process_fragment
from softshadow.pipeline.records import EITHER

CHUNK_LOG2 = 5  # columns processed in one go, 32: what rows are padded to (`image.PITCH`)
CHUNK = 1 << CHUNK_LOG2


@inlined
def fill_chunk(ops, z0, dz, dz_row, offset, depth_range, columns, left, right, start, row, depth, stencil):
    """Process the fragments of one row of a triangle, [left, right), that lie in the chunk from column `start` on.

    Always the same number of columns, those outside unchanged: the whole loop is vectorised, without a remainder loop.
    """
    j, row_at = np.uint64(row), columns[row]
    for k in range(CHUNK):
        i = np.uint64(start + k)
        inside = (columns[i] >= left) & (columns[i] < right)
        z = depth_units(depth_at(z0, dz, dz_row, offset, columns[i], row_at), depth_range, ops.depth_largest)
        _, stencil[j, i], _ = process_fragment(ops, inside, NO_ALPHA, z, depth[j, i], stencil[j, i])


@inlined
def advance_chunk(op, step, ref, largest, left, right, start, row, stencil):
    """Do the same where the result of the depth test is known: in bytes, so that a chunk is one vector."""
    first = min(max(left - start, 0), CHUNK)
    width = np.uint8(min(max(right - start, first), CHUNK) - first)
    j = np.uint64(row)
    for k in range(CHUNK):
        i = np.uint64(start + k)
        inside = np.uint8((k - first) & 255) < width  # left of the first one wraps round to large numbers
        stencil[j, i] = advance(op, stencil[j, i], step, ref, largest) if inside else stencil[j, i]


@inlined
def fill_in_tiles(ops, facing, triangles, numbers, region, depth_range, buffers):
    """Fill the triangles of one facing, FRONT, BACK or EITHER, under a state that is `order_independent`.

    Small triangles bypass the tiles.
    """
    # taken out of the tuples once: for every triangle, counting the references would take as long as drawing it
    corners, planes, faces_front = triangles.corners, triangles.depth, triangles.front
    columns, depth, stencil, ids = buffers.columns, buffers.depth, buffers.stencil, buffers.ids
    op, ref, largest = common_op(ops), np.uint8(ops.ref), np.uint8(ops.stencil_largest)
    last_start = common_pitch(0, depth, stencil, ids) - CHUNK
    tiles = tiles_of(region, columns.dtype)
    lows, highs, pending = tiles.low, tiles.high, tiles.pending
    scratch = np.empty((3, COLUMNS), columns.dtype)
    lefts, rights = np.empty(region.end_row, np.int32), np.empty(region.end_row, np.int32)
    n = 0
    while n < numbers.shape[0]:
        n = fill_small(
            ops, facing, 0, corners, planes, faces_front, numbers, n, region, depth_range, depth, stencil, ids
        )  # fmt: skip
        if n == numbers.shape[0]:
            break
        t = int(numbers[n])
        n += 1
        first, end = bounds(corners, t)
        first, end = max(first, region.first_row), min(end, region.end_row)
        box_left, box_right = columns_of(corners, t)
        box_left, box_right = max(box_left, region.left), min(box_right, region.right)
        if first >= end or box_left >= box_right or (facing != EITHER and faces_front[t] != facing):
            continue
        z0, dz, dz_row, offset = planes[t, 0], planes[t, 1], planes[t, 2], planes[t, 3]
        row_spans(corners, t, first, end, region.downwards, region.left, region.right, lefts, rights)
        for tile_row in range((first - region.first_row) >> ROWS_LOG2, ((end - 1 - region.first_row) >> ROWS_LOG2) + 1):
            top, bottom = rows_of(tile_row, region)
            first_here, end_here = max(first, top), min(end, bottom)
            # outer: from the first to the last column; inner: the columns that all rows cover
            outer_left, outer_right = np.int32(box_right), np.int32(box_left)
            inner_left, inner_right = outer_right, outer_left
            for row in range(first_here, end_here):
                row_left, row_right = lefts[np.uint64(row)], rights[np.uint64(row)]
                inner_left, inner_right = max(inner_left, row_left), min(inner_right, row_right)
                if row_left < row_right:
                    outer_left, outer_right = min(outer_left, row_left), max(outer_right, row_right)
            if outer_left >= outer_right:
                continue
            has_all_rows = first_here == top and end_here == bottom
            for tile in range(outer_left >> COLUMNS_LOG2, ((outer_right - 1) >> COLUMNS_LOG2) + 1):
                tile_left, tile_right = columns_of_tile(tile, region)
                left, right = max(outer_left, tile_left), min(outer_right, tile_right)
                if ops.depth_test and np.isnan(lows[tile_row, tile]):
                    lows[tile_row, tile], highs[tile_row, tile] = find_bounds(
                        depth, top, bottom, tile_left, tile_right, scratch
                    )
                what = outcome(
                    ops, depth_range, z0, dz, dz_row, offset, columns[left], columns[right - 1], columns[first_here],
                    columns[end_here - 1], lows[tile_row, tile], highs[tile_row, tile],
                )  # fmt: skip
                if what == NOTHING:
                    continue
                step = -1 if (ops.zpass if what == PASS else ops.zfail) == DECR_WRAP else 1
                if what != MIXED and has_all_rows and inner_left <= tile_left and inner_right >= tile_right:
                    pending[tile_row, tile] += step
                    continue
                fits = right - left <= CHUNK  # then one chunk, from `left` on, covers the row
                for row in range(first_here, end_here):
                    j = np.uint64(row)
                    row_left, row_right = max(lefts[j], tile_left), min(rights[j], tile_right)
                    start, stop = row_left >> CHUNK_LOG2 << CHUNK_LOG2, row_right
                    if fits:
                        start = min(left, last_start)
                        stop = start + 1
                    for at in range(start, stop, CHUNK):
                        if what == MIXED:
                            fill_chunk(
                                ops, z0, dz, dz_row, offset, depth_range, columns, row_left, row_right,
                                at, row, depth, stencil,
                            )  # fmt: skip
                        else:
                            advance_chunk(op, step, ref, largest, row_left, row_right, at, row, stencil)
    apply_pending_updates(ops, tiles, region, stencil)
