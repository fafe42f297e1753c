"""Where draws leave the line stipple: a strip whose first line is clipped goes on where the draw before it ended."""

from __future__ import annotations

import numpy as np

from softshadow import tokens as gl
from softshadow.framebuffer import Storage
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.geometry.clip import outcodes
from softshadow.pipeline.geometry.clip_planes import user_planes
from softshadow.pipeline.geometry.draw_primitives import lines_or_points_of
from softshadow.pipeline.geometry.geometry import (
    positions_of,
    process_geometry,
    stipple_places,
    with_new_vertices,
)
from softshadow.pipeline.geometry.line_stipple import place_after
from softshadow.pipeline.geometry.lines import LINES, clip_lines
from softshadow.pipeline.geometry.vertex import to_clip
from softshadow.pipeline.mesa.polygon_rules import is_stippled, passes_stages


def draws_stippled_lines(command: Draw) -> bool:
    """Return whether a draw may go on in the line stipple, or leave it elsewhere."""
    state = command.state
    may_be_lines = command.mode in LINES or (command.mode != gl.GL_POINTS and passes_stages(state))
    return is_stippled(state.lines) and may_be_lines


def begins_stipple_anew(command: Draw, model_view_projection: np.ndarray) -> bool:
    """Return whether the first line or polygon of a draw is surely drawn, so that the pattern begins anew there."""
    indices, positions = command.indices, command.vertices.position
    if command.mode in LINES:
        n = 2
    elif command.state.cull.enabled or command.vertices.edges is not None:
        return False
    else:
        n = 4 if command.mode in (gl.GL_QUADS, gl.GL_QUAD_STRIP) else 3
    first = positions[:n] if indices is None else positions[indices[:n]]
    if len(first) < n:
        return False
    with np.errstate(all="ignore"):  # as in pipeline.draw
        clip = to_clip(model_view_projection, first)
        return not outcodes(clip, command.state.depth.clamp, user_planes(command)).any()


def stipple_place_after(command: Draw, storage: Storage) -> int:
    """Return the place in the line stipple after a draw; it is 0 again after filled polygons and points."""
    if not draws_stippled_lines(command):
        return command.stipple_place
    state = command.state
    target = storage.framebuffers[state.draw_framebuffer]
    with np.errstate(all="ignore"):  # as in pipeline.draw
        if command.mode not in LINES:
            return process_geometry(command, target, storage).stipple_place
        clip, codes, window, planes = positions_of(command, target)
        clipped = clip_lines(clip, np.empty((len(clip), 0), clip.dtype), lines_or_points_of(command), codes, planes)
        window = with_new_vertices(window, clipped, command, target)
        places = stipple_places(clipped, command)
        return place_after(window, clipped.triangles, places, state.lines, command.stipple_place)
