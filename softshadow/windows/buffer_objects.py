"""OpenGL.arrays.vbo: PyOpenGL's class for a vertex buffer object and its data."""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np

from softshadow import gl


class VBOOffset(ctypes.c_void_p):
    """A place in the buffer that is bound, in bytes; pointer calls accept it in place of an array."""


class VBO(ctypes.c_void_p):
    """A buffer object with the array that fills it; in pointer calls it stands for the beginning of the buffer.

    Parameters
    ----------
    data : array
    usage, target : tokens, or their names
    size : int                   bytes of the buffer; by default, those of the data
    """

    def __init__(
        self,
        data: Any,
        usage: int | str = "GL_DYNAMIC_DRAW",
        target: int | str = "GL_ARRAY_BUFFER",
        size: int | None = None,
    ) -> None:
        super().__init__(None)
        self.usage, self.target = _token(usage), _token(target)
        self.buffers: list[int] = []
        self.set_array(data, size)

    def set_array(self, data: Any, size: int | None = None) -> None:
        """Replace all data; they are copied at the next bind."""
        self.data = np.asarray(data)
        self.size = self.data.nbytes if size is None else size
        self.copied = False

    def __setitem__(self, rows: slice, values: Any) -> None:
        self.data[rows] = values
        self.copied = False

    def __len__(self) -> int:
        return len(self.data)

    def __getattr__(self, name: str) -> Any:
        if name == "data":
            raise AttributeError(name)
        return getattr(self.data, name)

    def __add__(self, offset: int) -> VBOOffset:
        return VBOOffset(offset)

    def create_buffers(self) -> list[int]:
        """Make the buffer object."""
        self.buffers = [int(gl.glGenBuffers(1))]
        return self.buffers

    def bind(self) -> None:
        """Bind the buffer, and copy the data into it if they have changed."""
        if not self.buffers:
            self.create_buffers()
        gl.glBindBuffer(self.target, self.buffers[0])
        if not self.copied:
            gl.glBufferData(self.target, self.size, self.data, self.usage)
            self.copied = True

    def unbind(self) -> None:
        """Bind no buffer."""
        gl.glBindBuffer(self.target, 0)

    def copy_data(self) -> None:
        """Copy the data into the buffer, which must be bound."""
        gl.glBufferData(self.target, self.size, self.data, self.usage)
        self.copied = True

    def delete(self) -> None:
        """Delete the buffer object."""
        if self.buffers:
            gl.glDeleteBuffers(1, self.buffers)
        self.buffers, self.copied = [], False

    def __enter__(self) -> None:
        self.bind()

    def __exit__(self, *_: object) -> None:
        self.unbind()


def _token(value: int | str) -> int:
    if not isinstance(value, str):
        return value
    token: int = getattr(gl, value.removesuffix("_ARB"))
    return token


NAMES = {"VBO": VBO, "VBOOffset": VBOOffset, "get_implementation": lambda: True}
