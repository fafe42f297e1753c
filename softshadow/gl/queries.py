"""glGet: all state that can be set can be queried, as floats, doubles, integers or booleans."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import current
from softshadow.gl.calls import spelled_like_gl
from softshadow.gl.capabilities import KNOWN, is_on
from softshadow.gl.conversions import nearest_int, to_int
from softshadow.gl.errors import outside_begin, wrong_enum
from softshadow.gl.state_table import BY_TOKEN, NORMALIZED

CURRENT_VALUES = (
    gl.GL_CURRENT_COLOR, gl.GL_CURRENT_NORMAL, gl.GL_CURRENT_TEXTURE_COORDS, gl.GL_CURRENT_SECONDARY_COLOR,
    gl.GL_CURRENT_FOG_COORD, gl.GL_CURRENT_INDEX,
)  # fmt: skip
DOUBLES = (gl.GL_DEPTH_RANGE, gl.GL_DEPTH_CLEAR_VALUE)  # state that GL stores in double precision
STRINGS = {
    gl.GL_VENDOR: b"softshadow",
    gl.GL_RENDERER: b"softshadow software rasterizer",
    gl.GL_VERSION: b"2.1 softshadow",
    gl.GL_EXTENSIONS: b"GL_ARB_depth_clamp GL_ARB_depth_texture GL_ARB_framebuffer_object GL_ARB_shadow GL_KHR_debug",
}


def glGetString(name: int) -> bytes | None:
    """Return a string that describes this implementation."""
    if outside_begin("glGetString") is None:
        return None
    if name in STRINGS:
        return STRINGS[name]
    wrong_enum("glGetString", "name", name, "GL_VENDOR, GL_RENDERER, GL_VERSION or GL_EXTENSIONS")
    return None


def glGetFloatv(pname: int, params: Any = None) -> Any:
    """Return state as float32: a number, or an array; matrices as (4, 4) in GL's memory order."""
    return _get("glGetFloatv", pname, params, np.float32, lambda value: float(np.float32(value)))


def glGetDoublev(pname: int, params: Any = None) -> Any:
    """Return state as float64: a number, or an array; matrices as (4, 4) in GL's memory order."""
    return _get("glGetDoublev", pname, params, np.float64, float if pname in DOUBLES else _rounded)


def glGetIntegerv(pname: int, params: Any = None) -> Any:
    """Return state as int32: a number, or an array. For colours, normals and depths, 1.0 is the largest int."""
    convert = to_int if pname in DOUBLES else _scaled if pname in NORMALIZED else nearest_int
    return _get("glGetIntegerv", pname, params, np.int32, convert)


def glGetBooleanv(pname: int, params: Any = None) -> Any:
    """Return state as booleans: whether it is not 0."""
    return _get("glGetBooleanv", pname, params, np.uint8, bool)


glGetFloat, glGetDouble, glGetInteger, glGetBoolean = glGetFloatv, glGetDoublev, glGetIntegerv, glGetBooleanv


def _get(operation: str, pname: int, params: Any, dtype: type[np.generic], convert: Callable[[Any], Any]) -> Any:
    """Return a state value, converted; an array `params` is filled, too."""
    context = outside_begin(operation)
    if context is None:
        return None
    if pname in CURRENT_VALUES:
        context.update_current()
    if pname in BY_TOKEN:
        value = BY_TOKEN[pname](context)
    elif pname in KNOWN:
        value = is_on(context.state, pname, context.active_unit)
    else:
        return wrong_enum(operation, "pname", pname, "a state variable of this subset")
    if isinstance(value, tuple | np.ndarray):
        rows = np.asarray(value)
        if dtype is np.float32:  # what converting one by one gives, in a fifth of the time
            answer: Any = rows.astype(dtype, order="C")
        else:
            answer = np.array([convert(v) for v in rows.ravel().tolist()], dtype).reshape(rows.shape)
    else:
        answer = convert(value)
    if params is not None:
        np.asarray(params).reshape(-1)[: np.size(answer)] = np.ravel(answer)
    return answer


def _rounded(value: float) -> float:
    """Return a number in the precision of the context; integers stay exact."""
    return float(value) if isinstance(value, int) else float(current().real(value))


def _scaled(value: float) -> int:
    """Return the int that represents a component of a colour or normal."""
    return to_int(float(np.float32(value)))


__all__ = spelled_like_gl(globals())
