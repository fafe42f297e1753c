"""The polygon modes, offsets and stages that llvmpipe applies where it differs from the specification."""

from __future__ import annotations

from softshadow import tokens as gl
from softshadow.state import Lines, Polygon, State

SOLID_LINE = 0xFFFF  # the line stipple that lets all fragments through


def effective_modes(state: State) -> tuple[int, int]:
    """Return the polygon modes of front and back faces; a culled face takes the mode of the other one."""
    front, back, cull = state.polygon.mode_front, state.polygon.mode_back, state.cull
    if cull.enabled and cull.face in (gl.GL_FRONT, gl.GL_FRONT_AND_BACK):
        front = back
    return front, front if cull.enabled and cull.face in (gl.GL_BACK, gl.GL_FRONT_AND_BACK) else back


def offset_is_on(polygon: Polygon) -> bool:
    """Return whether llvmpipe offsets filled polygons; by GL 2.1, sec. 3.5.5, only `offset_fill` decides."""
    return polygon.offset_fill or polygon.offset_line or polygon.offset_point


def is_stippled(lines: Lines) -> bool:
    """Return whether lines are cut into pieces: Mesa ignores a pattern that is all ones."""
    return lines.stippled and lines.pattern != SOLID_LINE


def points_are_smooth(state: State) -> bool:
    """Return whether points are smooth: point sprites are not."""
    return state.points.smooth and not state.points.sprites


def passes_stages(state: State) -> bool:
    """Return whether triangles pass Mesa's pipeline of stages before they are set up (draw_need_pipeline).

    Then quads are cut in another way, and the offset is added to the vertices. llvmpipe's own setup knows offset and
    two-sided lighting, too, but leaves both to the stages where any of the states in the first line is on
    (lp_state_rasterizer.c).
    """
    front, back = effective_modes(state)
    polygon, lighting = state.polygon, state.lighting
    if (front, back) != (gl.GL_FILL, gl.GL_FILL) or polygon.stippled:
        return True
    if not (points_are_smooth(state) or state.lines.smooth or is_stippled(state.lines)):
        return False
    return offset_is_on(polygon) or (lighting.two_side and lighting.enabled and not state.program)


def has_special_fragments(state: State, mode: int) -> bool:
    """Return whether stipple, smoothing or point sprites decide about the fragments of a draw of a mode."""
    polygon, lines, points = state.polygon, state.lines, state.points
    if mode == gl.GL_POINTS:
        return points.smooth or points.sprites
    if mode in (gl.GL_LINES, gl.GL_LINE_STRIP, gl.GL_LINE_LOOP):
        return lines.smooth
    modes = effective_modes(state)
    return (
        polygon.stippled
        or (gl.GL_LINE in modes and lines.smooth)
        or (gl.GL_POINT in modes and (points.smooth or points.sprites))
    )
