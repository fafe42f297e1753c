"""Mapped buffer objects: their bytes as memory of the client.

References: GL 2.1, sec. 2.9; ARB_map_buffer_range; bufferobj.c of Mesa 22.3.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import BufferObject, Context, Mapping
from softshadow.gl.buffers import bound_object, own_content
from softshadow.gl.calls import spelled_like_gl
from softshadow.gl.errors import fail, is_one_of, outside_begin
from softshadow.mapped_memory import MappedMemory
from softshadow.tokens import token_name

ACCESSES = {
    gl.GL_READ_ONLY: gl.GL_MAP_READ_BIT,
    gl.GL_WRITE_ONLY: gl.GL_MAP_WRITE_BIT,
    gl.GL_READ_WRITE: gl.GL_MAP_READ_BIT | gl.GL_MAP_WRITE_BIT,
}
BITS = (
    gl.GL_MAP_READ_BIT
    | gl.GL_MAP_WRITE_BIT
    | gl.GL_MAP_INVALIDATE_RANGE_BIT
    | gl.GL_MAP_INVALIDATE_BUFFER_BIT
    | gl.GL_MAP_FLUSH_EXPLICIT_BIT
    | gl.GL_MAP_UNSYNCHRONIZED_BIT
)
NOT_TO_READ = gl.GL_MAP_INVALIDATE_RANGE_BIT | gl.GL_MAP_INVALIDATE_BUFFER_BIT | gl.GL_MAP_UNSYNCHRONIZED_BIT


def glMapBuffer(target: int, access: int) -> MappedMemory | None:
    """Return all bytes of the bound buffer object as memory: an address, and an array (`MappedMemory`).

    Raises
    ------
    GLError
        GL_INVALID_ENUM for another access; GL_INVALID_OPERATION if nothing is bound, the buffer is empty or mapped.
    """
    context, operation = outside_begin("glMapBuffer"), "glMapBuffer"
    if context is None or not is_one_of(operation, "access", access, ACCESSES, "GL_READ_ONLY … GL_READ_WRITE"):
        return None
    if (bound := bound_object(context, operation, target)) is None:
        return None
    return _map(context, operation, bound, 0, len(bound.content), ACCESSES[access])


def glMapBufferRange(target: int, offset: int, length: int, access: int) -> MappedMemory | None:
    """Return a range of bytes of the bound buffer object as memory; `access` are GL_MAP_READ_BIT and so on.

    Raises
    ------
    GLError
        GL_INVALID_VALUE for a range outside the buffer, or unknown bits; GL_INVALID_OPERATION for a range without
        bytes, bits that exclude each other, and a buffer that is mapped.
    """
    context, operation = outside_begin("glMapBufferRange"), "glMapBufferRange"
    if context is None or (bound := bound_object(context, operation, target)) is None:
        return None
    return _map(context, operation, bound, int(offset), int(length), int(access))


def _map(
    context: Context, operation: str, bound: BufferObject, offset: int, length: int, access: int
) -> MappedMemory | None:
    if problem := _mapping_problem(bound, offset, length, access):
        fail(problem[0], operation, problem[1])
        return None
    pointer = MappedMemory.of(own_content(context, bound)[offset : offset + length])
    bound.mapping = Mapping(offset, length, access, pointer)
    return pointer


def _mapping_problem(bound: BufferObject, offset: int, length: int, access: int) -> tuple[int, str] | None:
    """Return (error code, message) if a range cannot be mapped, else None; in Mesa's order."""
    reads, writes = access & gl.GL_MAP_READ_BIT, access & gl.GL_MAP_WRITE_BIT
    where = f"offset={offset}, length={length}"
    if offset < 0 or length < 0:
        return gl.GL_INVALID_VALUE, f"{where}: expected 0 or more"
    if length == 0:
        return gl.GL_INVALID_OPERATION, f"{where}: expected at least one byte"
    if access & ~BITS:
        return gl.GL_INVALID_VALUE, f"access={access:#x}: expected GL_MAP_*_BIT"
    if not (reads or writes):
        return gl.GL_INVALID_OPERATION, f"access={access:#x}: expected GL_MAP_READ_BIT or GL_MAP_WRITE_BIT"
    if reads and access & NOT_TO_READ:
        return gl.GL_INVALID_OPERATION, f"access={access:#x}: GL_MAP_READ_BIT needs the old contents"
    if access & gl.GL_MAP_FLUSH_EXPLICIT_BIT and not writes:
        return gl.GL_INVALID_OPERATION, f"access={access:#x}: GL_MAP_FLUSH_EXPLICIT_BIT needs GL_MAP_WRITE_BIT"
    if offset + length > len(bound.content):
        return gl.GL_INVALID_VALUE, f"{where}: expected a range inside the {len(bound.content)} bytes"
    if bound.mapping is not None:
        return gl.GL_INVALID_OPERATION, "the buffer object is mapped: call glUnmapBuffer first"
    return None


def glUnmapBuffer(target: int) -> bool:
    """End the mapping of the bound buffer object; return whether its contents are intact, which they always are."""
    context, operation = outside_begin("glUnmapBuffer"), "glUnmapBuffer"
    if context is None or (bound := bound_object(context, operation, target)) is None:
        return False
    if bound.mapping is None:
        fail(gl.GL_INVALID_OPERATION, operation, "the buffer object is not mapped")
        return False
    unmap(context, bound)
    return True


def unmap(context: Context, bound: BufferObject) -> None:
    """End a mapping: what the client writes to its memory afterwards changes nothing."""
    bound.mapping = None
    bound.content, bound.views = bound.content.copy(), {}
    context.arrays.active = None


def glFlushMappedBufferRange(target: int, offset: int, length: int) -> None:
    """Say that bytes of the mapped range have been written; here they always count."""
    context, operation = outside_begin("glFlushMappedBufferRange"), "glFlushMappedBufferRange"
    if context is None or (bound := bound_object(context, operation, target)) is None:
        return
    mapping, where = bound.mapping, f"offset={offset}, length={length}"
    if offset < 0 or length < 0:
        fail(gl.GL_INVALID_VALUE, operation, f"{where}: expected 0 or more")
    elif mapping is None:
        fail(gl.GL_INVALID_OPERATION, operation, "the buffer object is not mapped")
    elif not mapping.access & gl.GL_MAP_FLUSH_EXPLICIT_BIT:
        fail(gl.GL_INVALID_OPERATION, operation, "the buffer object was mapped without GL_MAP_FLUSH_EXPLICIT_BIT")
    elif offset + length > mapping.length:
        fail(gl.GL_INVALID_VALUE, operation, f"{where}: expected a range inside the {mapping.length} mapped bytes")


# -- queries -----------------------------------------------------------------------------------------------------------
def glGetBufferParameteriv(target: int, pname: int, params: Any = None) -> Any:
    """Return a property of the bound buffer object: size in bytes, usage, or how it is mapped."""
    context, operation = outside_begin("glGetBufferParameteriv"), "glGetBufferParameteriv"
    if context is None or (bound := bound_object(context, operation, target)) is None:
        return None
    mapping = bound.mapping
    flags = mapping.access & ~gl.GL_MAP_FLUSH_EXPLICIT_BIT if mapping else 0
    both = gl.GL_MAP_READ_BIT | gl.GL_MAP_WRITE_BIT
    access = {gl.GL_MAP_READ_BIT: gl.GL_READ_ONLY, gl.GL_MAP_WRITE_BIT: gl.GL_WRITE_ONLY}
    answers = {
        gl.GL_BUFFER_SIZE: len(bound.content),
        gl.GL_BUFFER_USAGE: bound.usage,
        gl.GL_BUFFER_ACCESS: access.get(flags & both, gl.GL_READ_WRITE),
        gl.GL_BUFFER_MAPPED: int(mapping is not None),
        gl.GL_BUFFER_ACCESS_FLAGS: mapping.access if mapping else 0,
        gl.GL_BUFFER_MAP_OFFSET: mapping.offset if mapping else 0,
        gl.GL_BUFFER_MAP_LENGTH: mapping.length if mapping else 0,
    }
    expected = ", ".join(token_name(name) for name in answers)
    if not is_one_of(operation, "pname", pname, answers, f"one of {expected}"):
        return None
    if params is not None:
        np.asarray(params)[:1] = answers[pname]
    return answers[pname]


def glGetBufferPointerv(target: int, pname: int, params: Any = None) -> MappedMemory | None:
    """Return the memory of the bound buffer object's mapping, None if it is not mapped."""
    context, operation = outside_begin("glGetBufferPointerv"), "glGetBufferPointerv"
    if context is None or not is_one_of(
        operation, "pname", pname, (gl.GL_BUFFER_MAP_POINTER,), "GL_BUFFER_MAP_POINTER"
    ):
        return None
    bound = bound_object(context, operation, target)
    pointer = bound.mapping.pointer if bound is not None and bound.mapping is not None else None
    if params is not None:
        params[0] = int(pointer or 0)
    return pointer


__all__ = spelled_like_gl(globals())
