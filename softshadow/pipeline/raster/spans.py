"""One row of one triangle: depth and `process_fragment` from its first column to its last.

For rows of more than a few pixels: their ends cost divisions (`coverage.row_span`), but between them nothing has to be
asked, and the loop is vectorised. `boxes.py` has what small triangles take.
"""

from typing import NamedTuple

import numpy as np

from softshadow.jit import inlined, kernel
from softshadow.pipeline.constants import HALF_RANGE, TWO
from softshadow.pipeline.raster.fragment_ops import NO_ALPHA, PASSED, process_fragment
from softshadow.pixels import LARGEST_UINT

LAST, SOLE = 1, 2  # what is written of the triangles that pass at a pixel: the last one's number, or the only one's
NONE, SEVERAL = np.int32(-1), np.int32(-2)  # instead of a number


class DepthRange(NamedTuple):
    """What z is clamped to after the offset."""

    low: np.floating
    high: np.floating


@kernel
def depth_units(z, depth_range, largest):
    """Return z clamped, in buffer units: fixed-point formats round half to even, float formats keep z.

    NaN, which a triangle has whose area is 0 before snapping, becomes the upper end, as with llvmpipe's minps. Of 32
    bits llvmpipe fills the upper 31, cutting (lp_bld_conv.c).
    """
    z = z if z < depth_range.high else depth_range.high
    z = z if z > depth_range.low else depth_range.low
    if largest == LARGEST_UINT:
        return np.floor(z * HALF_RANGE) * TWO
    return np.rint(z * np.float32(largest)) if largest else z


@kernel
def id_after(writes_ids, passed, number, before):
    """Return the triangle that a pixel is left with: the last that passed, or SEVERAL where only one may."""
    if writes_ids == SOLE:
        number = number if before == NONE else SEVERAL
    return number if passed else before


@inlined
def fill_span(ops, writes_ids, plane, row_z, depth_range, columns, left, right, number, depth, stencil, ids):
    """Process the fragments of one row of one triangle; `plane` is (z at pixel 0, dz/di, dz/dj, offset)."""
    z0, dz, offset = plane[0], plane[1], plane[3]
    for column in range(left, right):
        i = np.uint64(column)  # unsigned: no wrap-around of negative indices is compiled in
        z = depth_units(((dz * columns[i] + z0) + row_z) + offset, depth_range, ops.depth_largest)
        verdict, s, stored_z = process_fragment(ops, True, NO_ALPHA, z, depth[i], stencil[i])
        if ops.stencil_test:
            stencil[i] = s
        if ops.depth_write:
            depth[i] = stored_z
        if writes_ids:
            ids[i] = id_after(writes_ids, verdict == PASSED, number, ids[i])


@inlined
def count_span(ops, plane, row_z, depth_range, columns, left, right, depth, stencil, verdicts):
    """Count what will happen to the fragments of one row, before they are processed."""
    for i in range(left, right):
        z = depth_units(((plane[1] * columns[i] + plane[0]) + row_z) + plane[3], depth_range, ops.depth_largest)
        verdict, s, _ = process_fragment(ops, True, NO_ALPHA, z, depth[i], stencil[i])
        verdicts[verdict] += 1
        verdicts[verdicts.shape[0] - 1] += 1 if s != stencil[i] else 0
