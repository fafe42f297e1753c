"""glPolygonMode: polygons drawn as their edges or corners, front and back faces in modes of their own.

Mesa does this per triangle, after clipping: facing and culling, polygon offset (here added to the vertices), then the
edges that belong to the drawn primitive. Faces that stay filled take the same path (draw_pipe_unfilled.c, _offset.c).
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.image import Image
from softshadow.jit import inlined, kernel, read_only
from softshadow.pipeline.constants import ZERO
from softshadow.pipeline.geometry.facing import CULL_BACK, CULL_FRONT, culling
from softshadow.pipeline.geometry.line_stipple import CONTINUES
from softshadow.pipeline.geometry.triangle_setup import Offset, add_float_units, offset_of
from softshadow.pipeline.memory.scratch import scratch
from softshadow.pipeline.mesa.polygon_rules import effective_modes, offset_is_on
from softshadow.state import Cull, Polygon, State


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
    places: np.ndarray | None = None,
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
    places : (T,) int32, optional
        Of the triangles of several draws: at the first one of each the place in the line stipple before the draw, at
        the others CONTINUES.
    """
    n, columns = len(triangles), values.shape[1]
    corners, corner_values = scratch((n, 3, 4), window.dtype), scratch((3 * n, columns), values.dtype)
    det, front, mode = np.empty(n, window.dtype), np.empty(n, bool), np.empty(n, np.int32)
    write_corners(
        window, read_only(values), read_only(values if back is None else back), flat, read_only(triangles), provoking,
        (state.cull.front_face == gl.GL_CCW) == flipped, *effective_modes(state), corners, corner_values, det, front,
        mode,
    )  # fmt: skip
    polygon = state.polygon
    if offset_is_on(polygon):
        decisive = first_drawn(front, mode, culling(state.cull)[0], no_edges)
        if offset_mode == 0 and decisive >= 0:
            offset_mode = int(mode[decisive])
        offset = _mode_offset(polygon, offset_mode or gl.GL_FILL)
        corners[:, :, 2] = _offset_depth(corners, det, offset, depth, slope, unit, flipped)
    filled, points = np.empty((n, 3), np.int32), np.empty(3 * n, np.int32)
    lines, line_places = np.empty((3 * n, 2), np.int32), np.empty(3 * n, np.int32)
    places = np.full(n, CONTINUES, np.int32) if places is None else places
    n_filled, n_lines, n_points, ends_stipple = list_primitives(
        front, mode, culling(cull)[0], no_edges, edges, begins, places, filled, lines, line_places, points
    )
    return Outlined(
        corners.reshape(-1, 4), corner_values, filled[:n_filled], lines[:n_lines], points[:n_points], front,
        offset_mode, line_places[:n_lines], ends_stipple,
    )  # fmt: skip


@kernel
def write_corners(
    window, values, back, flat, triangles, provoking, negative_is_front, front_mode, back_mode, corners, corner_values,
    det, front, mode,
):  # fmt: skip
    """Write the corners (T, 3, 4) of triangles and their values, twice their area, their facing and polygon mode.

    `det` is that of the unsnapped positions. A triangle without area counts as a back face for culling, but it is lit
    as a front face, and drawn in the mode of clockwise ones.
    """
    for t in range(triangles.shape[0]):
        for k in range(3):
            for c in range(4):
                corners[t, k, c] = window[triangles[t, k], c]
        e_x, e_y = corners[t, 0, 0] - corners[t, 2, 0], corners[t, 0, 1] - corners[t, 2, 1]
        f_x, f_y = corners[t, 1, 0] - corners[t, 2, 0], corners[t, 1, 1] - corners[t, 2, 1]
        area = e_x * f_y - e_y * f_x
        det[t], turns_to_front = area, (area < ZERO) == negative_is_front
        front[t], mode[t] = turns_to_front and area != ZERO, front_mode if turns_to_front else back_mode
        lit = back if area != ZERO and not front[t] else values
        for k in range(3):
            for c in range(values.shape[1]):
                corner_values[3 * t + k, c] = lit[provoking[t] if flat[c] else triangles[t, k], c]


@inlined
def is_drawn(is_front, mode, culled, no_edges):
    """Return whether a triangle is drawn in its mode; `culled` are the faces to leave out."""
    return not culled & (CULL_FRONT if is_front else CULL_BACK) and (mode == gl.GL_FILL or not no_edges)


@kernel
def first_drawn(front, mode, culled, no_edges):
    """Return the first triangle that is drawn, -1 if none is."""
    for t in range(front.shape[0]):
        if is_drawn(front[t], mode[t], culled, no_edges):
            return t
    return -1


@kernel
def list_primitives(front, mode, culled, no_edges, edges, begins, places, filled, lines, line_places, points):
    """List the triangles (A, 3), lines (B, 2) and points (C,) to draw; return A, B, C, and `Outlined.ends_stipple`.

    `line_places` (B,): those of the lines in the line stipple. A filled triangle begins it anew, and so does one with
    drawn points; one drawn as lines where `begins` says so. `places`: see `outline`.
    """
    n_filled = n_lines = n_points = 0
    begins_next, place_next = False, CONTINUES
    for t in range(front.shape[0]):
        if places[t] != CONTINUES:
            begins_next, place_next = False, places[t]
        if not is_drawn(front[t], mode[t], culled, no_edges):
            continue
        if mode[t] == gl.GL_LINE:
            begins_next = begins_next or begins[t]
        else:
            begins_next = begins_next or mode[t] != gl.GL_POINT or edges[t, 0] or edges[t, 1] or edges[t, 2]
        if mode[t] == gl.GL_FILL:
            for k in range(3):
                filled[n_filled, k] = 3 * t + k
            n_filled += 1
            continue
        for k in range(3):
            if mode[t] == gl.GL_POINT:
                if edges[t, k]:
                    points[n_points] = 3 * t + k
                    n_points += 1
                continue
            start = (k + 2) % 3  # the edge between the last corner and the first one is drawn first
            if edges[t, start]:
                lines[n_lines, 0], lines[n_lines, 1] = 3 * t + start, 3 * t + k
                line_places[n_lines] = 0 if begins_next else place_next
                begins_next, place_next = False, CONTINUES
                n_lines += 1
    return n_filled, n_lines, n_points, begins_next


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
