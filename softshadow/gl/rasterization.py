"""Calls that set rasterization: culling, polygon mode and offset, line and point size, viewport, scissor box."""

from __future__ import annotations

from softshadow import tokens as gl
from softshadow.context import thread
from softshadow.gl.calls import is_allowed, spelled_like_gl
from softshadow.gl.errors import fail, is_one_of
from softshadow.gl.fragment_state import A_FACE, FACES, clamp01, rounded_number, rounded_pair
from softshadow.gl.refusals import CONVERTING, refusal

LARGEST_VIEWPORT = 16384
FARTHEST_CORNER = 32768  # Mesa clamps the corner of a viewport to this
POLYGON_MODES = (gl.GL_POINT, gl.GL_LINE, gl.GL_FILL)


# -- polygons, lines, points -------------------------------------------------------------------------------------------
def glCullFace(mode: int) -> None:
    """Set which faces GL_CULL_FACE removes."""
    context = thread.context
    if not (context.ready or is_allowed(context, glCullFace, mode)):
        return
    if is_one_of("glCullFace", "mode", mode, FACES, A_FACE):
        context.change_field("cull", "face", int(mode))


def glFrontFace(mode: int) -> None:
    """Set which winding is front-facing."""
    context = thread.context
    if not (context.ready or is_allowed(context, glFrontFace, mode)):
        return
    if is_one_of("glFrontFace", "mode", mode, (gl.GL_CW, gl.GL_CCW), "GL_CW or GL_CCW"):
        context.change_field("cull", "front_face", int(mode))


def glPolygonMode(face: int, mode: int) -> None:
    """Set whether polygons are drawn filled, as lines or as points."""
    context = thread.context
    if not (context.ready or is_allowed(context, glPolygonMode, face, mode)):
        return
    if not is_one_of("glPolygonMode", "face", face, FACES, A_FACE):
        return
    if is_one_of("glPolygonMode", "mode", mode, POLYGON_MODES, "GL_POINT, GL_LINE or GL_FILL"):
        fields = {} if face == gl.GL_BACK else {"mode_front": int(mode)}
        if face != gl.GL_FRONT:
            fields["mode_back"] = int(mode)
        context.change_fields("polygon", fields)


def glPolygonOffset(factor: float, units: float) -> None:
    """Set the depth offset of polygons: `factor` times the slope, plus `units` times the smallest depth step."""
    context = thread.context
    try:
        if context.ready or is_allowed(context, glPolygonOffset, factor, units):
            slope, steps = rounded_pair(context, factor, units)
            context.change_fields("polygon", {"factor": slope, "units": steps})
    except CONVERTING as error:
        raise refusal(glPolygonOffset, error, factor, units) from error


def glLineWidth(width: float) -> None:
    """Set the width of lines in pixels."""
    context = thread.context
    try:
        if not (context.ready or is_allowed(context, glLineWidth, width)):
            return
        if width <= 0:
            fail(gl.GL_INVALID_VALUE, "glLineWidth", f"width={width}: expected more than 0")
        else:
            context.change_field("polygon", "line_width", rounded_number(context, width))
    except CONVERTING as error:
        raise refusal(glLineWidth, error, width) from error


def glPointSize(size: float) -> None:
    """Set the size of points in pixels."""
    context = thread.context
    if not (context.ready or is_allowed(context, glPointSize, size)):
        return
    if size <= 0:
        fail(gl.GL_INVALID_VALUE, "glPointSize", f"size={size}: expected more than 0")
    else:
        context.change_field("polygon", "point_size", rounded_number(context, size))


# -- viewport and scissor box ------------------------------------------------------------------------------------------
def glViewport(x: int, y: int, width: int, height: int) -> None:
    """Set the viewport, in pixels from the lower left."""
    context = thread.context
    if not (context.ready or is_allowed(context, glViewport, x, y, width, height)):
        return
    if (width >= 0 and height >= 0) or _box_is_valid("glViewport", width, height):
        if not (type(x) is type(y) is type(width) is type(height) is int):
            x, y, width, height = int(x), int(y), int(width), int(height)
        if width > LARGEST_VIEWPORT or height > LARGEST_VIEWPORT:
            width, height = min(width, LARGEST_VIEWPORT), min(height, LARGEST_VIEWPORT)
        if not (-FARTHEST_CORNER <= x < FARTHEST_CORNER and -FARTHEST_CORNER <= y < FARTHEST_CORNER):
            x, y = (max(-FARTHEST_CORNER, min(corner, FARTHEST_CORNER - 1)) for corner in (x, y))
        context.change_fields("viewport", {"x": x, "y": y, "width": width, "height": height})


def glScissor(x: int, y: int, width: int, height: int) -> None:
    """Set the scissor box, in pixels from the lower left."""
    context = thread.context
    if not (context.ready or is_allowed(context, glScissor, x, y, width, height)):
        return
    if (width >= 0 and height >= 0) or _box_is_valid("glScissor", width, height):
        if not (type(x) is type(y) is type(width) is type(height) is int):
            x, y, width, height = int(x), int(y), int(width), int(height)
        context.change_fields("scissor", {"x": x, "y": y, "width": width, "height": height})


def _box_is_valid(operation: str, width: int, height: int) -> bool:
    if width >= 0 and height >= 0:
        return True
    name, size = ("width", width) if width < 0 else ("height", height)
    fail(gl.GL_INVALID_VALUE, operation, f"{name}={size}: expected 0 or more")
    return False


def glDepthRange(zNear: float, zFar: float) -> None:
    """Set the depths of the near and far plane, clamped to [0, 1]."""
    context = thread.context
    try:
        if context.ready or is_allowed(context, glDepthRange, zNear, zFar):
            near, far = rounded_pair(context, clamp01(zNear), clamp01(zFar))
            context.change_fields("viewport", {"near": near, "far": far})
    except CONVERTING as error:
        raise refusal(glDepthRange, error, zNear, zFar) from error


glDepthRangef = glDepthRange

__all__ = spelled_like_gl(globals())
