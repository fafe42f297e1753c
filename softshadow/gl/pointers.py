"""glGetPointerv: the arrays and buffers that the client has given to GL.

References: GL 2.1, sec. 6.1.11; getstring.c of Mesa 22.3.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import ClientArrays
from softshadow.gl.calls import spelled_like_gl
from softshadow.gl.errors import is_one_of, outside_begin
from softshadow.gl.vertex_arrays import array_name

ARRAY_POINTERS = {
    gl.GL_VERTEX_ARRAY_POINTER: gl.GL_VERTEX_ARRAY,
    gl.GL_NORMAL_ARRAY_POINTER: gl.GL_NORMAL_ARRAY,
    gl.GL_COLOR_ARRAY_POINTER: gl.GL_COLOR_ARRAY,
    gl.GL_INDEX_ARRAY_POINTER: gl.GL_INDEX_ARRAY,
    gl.GL_TEXTURE_COORD_ARRAY_POINTER: gl.GL_TEXTURE_COORD_ARRAY,
    gl.GL_EDGE_FLAG_ARRAY_POINTER: gl.GL_EDGE_FLAG_ARRAY,
    gl.GL_SECONDARY_COLOR_ARRAY_POINTER: gl.GL_SECONDARY_COLOR_ARRAY,
    gl.GL_FOG_COORD_ARRAY_POINTER: gl.GL_FOG_COORD_ARRAY,
}
BUFFER_POINTERS = (gl.GL_FEEDBACK_BUFFER_POINTER, gl.GL_SELECTION_BUFFER_POINTER)


def glGetPointerv(pname: int, params: Any = None) -> np.uint64 | None:
    """Return the address of an array that was given to GL, as PyOpenGL does; an array `params` is filled, too.

    Parameters
    ----------
    pname : GL_VERTEX_ARRAY_POINTER, GL_NORMAL_ARRAY_POINTER, GL_COLOR_ARRAY_POINTER, GL_INDEX_ARRAY_POINTER,
        GL_TEXTURE_COORD_ARRAY_POINTER (of the client's active unit), GL_EDGE_FLAG_ARRAY_POINTER,
        GL_SECONDARY_COLOR_ARRAY_POINTER, GL_FOG_COORD_ARRAY_POINTER, GL_FEEDBACK_BUFFER_POINTER or
        GL_SELECTION_BUFFER_POINTER

    Returns
    -------
    the address of the first number (of a copy, if GL could not read the array in place), the offset into a buffer
    object, or 0
    """
    context = outside_begin("glGetPointerv")
    known = (*ARRAY_POINTERS, *BUFFER_POINTERS)
    if context is None or not is_one_of("glGetPointerv", "pname", pname, known, "the pointer of an array or buffer"):
        return None
    if pname in ARRAY_POINTERS:
        address = _pointer_of(context.arrays, array_name(context.arrays, ARRAY_POINTERS[pname]))
    else:
        modes = context.render_mode
        buffer = (modes.feedback if pname == gl.GL_FEEDBACK_BUFFER_POINTER else modes.selection).buffer
        address = 0 if buffer is None else buffer.ctypes.data
    if params is not None:
        np.asarray(params).reshape(-1)[:1] = address
    return np.uint64(address)


def _pointer_of(arrays: ClientArrays, name: str) -> int:
    array = arrays.pointers.get(name)
    return arrays.offsets.get(name, (0, 0))[1] if array is None else array.rows.ctypes.data


__all__ = spelled_like_gl(globals())
