"""Triangles in drawing order; equals `raster.ordered.process_fragments`, see fast/test_forward.py.

For draws whose colours depend on the order of their fragments, and for small opaque ones: no fragment is listed, and no
buffer of triangle numbers is searched for spans. A draw is one segment (`segment_rows`); consecutive small draws are
drawn together (`segment_groups`).
"""

from __future__ import annotations

import math
import threading
from typing import NamedTuple

import numpy as np

from softshadow.framebuffer import Framebuffer
from softshadow.pipeline.fast.fragment_block import block_memory
from softshadow.pipeline.fast.segment_rows import draw_segments
from softshadow.pipeline.fast.segment_tables import (
    COST_OF_PLAIN,
    IN_ORDER,
    NO_DEPTH,
    NO_STENCIL,
    SegmentState,
    padded_textures,
    texels_of_units,
)
from softshadow.pipeline.fast.span_float_writes import pixels_of
from softshadow.pipeline.memory.scratch import apart, row_columns, scratch
from softshadow.pipeline.memory.threads import share, threads
from softshadow.pipeline.raster.bins import BAND_ROWS, rows_of_few_bands, triangles_in_bands
from softshadow.pipeline.raster.region import depth_range_of
from softshadow.pipeline.records import Geometry, Region, Setup, Spans
from softshadow.pipeline.shade.interpolate import AttributePlanes, attribute_planes
from softshadow.pipeline.shade.shading import write_sprite_planes
from softshadow.state import State

TRIANGLES = 1 << 12  # whose planes are computed at a time
SPANS = 1 << 14  # collected at a time; a row of the widest buffer has at most half as many
WORTH_BANDS = 180_000  # plain fragments from which bands of rows pay for several threads: they take some 300 us
ROW, SET_UP = 20, 25  # plain fragments that take as long as to begin a row of a triangle, and as its planes


class _SpanLists(threading.local):
    """The memory of collected spans, for each thread."""

    def __init__(self) -> None:
        row, left, triangle = np.empty((3, SPANS), np.int32)
        self.spans = Spans(row, left, triangle, np.empty(SPANS + 1, np.int64))


_lists = _SpanLists()
in_order = np.arange(TRIANGLES, dtype=np.int32)


class Segments(NamedTuple):
    """Segments to draw, and what all of them have in common.

    table (S, 12) int32: columns as in `segment_tables`; ranges (S, 2) float32: what depths are clamped to; flats (g, k)
    bool: which columns are not interpolated; states: of `state_tables`; textures: of `padded_textures`; depth, stencil,
    pixels: the buffers; region: where any of the segments may write; work: see `work_of`.
    """

    table: np.ndarray
    ranges: np.ndarray
    flats: np.ndarray
    states: tuple[np.ndarray, ...]
    textures: tuple[np.ndarray, ...]
    depth: np.ndarray
    stencil: np.ndarray
    pixels: np.ndarray
    region: Region
    work: int

    @property
    def pay_bands(self) -> bool:
        """Whether several threads share bands of rows."""
        rows = self.region.end_row - self.region.first_row
        return threads() > 1 and self.work >= WORTH_BANDS and rows > BAND_ROWS


def draw_forward(
    numbers: SegmentState, state: State, target: Framebuffer, geometry: Geometry, region: Region, fragments: int = 0
) -> int:
    """Draw the triangles of a geometry in drawing order: tests, colours, blending and writes.

    Return how many fragments have passed the tests before shading.

    Parameters
    ----------
    numbers : of `segment_tables.segment_state`
    fragments : about how many fragments there are; many are shared by several threads in bands of rows
    """
    if region.first_row >= region.end_row:
        return 0
    n_passed = 0
    count, textures = len(geometry.triangles.ids), texels_of_units(geometry.program.units)
    row = 0, 0, 0, count, region.left, region.right, region.first_row, region.end_row, *IN_ORDER
    segments = Segments(
        np.array([row], np.int32), np.array([depth_range_of(state, np.float32)], np.float32), np.array([geometry.flat]),
        numbers.tables, padded_textures(textures), *buffers_of(target, numbers.writes_depth), region,
        work_of(numbers, fragments, count),
    )  # fmt: skip
    for begin in range(0, count, TRIANGLES):
        triangles = geometry.triangles
        if count > TRIANGLES:
            triangles = Setup(*(array[begin : begin + TRIANGLES] for array in triangles))
        planes = scratch((len(triangles.ids), 3, len(geometry.flat) + 1), np.float32)
        write_planes(geometry, triangles, planes)
        if segments.pay_bands:
            passed = _draw_in_bands(segments, triangles, planes)
        else:
            order = in_order[: len(triangles.ids)]
            passed = draw_rows(segments, region.first_row, region.end_row, triangles, planes, order)
        n_passed += int(passed[0])
    return n_passed


def buffers_of(target: Framebuffer, writes_depth: bool) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return depth and stencil values and pixels; those that are missing have a stand-in."""
    depth, stencil = target.depth, target.stencil
    return (
        NO_DEPTH if depth is None else depth.cells if writes_depth else depth.read_cells,
        NO_STENCIL if stencil is None else stencil.cells,
        pixels_of(target.colors[0]),
    )


def work_of(numbers: SegmentState, fragments: int, n_triangles: int) -> int:
    """Return how many plain fragments take as long as these and their triangles.

    A triangle of F fragments has about the root of 2 F rows.
    """
    rows = math.isqrt(2 * fragments * n_triangles)
    return fragments * numbers.cost // COST_OF_PLAIN + ROW * rows + SET_UP * n_triangles


def write_planes(geometry: Geometry, triangles: Setup, planes: np.ndarray) -> None:
    """Write the `interpolate.attribute_planes` of all triangles of a part of the geometry."""
    count, values, back = len(triangles.ids), geometry.values, geometry.back
    attribute_planes(
        geometry.window, values, values if back is None else back, triangles.vertices, triangles.front,
        in_order[:count], geometry.flat, geometry.provoking, triangles.ids, planes,
    )  # fmt: skip
    if geometry.sprites is not None:
        part = geometry._replace(triangles=triangles)
        write_sprite_planes(part, geometry.sprites, AttributePlanes(planes, in_order[:count]))


def _draw_in_bands(segments: Segments, triangles: Setup, planes: np.ndarray) -> np.ndarray:
    """Draw the triangles of one segment in bands of rows, which several threads share; return what `draw_rows` does."""
    region = segments.region
    band_rows = rows_of_few_bands(region, segments.work)
    bands = triangles_in_bands(triangles.corners, [(0, len(triangles.ids))], region, band_rows)

    def draw_band(n: int) -> np.ndarray:
        return draw_rows(segments, bands[n].first_row, bands[n].end_row, triangles, planes, bands[n].numbers)

    return np.sum(share(draw_band, len(bands)), axis=0)


def draw_rows(
    segments: Segments, first_row: int, end_row: int, triangles: Setup, planes: np.ndarray, order: np.ndarray
) -> np.ndarray:
    """Draw the segments into the rows [first_row, end_row); they divide the numbers of triangles `order` (n,).

    Return how many fragments of each have passed the tests before shading, (S,) int64.
    """
    passed = apart(len(segments.table), np.int64)
    passed.fill(0)
    draw_segments(
        segments.table, segments.ranges, order, first_row, end_row, segments.region.downwards, triangles.corners,
        triangles.depth, triangles.front, planes, in_order, segments.flats, *segments.states, segments.textures,
        segments.pixels, segments.depth, segments.stencil, passed, *_lists.spans, *row_columns(end_row),
        *block_memory.arrays,
    )  # fmt: skip
    return passed
