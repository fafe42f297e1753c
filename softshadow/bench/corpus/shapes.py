"""Meshes and pictures that the programs build themselves, so that they need no files."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

STEP = 1e-4  # of the difference quotients that give the normals
CORNERS = ((0, 0), (1, 0), (1, 1), (0, 1))  # of a square, in order
Place = Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray, np.ndarray]]


class Surface(NamedTuple):
    """A mesh: positions (n, 3), normals (n, 3), texture coordinates (n, 2) float32; triangles (m, 3) uint32."""

    positions: np.ndarray
    normals: np.ndarray
    texture: np.ndarray
    triangles: np.ndarray


def surface(place: Place, columns: int, rows: int) -> Surface:
    """Return the surface of points place(u, v), with u and v in [0, 1], as a grid of columns x rows quads."""
    v, u = np.meshgrid(np.linspace(0, 1, rows + 1), np.linspace(0, 1, columns + 1), indexing="ij")

    def points(u: np.ndarray, v: np.ndarray) -> np.ndarray:
        return np.stack(np.broadcast_arrays(*place(u, v)), axis=-1)

    along_u, along_v = points(u + STEP, v) - points(u - STEP, v), points(u, v + STEP) - points(u, v - STEP)
    normals = np.cross(along_u, along_v)
    normals /= np.maximum(np.linalg.norm(normals, axis=-1, keepdims=True), 1e-12)
    corner = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    right, up = corner + 1, corner + columns + 1
    triangles = np.concatenate([np.stack([corner, right, up + 1], 1), np.stack([corner, up + 1, up], 1)])
    return Surface(
        np.ascontiguousarray(points(u, v).reshape(-1, 3), np.float32),
        np.ascontiguousarray(normals.reshape(-1, 3), np.float32),
        np.ascontiguousarray(np.stack([u, v], axis=-1).reshape(-1, 2), np.float32),
        np.ascontiguousarray(triangles, np.uint32),
    )


def sphere(radius: float = 1.0, columns: int = 32, rows: int = 16) -> Surface:
    """Return a sphere around the origin, seen from outside counter-clockwise."""

    def place(u: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        longitude, latitude = 2 * np.pi * u, np.pi * (0.002 + 0.996 * v - 0.5)  # no normal exists at the poles
        around = radius * np.cos(latitude)
        return around * np.sin(longitude), radius * np.sin(latitude), around * np.cos(longitude)

    return surface(place, columns, rows)


def torus(ring: float = 1.0, tube: float = 0.4, columns: int = 48, rows: int = 24) -> Surface:
    """Return a torus in the plane z = 0."""

    def place(u: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        around = ring + tube * np.cos(2 * np.pi * v)
        return around * np.cos(2 * np.pi * u), around * np.sin(2 * np.pi * u), tube * np.sin(2 * np.pi * v)

    return surface(place, columns, rows)


def turned(profile: Callable[[np.ndarray], np.ndarray], height: float, columns: int = 32, rows: int = 24) -> Surface:
    """Return what a lathe makes: the radius is profile(v), from v = 0 at the bottom to v = 1 at the top."""

    def place(u: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        radius = profile(v)
        return radius * np.sin(2 * np.pi * u), height * v, radius * np.cos(2 * np.pi * u)

    return surface(place, columns, rows)


def knot(columns: int = 600, rows: int = 40, tube: float = 0.25) -> Surface:
    """Return a trefoil knot: a tube around a closed curve."""

    def curve(t: np.ndarray) -> np.ndarray:
        return 0.4 * np.stack([np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -np.sin(3 * t)], -1)

    def place(u: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        t, angle = 2 * np.pi * u, 2 * np.pi * v[..., None]
        tangent = curve(t + STEP) - curve(t - STEP)
        tangent /= np.linalg.norm(tangent, axis=-1, keepdims=True)
        side = np.cross(tangent, (0.0, 0.0, 1.0))
        side /= np.linalg.norm(side, axis=-1, keepdims=True)
        point = curve(t) + tube * (np.cos(angle) * side + np.sin(angle) * np.cross(side, tangent))
        return point[..., 0], point[..., 1], point[..., 2]

    return surface(place, columns, rows)


def terrain(cells: int, size: float = 10.0, height: float = 1.2) -> Surface:
    """Return hills: a square grid whose heights are a sum of waves."""

    def place(u: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        x, z = size * (u - 0.5), size * (0.5 - v)
        waves = (
            np.sin(0.9 * x + 1.3) * np.cos(0.7 * z),
            0.5 * np.sin(2.1 * z - 0.4 * x),
            0.2 * np.cos(5.3 * x + 3.1 * z),
        )
        return x, height * 0.5 * sum(waves, np.zeros_like(x)), z

    return surface(place, cells, cells)


def box_faces() -> list[tuple[tuple[float, ...], list[tuple[float, ...]]]]:
    """Return the faces of the cube from -1 to 1: an outward normal and four corners, counter-clockwise."""
    faces = []
    for axis in range(3):
        for sign in (1.0, -1.0):
            normal, right, up = np.zeros(3), np.zeros(3), np.zeros(3)
            normal[axis], right[(axis + 1) % 3], up[(axis + 2) % 3] = sign, 1.0, sign
            corners = [normal + x * right + y * up for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
            faces.append((tuple(normal.tolist()), [tuple(corner.tolist()) for corner in corners]))
    return faces


# -- pictures (h, w, 4) uint8 ------------------------------------------------------------------------------------------
def checkers(size: int = 256, squares: int = 8, dark: int = 70, light: int = 230) -> np.ndarray:
    """Return a checkerboard with a little red towards the right."""
    y, x = np.mgrid[0:size, 0:size]
    gray = np.where((x * squares // size + y * squares // size) & 1, light, dark)
    red = np.minimum(gray + x * 40 // size, 255)
    return np.ascontiguousarray(np.dstack([red, gray, gray, np.full_like(gray, 255)]), np.uint8)


def noise(size: int = 256, seed: int = 1) -> np.ndarray:
    """Return a cloudy picture in brown and green, as for grass or marble."""
    random, total = np.random.default_rng(seed), np.zeros((size, size))
    for octave in range(2, int(math.log2(size)) + 1):
        cells = 1 << octave
        total += np.kron(random.random((cells, cells)), np.ones((size // cells, size // cells))) / octave
    total = (total - total.min()) / np.ptp(total)
    parts = (60 + 120 * total, 90 + 140 * total, 40 + 60 * total, np.full_like(total, 255))
    return np.ascontiguousarray(np.dstack(parts), np.uint8)


def spot(size: int = 64) -> np.ndarray:
    """Return a white spot whose alpha falls to 0 at the rim."""
    y, x = np.mgrid[-1 : 1 : size * 1j, -1 : 1 : size * 1j]
    alpha = 255 * np.clip(1 - np.hypot(x, y), 0, 1)
    return np.ascontiguousarray(np.dstack([np.full((size, size, 3), 255), alpha]), np.uint8)


def leaf(size: int = 64) -> np.ndarray:
    """Return a green leaf with a hard outline in alpha."""
    y, x = np.mgrid[-1 : 1 : size * 1j, -1 : 1 : size * 1j]
    alpha = np.where(np.abs(x) < 0.7 * np.cos(np.pi * y / 2) * (1 + 0.2 * np.sin(14 * y)), 255, 0)
    parts = (40 + 60 * (1 - np.abs(x)), 120 + 100 * np.abs(y), np.full_like(x, 40), alpha)
    return np.ascontiguousarray(np.dstack(parts), np.uint8)


def letters(size: int = 128) -> np.ndarray:
    """Return a font of 8 x 8 made-up characters, white with their shapes in alpha."""
    random = np.random.default_rng(7)
    dots = np.kron(random.random((32, 32)) < 0.5, np.ones((size // 32, size // 32)))
    return np.ascontiguousarray(np.dstack([np.full((size, size, 3), 255), 255 * dots]), np.uint8)
