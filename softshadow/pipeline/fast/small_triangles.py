"""Small triangles: every pixel of the bounding box, those outside left as they are.

The divisions that find the ends of a row cost more than the few pixels between them. Here each pixel is asked on which
side of the three edges it lies, and to `process_fragment` one outside is like one outside the scissor box: nothing is
decided by a branch, and what is stored is what was there.

A row is always the same number of pixels, which makes one vector instruction of each operation. Measured on a million
triangles of 4 pixels: a loop over the box's own columns takes 47 ms, rows of 16 pixels 22 to 30.
"""

import numpy as np

from softshadow.jit import inlined, kernel
from softshadow.pipeline.raster.fragment_ops import NO_ALPHA, PASSED, process_fragment
from softshadow.pipeline.raster.spans import depth_units, id_after

WIDEST = 16  # columns; measured, boxes are the faster up to some 12 to 24
TALLEST = 64  # rows; up to these, edge functions over a row of a box stay below 2^30 in 1/256 pixel squared


@kernel
def columns_of(corners, t):
    """Return first and end column of the samples in a triangle's bounding box (end exclusive)."""
    x0, x1, x2 = int(corners[t, 0]), int(corners[t, 2]), int(corners[t, 4])
    return (min(x0, min(x1, x2)) + 255) >> 8, (max(x0, max(x1, x2)) >> 8) + 1


@inlined
def edge_from(x0, y0, x1, y1, x, y, flip):
    """Return the edge function of `coverage.edge` at a sample, and what a column takes from it and a row adds to it.

    Of corners near the sample: cut to 32 bits operation by operation, which the compiler makes an operation of 32 bits.
    `flip` is 0 where rows grow downwards, else -1.
    """
    across, along = np.int32(y0 - y1), np.int32(x0 - x1)
    # negative where the edge is inclusive: by the sign of `across` and, where that is 0, of `along`;
    # without a branch, which would be wrong for every second or third edge
    order = (np.int64(across) << 33) + (np.int64(along) ^ flip)
    at = np.int32(np.int32(across * np.int32(x0 - x)) - np.int32(along * np.int32(y0 - y)))
    return np.int32(at + np.int32(~(order >> 63))), np.int32(across << 8), np.int32(along << 8)


@inlined
def fill_box(
    ops, writes_ids, corners, z_planes, flip, left, first, end, depth_range, t, depth, stencil, ids, first_of_ids
):  # fmt: skip
    """Process the fragments of triangle `t` in the rows [first, end); its box begins with column `left`.

    `ids` begins with row `first_of_ids`. Columns and rows as floats are those of `Planes.columns`: reading them there
    would make the compiler ask for every triangle whether the planes overlap them.
    """
    z0, dz, dz_row, offset = z_planes[t, 0], z_planes[t, 1], z_planes[t, 2], z_planes[t, 3]
    x0, y0, x1, y1, x2, y2 = corners[t, 0], corners[t, 1], corners[t, 2], corners[t, 3], corners[t, 4], corners[t, 5]
    start = np.int32(min(left, depth.shape[1] - WIDEST))
    x, y = np.int32(start << 8), np.int32(first << 8)
    at0, across0, along0 = edge_from(x0, y0, x1, y1, x, y, flip)
    at1, across1, along1 = edge_from(x1, y1, x2, y2, x, y, flip)
    at2, across2, along2 = edge_from(x2, y2, x0, y0, x, y, flip)
    for row in range(first, end):
        j = np.uint64(row)
        row_z = dz_row * np.float32(np.int32(row))
        for column in range(WIDEST):
            n, i = np.int32(column), np.uint64(start) + np.uint64(column)
            column_z = dz * np.float32(np.int32(start + n)) + z0
            z = depth_units((column_z + row_z) + offset, depth_range, ops.depth_largest)
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
