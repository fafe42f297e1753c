"""Primitive assembly: which vertices make which triangle, in GL's order."""

from typing import NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.pipeline.mesa.quad_cuts import quads_of


class Triangles(NamedTuple):
    """corners (T, 3) int32 vertex numbers in drawing order;

    Provoking (T,) int32: the vertex that gives flat colours.
    """

    corners: np.ndarray
    provoking: np.ndarray


# Each row: vertices of one triangle relative to the first vertex of its primitive, then the provoking one. The order of
# the vertices decides the last bits of interpolated values, so it is llvmpipe's (docs/exactness.md, 5).
QUAD = ((0, 1, 2, 3), (0, 2, 3, 3))
QUAD_ACROSS = ((0, 1, 3, 3), (1, 2, 3, 3))  # cut along the other diagonal
QUAD_OF_STRIP = ((0, 1, 3, 3), (2, 0, 3, 3))
CLIPPED_QUAD_OF_STRIP = ((2, 0, 3, 3), (0, 1, 3, 3))  # the same cut, but the other triangle comes first
STRIP_PAIR = ((0, 1, 2, 2), (2, 1, 3, 3))  # the odd triangle is (i+1, i, i+2), so that both turn the same way


def assemble(mode: int, count: int, clipped: np.ndarray | None = None, across: bool = False) -> Triangles:
    """Return the triangles that `count` vertices make; vertices that complete no primitive are dropped.

    Parameters
    ----------
    mode : GL_TRIANGLES ... GL_POLYGON
    clipped : (quads,) bool, optional
        For quads and quad strips: which of them are drawn in a batch that is clipped; they are cut in Mesa's other way
        (draw_decompose_tmp.h).
    across : bool
        Cut all quads along the other diagonal, as Mesa does for indexed and flat-shaded ones.

    References
    ----------
    GL 2.1, sec. 2.6.1 (primitives) and 2.14.7 (flat shading).
    """
    if mode == gl.GL_TRIANGLES:
        return separate(np.arange(count, dtype=np.int32))
    if mode in (gl.GL_QUADS, gl.GL_QUAD_STRIP):
        rows = _quads(mode, count, clipped, across)
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


def separate(order: np.ndarray) -> Triangles:
    """Return the triangles that each three vertices of `order` (N,) make, as views of it: a mesh may have millions."""
    corners = order[: len(order) // 3 * 3].reshape(-1, 3)
    return Triangles(corners, corners[:, 2])


def edge_flags(mode: int, triangles: int) -> np.ndarray:
    """Return which edges of the assembled triangles, from corner i to i + 1, are edges of the primitives.

    (T, 3) uint8; quads are cut as in a clipped batch. glPolygonMode does not draw the diagonals of quads and polygons,
    but it does draw what lies between the triangles of a strip or fan.
    """
    edges = np.ones((triangles, 3), np.uint8)
    if mode in (gl.GL_QUADS, gl.GL_QUAD_STRIP):
        edges[0::2, 1] = edges[1::2, 2] = 0
    elif mode == gl.GL_POLYGON:
        edges[1:, 2] = edges[:-1, 1] = 0
    return edges


def _quads(mode: int, count: int, clipped: np.ndarray | None, across: bool) -> np.ndarray:
    whole, cut = (QUAD, QUAD_ACROSS) if mode == gl.GL_QUADS else (QUAD_OF_STRIP, CLIPPED_QUAD_OF_STRIP)
    quads, stride = quads_of(mode, count)
    rows = _repeat(QUAD_ACROSS if across and mode == gl.GL_QUADS else whole, quads, stride)
    if clipped is not None:
        chosen = np.repeat(clipped, 2)
        rows[chosen] = _repeat(cut, quads, stride)[chosen]
    return rows


def _repeat(pattern: tuple[tuple[int, ...], ...], primitives: int, stride: int) -> np.ndarray:
    first = np.arange(primitives, dtype=np.int32) * stride
    return (first[:, None, None] + np.array(pattern, np.int32)).reshape(-1, 4)


def through_indices(triangles: Triangles, indices: np.ndarray) -> Triangles:
    """Return the triangles over the vertices that `indices` (N,) name."""
    return Triangles(indices[triangles.corners], indices[triangles.provoking])
