"""The fixed function on visible spans; equals `shade.shading.shade_and_write`, see fast/test_span_shading.py."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from softshadow.framebuffer import Framebuffer
from softshadow.jit import kernel
from softshadow.kernel_cache import KernelGroup
from softshadow.pipeline.fast.fragment_block import NEXT, block_memory
from softshadow.pipeline.fast.segment_rows import draw_segments
from softshadow.pipeline.fast.segment_tables import (
    IN_ORDER,
    NO_DEPTH,
    NO_STENCIL,
    OF_SPANS,
    covered_state,
    padded_textures,
    tables_of,
    texels_of_units,
)
from softshadow.pipeline.fast.span_float_writes import pixels_of
from softshadow.pipeline.fast.span_tests import NO_OPS
from softshadow.pipeline.fast.special_fragments import NO_SPECIAL
from softshadow.pipeline.memory.scratch import scratch
from softshadow.pipeline.records import Geometry, Spans
from softshadow.pipeline.shade.interpolate import AttributePlanes
from softshadow.pipeline.shade.shading import LOOKED_UP, shade_in_parts
from softshadow.state import State

NO_RANGE, NO_ORDER, NO_COLUMNS = np.zeros((1, 2), np.float32), np.empty(0, np.int32), np.empty((2, 0), np.int32)
NO_COUNT = np.zeros(1, np.int64)  # spans have passed the tests before

# so many fragments, in draws that cover most of a small window, pay for compiling them
SPAN_KERNELS = KernelGroup("spans", pays_after=250_000)
LONG_SPAN = 64  # fragments; spans of this length take no longer in any order


def fixed_function_shader(state: State, target: Framebuffer, geometry: Geometry) -> Callable[[Spans], None] | None:
    """Return the function that shades and writes spans of a draw without overlaps; None where it is not covered."""
    units = geometry.program.units
    numbers = covered_state(state, target, geometry, units)
    if numbers is None:
        return None
    triangles, pixels = geometry.triangles, pixels_of(target.colors[0])
    tables, textures = tables_of(NO_OPS, NO_OPS, *numbers, NO_SPECIAL), padded_textures(texels_of_units(units))
    flats = np.array([geometry.flat])

    def shade_part(spans: Spans, planes: AttributePlanes) -> None:
        spans = spans_by_triangle(spans, planes)
        segment = np.array([[0, 0, OF_SPANS, len(spans.row), 0, 0, 0, 0, *IN_ORDER]], np.int32)
        draw_segments(
            segment, NO_RANGE, NO_ORDER, 0, 0, 0, triangles.corners, triangles.depth, triangles.front, planes.values,
            planes.place, flats, *tables, textures, pixels, NO_DEPTH, NO_STENCIL, NO_COUNT, *spans,
            *NO_COLUMNS, *block_memory.arrays,
        )  # fmt: skip

    return lambda spans: shade_in_parts(geometry, spans, shade_part, LOOKED_UP if geometry.program.units else 1)


def spans_by_triangle(spans: Spans, planes: AttributePlanes) -> Spans:
    """Return spans that do not overlap in the order of their triangles, where shading them takes less time then.

    A vector holds the fragments of one triangle. In the order of rows, a span of three fragments has one of its own.
    """
    n_spans, n_triangles = len(spans.row), len(planes.values)
    if n_spans < 2 * n_triangles or spans.fragments >= LONG_SPAN * n_spans:
        return spans
    row, left, triangle = scratch((3, n_spans), np.int32)
    start, next_place = scratch(n_spans + 1, np.int64), scratch(n_triangles, np.int32)
    sort_by_triangle(planes.place, *spans, next_place, row, left, triangle, start)
    return Spans(row, left, triangle, start)


@kernel
def sort_by_triangle(place, rows, lefts, triangles, starts, next_place, out_rows, out_lefts, out_triangles, out_starts):
    """Sort spans by the `place` of their triangle, keeping the order of those of one; `next_place` (P,) is scratch."""
    n_spans = np.uint64(rows.shape[0])  # unsigned numbers: no wrap-around of negative indices is compiled in
    next_place[:] = 0
    for r in range(n_spans):
        next_place[np.uint64(place[np.uint64(triangles[r])])] += np.int32(1)
    n = np.int32(0)
    for p in range(np.uint64(next_place.shape[0])):
        n, next_place[p] = np.int32(n + next_place[p]), n
    for r in range(n_spans):
        t = np.uint64(triangles[r])
        own = np.uint64(place[t])
        k = np.uint64(next_place[own])
        next_place[own] += np.int32(1)
        out_rows[k], out_lefts[k], out_triangles[k] = rows[r], lefts[r], t
        out_starts[k + NEXT] = starts[r + NEXT] - starts[r]
    out_starts[0] = 0
    for r in range(n_spans):
        out_starts[r + NEXT] += out_starts[r]
