"""Features of how vertices come: a second mesh of 800 triangles, drawn in another way."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from softshadow.bench.corpus.features.feature import Around, Feature
from softshadow.bench.corpus.shapes import Surface, torus

COLUMNS, ROWS = 40, 10


def _drawn(name: str, title: str, begin: Callable[[Any, Surface], Callable[[], None]]) -> Feature:
    """Return a feature that draws the second mesh before the first: `begin` returns the function that draws it."""

    def prepare(gl: Any) -> Around:
        mesh = torus(0.5, 0.25, COLUMNS, ROWS)
        draw = begin(gl, mesh)

        @contextmanager
        def around() -> Iterator[None]:
            draw()
            yield

        return around

    return Feature(name, title, prepare)


def _corners(mesh: Surface) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return positions, normals and texture coordinates of the corners of all triangles, one after the other."""
    order = mesh.triangles.ravel()
    return mesh.positions[order], mesh.normals[order], mesh.texture[order]


def _strip(mesh: Surface) -> np.ndarray:
    """Return the indices of one strip of triangles per ring, (ROWS, 2 * (COLUMNS + 1))."""
    rows = np.arange(ROWS)[:, None] * (COLUMNS + 1) + np.arange(COLUMNS + 1)
    return np.ascontiguousarray(np.stack([rows + COLUMNS + 1, rows], axis=-1).reshape(ROWS, -1), np.uint32)


def _immediate(gl: Any, mesh: Surface) -> Callable[[], None]:
    corners = list(zip(*(part.tolist() for part in _corners(mesh)), strict=True))

    def draw() -> None:
        gl.glBegin(gl.GL_TRIANGLES)
        for position, normal, place in corners:
            gl.glNormal3f(*normal)
            gl.glTexCoord2f(*place)
            gl.glVertex3f(*position)
        gl.glEnd()

    return draw


def _list(gl: Any, mesh: Surface) -> Callable[[], None]:
    number, draw = gl.glGenLists(1), _immediate(gl, mesh)
    gl.glNewList(number, gl.GL_COMPILE)
    draw()
    gl.glEndList()
    return lambda: gl.glCallList(number)


def _pointers(gl: Any, positions: Any, normals: Any, places: Any, kind: int) -> None:
    for array in (gl.GL_VERTEX_ARRAY, gl.GL_NORMAL_ARRAY, gl.GL_TEXTURE_COORD_ARRAY):
        gl.glEnableClientState(array)
    gl.glVertexPointer(3, kind, 0, positions)
    gl.glNormalPointer(kind, 0, normals)
    gl.glTexCoordPointer(2, kind, 0, places)


def _arrays(gl: Any, mesh: Surface) -> Callable[[], None]:
    corners = _corners(mesh)

    def draw() -> None:
        _pointers(gl, *corners, gl.GL_FLOAT)
        gl.glDrawArrays(gl.GL_TRIANGLES, 0, len(corners[0]))

    return draw


def _doubles(gl: Any, mesh: Surface) -> Callable[[], None]:
    positions, normals, places = (part.astype(np.float64) for part in _corners(mesh))

    def draw() -> None:
        _pointers(gl, positions, normals, places, gl.GL_DOUBLE)
        gl.glDrawArrays(gl.GL_TRIANGLES, 0, len(positions))

    return draw


def _interleaved(gl: Any, mesh: Surface) -> Callable[[], None]:
    positions, normals, places = _corners(mesh)
    rows = np.ascontiguousarray(np.hstack([places, normals, positions]))

    def draw() -> None:
        gl.glInterleavedArrays(gl.GL_T2F_N3F_V3F, 0, rows)
        gl.glDrawArrays(gl.GL_TRIANGLES, 0, len(rows))

    return draw


def _strips(gl: Any, mesh: Surface) -> Callable[[], None]:
    strips = _strip(mesh)

    def draw() -> None:
        _pointers(gl, mesh.positions, mesh.normals, mesh.texture, gl.GL_FLOAT)
        for strip in strips:
            gl.glDrawElements(gl.GL_TRIANGLE_STRIP, len(strip), gl.GL_UNSIGNED_INT, strip)

    return draw


def _quad_strips(gl: Any, mesh: Surface) -> Callable[[], None]:
    strips = _strip(mesh)

    def draw() -> None:
        _pointers(gl, mesh.positions, mesh.normals, mesh.texture, gl.GL_FLOAT)
        for strip in strips:
            gl.glDrawElements(gl.GL_QUAD_STRIP, len(strip), gl.GL_UNSIGNED_INT, strip)

    return draw


def _short_indices(gl: Any, mesh: Surface) -> Callable[[], None]:
    indices = mesh.triangles.astype(np.uint16)

    def draw() -> None:
        _pointers(gl, mesh.positions, mesh.normals, mesh.texture, gl.GL_FLOAT)
        gl.glDrawRangeElements(gl.GL_TRIANGLES, 0, len(mesh.positions) - 1, indices.size, gl.GL_UNSIGNED_SHORT, indices)

    return draw


def _colors(gl: Any, mesh: Surface) -> Callable[[], None]:
    colors = np.ascontiguousarray((mesh.normals * 100 + 128).astype(np.uint8))

    def draw() -> None:
        _pointers(gl, mesh.positions, mesh.normals, mesh.texture, gl.GL_FLOAT)
        gl.glEnableClientState(gl.GL_COLOR_ARRAY)
        gl.glColorPointer(3, gl.GL_UNSIGNED_BYTE, 0, colors)
        gl.glDrawElements(gl.GL_TRIANGLES, mesh.triangles.size, gl.GL_UNSIGNED_INT, mesh.triangles)
        gl.glDisableClientState(gl.GL_COLOR_ARRAY)
        gl.glColor4f(0.9, 0.8, 0.7, 0.6)

    return draw


def _written(gl: Any, mesh: Surface) -> Callable[[], None]:
    positions, number = mesh.positions.copy(), [0]

    def draw() -> None:
        number[0] += 1
        np.multiply(mesh.positions, 1 + 0.01 * (number[0] % 10), out=positions)
        _pointers(gl, positions, mesh.normals, mesh.texture, gl.GL_FLOAT)
        gl.glDrawElements(gl.GL_TRIANGLES, mesh.triangles.size, gl.GL_UNSIGNED_INT, mesh.triangles)

    return draw


def _sphere(gl: Any, mesh: Surface) -> Callable[[], None]:
    quadric = gl.gluNewQuadric()
    gl.gluQuadricTexture(quadric, True)
    return lambda: gl.gluSphere(quadric, 0.6, 32, 16)


def _lines(gl: Any, mesh: Surface) -> Callable[[], None]:
    positions = _corners(mesh)[0]

    def draw() -> None:
        gl.glDisable(gl.GL_LIGHTING)
        gl.glDisable(gl.GL_TEXTURE_2D)
        gl.glDisableClientState(gl.GL_NORMAL_ARRAY)
        gl.glDisableClientState(gl.GL_TEXTURE_COORD_ARRAY)
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        gl.glVertexPointer(3, gl.GL_FLOAT, 0, positions)
        gl.glDrawArrays(gl.GL_LINES, 0, len(positions))
        gl.glPointSize(3.0)
        gl.glDrawArrays(gl.GL_POINTS, 0, len(positions))
        gl.glEnable(gl.GL_LIGHTING)
        gl.glEnable(gl.GL_TEXTURE_2D)

    return draw


def _transparent_boxes(gl: Any, mesh: Surface) -> Callable[[], None]:
    def draw() -> None:
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
        for n in range(30):
            gl.glPushMatrix()
            gl.glTranslatef(0.1 * n - 1.5, 0.02 * n, -0.5)
            gl.glRectf(-0.1, -0.3, 0.1, 0.3)
            gl.glPopMatrix()
        gl.glDisable(gl.GL_BLEND)

    return draw


FEATURES = (
    _drawn("immediate", "a mesh by glBegin", _immediate),
    _drawn("display-list", "a mesh in a display list", _list),
    _drawn("draw-arrays", "a mesh by glDrawArrays", _arrays),
    _drawn("double-arrays", "a mesh in arrays of doubles", _doubles),
    _drawn("interleaved", "a mesh in interleaved arrays", _interleaved),
    _drawn("strips", "a mesh of triangle strips", _strips),
    _drawn("quad-strips", "a mesh of quad strips", _quad_strips),
    _drawn("short-indices", "a mesh with indices of 16 bits", _short_indices),
    _drawn("byte-colors", "a mesh with a colour of bytes at each vertex", _colors),
    _drawn("written-arrays", "a mesh whose arrays the program writes in each frame", _written),
    _drawn("sphere", "a sphere by gluSphere", _sphere),
    _drawn("lines-and-points", "lines and points", _lines),
    _drawn("transparent-boxes", "thirty transparent rectangles", _transparent_boxes),
)
