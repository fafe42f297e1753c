"""Cube maps, one direction at a time in NumPy scalars (float32): faces by GL's table, edges by geometry.

Imports nothing from the package. The texel beyond an edge is the nearest texel of another face.
"""

from itertools import product

import numpy as np

F = np.float32
HALF, ONE = F(0.5), F(1)
# GL 2.1, table 3.21: the axes of sc, tc and ma of each face, and their signs
TABLE = (
    ((2, -1), (1, -1), (0, 1)),
    ((2, 1), (1, -1), (0, -1)),
    ((0, 1), (2, 1), (1, 1)),
    ((0, 1), (2, -1), (1, -1)),
    ((0, 1), (1, -1), (2, 1)),
    ((0, -1), (1, -1), (2, -1)),
)


def on_face(direction: np.ndarray) -> tuple[int, np.float32, np.float32]:
    """Return face, s and t of a direction; among equal components z comes first, then y."""
    axis = max((2, 1, 0), key=lambda i: abs(direction[i]))
    face = 2 * axis + int(np.signbit(direction[axis]))
    (s_axis, s_sign), (t_axis, t_sign), _ = TABLE[face]
    scale = HALF / abs(direction[axis])
    return face, F(s_sign) * direction[s_axis] * scale + HALF, F(t_sign) * direction[t_axis] * scale + HALF


def point(face: int, s: float, t: float) -> np.ndarray:
    """Return the position of a face's (s, t) on the cube from -1 to 1."""
    position = np.zeros(3)
    for (axis, sign), value in zip(TABLE[face], (2 * s - 1, 2 * t - 1, 1), strict=True):
        position[axis] = sign * value
    return position


def beyond(face: int, x: int, y: int, size: int) -> tuple[int, int, int]:
    """Return (face, x, y) of the texel on another face that is next to texel (x, y), one beyond the edge."""
    edge = point(face, *(min(max((i + 0.5) / size, 0), 1) for i in (x, y)))
    others = [(f, i, j) for f, j, i in product(range(6), range(size), range(size)) if f != face]
    distances = [np.linalg.norm(point(f, (i + 0.5) / size, (j + 0.5) / size) - edge) for f, i, j in others]
    return others[int(np.argmin(distances))]


def sample_seamlessly(cells: np.ndarray, direction: np.ndarray) -> np.ndarray:
    """Return the linear filter over cells (6, n, n, channels); not for texels beyond a corner."""
    face, s, t = on_face(direction)
    size = cells.shape[1]
    u, v = s * F(size) - HALF, t * F(size) - HALF
    x, y = int(np.floor(u)), int(np.floor(v))

    def texel(i: int, j: int) -> np.ndarray:
        f, i, j = (face, i, j) if 0 <= i < size and 0 <= j < size else beyond(face, i, j, size)
        return cells[f, j, i]

    rows = [lerp(u - np.floor(u), texel(x, j), texel(x + 1, j)) for j in (y, y + 1)]
    return lerp(v - np.floor(v), *rows)


def lerp(weight: np.float32, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return weight * (b - a) + a


def reaches_a_corner(direction: np.ndarray, size: int) -> bool:
    """Return whether the linear filter at a direction needs a texel beyond a corner."""
    _, s, t = on_face(direction)
    return all(not HALF <= place * F(size) < F(size) - HALF for place in (s, t))
