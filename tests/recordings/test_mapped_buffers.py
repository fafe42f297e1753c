"""What a recorded program has written to a mapped buffer is written to the buffer of the replay."""

from typing import Any

import numpy as np
import pytest

from softshadow import gl
from softshadow.context import Context
from softshadow.recordings.mapped_buffers import MappedBuffers
from softshadow.traces import Call

TARGETS = ("GL_ARRAY_BUFFER", "GL_ELEMENT_ARRAY_BUFFER", "GL_PIXEL_UNPACK_BUFFER", "GL_PIXEL_PACK_BUFFER")
ADDRESS = 0x55635E7D3380


def call(name: str, *arguments: Any, result: Any = None) -> Call:
    return Call(1, name, list(arguments), result)


def bound_to(context: Context, target: int) -> int:
    """Bind a new buffer of 8 bytes; return its name."""
    name = gl.glGenBuffers(1)
    gl.glBindBuffer(target, name)
    gl.glBufferData(target, np.zeros(8, np.uint8), gl.GL_STATIC_DRAW)
    assert name in context.buffers
    return int(name)


@pytest.mark.parametrize("name", TARGETS)
def test_written_bytes_reach_buffers_of_every_target(name: str) -> None:
    target = getattr(gl, name)
    with gl.create_context(4, 4) as context:
        buffer, mapped = bound_to(context, target), MappedBuffers()
        mapped.map(call("glMapBuffer", target, gl.GL_WRITE_ONLY, result=ADDRESS), context)
        gl.glBindBuffer(target, 0)
        mapped.copy(call("memcpy", ADDRESS + 2, b"abc", 3))
        assert context.buffers[buffer].content.tobytes() == b"\0\0abc\0\0\0"


def test_addresses_of_deleted_buffers_belong_to_the_next_ones() -> None:
    with gl.create_context(4, 4) as context:
        mapped = MappedBuffers()
        first = bound_to(context, gl.GL_PIXEL_PACK_BUFFER)
        mapped.map(call("glMapBuffer", gl.GL_PIXEL_PACK_BUFFER, gl.GL_READ_ONLY, result=ADDRESS), context)
        gl.glDeleteBuffers([first])  # while it is mapped
        second = bound_to(context, gl.GL_PIXEL_UNPACK_BUFFER)
        mapped.map(call("glMapBuffer", gl.GL_PIXEL_UNPACK_BUFFER, gl.GL_WRITE_ONLY, result=ADDRESS), context)
        mapped.copy(call("memcpy", ADDRESS, b"12345678", 8))
        assert context.buffers[second].content.tobytes() == b"12345678"
        mapped.unmap(call("glUnmapBuffer", gl.GL_PIXEL_UNPACK_BUFFER))
        with pytest.raises(ValueError, match="no mapped buffer"):
            mapped.copy(call("memcpy", ADDRESS, b"1", 1))
