"""Colour indices: state that can be set and queried. No buffer has indices, so they draw nothing, as in Mesa.

References: GL 2.1, sec. 2.7, 4.2.2 and 4.2.3; vbo_attrib_tmp.h, blend.c and clear.c of Mesa 22.3.
"""

from __future__ import annotations

from collections.abc import Callable
from ctypes import c_int, c_short, c_ubyte, c_uint
from functools import partial
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import current
from softshadow.frozen import evolve
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.conversions import vector
from softshadow.gl.errors import outside_begin
from softshadow.gl.vertex_format import carry_attribute, set_attribute

LARGEST_CONVERTED = 2.0**63  # C's conversion of larger floats to unsigned int gives 0 on x86


# -- the current index -------------------------------------------------------------------------------------------------
def set_index(index: float) -> None:
    """Set the current colour index, in single precision; the vertices that follow carry it."""
    context = current()
    carry_attribute(context, "index", 1)
    set_attribute(context, "index", 1, _single(index))


def _single(value: float) -> float:
    with np.errstate(over="ignore"):
        return float(np.float32(value))


def _calls_for(convert: Callable[[Any], float]) -> tuple[Callable[[Any], None], Callable[[Any], None]]:
    """Return glIndex and glIndexv for numbers of one type."""

    @in_lists
    def of_number(c: float) -> None:
        """Set the current colour index."""
        set_index(convert(c))

    @in_lists
    def of_vector(c: Any) -> None:
        """Set the current colour index from a vector of one number."""
        set_index(convert(vector(c, 1)[0]))

    return of_number, of_vector


glIndexf, glIndexfv = glIndexd, glIndexdv = _calls_for(float)
glIndexi, glIndexiv = _calls_for(lambda c: c_int(int(c)).value)
glIndexs, glIndexsv = _calls_for(lambda c: c_short(int(c)).value)
glIndexub, glIndexubv = _calls_for(lambda c: c_ubyte(int(c)).value)


# -- the buffer that there is not --------------------------------------------------------------------------------------
@in_lists
def glIndexMask(mask: int) -> None:
    """Set which bits of colour indices are written."""
    context = outside_begin("glIndexMask")
    bits = c_uint(int(mask)).value
    if context is not None and context.color_indices.write_mask != bits:
        context.flush()
        context.touched |= gl.GL_COLOR_BUFFER_BIT
        context.color_indices = evolve(context.color_indices, write_mask=bits)


def glClearIndex(c: float) -> None:
    """Set the clear value of a colour index buffer, without its fraction.

    In a display list Mesa takes the bits of the number for an integer: 9 becomes 1091567616.
    """
    context = current()
    if context.compiled_list is None:
        _set_clear_value(c)
        return
    if context.compiled_list.executes:
        _set_clear_value(c)
    context.compiled_list.calls.append(partial(_set_clear_value, float(np.float32(_single(c)).view(np.uint32))))


def _set_clear_value(c: float) -> None:
    context = outside_begin("glClearIndex")
    if context is not None:
        context.touched |= gl.GL_COLOR_BUFFER_BIT
        value = _single(c)
        whole = int(value) if abs(value) < LARGEST_CONVERTED else 0
        context.color_indices = evolve(context.color_indices, clear=c_uint(whole).value)


__all__ = spelled_like_gl(globals())
