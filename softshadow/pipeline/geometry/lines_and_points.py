"""Lines and points in the window: stippled, smooth, as sprites, or plain.

A plain line or point is two triangles of its own kind (`lines`, `points`); a smooth one is two triangles like those of
polygons, with a coverage (`smooth`).
"""

from __future__ import annotations

import numpy as np

from softshadow import tokens as gl
from softshadow.pipeline.geometry.line_stipple import cut_into_pieces
from softshadow.pipeline.geometry.lines import set_up_lines
from softshadow.pipeline.geometry.points import set_up_points, set_up_sprites
from softshadow.pipeline.geometry.smooth import (
    INSIDE_LINE,
    INSIDE_POINT,
    LINE_TRIANGLES,
    PLACE_COLUMNS,
    POINT_TRIANGLES,
    is_outside_point,
    smooth_lines,
    smooth_points,
    with_coverage,
)
from softshadow.pipeline.geometry.triangle_setup import MAX_SLOPE, Offset, set_up
from softshadow.pipeline.geometry.vertex import append_rows
from softshadow.pipeline.memory.scratch import scratch
from softshadow.pipeline.mesa.polygon_rules import is_stippled, points_are_smooth
from softshadow.pipeline.records import Discards, Geometry, Setup, Sprites
from softshadow.programs.fixed_function import has_secondary
from softshadow.state import Cull, State

COLUMNS_OF_UNIT = 4


def set_up_lines_of(
    geometry: Geometry,
    lines: np.ndarray,
    ids: np.ndarray,
    places: np.ndarray,
    widths: np.ndarray | None,
    state: State,
    flipped: bool,
) -> tuple[Geometry, Setup]:
    """Return the triangles of lines (L, 2) int32, and the geometry with the vertices and values that they need.

    `ids` (L,) int32 are copied to the triangles; `places` (L,) int32: see `line_stipple.cut_into_pieces`; `widths` (L,)
    float64 are those of the lines if draws differ in it; else None.
    """
    widths = np.full(len(lines), state.polygon.line_width, np.float64) if widths is None else widths
    stippled, smooth = is_stippled(state.lines), state.lines.smooth
    if not stippled and not smooth:
        return geometry, set_up_lines(geometry.window, lines, ids, widths)
    window, values, provoking = geometry.window, geometry.values, geometry.provoking[ids]
    if stippled:
        before = geometry.stipple_place
        pieces = cut_into_pieces(window, values, lines, provoking, geometry.flat, places, state.lines, before)
        geometry, ids = geometry._replace(stipple_place=pieces.counter), ids[pieces.line]
        widths = widths[pieces.line]
        lines = np.arange(2 * len(ids), dtype=np.int32).reshape(-1, 2)
        window, values, provoking = pieces.window, pieces.values, np.ascontiguousarray(lines[:, 0])
    if smooth:
        geometry = geometry._replace(line_places=values.shape[1])
        flat, corners = geometry.flat, _room_for_corners(geometry, len(lines), INSIDE_LINE)
        first = len(geometry.window)
        smooth_lines(window, values, lines, provoking, flat, widths, *(rows[first:] for rows in corners))
        return _with_rectangles(geometry, *corners, LINE_TRIANGLES, ids, "line", flipped)
    lines += np.int32(len(geometry.window))
    geometry = geometry._replace(
        window=append_rows(geometry.window, window), values=np.concatenate([geometry.values, values])
    )
    return geometry, set_up_lines(geometry.window, lines, ids, widths)


def set_up_points_of(
    geometry: Geometry, points: np.ndarray, ids: np.ndarray, sizes: np.ndarray | None, state: State, flipped: bool
) -> tuple[Geometry, Setup]:
    """Return the triangles of points (P,) int32, and the geometry with the vertices and values that they need.

    `sizes` (V,) are those of the vertices if the vertex stage computes them, or draws differ in it; else None.
    """
    real = geometry.window.dtype.type
    own_sizes = np.full(len(points), size_of_points(state), real) if sizes is None else sizes[points]
    if points_are_smooth(state):
        places, corners = geometry.values.shape[1], _room_for_corners(geometry, len(points), INSIDE_POINT)
        room = (rows[len(geometry.window) :] for rows in corners)
        points = np.ascontiguousarray(points)
        smooth_points(geometry.window, geometry.values, points, own_sizes, *room)
        geometry, triangles = _with_rectangles(geometry, *corners, POINT_TRIANGLES, ids, "point", flipped)
        discards = (geometry.discards or Discards())._replace(places=places, outside=is_outside_point)
        return geometry._replace(discards=discards), triangles
    if not state.points.sprites:
        return geometry, set_up_points(geometry.window, points, ids, own_sizes, flipped)
    triangles, widths = set_up_sprites(geometry.window, points, ids, own_sizes)
    of_vertices = np.ones(len(geometry.window), real)
    of_vertices[points] = widths
    upwards = (state.points.origin == gl.GL_UPPER_LEFT) == flipped
    return geometry._replace(sprites=Sprites(_replaced_columns(geometry, state), of_vertices, upwards)), triangles


def size_of_points(state: State) -> float:
    """Return the size in pixels of all points of a draw; that of smooth ones is at least 2."""
    size, points = state.polygon.point_size, state.points
    limited = min(size, points.largest) if size > points.smallest else points.smallest
    return max(limited, 2.0) if points_are_smooth(state) else limited


def _replaced_columns(geometry: Geometry, state: State) -> tuple[int, ...]:
    """Return the first column of each texture unit whose coordinates are replaced."""
    first = 7 if has_secondary(state) else 4
    units = geometry.program.units or []
    return tuple(
        first + COLUMNS_OF_UNIT * number for number, unit in enumerate(units) if state.points.replaced[unit.index]
    )


def _room_for_corners(geometry: Geometry, n: int, inside: tuple[float, ...]) -> tuple[np.ndarray, np.ndarray]:
    """Return window and values for the vertices of a geometry and `n` rectangles, with four more columns of values.

    Those of the geometry are written, with the places `inside`.
    """
    first, columns, real = len(geometry.window), geometry.values.shape[1], geometry.window.dtype
    window = scratch((first + 4 * n, 4), real)
    values = np.empty((first + 4 * n, columns + PLACE_COLUMNS), real)
    window[:first], values[:first, :columns], values[:first, columns:] = geometry.window, geometry.values, inside
    return window, values


def _with_rectangles(
    geometry: Geometry,
    window: np.ndarray,
    values: np.ndarray,
    triangles: tuple[tuple[int, int, int], ...],
    ids: np.ndarray,
    kind: str,
    flipped: bool,
) -> tuple[Geometry, Setup]:
    """Return the geometry with the vertices of rectangles, and their triangles by the corners of each."""
    columns, real = geometry.values.shape[1], geometry.window.dtype
    first = np.arange(len(geometry.window), len(window), 4, dtype=np.int32)
    geometry = geometry._replace(
        window=window,
        values=values,
        flat=np.append(geometry.flat, np.zeros(PLACE_COLUMNS, bool)),
        program=with_coverage(geometry.program, columns, kind),
    )
    corners = (first[:, None, None] + np.array(triangles, np.int32)).reshape(-1, 3)
    no_offset = Offset(MAX_SLOPE, real.type(0), real.type(0), int(flipped))
    setup = set_up(geometry.window, corners, Cull(), no_offset, flipped)
    return geometry, setup._replace(ids=np.ascontiguousarray(ids[setup.ids // 2]))
