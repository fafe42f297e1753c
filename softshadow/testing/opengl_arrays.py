"""Vertex arrays and buffer objects on Mesa, where PyOpenGL's own calls take less or forget what they point to."""

import ctypes
from collections.abc import Callable
from typing import Any

import numpy as np
from OpenGL import GL
from OpenGL.raw.GL.VERSION import GL_1_1 as arrays
from OpenGL.raw.GL.VERSION import GL_1_5 as buffers

from softshadow.mapped_memory import MappedMemory
from softshadow.testing.opengl_pixels import DTYPES

_kept_flags: list[np.ndarray] = []
_kept_arrays: dict[str, np.ndarray] = {}


def _mapped(address: Any, n_bytes: int) -> MappedMemory | None:
    """Return mapped bytes at an address as `softshadow.gl` does."""
    if not address:
        return None
    return MappedMemory.of(np.ctypeslib.as_array((ctypes.c_uint8 * n_bytes).from_address(int(address))))


def glMapBuffer(target: int, access: int) -> MappedMemory | None:
    """Return all bytes of a buffer object."""
    address = GL.glMapBuffer(target, access)
    return _mapped(address, glGetBufferParameteriv(target, GL.GL_BUFFER_SIZE))


def glMapBufferRange(target: int, offset: int, length: int, access: int) -> MappedMemory | None:
    """Return a range of bytes of a buffer object."""
    return _mapped(GL.glMapBufferRange(target, offset, length, access), length)


def glGetBufferSubData(target: int, offset: int, size: int) -> np.ndarray:
    """Return bytes of a buffer object."""
    out = np.zeros(size, np.uint8)
    buffers.glGetBufferSubData(target, offset, size, ctypes.c_void_p(out.ctypes.data))
    return out


def glGetBufferParameteriv(target: int, pname: int) -> int:
    """Return a property of a buffer object."""
    out = (ctypes.c_int * 2)()
    buffers.glGetBufferParameteriv(target, pname, out)
    return int(out[0])


def glEdgeFlagPointer(stride: int, pointer: Any) -> None:
    """Set the array of edge flags from bytes; PyOpenGL 3.1 would make 16-bit numbers of them."""
    if isinstance(pointer, np.ndarray | list | tuple | bytes):
        flags = np.frombuffer(pointer, np.uint8) if isinstance(pointer, bytes) else np.asarray(pointer, np.uint8)
        _kept_flags[:] = [np.ascontiguousarray(flags)]  # GL reads them at the next draw
        pointer = ctypes.c_void_p(_kept_flags[0].ctypes.data)
    arrays.glEdgeFlagPointer(stride, pointer)


def _keeping(name: str) -> Callable[..., None]:
    """Return a pointer call that keeps its array in memory until the next one; PyOpenGL 3.1 forgets it."""
    point = getattr(GL, name)

    def call(*arguments: Any) -> None:
        *layout, pointer = arguments
        if isinstance(pointer, np.ndarray | list | tuple):
            _kept_arrays[name] = np.ascontiguousarray(pointer, {**DTYPES, GL.GL_DOUBLE: np.float64}.get(layout[-2]))
            pointer = ctypes.c_void_p(_kept_arrays[name].ctypes.data)
        point(*layout, pointer)

    return call


def glMultiDrawElements(mode: int, count: Any, type: int, indices: Any, drawcount: int) -> None:
    """Draw from several arrays of indices; PyOpenGL takes their addresses only."""
    kept = [
        np.ascontiguousarray(place, DTYPES.get(type)) if isinstance(place, np.ndarray | list) else place
        for place in indices
    ]
    places = [place.ctypes.data if isinstance(place, np.ndarray) else place for place in kept]
    GL.glMultiDrawElements(
        mode, np.asarray(count, np.int32), type, (ctypes.c_void_p * max(len(places), 1))(*places), drawcount
    )


ARRAY_CALLS: dict[str, Callable[..., Any]] = {
    "glEdgeFlagPointer": glEdgeFlagPointer,
    **{name: _keeping(name) for name in ("glSecondaryColorPointer", "glFogCoordPointer")},
    "glMultiDrawElements": glMultiDrawElements,
    "glMapBuffer": glMapBuffer,
    "glMapBufferRange": glMapBufferRange,
    "glGetBufferSubData": glGetBufferSubData,
    "glGetBufferParameteriv": glGetBufferParameteriv,
}
