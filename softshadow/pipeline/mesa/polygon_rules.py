"""Which polygon modes and offsets llvmpipe applies, where they differ from what the specification asks for."""

from __future__ import annotations

from softshadow import tokens as gl
from softshadow.state import Polygon, State


def drawn_modes(state: State) -> tuple[int, int]:
    """Return the polygon modes of front and back faces; a face that is culled takes that of the other."""
    front, back, cull = state.polygon.mode_front, state.polygon.mode_back, state.cull
    if cull.enabled and cull.face in (gl.GL_FRONT, gl.GL_FRONT_AND_BACK):
        front = back
    return front, front if cull.enabled and cull.face in (gl.GL_BACK, gl.GL_FRONT_AND_BACK) else back


def offset_is_on(polygon: Polygon) -> bool:
    """Return whether llvmpipe offsets filled polygons; GL 2.1, sec. 3.5.5, asks for `offset_fill` alone."""
    return polygon.offset_fill or polygon.offset_line or polygon.offset_point
