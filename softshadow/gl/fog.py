"""Fog parameters, and the current fog coordinate, which fog may depend on in place of the distance."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from softshadow import tokens as gl
from softshadow.context import current, thread
from softshadow.gl.calls import in_lists, is_allowed, spelled_like_gl
from softshadow.gl.conversions import enum, first, from_int, vector
from softshadow.gl.errors import fail, is_one_of, outside_begin, wrong_enum
from softshadow.gl.fragment_state import rounded, rounded_number
from softshadow.gl.refusals import CONVERTING, refusal
from softshadow.gl.vertex_format import carry_attribute, set_attribute

NUMBERS = {gl.GL_FOG_DENSITY: "density", gl.GL_FOG_START: "start", gl.GL_FOG_END: "end"}
MODES = (gl.GL_LINEAR, gl.GL_EXP, gl.GL_EXP2)
SOURCES = (gl.GL_FRAGMENT_DEPTH, gl.GL_FOG_COORD)
A_NUMBER = "GL_FOG_MODE, GL_FOG_COORD_SRC, GL_FOG_DENSITY, GL_FOG_START or GL_FOG_END"
PLAIN = (float, int)  # types of numbers that need no other question
SINGLE = (gl.GL_FOG_MODE, gl.GL_FOG_COORD_SRC, *NUMBERS)


@in_lists
def glFogfv(pname: int, params: Any) -> None:
    """Set a fog parameter from a vector: the colour, or a number."""
    _set("glFogfv", pname, params, float)


@in_lists
def glFogiv(pname: int, params: Any) -> None:
    """Set a fog parameter from integers; colours use the full range of int."""
    _set("glFogiv", pname, params, from_int)


def glFogf(pname: int, param: float) -> None:
    """Set a fog parameter that is a single number."""
    context = thread.context
    try:
        if not (context.ready or is_allowed(context, glFogf, pname, param)):
            return
        if pname in NUMBERS and type(param) in PLAIN and param >= 0:
            context.change_field("fog", NUMBERS[pname], rounded_number(context, param))
        elif pname == gl.GL_FOG_MODE and type(param) in PLAIN and param in MODES:
            context.change_field("fog", "mode", int(param))
        elif pname in SINGLE:
            _set("glFogf", pname, param, float)
        else:
            wrong_enum("glFogf", "pname", pname, A_NUMBER)
    except CONVERTING as error:
        raise refusal(glFogf, error, pname, param) from error


glFogi = glFogf


def _set(operation: str, pname: int, params: Any, color: Callable[[Any], float]) -> None:
    context = outside_begin(operation)
    if context is None:
        return
    if pname == gl.GL_FOG_COLOR:
        context.change("fog", color=rounded(context, *vector(params, 4, color)))
        return
    if pname not in SINGLE:
        wrong_enum(operation, "pname", pname, f"GL_FOG_COLOR, {A_NUMBER}")
        return
    value = first(params, int if color is from_int else float)
    if pname == gl.GL_FOG_MODE:
        if is_one_of(operation, "param", mode := enum(value), MODES, "GL_LINEAR, GL_EXP or GL_EXP2"):
            context.change("fog", mode=mode)
    elif pname == gl.GL_FOG_COORD_SRC:
        if is_one_of(operation, "param", source := enum(value), SOURCES, "GL_FRAGMENT_DEPTH or GL_FOG_COORD"):
            context.change("fog", source=source)
    elif pname == gl.GL_FOG_DENSITY and value < 0:
        fail(gl.GL_INVALID_VALUE, operation, f"param={value:g}: expected 0 or more for GL_FOG_DENSITY")
    else:
        context.change_field("fog", NUMBERS[pname], rounded_number(context, value))


# -- coordinates of vertices -------------------------------------------------------------------------------------------
def set_fog_coordinate(coord: float) -> None:
    """Set the current fog coordinate."""
    context = current()
    carry_attribute(context, "fog_coordinate", 1)
    set_attribute(context, "fog_coordinate", 1, float(coord))


@in_lists
def glFogCoordf(coord: float) -> None:
    """Set the current fog coordinate."""
    set_fog_coordinate(coord)


@in_lists
def glFogCoordfv(coord: Any) -> None:
    """Set the current fog coordinate from a vector."""
    set_fog_coordinate(*vector(coord, 1))


glFogCoordd, glFogCoorddv = glFogCoordf, glFogCoordfv


__all__ = spelled_like_gl(globals())
