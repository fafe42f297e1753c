"""Triangle by triangle from coverage to pixels; equals `raster.ordered.process_fragments`, see fast/test_forward.py.

For draws whose colours depend on the order of their fragments, and for small opaque ones: no fragment is listed, and no
buffer of triangle numbers is searched for spans. The spans of a triangle are tested row by row, and those that pass are
collected in blocks, which are shaded and written in drawing order.
"""

from __future__ import annotations

import numpy as np

from softshadow.framebuffer import Framebuffer
from softshadow.jit import kernel
from softshadow.pipeline.fast.fixed_function_spans import covered_state
from softshadow.pipeline.fast.fragment_block import (
    FLOAT_ROWS,
    NEXT,
    SIZE,
    SPAN_LEFT,
    SPAN_PLACE,
    SPAN_ROW,
    SPAN_START,
    WHOLE_ROWS,
)
from softshadow.pipeline.fast.span_colors import shade_block
from softshadow.pipeline.fast.span_state import COMPARISONS, SpanState
from softshadow.pipeline.fast.span_tests import N_OPS, WANTED, test_block, test_span
from softshadow.pipeline.fast.span_writes import write_block
from softshadow.pipeline.memory.threads import share, threads
from softshadow.pipeline.raster.bins import BAND_ROWS_LOG2, sort_into_bands
from softshadow.pipeline.raster.coverage import bounds, row_span
from softshadow.pipeline.raster.fragment_ops import FragmentOps
from softshadow.pipeline.raster.region import depth_range_of
from softshadow.pipeline.records import Geometry, Region
from softshadow.pipeline.shade.blend import to_unorm8
from softshadow.pipeline.shade.interpolate import attribute_planes
from softshadow.state import State

PLACES = 32  # triangles whose planes a block holds
WORTH_BANDS = 100_000  # fragments, about, from which sorting triangles into bands pays for several threads
NO_DEPTH, NO_STENCIL = np.zeros((1, 1), np.float32), np.zeros((1, 1), np.uint8)

_ops_numbers: dict[tuple[FragmentOps, FragmentOps, int], np.ndarray] = {}
KEPT = 256
_in_order = [np.arange(1 << 12, dtype=np.int32)]


def forward_state(state: State, target: Framebuffer, geometry: Geometry) -> SpanState | None:
    """Return the numbers of the fragment state for `draw_forward`, or None where it cannot draw."""
    depth = target.depth
    if depth is not None and depth.format.dtype != np.float32:
        return None
    return covered_state(state, target, geometry)


def draw_forward(
    numbers: SpanState,
    front: FragmentOps,
    back: FragmentOps,
    state: State,
    target: Framebuffer,
    geometry: Geometry,
    region: Region,
    fragments: int = 0,
) -> None:
    """Draw the triangles of a geometry in drawing order: tests, colours, blending and writes.

    Parameters
    ----------
    numbers : of `forward_state`
    front, back : the per-fragment operations of each facing
    fragments : about how many fragments there are; many are shared by several threads in bands of rows
    """
    triangles, values = geometry.triangles, geometry.values
    depth, stencil = target.depth, target.stencil
    buffers = (
        NO_DEPTH if depth is None else depth.cells,
        NO_STENCIL if stencil is None else stencil.cells,
        target.colors[0].cells.view(np.int32)[..., 0],
    )
    arrays = (
        triangles.corners, triangles.vertices, triangles.depth, triangles.front, triangles.ids, geometry.window, values,
        values if geometry.back is None else geometry.back, geometry.flat, geometry.provoking,
        ops_numbers(front, back, state), *depth_range_of(state, np.float32), numbers.switches, numbers.numbers,
        *numbers.texels,
    )  # fmt: skip
    if threads() > 1 and fragments >= WORTH_BANDS and region.end_row - region.first_row > 1 << BAND_ROWS_LOG2:
        bins = sort_into_bands(triangles.corners, [(0, len(triangles.ids))], region)
        bands = np.flatnonzero(np.diff(bins.starts)).tolist()

        def draw_band(n: int) -> None:
            rows = bins.rows_of(bands[n], region)
            draw_triangles_forward(
                bins.of(bands[n]), region.left, region.right, *rows, region.downwards, *arrays, *buffers
            )

        share(draw_band, len(bands))
        return
    order = in_order(len(triangles.ids))
    draw_triangles_forward(
        order, region.left, region.right, region.first_row, region.end_row, region.downwards, *arrays, *buffers
    )


def in_order(count: int) -> np.ndarray:
    """Return 0, 1, 2 ... (count,) int32."""
    if count > len(_in_order[0]):
        _in_order[0] = np.arange(2 * count, dtype=np.int32)
    return _in_order[0][:count]


def ops_numbers(front: FragmentOps, back: FragmentOps, state: State) -> np.ndarray:
    """Return the operations of both facings as numbers (2, N_OPS), with the alpha reference as a byte."""
    reference = int(to_unorm8(np.array(state.alpha.ref, np.float32))) if front.alpha_test else 0
    key = (front, back, reference)
    numbers = _ops_numbers.get(key)
    if numbers is None:
        if len(_ops_numbers) >= KEPT:
            _ops_numbers.clear()
        numbers = _ops_numbers[key] = np.empty((2, N_OPS), np.int64)
        for row, ops in zip(numbers, (front, back), strict=True):
            row[:WANTED] = ops._replace(alpha_ref=reference)
            row[WANTED] = COMPARISONS[ops.depth_func]
    return numbers


@kernel
def draw_triangles_forward(
    order, region_left, region_right, first_row, end_row, downwards, corners, vertices, planes, faces_front, ids,
    window, values, back_values, flat, provoking, ops, low, high, switches, numbers, texels0, texels1, depth, stencil,
    pixels,
):  # fmt: skip
    """Draw the triangles with the numbers `order` (n,) into the rows [first_row, end_row); see `draw_forward`."""
    room, whole = np.empty(FLOAT_ROWS * SIZE, np.float32), np.empty(WHOLE_ROWS * SIZE, np.int32)
    spans, needed = np.zeros((4, SIZE + 1), np.int32), np.empty(1, np.int32)
    block_triangles, block_planes = np.empty(PLACES, np.int32), np.empty((PLACES, 3, flat.shape[0] + 1), np.float32)
    tests_alpha, no_depth, no_stencil = ops[0, 0] != 0, depth.shape[0] < end_row, stencil.shape[0] < end_row
    count = n_spans = n_places = 0
    for m in range(order.shape[0]):
        t, place = np.uint64(order[m]), -1
        first, end = bounds(corners, t)
        for row in range(max(first, first_row), min(end, end_row)):
            left, right = row_span(corners, t, row, downwards)
            left, right = max(left, region_left), min(right, region_right)
            while left < right:
                length = min(right - left, SIZE - count)
                begin, stop = 0, length
                if not tests_alpha:
                    begin, stop = test_span(
                        ops[0] if faces_front[t] else ops[1], planes[t], low, high, row, left, length, count,
                        depth[0 if no_depth else row], stencil[0 if no_stencil else row], room, whole,
                    )  # fmt: skip
                if begin < stop:
                    if place < 0:
                        place, needed[0], block_triangles[n_places] = n_places, t, t
                        own = block_planes[place : place + 1]
                        attribute_planes(
                            window, values, back_values, vertices, faces_front, needed, flat, provoking, ids, own
                        )
                        n_places += 1
                    s = np.uint64(n_spans)
                    spans[SPAN_ROW, s], spans[SPAN_LEFT, s], spans[SPAN_PLACE, s] = row, left + begin, place
                    n_spans, count = n_spans + 1, count + stop - begin
                    spans[SPAN_START, s + NEXT] = count
                left += length
                if count == SIZE:
                    finish_block(
                        spans, n_spans, count, block_triangles, block_planes, planes, faces_front, flat, ops, low, high,
                        switches, numbers, texels0, texels1, depth, stencil, pixels, room, whole,
                    )  # fmt: skip
                    count = n_spans = n_places = 0
                    place = -1
        if n_places == PLACES or (m == order.shape[0] - 1 and count):
            finish_block(
                spans, n_spans, count, block_triangles, block_planes, planes, faces_front, flat, ops, low, high,
                switches, numbers, texels0, texels1, depth, stencil, pixels, room, whole,
            )  # fmt: skip
            count = n_spans = n_places = 0


@kernel
def finish_block(
    spans, n_spans, count, block_triangles, block_planes, planes, faces_front, flat, ops, low, high, switches, numbers,
    texels0, texels1, depth, stencil, pixels, room, whole,
):  # fmt: skip
    """Shade the spans of a block, test their alpha and write them."""
    shade_block(block_planes, spans, n_spans, count, flat, switches, numbers, texels0, texels1, room, whole)
    if ops[0, 0]:
        test_block(ops, spans, n_spans, block_triangles, planes, faces_front, low, high, depth, stencil, room, whole)
    write_block(spans, n_spans, switches, whole, pixels)
