"""glPolygonMode: polygons drawn as their edges or corners, front and back faces in modes of their own.

Mesa does this per triangle, after clipping: facing and culling, polygon offset (here added to the vertices), then the
edges that belong to the drawn primitive. Faces that stay filled take the same path (draw_pipe_unfilled.c, _offset.c).
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.image import Image
from softshadow.pipeline.geometry.facing import CULL_BACK, CULL_FRONT, culling
from softshadow.pipeline.geometry.line_stipple import places_of
from softshadow.pipeline.geometry.triangle_setup import Offset, add_float_units, offset_of
from softshadow.pipeline.mesa.polygon_rules import effective_modes, offset_is_on
from softshadow.state import Cull, Polygon, State

EDGES_IN_ORDER = ((2, 0), (0, 1), (1, 2))  # of a triangle, as they are drawn
STARTS = [start for start, _ in EDGES_IN_ORDER]


class Outlined(NamedTuple):
    """Triangles, lines and points made of clipped triangles; triangle t has the vertices 3t, 3t + 1 and 3t + 2.

    window (3T, 4), z with its offset; values (3T, k), those of the facing, flat ones equal at all three; triangles
    (A, 3), lines (B, 2) and points (C,) int32; their number t is a vertex // 3; front (T,) bool; offset_mode: the
    polygon mode whose offset was added, 0 where no triangle decides it; places (B,) int32: of the lines in the line
    stipple (`line_stipple.cut_into_pieces`); ends_stipple: whether it begins anew after the last line.
    """

    window: np.ndarray
    values: np.ndarray
    triangles: np.ndarray
    lines: np.ndarray
    points: np.ndarray
    front: np.ndarray
    offset_mode: int
    places: np.ndarray
    ends_stipple: bool


def outline(
    window: np.ndarray,
    values: np.ndarray,
    back: np.ndarray | None,
    flat: np.ndarray,
    triangles: np.ndarray,
    edges: np.ndarray,
    provoking: np.ndarray,
    state: State,
    cull: Cull,
    depth: Image | None,
    slope: str,
    unit: str,
    flipped: bool,
    begins: np.ndarray,
    offset_mode: int = 0,
    no_edges: bool = False,
) -> Outlined:
    """Return the triangles, lines and points that the polygon modes make of triangles in the window.

    Parameters
    ----------
    window : (V, 4) window x, y (stored rows), z, 1/w
    values, back : (V, k) from the vertex stage, for front- and back-facing triangles
    flat : (k,) bool, columns taken from the `provoking` (T,) vertex
    triangles, edges : (T, 3), corners, and which edges are drawn
    cull : the faces to leave out; the modes depend on `state.cull`
    depth, slope, unit : of the polygon offset, as for `offset_of`
    begins : (T,) bool, triangles at which the line stipple begins anew
    offset_mode : the polygon mode whose offset is added; 0: that of the first triangle that is not culled
    no_edges : whether no vertex begins an edge; then Mesa culls the triangles that are not filled
    """
    corners = window[triangles]
    det = _determinant(corners)
    counter_clockwise_is_front = (state.cull.front_face == gl.GL_CCW) == flipped
    negative = det < 0
    front = np.where(det == 0, False, negative == counter_clockwise_is_front)
    modes = effective_modes(state)
    # a triangle without area is culled as a back face, but drawn in the mode of clockwise ones
    mode = np.where(negative == counter_clockwise_is_front, *modes)
    polygon = state.polygon
    has_edges = mode == gl.GL_FILL if no_edges else np.ones(len(mode), bool)
    if offset_is_on(polygon):
        decisive = np.flatnonzero(_not_culled(front, state.cull) & has_edges)[:1]
        if offset_mode == 0 and len(decisive):
            offset_mode = int(mode[decisive[0]])
        offset = _mode_offset(polygon, offset_mode or gl.GL_FILL)
        corners[:, :, 2] = _offset_depth(corners, det, offset, depth, slope, unit, flipped)
    corner_values, provoking_values = values[triangles], values[provoking]
    if back is not None:
        back_lit = (det != 0) & ~front  # a triangle without area is lit as a front face
        corner_values[back_lit], provoking_values[back_lit] = back[triangles[back_lit]], back[provoking[back_lit]]
    corner_values[:, :, flat] = provoking_values[:, None, flat]
    visible = _not_culled(front, cull) & has_edges
    first = np.arange(len(triangles), dtype=np.int32) * 3
    filled = first[visible & (mode == gl.GL_FILL)]
    as_lines, as_points = visible & (mode == gl.GL_LINE), visible & (mode == gl.GL_POINT)
    drawn_lines = edges[as_lines][:, STARTS] != 0
    # a filled triangle begins the line stipple anew, and so does each point, but not a triangle without drawn points
    restarting = np.where(as_lines, begins, ~as_points | (edges != 0).any(axis=1))
    return Outlined(
        np.ascontiguousarray(corners.reshape(-1, 4)),
        np.ascontiguousarray(corner_values.reshape(-1, values.shape[1])),
        filled[:, None] + np.arange(3, dtype=np.int32),
        _edge_lines(first[as_lines], drawn_lines),
        (first[as_points][:, None] + np.arange(3, dtype=np.int32))[edges[as_points] != 0],
        front,
        offset_mode,
        *_places(restarting & visible, as_lines, drawn_lines),
    )


def _determinant(corners: np.ndarray) -> np.ndarray:
    """Return twice the area (T,) of triangles (T, 3, 4), from the unsnapped positions."""
    e, f = corners[:, 0] - corners[:, 2], corners[:, 1] - corners[:, 2]
    return e[:, 0] * f[:, 1] - e[:, 1] * f[:, 0]


def _not_culled(front: np.ndarray, cull: Cull) -> np.ndarray:
    culled, _ = culling(cull)
    return np.where(front, not culled & CULL_FRONT, not culled & CULL_BACK)


def _edge_lines(first: np.ndarray, drawn: np.ndarray) -> np.ndarray:
    """Return the lines (B, 2) of triangles with vertices first, first + 1, first + 2."""
    lines = first[:, None, None] + np.array(EDGES_IN_ORDER, np.int32)
    return np.ascontiguousarray(lines[drawn], np.int32)


def _places(begins: np.ndarray, as_lines: np.ndarray, drawn: np.ndarray) -> tuple[np.ndarray, bool]:
    """Return the places (B,) of lines in the line stipple, and whether it begins anew after the last one.

    `begins` (T,) are the triangles that begin it, filled ones and those of points among them; `drawn` (n, 3) the edges
    of the triangles drawn as lines.
    """
    number = np.cumsum(begins)  # of beginnings up to each triangle
    of_line = np.repeat(number[as_lines], drawn.sum(axis=1))
    last = int(of_line[-1]) if len(of_line) else 0
    return places_of(np.diff(of_line, prepend=0) > 0), bool(len(number) and number[-1] > last)


def _mode_offset(polygon: Polygon, mode: int) -> Polygon:
    """Return the polygon state with the offset of one mode only."""
    enabled = {gl.GL_FILL: polygon.offset_fill, gl.GL_LINE: polygon.offset_line, gl.GL_POINT: polygon.offset_point}
    return replace(polygon, offset_fill=enabled[mode], offset_line=False, offset_point=False)


def _offset_depth(
    corners: np.ndarray, det: np.ndarray, polygon: Polygon, depth: Image | None, slope: str, unit: str, flipped: bool
) -> np.ndarray:
    """Return z (T, 3) of the corners with the offset added, clamped to [0, 1]; NaN becomes 0."""
    real = corners.dtype.type
    offset: Offset = offset_of(polygon, depth, real, slope, unit, flipped)
    e, f = corners[:, 0] - corners[:, 2], corners[:, 1] - corners[:, 2]
    over_area = real(1) / det
    di = -((e[:, 1] * f[:, 2] - e[:, 2] * f[:, 1]) * over_area)
    dj = -((e[:, 2] * f[:, 0] - e[:, 0] * f[:, 2]) * over_area)
    if slope == "max":
        steepness = np.where(np.abs(di) > np.abs(dj), np.abs(di), np.abs(dj))
    elif slope == "length":
        steepness = np.sqrt(di * di + dj * dj)
    else:
        steepness = np.maximum(di, -dj if flipped else dj)
    added = steepness * offset.factor + offset.constant
    if polygon.offset_fill and depth is not None and not depth.format.largest:
        add_float_units(added, corners[:, :, 2], polygon.units)
    z = corners[:, :, 2] + added[:, None]
    return np.where(z > 0, np.minimum(z, real(1)), real(0))
