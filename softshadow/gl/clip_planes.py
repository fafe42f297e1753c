"""User clip planes."""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.capabilities import CLIP_PLANES, with_item
from softshadow.gl.conversions import vector
from softshadow.gl.errors import is_one_of, outside_begin
from softshadow.gl.texture_units import eye_plane

A_PLANE = "GL_CLIP_PLANE0 … GL_CLIP_PLANE5"


@in_lists
def glClipPlane(plane: int, equation: Any) -> None:
    """Set a clip plane (a, b, c, d) that clips where a·x + b·y + c·z + d·w < 0; GL stores it in eye space."""
    context = outside_begin("glClipPlane")
    if context is None or not is_one_of("glClipPlane", "plane", plane, CLIP_PLANES, A_PLANE):
        return
    object_space = np.array(vector(equation, 4), np.float64)
    eye_space = tuple(eye_plane(context, object_space).tolist())
    equations = with_item(context.groups["clip_planes"].fields["equations"], plane - gl.GL_CLIP_PLANE0, eye_space)
    context.change("clip_planes", equations=equations)


def glGetClipPlane(plane: int) -> Any:
    """Return the equation of a clip plane in eye space, 4 float64."""
    context = outside_begin("glGetClipPlane")
    if context is None or not is_one_of("glGetClipPlane", "plane", plane, CLIP_PLANES, A_PLANE):
        return None
    return np.array(context.state.clip_planes.equations[plane - gl.GL_CLIP_PLANE0], np.float64)


__all__ = spelled_like_gl(globals())
