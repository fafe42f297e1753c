"""Polygons that are not filled: glPolygonMode turns them into their edges or corners, each face in its own way.

Mesa does this per triangle, after clipping: facing and culling, polygon offset (here added to the vertices), then the
edges that are edges of what was drawn. Faces that stay filled go the same way (draw_pipe_unfilled.c, _offset.c).
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.image import Image
from softshadow.pipeline.geometry.facing import CULL_BACK, CULL_FRONT, culling
from softshadow.pipeline.geometry.triangle_setup import Offset, add_float_units, offset_of
from softshadow.pipeline.mesa.polygon_rules import drawn_modes, offset_is_on
from softshadow.state import Cull, Polygon, State

EDGES_IN_ORDER = ((2, 0), (0, 1), (1, 2))  # of a triangle, as they are drawn


class Outlined(NamedTuple):
    """What becomes of clipped triangles, over vertices of their own: 3t, 3t + 1, 3t + 2 for triangle t.

    window (3T, 4), z with its offset; values (3T, k), those of the facing, flat ones equal on all three; triangles
    (A, 3), lines (B, 2) and points (C,) int32; their number t is a vertex // 3; front (T,) bool; offset_mode: the
    polygon mode whose offset was added, 0 where no triangle decides it.
    """

    window: np.ndarray
    values: np.ndarray
    triangles: np.ndarray
    lines: np.ndarray
    points: np.ndarray
    front: np.ndarray
    offset_mode: int


def is_filled(state: State) -> bool:
    return drawn_modes(state) == (gl.GL_FILL, gl.GL_FILL)


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
    offset_mode: int = 0,
) -> Outlined:
    """Return triangles, lines and points that are left of triangles in the window.

    Parameters
    ----------
    window : (V, 4) window x, y (stored rows), z, 1/w
    values, back : (V, k) from the vertex stage, for front- and back-facing triangles
    flat : (k,) bool, columns taken from the `provoking` (T,) vertex
    triangles, edges : (T, 3), corners, and which edges are drawn
    cull : what is left out; `state.cull` decides about modes
    depth, slope, unit : of the polygon offset, as for `offset_of`
    offset_mode : the polygon mode whose offset is added; 0: that of the first triangle that is not culled
    """
    corners = window[triangles]
    det = _determinant(corners)
    counter_clockwise_is_front = (state.cull.front_face == gl.GL_CCW) == flipped
    turns = det < 0
    front = np.where(det == 0, False, turns == counter_clockwise_is_front)
    modes = drawn_modes(state)
    # a triangle without area is culled as a back face, but drawn in the mode of clockwise ones
    mode = np.where(turns == counter_clockwise_is_front, *modes)
    polygon = state.polygon
    if offset_is_on(polygon):
        decisive = np.flatnonzero(_kept(front, state.cull))[:1]
        if offset_mode == 0 and len(decisive):
            offset_mode = int(mode[decisive[0]])
        offset = _offset(polygon, offset_mode or gl.GL_FILL)
        corners[:, :, 2] = _with_offset(corners, det, offset, depth, slope, unit, flipped)
    shown, constant = values[triangles], values[provoking]
    if back is not None:
        turned = (det != 0) & ~front  # without area: lit as a front face
        shown[turned], constant[turned] = back[triangles[turned]], back[provoking[turned]]
    shown[:, :, flat] = constant[:, None, flat]
    kept = _kept(front, cull)
    first = np.arange(len(triangles), dtype=np.int32) * 3
    filled = first[kept & (mode == gl.GL_FILL)]
    lined, dotted = kept & (mode == gl.GL_LINE), kept & (mode == gl.GL_POINT)
    return Outlined(
        np.ascontiguousarray(corners.reshape(-1, 4)),
        np.ascontiguousarray(shown.reshape(-1, values.shape[1])),
        filled[:, None] + np.arange(3, dtype=np.int32),
        _lines(first[lined], edges[lined]),
        (first[dotted][:, None] + np.arange(3, dtype=np.int32))[edges[dotted] != 0],
        front,
        offset_mode,
    )


def _determinant(corners: np.ndarray) -> np.ndarray:
    """Return twice the area (T,) of triangles (T, 3, 4), from the unsnapped positions."""
    e, f = corners[:, 0] - corners[:, 2], corners[:, 1] - corners[:, 2]
    return e[:, 0] * f[:, 1] - e[:, 1] * f[:, 0]


def _kept(front: np.ndarray, cull: Cull) -> np.ndarray:
    culled, _ = culling(cull)
    return np.where(front, not culled & CULL_FRONT, not culled & CULL_BACK)


def _lines(first: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Return the lines (B, 2) of triangles with vertices first, first + 1, first + 2."""
    lines = first[:, None, None] + np.array(EDGES_IN_ORDER, np.int32)
    return np.ascontiguousarray(lines[edges[:, [start for start, _ in EDGES_IN_ORDER]] != 0], np.int32)


def _offset(polygon: Polygon, mode: int) -> Polygon:
    """Return the polygon state with the offset of one mode only."""
    enabled = {gl.GL_FILL: polygon.offset_fill, gl.GL_LINE: polygon.offset_line, gl.GL_POINT: polygon.offset_point}
    return replace(polygon, offset_fill=enabled[mode], offset_line=False, offset_point=False)


def _with_offset(
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
