"""The fill stage: for every covered pixel of every triangle, depth and `process_fragment`.

`fill_triangles` is written once; `binding.py` binds it to a state.
"""

from typing import NamedTuple

import numpy as np

from softshadow.jit import inlined, kernel
from softshadow.pipeline.coverage import bounds, row_span
from softshadow.pipeline.fragment_ops import PASSED, process_fragment


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


@kernel
def depth_units(z, depth_range, largest):
    """Return z clamped, in buffer units: rounded to an integer for fixed-point formats (half to even), else as it is."""
    z = depth_range.low if z < depth_range.low else depth_range.high if z > depth_range.high else z
    return np.rint(z * np.float32(largest)) if largest else z


@inlined
def fill_span(ops, writes_ids, z0, dz, row_z, offset, depth_range, columns, left, right, number, depth, stencil, ids):
    """Process the fragments of one row of one triangle."""
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
def count_span(ops, z0, dz, row_z, offset, depth_range, columns, left, right, depth, stencil, verdicts):
    """Count the verdicts of the fragments of one row, before they are processed; the last count is changed stencil values."""
    for i in range(left, right):
        z = depth_units(((dz * columns[i] + z0) + row_z) + offset, depth_range, ops.depth_largest)
        verdict, s, _ = process_fragment(ops, True, 0, z, depth[i], stencil[i])
        verdicts[verdict] += 1
        verdicts[verdicts.shape[0] - 1] += 1 if s != stencil[i] else 0


@inlined
def fill_triangles(
    front, back, two_sided, writes_ids, counts, triangles, region, depth_range, columns, depth, stencil, ids, verdicts
):
    """Process all fragments of the triangles inside the region, in drawing order.

    The state is `front`, and for back-facing triangles `back` where `two_sided` is 1. `columns` holds 0, 1, 2 ... in the precision of depth. `depth`, `stencil` and, where `writes_ids` is 1, `ids` (rows from
    the region's first row on) are changed; where `counts` is 1, `verdicts` counts what happened.
    """
    corners, planes = triangles.corners, triangles.depth
    for t in range(corners.shape[0]):
        first, end = bounds(corners, t)
        for row in range(max(first, region.first_row), min(end, region.end_row)):
            left, right = row_span(corners, t, row, region.downwards)
            left, right = max(left, region.left), min(right, region.right)
            if left >= right:
                continue
            z0, dz, row_z, offset = planes[t, 0], planes[t, 1], planes[t, 2] * columns[row], planes[t, 3]
            ids_row = ids[row - region.first_row] if writes_ids else ids[0]
            is_back = two_sided and not triangles.front[t]
            if counts:
                ops = back if is_back else front
                count_span(
                    ops, z0, dz, row_z, offset, depth_range, columns, left, right, depth[row], stencil[row], verdicts
                )
            if is_back:
                fill_span(
                    back, writes_ids, z0, dz, row_z, offset, depth_range, columns, left, right, triangles.ids[t],
                    depth[row], stencil[row], ids_row,
                )  # fmt: skip
            else:
                fill_span(
                    front, writes_ids, z0, dz, row_z, offset, depth_range, columns, left, right, triangles.ids[t],
                    depth[row], stencil[row], ids_row,
                )  # fmt: skip
