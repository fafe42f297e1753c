"""Calls that return names or answers on Mesa, as `softshadow.gl` returns them."""

import ctypes
from collections.abc import Callable
from functools import wraps
from typing import Any

import numpy as np
from OpenGL import GL, contextdata, platform
from OpenGL.raw.GL._glgets import _glget_size_mapping as sizes_of_answers
from OpenGL.raw.GL.VERSION import GL_1_0 as raw

LARGEST_ANSWER = 16  # numbers: a matrix

for _color in (GL.GL_CURRENT_SECONDARY_COLOR, GL.GL_CURRENT_RASTER_SECONDARY_COLOR):
    sizes_of_answers[_color] = (4,)  # PyOpenGL has room for one number, so that GL would write behind it


def _context_key(context: Any = None) -> Any:
    """Return what PyOpenGL keeps arrays under: the address of the context, not the pointer that OSMesa returns anew."""
    return ctypes.cast(context or platform.GetCurrentContext(), ctypes.c_void_p).value


def _with_plain_names(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return a glGen* function that returns an int for one name, an array for several."""

    def generate(n: int) -> Any:
        names = np.atleast_1d(function(n))
        return int(names[0]) if n == 1 else names

    return generate


def _with_unknown_names(function: Callable[..., Any], ctype: Any) -> Callable[..., Any]:
    """Return a glGet* function that passes names unknown to PyOpenGL on to GL, which rejects them."""
    raw_function = getattr(raw, function.__name__, None) or function

    def get(name: int) -> Any:
        try:
            return function(name)
        except KeyError:
            return raw_function(name, (ctype * LARGEST_ANSWER)())

    return get


def _under_one_key(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return a call that finds what an earlier one has stored for its context, such as the array of glSelectBuffer.

    For other calls a key that is new each time is right: a vertex array must stay in memory though the call for another
    texture unit gives one of the same name.
    """

    @wraps(function)
    def call(*arguments: Any) -> Any:
        before = contextdata.getContext
        contextdata.getContext = _context_key
        try:
            return function(*arguments)
        finally:
            contextdata.getContext = before

    return call


ANSWER_CALLS: dict[str, Callable[..., Any]] = {
    **{name: _under_one_key(getattr(GL, name)) for name in ("glRenderMode", "glSelectBuffer", "glFeedbackBuffer")},
    **{
        name: _with_plain_names(getattr(GL, name))
        for name in ("glGenTextures", "glGenFramebuffers", "glGenRenderbuffers", "glGenBuffers", "glGenQueries")
    },
    **{
        name: _with_unknown_names(getattr(GL, name), ctype)
        for name, ctype in (
            ("glGetBooleanv", ctypes.c_ubyte),
            ("glGetIntegerv", ctypes.c_int),
            ("glGetFloatv", ctypes.c_float),
            ("glGetDoublev", ctypes.c_double),
        )
    },
}
