"""The fill stage: for every covered pixel of every triangle, depth and `process_fragment`.

`fill_triangles` is the textbook: triangle by triangle, row by row. `fill` calls it, or a kernel of `fast/` that does
the same, for all triangles at once or for one band of rows after the other.
"""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from softshadow.jit import inlined, kernel
from softshadow.pipeline.memory.scratch import scratch
from softshadow.pipeline.memory.threads import parts_of, share
from softshadow.pipeline.raster.bins import Band, triangles_in_bands
from softshadow.pipeline.raster.coverage import bounds, row_span
from softshadow.pipeline.raster.fragment_ops import FragmentOps
from softshadow.pipeline.raster.spans import count_span, fill_span
from softshadow.pipeline.records import NO_TRIANGLE, DepthRange, FillBuffers, FragmentCounts, Region, Setup

AT_A_TIME = 1 << 19  # triangles sorted into bands in one go; bounds the memory where all of them meet all bands

# fill(front, back, triangles, numbers, region, depth_range, buffers) for the triangles with these numbers, in order
FillKernel = Callable[..., None]
OfRows = Callable[[int, int], None]


def nothing(first_row: int, end_row: int) -> None:
    """Do nothing before or after a band."""


def no_ids(region: Region, pitch: int) -> np.ndarray:
    """Return ids (rows of the region, pitch) int32 of pixels without a triangle; of other columns, any numbers."""
    ids = scratch((region.end_row - region.first_row, pitch), np.int32)
    ids[:, region.left : region.right] = NO_TRIANGLE
    return ids


def fill_buffers(
    depth: np.ndarray, stencil: np.ndarray, real: np.dtype, region: Region, ids: np.ndarray | None = None
) -> FillBuffers:
    """Return what the fill stage reads and writes; without ids, an array that is not written stands in."""
    columns = np.arange(max(*depth.shape, region.right, region.end_row), dtype=real)
    return FillBuffers(columns, depth, stencil, np.empty((1, 1), np.int32) if ids is None else ids)


def fill(
    fill_kernel: FillKernel,
    front: FragmentOps,
    back: FragmentOps,
    triangles: Setup,
    region: Region,
    depth_range: DepthRange,
    buffers: FillBuffers,
    *,
    writes_ids: bool = False,
    band_rows: int = 0,
    ranges: Sequence[tuple[int, int]] | None = None,
    before: OfRows = nothing,
    after: OfRows = nothing,
) -> None:
    """Process all fragments of the triangles inside the region.

    Parameters
    ----------
    fill_kernel : `textbook_kernel`, or a kernel of `fast/`
    writes_ids : whether the ids of `buffers` are written
    band_rows : how many rows a band has, 0 for no bands
    ranges : the rows [first, end) of `triangles` to draw, all by default
    before, after : called with first and end row of each band before and after it is filled, by the same thread
    """

    def fill_part(numbers: np.ndarray, first_row: int, end_row: int) -> None:
        part = region._replace(first_row=first_row, end_row=end_row)
        rows = buffers._replace(ids=buffers.ids[first_row - region.first_row :]) if writes_ids else buffers
        fill_kernel(front, back, triangles, numbers, part, depth_range, rows)

    if not band_rows:
        before(region.first_row, region.end_row)
        for first, end in [(0, len(triangles.ids))] if ranges is None else ranges:
            fill_part(np.arange(first, end, dtype=np.int32), region.first_row, region.end_row)
        after(region.first_row, region.end_row)
        return
    chunks = _chunks(len(triangles.ids)) if ranges is None else [ranges]
    for number, parts in enumerate(chunks):
        bands = triangles_in_bands(triangles.corners, parts, region, band_rows)
        is_first, is_last = number == 0, number == len(chunks) - 1

        def fill_band(n: int, bands: list[Band] = bands, is_first: bool = is_first, is_last: bool = is_last) -> None:
            numbers, first_row, end_row = bands[n]
            if is_first:
                before(first_row, end_row)
            if len(numbers):
                fill_part(numbers, first_row, end_row)
            if is_last:
                after(first_row, end_row)

        share(fill_band, len(bands))


def _chunks(count: int) -> list[list[tuple[int, int]]]:
    """Return the parts of so many triangles that are sorted into bands in one go, for each go."""
    return [
        [(begin + first, begin + end) for first, end in parts_of(min(AT_A_TIME, count - begin))]
        for begin in range(0, count, AT_A_TIME)
    ]


def textbook_kernel(two_sided: int, writes_ids: int, counts: FragmentCounts | None) -> FillKernel:
    """Return `fill_triangles` with these flags; the fragments are counted where there are counts."""
    counting, counts = int(counts is not None), counts or FragmentCounts.zero()

    def fill_kernel(front: FragmentOps, back: FragmentOps, *rest: Any) -> None:
        fill_triangles(front, back, two_sided, writes_ids, counting, counts, *rest)

    return fill_kernel


@kernel
def fill_triangles(
    front, back, two_sided, writes_ids, counting, counts, triangles, numbers, region, depth_range, buffers
):  # fmt: skip
    """Process all fragments of the triangles with these numbers, in this order: the state is an argument.

    The state is `front`, and for back-facing triangles `back` where `two_sided` is 1. `writes_ids` is 0, LAST or ONLY;
    `counting` is 1 where the fragments are counted.
    """
    for n in range(numbers.shape[0]):
        t = int(numbers[n])
        ops = back if two_sided and not triangles.front[t] else front
        if counting:
            count_rows(ops, triangles, t, region, depth_range, buffers, counts)
        fill_rows(
            ops, writes_ids, triangles.corners, triangles.depth, t, region, depth_range, buffers.columns,
            buffers.depth, buffers.stencil, buffers.ids,
        )  # fmt: skip


@inlined
def fill_rows(ops, writes_ids, corners, planes, t, region, depth_range, columns, depth, stencil, ids):
    """Process the fragments of triangle `t` inside the region, row by row; `planes` are those of `Setup.depth`.

    Depth and stencil change, the ids where `writes_ids` is LAST or ONLY.
    """
    first, end = bounds(corners, np.uint64(t))
    plane = planes[t]
    for row in range(max(first, region.first_row), min(end, region.end_row)):
        left, right = row_span(corners, np.uint64(t), row, region.downwards)
        left, right = max(left, region.left), min(right, region.right)
        if left < right:
            own_ids = ids[row - region.first_row] if writes_ids else ids[0]
            fill_span(
                ops, writes_ids, plane, depth_range, columns, columns[row], left, right, t, depth[row], stencil[row],
                own_ids,
            )  # fmt: skip


@inlined
def count_rows(ops, triangles, t, region, depth_range, buffers, counts):
    """Count the verdicts of the fragments of triangle `t`, before they are processed."""
    first, end = bounds(triangles.corners, np.uint64(t))
    plane = triangles.depth[t]
    for row in range(max(first, region.first_row), min(end, region.end_row)):
        left, right = row_span(triangles.corners, np.uint64(t), row, region.downwards)
        count_span(
            ops, plane, depth_range, buffers.columns, buffers.columns[row], max(left, region.left),
            min(right, region.right), buffers.depth[row], buffers.stencil[row], counts,
        )  # fmt: skip
