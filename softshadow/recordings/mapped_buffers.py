"""Buffer objects that a program has mapped: a trace has what it wrote there as ``memcpy`` to an address."""

from __future__ import annotations

from dataclasses import dataclass

from softshadow import gl
from softshadow.context import Context
from softshadow.gl.buffers import TARGETS, bound_buffer
from softshadow.traces import Call


@dataclass
class Mapping:
    """Where a part of a buffer object was mapped to in the recorded program's memory."""

    address: int
    context: Context
    buffer: int
    offset: int
    n_bytes: int


class MappedBuffers:
    """The mapped parts of buffer objects, by target."""

    def __init__(self) -> None:
        self._mappings: dict[int, Mapping] = {}

    def map(self, call: Call, context: Context) -> None:
        """Note where glMapBuffer or glMapBufferRange mapped a buffer.

        Raises
        ------
        ValueError                   this package has no such buffers, or none is bound
        """
        target, *rest = call.arguments
        name = bound_buffer(context, target) if target in TARGETS else 0
        if name not in context.buffers:
            raise ValueError(f"target={gl.token_name(target)}: expected a bound buffer of arrays, indices or pixels")
        size = len(context.buffers[name].content)
        is_range = call.name.startswith("glMapBufferRange")
        offset, n_bytes = (rest[0], rest[1]) if is_range else (0, size)
        if isinstance(call.result, int) and call.result:
            self._mappings[target] = Mapping(call.result, context, name, offset, n_bytes)

    def unmap(self, call: Call) -> None:
        """Forget the mapping of a target."""
        self._mappings.pop(call.arguments[0], None)

    def copy(self, call: Call) -> None:
        """Write to a buffer what a program has written to mapped memory.

        Raises
        ------
        ValueError                   no mapped buffer is there
        """
        address, content, _ = call.arguments
        for mapping in self._mappings.values():
            start = address - mapping.address
            if mapping.buffer not in mapping.context.buffers:  # it was deleted while it was mapped
                continue
            if isinstance(content, bytes) and start >= 0 and start + len(content) <= mapping.n_bytes:
                _write(mapping, mapping.offset + start, content)
                return
        raise ValueError("the memory belongs to no mapped buffer")


def _write(mapping: Mapping, offset: int, content: bytes) -> None:
    arrays = mapping.context.arrays
    bound = arrays.array_buffer
    arrays.array_buffer = mapping.buffer
    try:
        gl.glBufferSubData(gl.GL_ARRAY_BUFFER, offset, len(content), content)
    finally:
        arrays.array_buffer = bound
