"""Pixel buffer objects and mapped buffers work as on Mesa."""

import ctypes
from typing import Any

import numpy as np
import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa

SIZE = WIDTH, HEIGHT = 12, 7
IMAGE = np.random.default_rng(1).integers(0, 256, (HEIGHT, WIDTH, 4), dtype=np.uint8)


def check(program: Any) -> None:
    """Compare the buffers and answers of a program with Mesa's."""
    comparison = compare(program, SIZE)
    assert comparison, str(comparison)


def bind(gl: Any, target: str, data: np.ndarray) -> int:
    """Bind a new buffer object with these bytes to a target; return the target."""
    token = getattr(gl, target)
    gl.glBindBuffer(token, gl.glGenBuffers(1))
    gl.glBufferData(token, data.nbytes, data, gl.GL_STREAM_DRAW)
    return token


def code_of(gl: Any, call: Any) -> int:
    """The error of a call, 0 for none."""
    try:
        call()
    except gl.GLError as error:
        gl.glGetError()
        return int(error.err)
    return 0


@pytest.mark.parametrize("offset", [0, 48, 100])
def test_images_come_from_and_go_to_buffer_objects(offset):
    data = np.zeros(700, np.uint8)
    data[offset : offset + IMAGE.size] = IMAGE.ravel()

    def program(gl):
        unpack = bind(gl, "GL_PIXEL_UNPACK_BUFFER", data)
        shape, pixels = (WIDTH, HEIGHT), (gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)
        gl.glWindowPos2i(0, 0)
        gl.glDrawPixels(*shape, *pixels, offset)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, *shape, 0, *pixels, offset)
        gl.glTexSubImage2D(gl.GL_TEXTURE_2D, 0, 2, 1, 4, 3, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, offset)
        names = int(gl.glGetIntegerv(gl.GL_PIXEL_UNPACK_BUFFER_BINDING)) > 0
        gl.glBindBuffer(unpack, 0)
        pack = bind(gl, "GL_PIXEL_PACK_BUFFER", np.zeros(900, np.uint8))
        gl.glReadPixels(2, 1, 5, 4, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, offset)
        gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, *pixels, offset + 100)
        content = gl.glGetBufferSubData(pack, 0, 900)
        gl.glBindBuffer(pack, 0)
        return [content, gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, *pixels), np.array([names])]

    check(program)


def test_lists_have_the_images_of_the_time_when_they_were_compiled():
    def program(gl):
        pixels = (gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)
        unpack = bind(gl, "GL_PIXEL_UNPACK_BUFFER", IMAGE)
        gl.glNewList(1, gl.GL_COMPILE)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, 6, 5, 0, *pixels, 16)
        gl.glTexImage2D(gl.GL_PROXY_TEXTURE_2D, 0, gl.GL_RGBA8, 6, 5, 0, *pixels, None)
        gl.glDrawPixels(6, 5, *pixels, 32)
        gl.glEndList()
        proxy = int(gl.glGetTexLevelParameteriv(gl.GL_PROXY_TEXTURE_2D, 0, gl.GL_TEXTURE_WIDTH))
        gl.glBindBuffer(unpack, 0)
        gl.glPixelStorei(gl.GL_UNPACK_ROW_LENGTH, 9)
        gl.glNewList(2, gl.GL_COMPILE)
        gl.glTexSubImage2D(gl.GL_TEXTURE_2D, 0, 1, 1, 3, 2, *pixels, IMAGE)
        gl.glEndList()
        gl.glPixelStorei(gl.GL_UNPACK_ROW_LENGTH, 0)
        gl.glWindowPos2i(1, 1)
        gl.glCallList(1)
        gl.glCallList(2)
        return [gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, *pixels), np.array([proxy])]

    check(program)


def test_errors_of_pixel_buffers():
    def program(gl):
        unpack = bind(gl, "GL_PIXEL_UNPACK_BUFFER", np.zeros(100, np.uint8))
        pack = bind(gl, "GL_PIXEL_PACK_BUFFER", np.zeros(100, np.uint8))
        short, whole = (gl.GL_RGBA, gl.GL_UNSIGNED_SHORT), (gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)
        gl.glWindowPos2i(0, 0)
        codes = [
            code_of(gl, lambda: gl.glDrawPixels(5, 5, *whole, 0)),
            code_of(gl, lambda: gl.glDrawPixels(5, 5, *whole, 4)),
            code_of(gl, lambda: gl.glDrawPixels(2, 2, *short, 1)),
            code_of(gl, lambda: gl.glReadPixels(0, 0, 5, 5, *whole, 1)),
            code_of(gl, lambda: gl.glReadPixels(0, 0, 2, 2, *short, 3)),
            code_of(gl, lambda: gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, 6, 6, 0, *whole, 0)),
        ]
        for target in (unpack, pack):
            gl.glMapBuffer(target, gl.GL_READ_WRITE)
        codes += [
            code_of(gl, lambda: gl.glDrawPixels(2, 2, *whole, 0)),
            code_of(gl, lambda: gl.glReadPixels(0, 0, 2, 2, *whole, 0)),
            code_of(gl, lambda: gl.glBufferSubData(pack, 0, 4, np.zeros(4, np.uint8))),
            code_of(gl, lambda: gl.glGetBufferSubData(pack, 0, 4)),
        ]
        for target in (unpack, pack):
            gl.glUnmapBuffer(target)
        return [np.array(codes)]

    check(program)


@pytest.mark.parametrize(
    "target", ["GL_ARRAY_BUFFER", "GL_ELEMENT_ARRAY_BUFFER", "GL_PIXEL_PACK_BUFFER", "GL_PIXEL_UNPACK_BUFFER"]
)
def test_mapped_bytes_are_those_of_the_buffer(target):
    data = np.arange(96, dtype=np.uint8)

    def program(gl):
        token = bind(gl, target, data)

        def properties() -> list[int]:
            names = "SIZE USAGE ACCESS MAPPED ACCESS_FLAGS MAP_OFFSET MAP_LENGTH"
            return [int(gl.glGetBufferParameteriv(token, getattr(gl, f"GL_BUFFER_{name}"))) for name in names.split()]

        answers = [properties()]
        memory = gl.glMapBuffer(token, gl.GL_READ_WRITE)
        answers += [properties(), memory[10:20].tolist(), [len(memory)]]
        memory[4:8] = 255
        (ctypes.c_float * 4).from_address(int(memory) + 16)[0] = 1.5
        ctypes.memmove(memory, b"abcd", 4)
        answers.append([int(gl.glUnmapBuffer(token))])
        ranged = gl.glMapBufferRange(token, 32, 16, gl.GL_MAP_WRITE_BIT | gl.GL_MAP_FLUSH_EXPLICIT_BIT)
        ranged.view(np.uint32)[:] = [1, 2, 3, 2**31]
        gl.glFlushMappedBufferRange(token, 0, 16)
        answers.append(properties())
        gl.glUnmapBuffer(token)
        return [np.array(answer) for answer in answers] + [gl.glGetBufferSubData(token, 0, 96)]

    check(program)


def test_vertices_that_were_written_to_mapped_memory_are_drawn():
    corners = np.array([[-0.7, -0.6], [0.9, -0.4], [0.1, 0.8]], np.float32)

    def program(gl):
        token = bind(gl, "GL_ARRAY_BUFFER", np.zeros(24, np.uint8))
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        gl.glVertexPointer(2, gl.GL_FLOAT, 0, None)
        for shift in (0, 0.3):
            memory = gl.glMapBuffer(token, gl.GL_WRITE_ONLY)
            memory.view(np.float32)[:] = (corners - np.float32(shift)).ravel()
            gl.glUnmapBuffer(token)
            gl.glColor3f(1, shift, 0)
            gl.glDrawArrays(gl.GL_TRIANGLES, 0, 3)
        return []

    check(program)


def test_errors_of_mapping():
    def program(gl):
        token = gl.GL_ARRAY_BUFFER
        read, write, flush = gl.GL_MAP_READ_BIT, gl.GL_MAP_WRITE_BIT, gl.GL_MAP_FLUSH_EXPLICIT_BIT
        codes = [code_of(gl, lambda: gl.glUnmapBuffer(token))]
        bind(gl, "GL_ARRAY_BUFFER", np.zeros(64, np.uint8))
        ranges = [(-1, 4, read), (0, -4, read), (0, 0, read), (0, 65, read), (60, 8, write), (0, 4, 0), (0, 4, 1 << 12)]
        ranges += [(0, 4, read | gl.GL_MAP_INVALIDATE_RANGE_BIT), (0, 4, read | flush), (0, 4, flush)]
        codes += [code_of(gl, lambda r=r: gl.glMapBufferRange(token, *r)) for r in ranges]
        codes.append(code_of(gl, lambda: gl.glMapBuffer(token, gl.GL_FLOAT)))
        codes.append(code_of(gl, lambda: gl.glFlushMappedBufferRange(token, 0, 4)))
        gl.glMapBufferRange(token, 0, 16, write)
        codes.append(code_of(gl, lambda: gl.glMapBuffer(token, gl.GL_READ_ONLY)))
        codes.append(code_of(gl, lambda: gl.glFlushMappedBufferRange(token, 0, 4)))
        gl.glBufferData(token, 64, np.zeros(64, np.uint8), gl.GL_STATIC_DRAW)
        codes.append(code_of(gl, lambda: gl.glUnmapBuffer(token)))
        gl.glMapBufferRange(token, 0, 16, write | flush)
        codes += [code_of(gl, lambda r=r: gl.glFlushMappedBufferRange(token, *r)) for r in ((0, 17), (-1, 2), (4, 12))]
        return [np.array(codes)]

    check(program)
