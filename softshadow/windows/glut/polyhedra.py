"""The polyhedra of GLUT: cube, Platonic solids, rhombic dodecahedron, and a sponge of tetrahedra."""

from __future__ import annotations

import json
from functools import cache, lru_cache
from importlib.resources import files
from typing import Any

import numpy as np

from softshadow.windows.glut.drawing import KEPT_SIZES, Surface, count, draw_faces_as_loops, draw_triangles, indices

# how a face is cut into triangles, by its number of corners
TRIANGLES = {4: (0, 1, 2, 0, 2, 3), 5: (0, 1, 2, 0, 2, 4, 4, 2, 3)}


@cache
def tables() -> dict[str, dict[str, np.ndarray]]:
    """Return the tables of `solids.json`: float32 coordinates and integer indices, by shape and by name."""
    text = files(__package__).joinpath("solids.json").read_text(encoding="ascii")
    integers = ("faces", "patches")
    return {
        shape: {name: np.array(rows, np.intp if name in integers else np.float32) for name, rows in parts.items()}
        for shape, parts in json.loads(text).items()
    }


@cache
def polyhedron(name: str) -> Surface:
    """Return the corners of all faces, one face after another."""
    table = tables()[name]
    faces = table["faces"]
    return Surface(table["positions"][faces.ravel()], np.repeat(table["normals"], faces.shape[1], axis=0))


@cache
def _corners(name: str) -> np.ndarray | None:
    """Return the corners of the triangles of all faces; None if the faces are triangles."""
    n_faces, size = tables()[name]["faces"].shape
    if size not in TRIANGLES:
        return None
    return indices((size * np.arange(n_faces)[:, np.newaxis] + TRIANGLES[size]).ravel())


def _draw(solid: bool, surface: Surface, name: str) -> None:
    if solid:
        draw_triangles(surface, _corners(name))
    else:
        draw_faces_as_loops(surface, tables()[name]["faces"].shape[1])


def draw_polyhedron(solid: bool, name: str) -> None:
    """Draw a polyhedron of one size."""
    _draw(solid, polyhedron(name), name)


def draw_cube(solid: bool, size: float) -> None:
    """Draw a cube around the origin."""
    _draw(solid, _cube(np.float32(size).tobytes()), "cube")


@lru_cache(KEPT_SIZES)
def _cube(size_bits: bytes) -> Surface:
    unit = polyhedron("cube")
    return Surface(np.frombuffer(size_bits, np.float32) * unit.positions, unit.normals)


def draw_sponge(solid: bool, n_levels: Any, offset: Any, scale: float) -> None:
    """Draw tetrahedra in the corners of a tetrahedron, again and again (Sierpinski)."""
    n_levels = count("glutSolidSierpinskiSponge" if solid else "glutWireSierpinskiSponge", "n_levels", n_levels)
    if n_levels < 0:
        return
    unit = polyhedron("tetrahedron")
    positions = np.concatenate(_sponge(n_levels, np.array(offset, np.float64)[:3], np.float32(scale)))
    _draw(solid, Surface(positions, np.concatenate([unit.normals] * 4**n_levels)), "tetrahedron")


def _sponge(n_levels: int, offset: np.ndarray, scale: np.float32) -> list[np.ndarray]:
    """Return the positions of each small tetrahedron: float32, but places of tetrahedra are float64 until the last."""
    if n_levels == 0:
        return [offset.astype(np.float32) + scale * polyhedron("tetrahedron").positions]
    half = scale / np.float32(2)
    corners = tables()["tetrahedron"]["positions"]
    return [each for corner in corners for each in _sponge(n_levels - 1, offset + half * corner, half)]
