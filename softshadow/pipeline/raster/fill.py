"""The fill stage: for every covered pixel of every triangle, depth and `process_fragment`.

One triangle at a time; `binding.py` goes through those of a draw, and binds what is done here to a state.
"""

from typing import NamedTuple

import numpy as np

from softshadow.jit import inlined
from softshadow.pipeline.fast.small_triangles import TALLEST, WIDEST, columns_of, fill_box
from softshadow.pipeline.geometry.facing import EITHER
from softshadow.pipeline.memory.scratch import scratch
from softshadow.pipeline.raster.coverage import bounds, row_span
from softshadow.pipeline.raster.spans import NONE, count_span, fill_span

MIDDLING = 3 * WIDEST  # columns of boxes that are filled strip by strip: in half the time that rows take


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


def no_ids(region: Region, pitch: int) -> np.ndarray:
    """Return the ids (rows of the region, pitch) of pixels that no triangle has got."""
    ids = scratch((region.end_row - region.first_row, pitch), np.int32)
    ids[:] = NONE
    return ids


@inlined
def fill_rows(
    ops, writes_ids, corners, z_planes, t, region, depth_range, columns, depth_plane, stencil_plane, ids_plane
):  # fmt: skip
    """Process the fragments of triangle `t` inside the region, row by row: the plain form, for triangles of any size.

    Depth and stencil change, the ids where `writes_ids` is LAST or SOLE.
    """
    first, end = bounds(corners, np.uint64(t))
    plane = z_planes[t]
    for row in range(max(first, region.first_row), min(end, region.end_row)):
        left, right = row_span(corners, np.uint64(t), row, region.downwards)
        left, right = max(left, region.left), min(right, region.right)
        if left < right:
            row_z = plane[2] * columns[row]
            depth, stencil = depth_plane[row], stencil_plane[row]
            ids = ids_plane[row - region.first_row] if writes_ids else ids_plane[0]
            fill_span(ops, writes_ids, plane, row_z, depth_range, columns, left, right, t, depth, stencil, ids)


@inlined
def is_small(corners, t, region, depth):
    """Return whether triangle `t` is one for `fill_box`: few columns and rows, none of the columns cut off.

    Of boxes with several strips of columns, all of these have to lie within the planes.
    """
    first, end = bounds(corners, t)
    left, right = columns_of(corners, t)
    narrow = right - left <= WIDEST and depth.shape[1] >= WIDEST
    fits = narrow or (right - left <= MIDDLING and left + MIDDLING <= depth.shape[1])
    return fits and end - first <= TALLEST and left >= region.left and right <= region.right


@inlined
def fill_small(
    ops, facing, writes_ids, corners, z_planes, faces_front, numbers, n, region, depth_range, depth, stencil, ids
):  # fmt: skip
    """Do what `fill_rows` does, by boxes, for small triangles of one facing from ``numbers[n]`` on.

    Returns the place of the first triangle that is not small or faces elsewhere. These loops are apart so that the
    registers of the one do not have to hold what the other needs: it would take twice as long.
    """
    flip = 0 if region.downwards else -1
    while n < numbers.shape[0]:
        t = np.uint64(numbers[n])  # unsigned: no wrap-around of negative indices is compiled in
        if not is_small(corners, t, region, depth) or (facing != EITHER and faces_front[t] != facing):
            break
        first, end = bounds(corners, t)
        left, right = columns_of(corners, t)
        while left < right:
            fill_box(
                ops, writes_ids, corners, z_planes, flip, left, max(first, region.first_row), min(end, region.end_row),
                depth_range, t, depth, stencil, ids, region.first_row,
            )  # fmt: skip
            left += WIDEST
        n += 1
    return n


@inlined
def count_triangle(ops, triangles, t, region, depth_range, planes):
    """Count what will happen to the fragments of triangle `t`, before they are processed."""
    first, end = bounds(triangles.corners, np.uint64(t))
    plane = triangles.depth[t]
    for row in range(max(first, region.first_row), min(end, region.end_row)):
        left, right = row_span(triangles.corners, np.uint64(t), row, region.downwards)
        row_z = plane[2] * planes.columns[row]
        count_span(
            ops, plane, row_z, depth_range, planes.columns, max(left, region.left), min(right, region.right),
            planes.depth[row], planes.stencil[row], planes.verdicts,
        )  # fmt: skip
