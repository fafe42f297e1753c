"""Martin Newell's teapot of 1975, from its Bézier patches.

The patches are a quarter of the rim, body, lid and bottom, and half of the handle and spout; the rest mirrors them.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from softshadow.windows.shapes import draw_grid

SOLID, WIRE = 7, 10  # pieces of a patch in each direction, as in GLUT
QUARTERS = 6  # the first patches are mirrored in x and y, those after them in y
PATCHES = (
    (102, 103, 104, 105, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15),  # rim
    (12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27),  # body
    (24, 25, 26, 27, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40),
    (96, 96, 96, 96, 97, 98, 99, 100, 101, 101, 101, 101, 0, 1, 2, 3),  # lid
    (0, 1, 2, 3, 106, 107, 108, 109, 110, 111, 112, 113, 114, 115, 116, 117),
    (118, 118, 118, 118, 124, 122, 119, 121, 123, 126, 125, 120, 40, 39, 38, 37),  # bottom
    (41, 42, 43, 44, 45, 46, 47, 48, 49, 50, 51, 52, 53, 54, 55, 56),  # handle
    (53, 54, 55, 56, 57, 58, 59, 60, 61, 62, 63, 64, 28, 65, 66, 67),
    (68, 69, 70, 71, 72, 73, 74, 75, 76, 77, 78, 79, 80, 81, 82, 83),  # spout
    (80, 81, 82, 83, 84, 85, 86, 87, 88, 89, 90, 91, 92, 93, 94, 95),
)
POINTS = (
    (0.2, 0, 2.7), (0.2, -0.112, 2.7), (0.112, -0.2, 2.7), (0, -0.2, 2.7), (1.3375, 0, 2.53125),
    (1.3375, -0.749, 2.53125), (0.749, -1.3375, 2.53125), (0, -1.3375, 2.53125), (1.4375, 0, 2.53125),
    (1.4375, -0.805, 2.53125), (0.805, -1.4375, 2.53125), (0, -1.4375, 2.53125), (1.5, 0, 2.4), (1.5, -0.84, 2.4),
    (0.84, -1.5, 2.4), (0, -1.5, 2.4), (1.75, 0, 1.875), (1.75, -0.98, 1.875), (0.98, -1.75, 1.875), (0, -1.75, 1.875),
    (2, 0, 1.35), (2, -1.12, 1.35), (1.12, -2, 1.35), (0, -2, 1.35), (2, 0, 0.9), (2, -1.12, 0.9), (1.12, -2, 0.9),
    (0, -2, 0.9), (-2, 0, 0.9), (2, 0, 0.45), (2, -1.12, 0.45), (1.12, -2, 0.45), (0, -2, 0.45), (1.5, 0, 0.225),
    (1.5, -0.84, 0.225), (0.84, -1.5, 0.225), (0, -1.5, 0.225), (1.5, 0, 0.15), (1.5, -0.84, 0.15), (0.84, -1.5, 0.15),
    (0, -1.5, 0.15), (-1.6, 0, 2.025), (-1.6, -0.3, 2.025), (-1.5, -0.3, 2.25), (-1.5, 0, 2.25), (-2.3, 0, 2.025),
    (-2.3, -0.3, 2.025), (-2.5, -0.3, 2.25), (-2.5, 0, 2.25), (-2.7, 0, 2.025), (-2.7, -0.3, 2.025), (-3, -0.3, 2.25),
    (-3, 0, 2.25), (-2.7, 0, 1.8), (-2.7, -0.3, 1.8), (-3, -0.3, 1.8), (-3, 0, 1.8), (-2.7, 0, 1.575),
    (-2.7, -0.3, 1.575), (-3, -0.3, 1.35), (-3, 0, 1.35), (-2.5, 0, 1.125), (-2.5, -0.3, 1.125), (-2.65, -0.3, 0.9375),
    (-2.65, 0, 0.9375), (-2, -0.3, 0.9), (-1.9, -0.3, 0.6), (-1.9, 0, 0.6), (1.7, 0, 1.425), (1.7, -0.66, 1.425),
    (1.7, -0.66, 0.6), (1.7, 0, 0.6), (2.6, 0, 1.425), (2.6, -0.66, 1.425), (3.1, -0.66, 0.825), (3.1, 0, 0.825),
    (2.3, 0, 2.1), (2.3, -0.25, 2.1), (2.4, -0.25, 2.025), (2.4, 0, 2.025), (2.7, 0, 2.4), (2.7, -0.25, 2.4),
    (3.3, -0.25, 2.4), (3.3, 0, 2.4), (2.8, 0, 2.475), (2.8, -0.25, 2.475), (3.525, -0.25, 2.49375),
    (3.525, 0, 2.49375), (2.9, 0, 2.475), (2.9, -0.15, 2.475), (3.45, -0.15, 2.5125), (3.45, 0, 2.5125), (2.8, 0, 2.4),
    (2.8, -0.15, 2.4), (3.2, -0.15, 2.4), (3.2, 0, 2.4), (0, 0, 3.15), (0.8, 0, 3.15), (0.8, -0.45, 3.15),
    (0.45, -0.8, 3.15), (0, -0.8, 3.15), (0, 0, 2.85), (1.4, 0, 2.4), (1.4, -0.784, 2.4), (0.784, -1.4, 2.4),
    (0, -1.4, 2.4), (0.4, 0, 2.55), (0.4, -0.224, 2.55), (0.224, -0.4, 2.55), (0, -0.4, 2.55), (1.3, 0, 2.55),
    (1.3, -0.728, 2.55), (0.728, -1.3, 2.55), (0, -1.3, 2.55), (1.3, 0, 2.4), (1.3, -0.728, 2.4), (0.728, -1.3, 2.4),
    (0, -1.3, 2.4), (0, 0, 0), (1.425, -0.798, 0), (1.5, 0, 0.075), (1.425, 0, 0), (0.798, -1.425, 0), (0, -1.5, 0.075),
    (0, -1.425, 0), (1.5, -0.84, 0.075), (0.84, -1.5, 0.075),
)  # fmt: skip


def solid_teapot(size: float) -> None:
    """Draw the teapot's surface; its spout points along x, its lid up along y."""
    for rows in _grids(SOLID):
        draw_grid(_scaled(rows, size), True)


def wire_teapot(size: float) -> None:
    """Draw the lines of the teapot's patches."""
    for rows in _grids(WIRE):
        draw_grid(_scaled(rows, size), False)


def _scaled(rows: np.ndarray, size: float) -> list[list[tuple[np.ndarray, np.ndarray]]]:
    return [[(corner[:3], size * corner[3:]) for corner in row] for row in rows]


@lru_cache
def _grids(pieces: int) -> tuple[np.ndarray, ...]:
    """Return for each patch and each of its mirrored copies the normals and positions (pieces + 1, pieces + 1, 6)."""
    points, grids = np.array(POINTS, np.float64), []
    for number, patch in enumerate(PATCHES):
        controls = points[list(patch)].reshape(4, 4, 3)
        mirrors = [(1, 1), (1, -1)] + ([(-1, 1), (-1, -1)] if number < QUARTERS else [])
        for x, y in mirrors:
            grids.append(_grid(controls * (x, y, 1), pieces, x * y < 0))
    return tuple(grids)


def _grid(controls: np.ndarray, pieces: int, is_mirrored: bool) -> np.ndarray:
    """Return normals and positions of a patch, turned so that y is up, counterclockwise seen from outside."""
    at = np.linspace(0, 1, pieces + 1)
    inside = np.clip(at, 1e-4, 1 - 1e-4)  # at the tips of the lid and bottom, an edge of a patch is a point
    positions = np.einsum("ui,vj,ijk->uvk", _bernstein(at), _bernstein(at), controls)
    along_u = np.einsum("ui,vj,ijk->uvk", _slopes(inside), _bernstein(inside), controls)
    along_v = np.einsum("ui,vj,ijk->uvk", _bernstein(inside), _slopes(inside), controls)
    normals = np.cross(along_v, along_u)
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    positions = (positions - (0, 0, 1.5)) / 2
    turned = np.stack([values[..., [0, 2, 1]] * (1, 1, -1) for values in (normals, positions)])
    corners = np.concatenate([turned[0] * (-1 if is_mirrored else 1), turned[1]], axis=-1)
    return corners[:, ::-1] if is_mirrored else corners


def _bernstein(t: np.ndarray) -> np.ndarray:
    return np.stack([(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3], axis=-1)


def _slopes(t: np.ndarray) -> np.ndarray:
    """Return the derivatives of the four Bernstein polynomials."""
    return np.stack([-3 * (1 - t) ** 2, 3 * (1 - t) * (1 - 3 * t), 3 * t * (2 - 3 * t), 3 * t**2], axis=-1)
