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
    PLACE_COLUMNS,
    Rectangles,
    is_outside_point,
    smooth_lines,
    smooth_points,
    with_coverage,
)
from softshadow.pipeline.geometry.triangle_setup import MAX_SLOPE, Offset, set_up
from softshadow.pipeline.geometry.vertex import append_rows
from softshadow.pipeline.mesa.polygon_rules import is_stippled, points_are_smooth
from softshadow.pipeline.records import Discards, Geometry, Setup, Sprites
from softshadow.programs.fixed_function import has_secondary
from softshadow.state import Cull, State

COLUMNS_OF_UNIT = 4


def set_up_lines_of(
    geometry: Geometry, lines: np.ndarray, ids: np.ndarray, restarts: np.ndarray, state: State, flipped: bool
) -> tuple[Geometry, Setup]:
    """Return the triangles of lines (L, 2) int32, and the geometry with the vertices and values that they need.

    `ids` (L,) int32 are copied to the triangles; `restarts` (L,) bool: where the line stipple begins anew.
    """
    width = state.polygon.line_width
    stippled, smooth = is_stippled(state.lines), state.lines.smooth
    if not stippled and not smooth:
        return geometry, set_up_lines(geometry.window, lines, ids, width)
    window, values = geometry.window[lines], geometry.values[lines]
    values[:, :, geometry.flat] = geometry.values[geometry.provoking[ids]][:, None, geometry.flat]
    if stippled:
        pieces = cut_into_pieces(window, values, restarts, state.lines, geometry.stipple_place)
        geometry = geometry._replace(stipple_place=pieces.counter)
        window, values = pieces.window.reshape(-1, 2, 4), pieces.values.reshape(-1, 2, values.shape[2])
        ids = ids[pieces.line]
    first = len(geometry.window)
    if smooth:
        rectangles = smooth_lines(window, values, width)
        geometry = geometry._replace(line_places=values.shape[2])
        return _with_rectangles(geometry, rectangles, ids, "line", INSIDE_LINE, flipped)
    geometry = _with_vertices(geometry, window.reshape(-1, 4), values.reshape(-1, values.shape[2]))
    ends = first + np.arange(2 * len(ids), dtype=np.int32).reshape(-1, 2)
    return geometry, set_up_lines(geometry.window, ends, ids, width)


def set_up_points_of(
    geometry: Geometry, points: np.ndarray, ids: np.ndarray, sizes: np.ndarray | None, state: State, flipped: bool
) -> tuple[Geometry, Setup]:
    """Return the triangles of points (P,) int32, and the geometry with the vertices and values that they need.

    `sizes` (V,) are those of the vertices if the vertex stage computes them, else None.
    """
    real = geometry.window.dtype.type
    size = state.polygon.point_size
    limited = min(size, state.points.largest) if size > state.points.smallest else state.points.smallest
    own_sizes = np.full(len(points), limited, real) if sizes is None else sizes[points]
    if points_are_smooth(state):
        squares = smooth_points(
            geometry.window[points], geometry.values[points], own_sizes, per_vertex=sizes is not None
        )
        places = geometry.values.shape[1]
        geometry, triangles = _with_rectangles(geometry, squares, ids, "point", INSIDE_POINT, flipped)
        discards = (geometry.discards or Discards())._replace(places=places, outside=is_outside_point)
        return geometry._replace(discards=discards), triangles
    if not state.points.sprites:
        return geometry, set_up_points(geometry.window, points, ids, own_sizes, flipped)
    triangles, widths = set_up_sprites(geometry.window, points, ids, own_sizes)
    of_vertices = np.ones(len(geometry.window), real)
    of_vertices[points] = widths
    upwards = (state.points.origin == gl.GL_UPPER_LEFT) == flipped
    return geometry._replace(sprites=Sprites(_replaced_columns(geometry, state), of_vertices, upwards)), triangles


def _replaced_columns(geometry: Geometry, state: State) -> tuple[int, ...]:
    """Return the first column of each texture unit whose coordinates are replaced."""
    first = 7 if has_secondary(state) else 4
    units = geometry.program.units or []
    return tuple(
        first + COLUMNS_OF_UNIT * number for number, unit in enumerate(units) if state.points.replaced[unit.index]
    )


def _with_vertices(geometry: Geometry, window: np.ndarray, values: np.ndarray) -> Geometry:
    return geometry._replace(
        window=append_rows(geometry.window, np.ascontiguousarray(window)),
        values=np.concatenate([geometry.values, values]),
    )


def _with_rectangles(
    geometry: Geometry, rectangles: Rectangles, ids: np.ndarray, kind: str, inside: tuple[float, ...], flipped: bool
) -> tuple[Geometry, Setup]:
    """Return the geometry with rectangles and four more columns for their places, and the triangles."""
    columns, first, real = geometry.values.shape[1], len(geometry.window), geometry.window.dtype
    others = np.broadcast_to(np.array(inside, real), (first, PLACE_COLUMNS))
    geometry = geometry._replace(
        values=np.hstack([geometry.values, others]),
        flat=np.append(geometry.flat, np.zeros(PLACE_COLUMNS, bool)),
        program=with_coverage(geometry.program, columns, kind),
    )
    geometry = _with_vertices(geometry, rectangles.window, np.hstack([rectangles.values, rectangles.places]))
    no_offset = Offset(MAX_SLOPE, real.type(0), real.type(0), int(flipped))
    setup = set_up(geometry.window, rectangles.triangles + np.int32(first), Cull(), no_offset, flipped)
    return geometry, setup._replace(ids=np.ascontiguousarray(ids[setup.ids // 2]))
