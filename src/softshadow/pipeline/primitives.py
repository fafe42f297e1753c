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
# ... but a batch of vertices of which one needs clipping is cut the other way (Mesa, draw_decompose_tmp.h)
CLIPPED_QUAD = ((0, 1, 3, 3), (1, 2, 3, 3))
CLIPPED_QUAD_OF_STRIP = ((2, 0, 3, 3), (0, 1, 3, 3))
BATCH, INDEXED_BATCH = 4096, 1024  # vertices that llvmpipe handles at a time (draw_pt_vsplit.c)
STRIP_PAIR = ((0, 1, 2, 2), (2, 1, 3, 3))  # the odd triangle is (i+1, i, i+2), so that both turn the same way


def assemble(mode: int, count: int, clipped: np.ndarray | None = None) -> Triangles:
    """Return the triangles that `count` vertices make; vertices that complete no primitive are dropped.

    Parameters
    ----------
    mode : GL_TRIANGLES ... GL_POLYGON
    clipped : (quads,) bool, optional
        For quads and quad strips: which of them are drawn in a batch that is clipped.

    References
    ----------
    GL 2.1, sec. 2.6.1 (primitives) and 2.14.7 (flat shading).
    """
    if mode == gl.GL_TRIANGLES:
        rows = _repeat(TRIANGLE, count // 3, 3)
    elif mode in (gl.GL_QUADS, gl.GL_QUAD_STRIP):
        whole, cut = (QUAD, CLIPPED_QUAD) if mode == gl.GL_QUADS else (QUAD_OF_STRIP, CLIPPED_QUAD_OF_STRIP)
        quads, stride = quads_of(mode, count)
        rows = _repeat(whole, quads, stride)
        if clipped is not None:
            chosen = np.repeat(clipped, 2)
            rows[chosen] = _repeat(cut, quads, stride)[chosen]
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


def quads_of(mode: int, count: int) -> tuple[int, int]:
    """Return how many quads `count` vertices make, and how many vertices apart they start."""
    return (count // 4, 4) if mode == gl.GL_QUADS else (max(count // 2 - 1, 0), 2)


def in_clipped_batch(mode: int, needs_clipping: np.ndarray, indexed: bool) -> np.ndarray:
    """Return, per quad, whether its batch has a vertex that needs clipping; `needs_clipping` is (N,) bool, in draw order."""
    quads, stride = quads_of(mode, len(needs_clipping))
    step = (INDEXED_BATCH if indexed else BATCH) - (4 - stride)  # batches of a strip share their last two vertices
    starts = np.arange(0, max(len(needs_clipping), 1), step)
    batches = np.array([needs_clipping[at : at + step + 4 - stride].any() for at in starts])
    return batches[np.arange(quads) * stride // step]


def _repeat(pattern: tuple[tuple[int, ...], ...], primitives: int, stride: int) -> np.ndarray:
    first = np.arange(primitives, dtype=np.int32) * stride
    return (first[:, None, None] + np.array(pattern, np.int32)).reshape(-1, 4)


def through_indices(triangles: Triangles, indices: np.ndarray) -> Triangles:
    """Return the triangles over the vertices that `indices` (N,) name."""
    return Triangles(indices[triangles.corners], indices[triangles.provoking])
