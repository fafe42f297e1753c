"""Martin Newell's teapot, cup and spoon of 1975 in freeglut's form: Bézier patches, evaluated in float32.

The first six patches of pot and cup are a quarter of what goes round, and are turned three times; the others are half
of a handle or spout, and are mirrored.
"""

from __future__ import annotations

from functools import cache, lru_cache
from typing import NamedTuple

import numpy as np

from softshadow import gl
from softshadow.windows.glut.drawing import KEPT_SIZES, Shape, Surface, draw_lines, draw_triangles, indices
from softshadow.windows.glut.polyhedra import tables

F32 = np.float32
QUARTERS = 6
SOLID, WIRE = 8, 10  # vertices along each side of a patch


class Piece(NamedTuple):
    """How a piece of the tea set is made from its patches."""

    divisor: float  # of its size
    middle: float  # its height
    is_repeated: bool
    poles: dict[int, float]  # patches whose first row of vertices is one point: the normal's y there


PIECES = {
    "teapot": Piece(1.0, 1.575, True, {3: 1.0, 5: -1.0}),
    "teacup": Piece(2.5, 1.5121, True, {}),
    "teaspoon": Piece(2.5, -0.0315, False, {}),
}


class TeaSet:
    """The pieces as one program draws them: normals are those of the size in which a piece is drawn first."""

    def __init__(self) -> None:
        self._normals: dict[tuple[str, bool], np.ndarray] = {}

    def draw(self, solid: bool, name: str, size: float) -> None:
        """Draw a piece; the teapot's spout points along x, its lid up along y."""
        scale = F32(F32(size) / F32(PIECES[name].divisor))
        n = SOLID if solid else WIRE
        positions, tangents = _evaluated(name, scale.tobytes(), n)
        if (name, solid) not in self._normals:
            self._normals[name, solid] = _normals(name, tangents, n)
        n_patches = len(positions) // (n * n)
        surface = Surface(positions, self._normals[name, solid], _texcoords(n_patches, n) if solid else None)
        if solid:
            draw_triangles(surface, _corners(n_patches, n))
        else:
            draw_lines(Shape(surface, _line_strips(n_patches, n)), gl.GL_LINE_STRIP)


@cache
def _bernstein(n: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the cubic Bernstein polynomials and their derivatives, (n, 4) each, at n places from 0 to 1."""
    x = np.arange(n, dtype=F32) / F32(n - 1)
    rest = F32(1) - x
    three, six = F32(3), F32(6)
    values = (rest * (rest * rest), three * x * (rest * rest), three * (x * x) * rest, x * (x * x))
    slopes = (
        -three * (rest * rest), three * (rest * rest) - six * x * rest, six * x * rest - three * (x * x),
        three * (x * x),
    )  # fmt: skip
    return np.stack(values, axis=1), np.stack(slopes, axis=1)


@lru_cache(KEPT_SIZES)
def _evaluated(name: str, scale_bits: bytes, n: int) -> tuple[np.ndarray, tuple[np.ndarray, np.ndarray]]:
    """Return the positions of all patches, and the tangents of the given ones; sums are in the order of freeglut."""
    piece, table, scale = PIECES[name], tables()[name], np.frombuffer(scale_bits, F32)[0]
    x, y, z = np.moveaxis(table["points"][table["patches"]].reshape(-1, 4, 4, 3), -1, 0)
    points = np.stack([x, z - F32(piece.middle), -y], axis=-1) * scale / F32(2)
    values, slopes = _bernstein(n)
    rows = _sum(values, points[:, :, np.newaxis])  # (patches, 4, n, 3)
    sloped_rows = _sum(slopes, points[:, :, np.newaxis])
    columns, sloped_columns = (np.moveaxis(each, 1, 2)[:, np.newaxis] for each in (rows, sloped_rows))
    weights = values[:, np.newaxis], slopes[:, np.newaxis]
    positions = _sum(weights[0], columns)  # (patches, n, n, 3)
    return _repeated(positions, piece), (_sum(weights[0], sloped_columns), _sum(weights[1], columns))


def _sum(weights: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Return the sums over four points (..., 4, 3), one after another, with weights (..., 4)."""
    total = np.zeros((), F32)
    for number in range(4):
        total = total + weights[..., number, np.newaxis] * points[..., number, :]
    return total


def _normals(name: str, tangents: tuple[np.ndarray, np.ndarray], n: int) -> np.ndarray:
    (x1, y1, z1), (x2, y2, z2) = (np.moveaxis(each, -1, 0) for each in tangents)
    normals = np.stack([y1 * z2 - z1 * y2, z1 * x2 - x1 * z2, x1 * y2 - y1 * x2], axis=-1)
    squares = normals * normals
    with np.errstate(invalid="ignore"):  # where tangents are parallel there is no normal
        normals /= np.sqrt(squares[..., 0] + squares[..., 1] + squares[..., 2])[..., np.newaxis]
    for patch, up in PIECES[name].poles.items():
        normals[patch, 0] = 0.0, up, 0.0
    return _repeated(normals, PIECES[name])


def _repeated(patches: np.ndarray, piece: Piece) -> np.ndarray:
    """Return patches (number, n, n, 3) as rows of three numbers, each followed by its turned or mirrored copies."""
    if not piece.is_repeated:
        return patches.reshape(-1, 3).copy()
    parts = []
    for number, patch in enumerate(patches):
        x, y, z = np.moveaxis(patch, -1, 0)
        if number < QUARTERS:
            copies = [patch, *(np.stack(each, axis=-1) for each in ((z, y, -x), (-x, y, -z), (-z, y, x)))]
        else:
            copies = [patch, np.stack([x, y, -z], axis=-1)[::-1]]
        parts += [copy.reshape(-1, 3) for copy in copies]
    return np.concatenate(parts)


@cache
def _texcoords(n_patches: int, n: int) -> np.ndarray:
    steps = np.arange(n, dtype=F32) / F32(n - 1)
    return np.concatenate([np.stack(np.meshgrid(steps, steps, indexing="ij"), axis=-1).reshape(-1, 2)] * n_patches)


@cache
def _corners(n_patches: int, n: int) -> np.ndarray:
    """Return two triangles for each square of each patch."""
    grid = np.arange(n_patches * n * n).reshape(-1, n, n)
    here, below, across, beside = grid[:, :-1, :-1], grid[:, 1:, :-1], grid[:, 1:, 1:], grid[:, :-1, 1:]
    return indices(np.stack([here, below, across, here, across, beside], axis=-1).ravel())


@cache
def _line_strips(n_patches: int, n: int) -> np.ndarray:
    """Return the lines of one direction of all patches, then those of the other one."""
    grid = np.arange(n_patches * n * n).reshape(-1, n, n)
    return indices(np.concatenate([grid.transpose(0, 2, 1).reshape(-1, n), grid.reshape(-1, n)]))
