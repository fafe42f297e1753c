"""The fill stage: for every covered pixel of every triangle, depth and `process_fragment`.

`fill_triangles` is written once; `binding.py` binds it to a state.
"""

from typing import NamedTuple

import numpy as np

from softshadow.jit import inlined
from softshadow.pipeline.boxes import TALLEST, WIDEST, columns_of, fill_box
from softshadow.pipeline.coverage import bounds, row_span
from softshadow.pipeline.spans import count_span, fill_span


class Region(NamedTuple):
    """Where a draw may write: columns and rows (end exclusive) of the stored planes, and how their rows run."""

    left: int
    right: int
    first_row: int
    end_row: int
    downwards: int


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


@inlined
def fill_triangles(
    front, back, two_sided, writes_ids, counts, specialised, triangles, numbers, region, depth_range, planes
):  # fmt: skip
    """Process all fragments of the triangles with these numbers inside the region, in this order.

    The state is `front`, and for back-facing triangles `back` where `two_sided` is 1. Depth and stencil change, the ids
    where `writes_ids` is LAST or SOLE, the verdicts where `counts` is 1. `specialised` says that the compiler knows the
    state.
    """
    columns, depth_plane, stencil_plane = planes.columns, planes.depth, planes.stencil
    for n in range(numbers.shape[0]):
        t = int(numbers[n])
        first, end = bounds(triangles.corners, t)
        box_left, box_right = columns_of(triangles.corners, t)
        is_small = box_right - box_left <= WIDEST and end - first <= TALLEST
        first, end = max(first, region.first_row), min(end, region.end_row)
        box_left, box_right = max(box_left, region.left), min(box_right, region.right)
        if first >= end or box_left >= box_right:
            continue
        plane = triangles.depth[t]
        is_back = two_sided and not triangles.front[t]
        if is_small and depth_plane.shape[1] >= WIDEST and not counts:
            # two calls: each is compiled for its own state
            if is_back:
                fill_box(
                    back, writes_ids, specialised, triangles.corners, plane, region.downwards, box_left, box_right,
                    first, end, depth_range, columns, t, depth_plane, stencil_plane, planes.ids, region.first_row,
                )  # fmt: skip
            else:
                fill_box(
                    front, writes_ids, specialised, triangles.corners, plane, region.downwards, box_left, box_right,
                    first, end, depth_range, columns, t, depth_plane, stencil_plane, planes.ids, region.first_row,
                )  # fmt: skip
            continue
        for row in range(first, end):
            left, right = row_span(triangles.corners, t, row, region.downwards)
            left, right = max(left, region.left), min(right, region.right)
            if left >= right:
                continue
            row_z = plane[2] * columns[row]
            depth, stencil = depth_plane[row], stencil_plane[row]
            ids = planes.ids[row - region.first_row] if writes_ids else planes.ids[0]
            if counts:
                ops = back if is_back else front
                count_span(ops, plane, row_z, depth_range, columns, left, right, depth, stencil, planes.verdicts)
            if is_back:
                fill_span(back, writes_ids, plane, row_z, depth_range, columns, left, right, t, depth, stencil, ids)
            else:
                fill_span(front, writes_ids, plane, row_z, depth_range, columns, left, right, t, depth, stencil, ids)
