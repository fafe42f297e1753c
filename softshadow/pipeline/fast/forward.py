"""Triangles in drawing order; equals `raster.ordered.process_fragments`, see fast/test_forward.py.

For draws whose colours depend on the order of their fragments, and for small opaque ones: no fragment is listed, and no
buffer of triangle numbers is searched for spans. The triangles are tested row by row, one after the other; the spans
that pass are shaded and written in the same order.
"""

from __future__ import annotations

import threading
from typing import Any

import numpy as np

from softshadow.framebuffer import Framebuffer
from softshadow.pipeline.fast.fixed_function_spans import NO_DEPTH, NO_STENCIL, covered_state, shade_spans
from softshadow.pipeline.fast.fragment_block import block_memory
from softshadow.pipeline.fast.span_state import NEEDED, SpanState, with_texels
from softshadow.pipeline.fast.span_tests import alpha_tests, collect_passing_spans, span_tests
from softshadow.pipeline.fast.special_fragments import NO_SPECIAL, discards_some, needed_places, special_numbers
from softshadow.pipeline.memory.scratch import scratch
from softshadow.pipeline.memory.threads import parts_of, share, threads
from softshadow.pipeline.raster.bins import BAND_ROWS_LOG2, few_bands, triangles_in_bands
from softshadow.pipeline.raster.fragment_ops import ALWAYS, FragmentOps
from softshadow.pipeline.raster.region import depth_range_of
from softshadow.pipeline.records import Geometry, Region, Setup, Spans
from softshadow.pipeline.shade.interpolate import AttributePlanes, attribute_planes
from softshadow.pipeline.shade.shading import write_sprite_planes
from softshadow.state import State

TRIANGLES = 1 << 12  # whose planes are computed at a time
PLANES = 1 << 11  # of triangles, computed by one thread in one go
SPANS = 1 << 14  # collected at a time; a row of the widest buffer has at most half as many
WORTH_BANDS = 30_000  # fragments from which bands of rows pay for several threads: they take some 250 us
SMALL_TRIANGLE = 40  # fragments that take as long as a small triangle
STENCIL_TESTED = 8  # if the stencil test can fail: fragments that fail take an eighth of the time

Numbers = tuple[Any, ...]  # arguments of kernels


class _SpanLists(threading.local):
    """The memory of collected spans, for each thread."""

    def __init__(self) -> None:
        row, left, triangle = np.empty((3, SPANS), np.int32)
        self.spans = Spans(row, left, triangle, np.empty(SPANS + 1, np.int64))


_lists = _SpanLists()
_in_order = np.arange(TRIANGLES, dtype=np.int32)


def forward_state(state: State, target: Framebuffer, geometry: Geometry, known: list[SpanState]) -> SpanState | None:
    """Return the numbers of the fragment state for `draw_forward`, or None where it cannot draw.

    `known` keeps the numbers of a plan, of which only the contents of textures can change.
    """
    if known:
        return with_texels(known[0], geometry.program.units or [])
    depth = target.depth
    if depth is not None and depth.format.dtype != np.float32:
        return None
    numbers = covered_state(state, target, geometry)
    if numbers is not None:
        known.append(numbers)
    return numbers


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
    if region.first_row >= region.end_row:
        return
    depth, stencil, writes = target.depth, target.stencil, front.depth_write or back.depth_write
    buffers = (
        *depth_range_of(state, np.float32), NO_DEPTH if depth is None else depth.cells if writes else depth.read_cells,
        NO_STENCIL if stencil is None else stencil.cells,
    )  # fmt: skip
    special, switches = special_numbers(geometry), numbers.switches
    if discards_some(special) and not front.alpha_test:  # they are left out with those that fail the alpha test
        front, back = (ops._replace(alpha_test=1, alpha_func=ALWAYS) for ops in (front, back))
    if special is not NO_SPECIAL:
        switches = switches.copy()
        switches[NEEDED] |= needed_places(special)
    tests, later_tests = (*span_tests(front, back), *buffers), (*alpha_tests(front, back), *buffers)
    pixels = target.colors[0].cells.view(np.int32)[..., 0]
    colors = (geometry.flat, switches, numbers.numbers, *numbers.texels, special, pixels)
    tests_stencil = front.stencil_test or back.stencil_test
    work = fragments // (STENCIL_TESTED if tests_stencil else 1) + SMALL_TRIANGLE * len(geometry.triangles.ids)
    for begin in range(0, len(geometry.triangles.ids), TRIANGLES):
        triangles = geometry.triangles
        if len(triangles.ids) > TRIANGLES:
            triangles = Setup(*(array[begin : begin + TRIANGLES] for array in triangles))
        shared = triangles, _planes_of_all(geometry, triangles), region, tests, later_tests, colors
        if threads() > 1 and work >= WORTH_BANDS and region.end_row - region.first_row > 1 << BAND_ROWS_LOG2:
            _draw_in_bands(*shared)
        else:
            _draw_rows(_in_order[: len(triangles.ids)], region.first_row, region.end_row, *shared)


def _planes_of_all(geometry: Geometry, triangles: Setup) -> np.ndarray:
    """Return the `interpolate.attribute_planes` of all triangles of a part of the geometry."""
    count, values, back = len(triangles.ids), geometry.values, geometry.back
    planes = scratch((count, 3, values.shape[1] + 1), np.float32)

    def write_part(first: int, end: int) -> None:
        attribute_planes(
            geometry.window, values, values if back is None else back, triangles.vertices, triangles.front,
            _in_order[first:end], geometry.flat, geometry.provoking, triangles.ids, planes[first:end],
        )  # fmt: skip

    if count < 2 * PLANES:  # most draws: no time to look for threads
        write_part(0, count)
    else:
        parts = parts_of(count, PLANES)
        share(lambda n: write_part(*parts[n]), len(parts))
    if geometry.sprites is not None:
        part = geometry._replace(triangles=triangles)
        write_sprite_planes(part, geometry.sprites, AttributePlanes(planes, _in_order[:count]))
    return planes


def _draw_in_bands(triangles: Setup, planes: np.ndarray, region: Region, *numbers: Numbers) -> None:
    """Draw the triangles in bands of rows, which several threads share."""
    bands = triangles_in_bands(triangles.corners, [(0, len(triangles.ids))], region, few_bands(region))

    def draw_band(n: int) -> None:
        _draw_rows(*bands[n], triangles, planes, region, *numbers)

    share(draw_band, len(bands))


def _draw_rows(
    order: np.ndarray, first_row: int, end_row: int, triangles: Setup, planes: np.ndarray, region: Region,
    tests: Numbers, later_tests: Numbers, colors: Numbers,
) -> None:  # fmt: skip
    """Draw the triangles with the numbers `order` (n,) into the rows [first_row, end_row)."""
    corners, depth_planes, faces_front = triangles.corners, triangles.depth, triangles.front
    spans, memory, columns, m, row = _lists.spans, block_memory.arrays, np.empty((2, end_row), np.int32), 0, first_row
    while m < len(order):
        m, row, n_spans = collect_passing_spans(
            order, m, row, region.left, region.right, first_row, end_row, region.downwards, corners, depth_planes,
            faces_front, *tests, *spans, *memory[:2], *columns,
        )  # fmt: skip
        shade_spans(
            planes, _in_order, *spans, n_spans, True, *colors, depth_planes, faces_front, *later_tests, *memory
        )  # fmt: skip
