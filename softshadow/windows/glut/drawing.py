"""Shapes drawn by the GL calls of freeglut 3.4: from vertex arrays of positions and normals, in float32."""

from __future__ import annotations

import operator
from collections.abc import Callable
from dataclasses import dataclass
from functools import wraps
from typing import Any, NamedTuple

import numpy as np

from softshadow import gl
from softshadow.context.arrays import Cache
from softshadow.windows.desktop import desktop

MOST_VERTICES = 1 << 16  # that indices of 16 bits can name
KEPT_SHAPES, KEPT_BYTES = 4096, 50 << 20  # of the latest shapes
KEPT_SIZES = 256  # in which the latest pieces of one form were drawn


@dataclass(frozen=True)
class Surface:
    """Positions and normals, float32 (n, 3), and texture coordinates (n, 2) if there are any.

    Nobody can change them, so they are neither copied nor compared when they are drawn again.
    """

    positions: np.ndarray
    normals: np.ndarray
    texcoords: np.ndarray | None = None

    def __post_init__(self) -> None:
        for array in (self.positions, self.normals, self.texcoords):
            if array is not None:
                fixed(array)


class Shape(NamedTuple):
    """A surface, and rows of indices: of strips, or of lines and then `loops`."""

    surface: Surface
    rows: np.ndarray
    loops: np.ndarray | None = None

    @property
    def bytes(self) -> int:
        """The bytes of its arrays."""
        arrays = self.surface.positions, self.surface.normals, self.rows, self.loops
        return sum(array.nbytes for array in arrays if array is not None)


def fixed(array: np.ndarray) -> np.ndarray:
    """Return an array that owns its numbers as one that nobody can change."""
    assert array.base is None
    array.setflags(write=False)
    return array


def kept(make: Callable[..., Shape]) -> Callable[..., Shape]:
    """Keep the latest shapes that a function makes of numbers: programs draw the same ones in every frame."""
    known = Cache(KEPT_BYTES, KEPT_SHAPES)

    @wraps(make)
    def shape(*numbers: Any) -> Shape:
        # by the bits of float32: zeros of both signs are equal numbers
        key = tuple([each.tobytes() if isinstance(each, np.float32) else each for each in numbers])
        found: Shape | None = known.use(key)
        if found is None:
            found = make(*numbers)
            if len(found.surface.positions) <= MOST_VERTICES:  # of others, `indices` tells each program
                known.put(key, found, found.bytes)
        return found

    return shape


def count(call: str, name: str, value: Any) -> int:
    """Return an argument that is a whole number.

    Raises
    ------
    TypeError                    it is not, which ctypes refuses, too
    """
    try:
        return operator.index(value)
    except TypeError:
        raise TypeError(f"{call}({name}={value!r}): expected an int") from None


def indices(rows: Any) -> np.ndarray:
    """Return rows of indices as GL_UNSIGNED_SHORT; those from 65536 on begin again at 0."""
    values = np.asarray(rows, np.int64)
    if values.size and values.max() >= MOST_VERTICES:
        desktop().tell("a shape of GLUT has more than 65535 vertices; their numbers begin again at 0, as in freeglut")
    return fixed(values.astype(np.uint16, order="C"))


def _begin(surface: Surface) -> None:
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    gl.glEnableClientState(gl.GL_NORMAL_ARRAY)
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, surface.positions)
    gl.glNormalPointer(gl.GL_FLOAT, 0, surface.normals)
    if surface.texcoords is not None:
        gl.glEnableClientState(gl.GL_TEXTURE_COORD_ARRAY)
        gl.glTexCoordPointer(2, gl.GL_FLOAT, 0, surface.texcoords)


def _end(surface: Surface) -> None:
    gl.glDisableClientState(gl.GL_VERTEX_ARRAY)
    gl.glDisableClientState(gl.GL_NORMAL_ARRAY)
    if surface.texcoords is not None:
        gl.glDisableClientState(gl.GL_TEXTURE_COORD_ARRAY)


def draw_triangles(surface: Surface, corners: np.ndarray | None = None) -> None:
    """Draw triangles of all vertices in order, or of those that indices name."""
    _begin(surface)
    if corners is None:
        gl.glDrawArrays(gl.GL_TRIANGLES, 0, len(surface.positions))
    else:
        gl.glDrawElements(gl.GL_TRIANGLES, corners.size, gl.GL_UNSIGNED_SHORT, corners)
    _end(surface)


def draw_strips(shape: Shape) -> None:
    """Draw a triangle strip for each row of indices."""
    _begin(shape.surface)
    _draw_rows(gl.GL_TRIANGLE_STRIP, shape.rows)
    _end(shape.surface)


def draw_lines(shape: Shape, mode: int) -> None:
    """Draw lines of a mode for each row of indices, then a loop for each row of `loops`."""
    _begin(shape.surface)
    _draw_rows(mode, shape.rows)
    if shape.loops is not None:
        _draw_rows(gl.GL_LINE_LOOP, shape.loops)
    _end(shape.surface)


def draw_faces_as_loops(surface: Surface, size: int) -> None:
    """Draw a line loop for each `size` vertices."""
    _begin(surface)
    firsts = range(0, len(surface.positions), size)
    gl.glMultiDrawArrays(gl.GL_LINE_LOOP, list(firsts), [size] * len(firsts), len(firsts))  # glDrawArrays in freeglut
    _end(surface)


def _draw_rows(mode: int, rows: np.ndarray) -> None:
    """Draw primitives of a mode; freeglut calls glDrawElements for each row."""
    gl.glMultiDrawElements(mode, [rows.shape[1]] * len(rows), gl.GL_UNSIGNED_SHORT, rows, len(rows))
