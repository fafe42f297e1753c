"""The fill stage: for every covered pixel of every triangle, depth and `process_fragment`.

`fill_triangles` is written once; `binding.py` binds it to a state.
"""

from typing import NamedTuple

import numpy as np

from softshadow.jit import inlined, kernel
from softshadow.pipeline.constants import HALF_RANGE, TWO
from softshadow.pipeline.coverage import bounds, row_span
from softshadow.pipeline.fragment_ops import PASSED, process_fragment
from softshadow.pixels import LARGEST_UINT


class Region(NamedTuple):
    """Where a draw may write: columns and rows (end exclusive) of the stored planes, and how their rows run."""

    left: int
    right: int
    first_row: int
    end_row: int
    downwards: int


class DepthRange(NamedTuple):
    """What z is clamped to after the offset."""

    low: np.floating
    high: np.floating


class Planes(NamedTuple):
    """What the fill stage reads and writes, full rows with their padding.

    columns: 0, 1, 2 ... in the precision of the triangles' planes; depth and stencil (H, pitch); ids (rows of the
    region, pitch) int32 receives the number of the triangle whose fragment passed last; verdicts (6,) int64 counts the
    fragments by verdict, and last the stencil values that changed.
    """

    columns: np.ndarray
    depth: np.ndarray
    stencil: np.ndarray
    ids: np.ndarray
    verdicts: np.ndarray


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


@inlined
def fill_span(ops, writes_ids, plane, row_z, depth_range, columns, left, right, number, depth, stencil, ids):
    """Process the fragments of one row of one triangle; `plane` is (z at pixel 0, dz/di, dz/dj, offset)."""
    z0, dz, offset = plane[0], plane[1], plane[3]
    for column in range(left, right):
        i = np.uint64(column)  # unsigned: no wrap-around of negative indices is compiled in
        z = depth_units(((dz * columns[i] + z0) + row_z) + offset, depth_range, ops.depth_largest)
        verdict, s, stored_z = process_fragment(ops, True, 0, z, depth[i], stencil[i])
        if ops.stencil_test:
            stencil[i] = s
        if ops.depth_write:
            depth[i] = stored_z
        if writes_ids:
            ids[i] = number if verdict == PASSED else ids[i]


@kernel
def count_span(ops, plane, row_z, depth_range, columns, left, right, depth, stencil, verdicts):
    """Count what will happen to the fragments of one row, before they are processed."""
    for i in range(left, right):
        z = depth_units(((plane[1] * columns[i] + plane[0]) + row_z) + plane[3], depth_range, ops.depth_largest)
        verdict, s, _ = process_fragment(ops, True, 0, z, depth[i], stencil[i])
        verdicts[verdict] += 1
        verdicts[verdicts.shape[0] - 1] += 1 if s != stencil[i] else 0


@inlined
def fill_triangles(front, back, two_sided, writes_ids, counts, triangles, region, depth_range, planes):
    """Process all fragments of the triangles inside the region, in drawing order.

    The state is `front`, and for back-facing triangles `back` where `two_sided` is 1. Depth and stencil change, the ids
    where `writes_ids` is 1, the verdicts where `counts` is 1.
    """
    for t in range(triangles.corners.shape[0]):
        first, end = bounds(triangles.corners, t)
        plane = triangles.depth[t]
        is_back = two_sided and not triangles.front[t]
        for row in range(max(first, region.first_row), min(end, region.end_row)):
            left, right = row_span(triangles.corners, t, row, region.downwards)
            left, right = max(left, region.left), min(right, region.right)
            if left >= right:
                continue
            row_z = plane[2] * planes.columns[row]
            depth, stencil = planes.depth[row], planes.stencil[row]
            ids = planes.ids[row - region.first_row] if writes_ids else planes.ids[0]
            if counts:
                ops = back if is_back else front
                count_span(ops, plane, row_z, depth_range, planes.columns, left, right, depth, stencil, planes.verdicts)
            # two calls: each is compiled for its own state
            if is_back:
                fill_span(
                    back, writes_ids, plane, row_z, depth_range, planes.columns, left, right, t, depth, stencil, ids
                )
            else:
                fill_span(
                    front, writes_ids, plane, row_z, depth_range, planes.columns, left, right, t, depth, stencil, ids
                )
