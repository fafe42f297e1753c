"""Primitive assembly: which vertices make which triangle, in GL's order."""

from typing import NamedTuple

import numpy as np

from softshadow import tokens as gl


class Triangles(NamedTuple):
    """corners (T, 3) int32 vertex numbers in drawing order;

    Provoking (T,) int32: the vertex that gives flat colours.
    """

    corners: np.ndarray
    provoking: np.ndarray


# Each row: vertices of one triangle relative to the first vertex of its primitive, then the provoking one. The order of
# the vertices decides the last bits of interpolated values, so it is llvmpipe's (docs/exactness.md, 5).
TRIANGLE = ((0, 1, 2, 2),)
QUAD = ((0, 1, 2, 3), (0, 2, 3, 3))
QUAD_OF_STRIP = ((0, 1, 3, 3), (0, 3, 2, 3))
STRIP_PAIR = ((0, 1, 2, 2), (2, 1, 3, 3))  # the odd triangle is (i+1, i, i+2), so that both turn the same way


def assemble(mode: int, count: int) -> Triangles:
    """Return the triangles that `count` vertices make; vertices that complete no primitive are dropped.

    References
    ----------
    GL 2.1, sec. 2.6.1 (primitives) and 2.14.7 (flat shading).
    """
    if mode == gl.GL_TRIANGLES:
        rows = _repeat(TRIANGLE, count // 3, 3)
    elif mode == gl.GL_QUADS:
        rows = _repeat(QUAD, count // 4, 4)
    elif mode == gl.GL_QUAD_STRIP:
        rows = _repeat(QUAD_OF_STRIP, max(count // 2 - 1, 0), 2)
    elif mode == gl.GL_TRIANGLE_STRIP:
        triangles = max(count - 2, 0)
        rows = _repeat(STRIP_PAIR, (triangles + 1) // 2, 2)[:triangles]
    else:
        middle = np.arange(1, max(count - 1, 1), dtype=np.int32)
        first = np.zeros_like(middle)
        fan = (middle, middle + 1, first, first) if mode == gl.GL_POLYGON else (first, middle, middle + 1, middle + 1)
        rows = np.stack(fan, axis=1)
    rows = np.ascontiguousarray(rows, np.int32)
    return Triangles(np.ascontiguousarray(rows[:, :3]), np.ascontiguousarray(rows[:, 3]))


def _repeat(pattern: tuple[tuple[int, ...], ...], primitives: int, stride: int) -> np.ndarray:
    first = np.arange(primitives, dtype=np.int32) * stride
    return (first[:, None, None] + np.array(pattern, np.int32)).reshape(-1, 4)


def through_indices(triangles: Triangles, indices: np.ndarray) -> Triangles:
    """Return the triangles over the vertices that `indices` (N,) name."""
    return Triangles(indices[triangles.corners], indices[triangles.provoking])
