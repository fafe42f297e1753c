"""Buffer objects: vertex arrays, indices and images stored by GL."""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import BufferObject, Context
from softshadow.frozen import evolve
from softshadow.gl.calls import spelled_like_gl
from softshadow.gl.errors import fail, is_one_of, outside_begin
from softshadow.gl.names import generate, names_argument, reserve

OF_ARRAYS = {gl.GL_ARRAY_BUFFER: "array_buffer", gl.GL_ELEMENT_ARRAY_BUFFER: "element_buffer"}
OF_PIXELS = {gl.GL_PIXEL_PACK_BUFFER: "pack_store", gl.GL_PIXEL_UNPACK_BUFFER: "unpack_store"}
TARGETS = {**OF_ARRAYS, **OF_PIXELS}
A_TARGET = "GL_ARRAY_BUFFER, GL_ELEMENT_ARRAY_BUFFER, GL_PIXEL_PACK_BUFFER or GL_PIXEL_UNPACK_BUFFER"
USAGES = (
    gl.GL_STREAM_DRAW, gl.GL_STREAM_READ, gl.GL_STREAM_COPY, gl.GL_STATIC_DRAW, gl.GL_STATIC_READ, gl.GL_STATIC_COPY,
    gl.GL_DYNAMIC_DRAW, gl.GL_DYNAMIC_READ, gl.GL_DYNAMIC_COPY,
)  # fmt: skip
A_USAGE = "GL_STREAM_DRAW … GL_DYNAMIC_COPY"


# -- objects -----------------------------------------------------------------------------------------------------------
def glGenBuffers(n: int, buffers: Any = None) -> Any:
    """Return unused buffer names: an int for n = 1, else an array."""
    return generate("glGenBuffers", "buffer", n, buffers)


def glBindBuffer(target: int, buffer: int) -> None:
    """Bind a buffer object: pointers, indices or images are then offsets into it. Name 0 unbinds."""
    context = outside_begin("glBindBuffer")
    if context is None or not is_one_of("glBindBuffer", "target", target, TARGETS, A_TARGET):
        return
    name = int(buffer)
    if name and name not in context.buffers:
        reserve(context, "buffer", name)
        context.buffers[name] = BufferObject()
    _bind(context, target, name)


def bound_buffer(context: Context, target: int) -> int:
    """Return the name of the buffer object that is bound to a target, or 0."""
    if target in OF_PIXELS:
        return int(getattr(context, OF_PIXELS[target]).buffer)
    return int(getattr(context.arrays, OF_ARRAYS[target]))


def _bind(context: Context, target: int, name: int) -> None:
    if target in OF_PIXELS:
        store = getattr(context, OF_PIXELS[target])
        setattr(context, OF_PIXELS[target], evolve(store, buffer=name))
    else:
        setattr(context.arrays, OF_ARRAYS[target], name)


def glDeleteBuffers(*arguments: Any) -> None:
    """Delete buffer objects: (name), (names) or (n, names). Bindings and vertex arrays that use them are reset."""
    context = outside_begin("glDeleteBuffers")
    if context is None:
        return
    for name in names_argument("glDeleteBuffers", arguments):
        context.buffers.pop(name, None)
        for target in TARGETS:
            if name and bound_buffer(context, target) == name:
                _bind(context, target, 0)
        for key in [key for key, (buffer, _) in context.arrays.offsets.items() if buffer == name]:
            del context.arrays.offsets[key]
        context.arrays.active = None


def glIsBuffer(buffer: int) -> bool:
    """Return whether a buffer object of this name exists; the first glBindBuffer creates it."""
    context = outside_begin("glIsBuffer")
    return context is not None and int(buffer) in context.buffers


# -- contents ----------------------------------------------------------------------------------------------------------
def glBufferData(target: int, size: Any, data: Any = None, usage: int | None = None) -> None:
    """Set the contents of the bound buffer object: (target, size, data, usage) or (target, data, usage).

    Without data (None), all bytes are 0.
    """
    if usage is None:
        size, data, usage = None, size, data
    content = None if data is None else _bytes(data)
    n_bytes = int(size) if size is not None else 0 if content is None else len(content)
    context, operation = outside_begin("glBufferData"), "glBufferData"
    if context is None or (bound := bound_object(context, operation, target)) is None:
        return
    if n_bytes < 0:
        fail(gl.GL_INVALID_VALUE, operation, f"size={n_bytes}: expected 0 or more")
    elif is_one_of(operation, "usage", usage, USAGES, A_USAGE):
        if content is not None and len(content) < n_bytes:
            raise ValueError(f"glBufferData: size={n_bytes}, but data has {len(content)} bytes")
        bound.mapping = None  # new contents end it
        _replace(context, bound, np.zeros(n_bytes, np.uint8) if content is None else content[:n_bytes].copy())
        bound.usage = int(usage)


def glBufferSubData(target: int, offset: int, size: Any = None, data: Any = None) -> None:
    """Replace bytes of the bound buffer object: (target, offset, size, data) or (target, offset, data)."""
    if data is None:
        size, data = None, size
    content = _bytes(data)
    n_bytes = len(content) if size is None else int(size)
    context = outside_begin("glBufferSubData")
    bound = context and bound_object(context, "glBufferSubData", target)
    if context and bound and _is_inside("glBufferSubData", bound, int(offset), n_bytes):
        own_content(context, bound)[offset : offset + n_bytes] = content[:n_bytes]


def own_content(context: Context, bound: BufferObject) -> np.ndarray:
    """Return the bytes of a buffer object, to be written: a copy if recorded arrays share them."""
    if bound.views:
        _replace(context, bound, bound.content.copy())
    return bound.content


def glGetBufferSubData(target: int, offset: int, size: int, data: Any = None) -> Any:
    """Return bytes of the bound buffer object, (size,) uint8."""
    context = outside_begin("glGetBufferSubData")
    bound = context and bound_object(context, "glGetBufferSubData", target)
    if not bound or not _is_inside("glGetBufferSubData", bound, int(offset), int(size)):
        return None
    content = bound.content[offset : offset + size].copy()
    if data is not None:
        np.asarray(data).reshape(-1).view(np.uint8)[:size] = content
    return content


def _replace(context: Context, bound: BufferObject, content: np.ndarray) -> None:
    bound.content, bound.views = content, {}
    context.arrays.active = None


def bound_object(context: Context, operation: str, target: int) -> BufferObject | None:
    """Return the buffer object that is bound to a target, or None after an error of GL."""
    if not is_one_of(operation, "target", target, TARGETS, A_TARGET):
        return None
    name = bound_buffer(context, target)
    if name:
        return context.buffers[name]
    fail(gl.GL_INVALID_OPERATION, operation, "no buffer object is bound")
    return None


def _is_inside(operation: str, bound: BufferObject, offset: int, size: int) -> bool:
    if bound.mapping is not None and offset >= 0 and size >= 0 and offset + size <= len(bound.content):
        fail(gl.GL_INVALID_OPERATION, operation, "the buffer object is mapped: call glUnmapBuffer first")
        return False
    if offset >= 0 and size >= 0 and offset + size <= len(bound.content):
        return True
    message = f"offset={offset}, size={size}: expected a range inside the {len(bound.content)} bytes"
    fail(gl.GL_INVALID_VALUE, operation, message)
    return False


def _bytes(data: Any) -> np.ndarray:
    if isinstance(data, bytes | bytearray | memoryview):
        return np.frombuffer(data, np.uint8)
    return np.ascontiguousarray(data).reshape(-1).view(np.uint8)


# -- offsets -----------------------------------------------------------------------------------------------------------
def offset_of(pointer: Any) -> int:
    """Return a pointer argument as an offset into the bound buffer object: None, an int, or ctypes.c_void_p."""
    value = pointer.value if isinstance(pointer, ctypes.c_void_p) else pointer
    if value is None:
        return 0
    if isinstance(value, int | np.integer):
        return int(value)
    raise TypeError(f"pointer={pointer!r:.60}: a buffer object is bound, expected an offset (None, int, c_void_p)")


__all__ = spelled_like_gl(globals())
