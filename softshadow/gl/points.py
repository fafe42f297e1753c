"""glPointParameter: how the size of points depends on their distance, its limits, and the origin of point sprites."""

from __future__ import annotations

from typing import Any

from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.conversions import enum, numbers
from softshadow.gl.errors import fail, outside_begin, wrong_enum
from softshadow.gl.fragment_state import rounded, rounded_number

SIZES = {
    gl.GL_POINT_SIZE_MIN: "smallest",
    gl.GL_POINT_SIZE_MAX: "largest",
    gl.GL_POINT_FADE_THRESHOLD_SIZE: "fade_threshold",
}
ORIGINS = (gl.GL_LOWER_LEFT, gl.GL_UPPER_LEFT)
A_PARAMETER = (
    "GL_POINT_SIZE_MIN, GL_POINT_SIZE_MAX, GL_POINT_FADE_THRESHOLD_SIZE, GL_POINT_DISTANCE_ATTENUATION or "
    "GL_POINT_SPRITE_COORD_ORIGIN"
)


@in_lists
def glPointParameterf(pname: int, param: float) -> None:
    """Set a parameter of points."""
    _set("glPointParameterf", pname, [param])


@in_lists
def glPointParameteri(pname: int, param: int) -> None:
    """Set a parameter of points."""
    _set("glPointParameteri", pname, [param])


@in_lists
def glPointParameterfv(pname: int, params: Any) -> None:
    """Set a parameter of points; GL_POINT_DISTANCE_ATTENUATION takes three numbers."""
    _set("glPointParameterfv", pname, numbers(params))


@in_lists
def glPointParameteriv(pname: int, params: Any) -> None:
    """Set a parameter of points; GL_POINT_DISTANCE_ATTENUATION takes three numbers."""
    _set("glPointParameteriv", pname, numbers(params))


def _set(operation: str, pname: int, values: Any) -> None:
    context: Context | None = outside_begin(operation)
    if context is None:
        return
    values = [float(value) for value in values]
    if pname == gl.GL_POINT_DISTANCE_ATTENUATION:
        if len(values) < 3:
            wrong_enum(operation, "pname", pname, "a call that takes three numbers")
            return
        context.change("points", attenuation=tuple(rounded(context, *values[:3])))
    elif pname in SIZES:
        if values[0] < 0:
            fail(gl.GL_INVALID_VALUE, operation, f"{values[0]:g}: expected 0 or more")
            return
        context.change("points", **{SIZES[pname]: rounded_number(context, values[0])})
    elif pname == gl.GL_POINT_SPRITE_COORD_ORIGIN:
        origin = enum(values[0])
        if origin not in ORIGINS:
            fail(gl.GL_INVALID_VALUE, operation, f"{values[0]:g}: expected GL_LOWER_LEFT or GL_UPPER_LEFT")
            return
        context.change("points", origin=origin)
    else:
        wrong_enum(operation, "pname", pname, A_PARAMETER)


__all__ = spelled_like_gl(globals())
