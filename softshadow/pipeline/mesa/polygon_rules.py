"""The polygon modes and offsets that llvmpipe applies where it differs from the specification."""

from __future__ import annotations

from softshadow import tokens as gl
from softshadow.state import Polygon, State


def effective_modes(state: State) -> tuple[int, int]:
    """Return the polygon modes of front and back faces; a culled face takes the mode of the other one."""
    front, back, cull = state.polygon.mode_front, state.polygon.mode_back, state.cull
    if cull.enabled and cull.face in (gl.GL_FRONT, gl.GL_FRONT_AND_BACK):
        front = back
    return front, front if cull.enabled and cull.face in (gl.GL_BACK, gl.GL_FRONT_AND_BACK) else back


def offset_is_on(polygon: Polygon) -> bool:
    """Return whether llvmpipe offsets filled polygons; by GL 2.1, sec. 3.5.5, only `offset_fill` decides."""
    return polygon.offset_fill or polygon.offset_line or polygon.offset_point
