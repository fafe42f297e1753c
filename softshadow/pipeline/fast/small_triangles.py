"""Fill small triangles by bounding box; equals `raster.fill.fill_rows`, see fast/test_specialize.py.

For a triangle of a few pixels, the divisions that find the ends of a row cost more than the pixels. So three edge
functions are evaluated at every pixel of the box; to `process_fragment`, a pixel outside is like one outside the
scissor box: no branch decides, and its stored values are written back.

A row is always the same number of pixels, so that each operation is one vector instruction. Measured on a million
triangles of 4 pixels: a loop over the box's own columns takes 47 ms, rows of 16 pixels 22 to 30.
"""

import numpy as np

from softshadow.jit import inlined, kernel
from softshadow.pipeline.raster.coverage import bounds
from softshadow.pipeline.raster.depth import depth_at, depth_units
from softshadow.pipeline.raster.fragment_ops import NO_ALPHA, process_fragment
from softshadow.pipeline.raster.spans import id_after
from softshadow.pipeline.records import EITHER, PASSED

WIDEST = 16  # columns; measured, boxes are the faster up to some 12 to 24
WIDEST_OF_STRIPS = 3 * WIDEST  # columns of boxes that are filled strip by strip: in half the time that rows take
TALLEST = 64  # rows; up to these, edge functions over a row of a box stay below 2^30 in 1/256 pixel squared


@kernel
def columns_of(corners, t):
    """Return first and end column of the samples in a triangle's bounding box (end exclusive)."""
    x0, x1, x2 = int(corners[t, 0]), int(corners[t, 2]), int(corners[t, 4])
    return (min(x0, min(x1, x2)) + 255) >> 8, (max(x0, max(x1, x2)) >> 8) + 1


@inlined
def common_pitch(writes_ids, depth, stencil, ids):
    """Return how many columns all arrays have that are written: attachments may differ in size, and so in padding."""
    pitch = min(depth.shape[1], stencil.shape[1])
    return min(pitch, ids.shape[1]) if writes_ids else pitch


@inlined
def is_small(corners, t, region, pitch):
    """Return whether `fill_box` can take triangle `t`: few columns and rows, no column cut off by the region.

    All strips of a box must lie within the buffers, whose rows are `pitch` columns.
    """
    first, end = bounds(corners, t)
    left, right = columns_of(corners, t)
    narrow = right - left <= WIDEST and pitch >= WIDEST
    fits = narrow or (right - left <= WIDEST_OF_STRIPS and left + WIDEST_OF_STRIPS <= pitch)
    return fits and end - first <= TALLEST and left >= region.left and right <= region.right


@inlined
def fill_small(
    ops, facing, writes_ids, corners, planes, faces_front, numbers, n, region, depth_range, depth, stencil, ids
):  # fmt: skip
    """Fill small triangles of one facing by bounding box, from ``numbers[n]`` on; same result as `fill_rows`.

    Return the index of the first triangle that is not small or has the other facing. The caller's loop over large
    triangles is separate so that the registers of one loop need not hold the values of the other: in one loop, it
    takes twice as long.
    """
    flip, pitch = 0 if region.downwards else -1, common_pitch(writes_ids, depth, stencil, ids)
    while n < numbers.shape[0]:
        t = np.uint64(numbers[n])  # unsigned: no wrap-around of negative indices is compiled in
        if not is_small(corners, t, region, pitch) or (facing != EITHER and faces_front[t] != facing):
            break
        first, end = bounds(corners, t)
        left, right = columns_of(corners, t)
        while left < right:
            fill_box(
                ops, writes_ids, corners, planes, flip, left, max(first, region.first_row), min(end, region.end_row),
                depth_range, t, pitch, depth, stencil, ids, region.first_row,
            )  # fmt: skip
            left += WIDEST
        n += 1
    return n


@inlined
def edge_from(x0, y0, x1, y1, x, y, flip):
    """Return the edge function of `coverage.edge` at a sample, and its steps: a column subtracts, a row adds.

    For corners near the sample: truncated to 32 bits after every operation, so that the compiler uses 32-bit ones.
    `flip` is 0 where rows grow downwards, else -1.
    """
    across, along = np.int32(y0 - y1), np.int32(x0 - x1)
    # negative where the edge is inclusive: by the sign of `across` and, where that is 0, of `along`;
    # without a branch, which would be mispredicted for every second or third edge
    order = (np.int64(across) << 33) + (np.int64(along) ^ flip)
    at = np.int32(np.int32(across * np.int32(x0 - x)) - np.int32(along * np.int32(y0 - y)))
    return np.int32(at + np.int32(~(order >> 63))), np.int32(across << 8), np.int32(along << 8)


@inlined
def fill_box(
    ops, writes_ids, corners, planes, flip, left, first, end, depth_range, t, pitch, depth, stencil, ids, first_of_ids
):  # fmt: skip
    """Process the fragments of triangle `t` in the rows [first, end) of a strip of its box, from column `left` on.

    `ids` begins with row `first_of_ids`. Columns and rows as floats are those of `FillBuffers.columns`: reading that
    array would make the compiler test for every triangle whether it overlaps the buffers.
    """
    z0, dz, dz_row, offset = planes[t, 0], planes[t, 1], planes[t, 2], planes[t, 3]
    x0, y0, x1, y1, x2, y2 = corners[t, 0], corners[t, 1], corners[t, 2], corners[t, 3], corners[t, 4], corners[t, 5]
    start = np.int32(min(left, pitch - WIDEST))
    x, y = np.int32(start << 8), np.int32(first << 8)
    at0, across0, along0 = edge_from(x0, y0, x1, y1, x, y, flip)
    at1, across1, along1 = edge_from(x1, y1, x2, y2, x, y, flip)
    at2, across2, along2 = edge_from(x2, y2, x0, y0, x, y, flip)
    for row in range(first, end):
        j = np.uint64(row)
        row_at = np.float32(np.int32(row))
        for column in range(WIDEST):
            n, i = np.int32(column), np.uint64(start) + np.uint64(column)
            z = depth_at(z0, dz, dz_row, offset, np.float32(np.int32(start + n)), row_at)
            z = depth_units(z, depth_range, ops.depth_largest)
            inside0, inside1 = np.int32(at0 - np.int32(across0 * n)), np.int32(at1 - np.int32(across1 * n))
            inside2 = np.int32(at2 - np.int32(across2 * n))
            inside = np.int32(inside0 | inside1 | inside2) >= 0  # the sign of an or: whether one of them is negative
            s = stencil[j, i] if ops.stencil_test else np.uint8(0)
            verdict, s, stored_z = process_fragment(ops, inside, NO_ALPHA, z, depth[j, i], s)
            if ops.stencil_test:
                stencil[j, i] = s
            if ops.depth_write:
                depth[j, i] = stored_z
            if writes_ids:
                k = np.uint64(row - first_of_ids)
                ids[k, i] = id_after(writes_ids, verdict == PASSED, np.int32(t), ids[k, i])
        at0, at1, at2 = np.int32(at0 + along0), np.int32(at1 + along1), np.int32(at2 + along2)
