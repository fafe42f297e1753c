"""Primitive assembly: the triangles of each primitive, in GL's order."""

from typing import NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.pipeline.mesa.segments import QUADS_OF_SEGMENT, quads_and_stride


class Triangles(NamedTuple):
    """Assembled triangles.

    corners (T, 3) int32: vertex numbers, in drawing order; provoking (T,) int32: the vertex that gives flat colours.
    """

    corners: np.ndarray
    provoking: np.ndarray


# Each row: vertices of one triangle relative to the first vertex of its primitive, then the provoking one. The order of
# the vertices decides the last bits of interpolated values, so it is llvmpipe's (docs/exactness.md, 5).
QUAD = ((0, 1, 2, 3), (0, 2, 3, 3))
QUAD_ACROSS = ((0, 1, 3, 3), (1, 2, 3, 3))  # cut along the other diagonal
QUAD_OF_STRIP = ((0, 1, 3, 3), (2, 0, 3, 3))
CLIPPED_QUAD_OF_STRIP = ((2, 0, 3, 3), (0, 1, 3, 3))  # the same diagonal, but the other triangle comes first
STRIP_PAIR = ((0, 1, 2, 2), (2, 1, 3, 3))  # the odd triangle is (i+1, i, i+2), so that both turn the same way
# With GL_FIRST_VERTEX_CONVENTION the provoking vertex comes first; of quads it stays the last one.
FIRST_OF_QUAD = ((3, 0, 1, 3), (3, 1, 2, 3))
FIRST_OF_QUAD_STRIP = ((3, 0, 1, 3), (3, 2, 0, 3))
FIRST_OF_CLIPPED_QUAD_STRIP = ((3, 2, 0, 3), (3, 0, 1, 3))
FIRST_OF_STRIP_PAIR = ((0, 1, 2, 0), (1, 3, 2, 1))


def assemble(
    mode: int,
    n_vertices: int,
    in_clipped_segment: np.ndarray | None = None,
    across: bool = False,
    first_provokes: bool = False,
) -> Triangles:
    """Return the triangles that a number of vertices make; incomplete primitives are dropped.

    Parameters
    ----------
    mode : GL_TRIANGLES ... GL_POLYGON
    in_clipped_segment : (Q,) bool, optional
        For quads and quad strips: which of them lie in a segment with a vertex that needs clipping. Mesa cuts these in
        another way (draw_decompose_tmp.h).
    across : bool
        Cut all quads along the other diagonal, as Mesa does for indexed and flat-shaded ones.
    first_provokes : bool
        GL_FIRST_VERTEX_CONVENTION: the provoking vertex is the first corner of each triangle.

    References
    ----------
    GL 2.1, sec. 2.6.1 (primitives) and 2.14.7 (flat shading).
    """
    if mode == gl.GL_TRIANGLES:
        return separate_triangles(np.arange(n_vertices, dtype=np.int32), first_provokes)
    if mode in (gl.GL_QUADS, gl.GL_QUAD_STRIP):
        rows = _quads(mode, n_vertices, in_clipped_segment, across, first_provokes)
    elif mode == gl.GL_TRIANGLE_STRIP:
        n_triangles = max(n_vertices - 2, 0)
        rows = _repeat(FIRST_OF_STRIP_PAIR if first_provokes else STRIP_PAIR, (n_triangles + 1) // 2, 2)[:n_triangles]
    else:
        rows = np.stack(_fan(mode, n_vertices, first_provokes), axis=1)
    rows = np.ascontiguousarray(rows, np.int32)
    return Triangles(np.ascontiguousarray(rows[:, :3]), np.ascontiguousarray(rows[:, 3]))


def _fan(mode: int, n_vertices: int, first_provokes: bool) -> tuple[np.ndarray, ...]:
    """Return the three corners and the provoking vertex of the triangles of a fan or polygon."""
    middle = np.arange(1, max(n_vertices - 1, 1), dtype=np.int32)
    first, last = np.zeros_like(middle), middle + 1
    if mode == gl.GL_POLYGON:
        return (first, middle, last, first) if first_provokes else (middle, last, first, first)
    return (middle, last, first, middle) if first_provokes else (first, middle, last, last)


def separate_triangles(order: np.ndarray, first_provokes: bool = False) -> Triangles:
    """Return a triangle for each three vertices of `order` (N,), as views of it: a mesh may have millions."""
    corners = order[: len(order) // 3 * 3].reshape(-1, 3)
    return Triangles(corners, corners[:, 0 if first_provokes else 2])


def edge_flags(mode: int, n_triangles: int, first_provokes: bool = False) -> np.ndarray:
    """Return which edges of the assembled triangles are edges of the primitives.

    (T, 3) uint8, for the edges from corner i to corner i + 1; quads are cut as in a clipped segment. glPolygonMode does
    not draw the diagonals of quads and polygons, but it draws the edges between the triangles of a strip or fan.
    """
    edges = np.ones((n_triangles, 3), np.uint8)
    if mode in (gl.GL_QUADS, gl.GL_QUAD_STRIP):
        edges[0::2, 1] = edges[1::2, 2] = 0
    elif mode == gl.GL_POLYGON:
        edges[1:, 2] = edges[:-1, 1] = 0
    else:
        return edges
    # the same edges, with the last corner put first
    return np.ascontiguousarray(np.roll(edges, 1, axis=1)) if first_provokes else edges


def edges_of_joined_polygons(corners: np.ndarray) -> np.ndarray:
    """Return what `edge_flags` returns of each polygon, for the triangles (T, 3) of polygons in a row."""
    first = corners[:, 2]
    is_last = np.append(first[1:] != first[:-1], True)[: len(corners)]
    return np.stack([np.ones(len(corners), bool), is_last, corners[:, 0] == first + 1], axis=1).view(np.uint8)


def quads_of_joined_strips(corners: np.ndarray) -> np.ndarray:
    """Return the first triangles (Q,) of the quads of quad strips, among the triangles (T, 3) of strips and fans.

    The corners are those without clipping. Where two triangles of a fan or of a triangle strip look like a quad's, both
    have no area.
    """
    first, second = corners[:-1], corners[1:]
    found = np.flatnonzero((first[:, 0] == second[:, 1]) & (first[:, 2] == second[:, 2]))
    if np.all(np.diff(found) > 1):
        return found
    quads: list[int] = []  # equal vertices of a list: the second triangle of one quad and the first of the next
    for triangle in found.tolist():
        if not quads or triangle > quads[-1] + 1:
            quads.append(triangle)
    return np.array(quads)


def order_of_joined_strips(corners: np.ndarray, needs_clipping: np.ndarray, in_stages: bool) -> np.ndarray:
    """Return the order of the triangles (T, 3) of strips and fans in a row: (T,), as in a draw of each.

    The corners are those without clipping. `needs_clipping` (V,) bool, of all vertices; `in_stages`: the triangles pass
    Mesa's stages, and all quads are cut like clipped ones.
    """
    order = np.arange(len(corners))
    if not (in_stages or needs_clipping.any()):
        return order
    quads = quads_of_joined_strips(corners)
    if not in_stages:
        before, after = corners[quads][:, :2], corners[quads + 1][:, ::2]  # first and last edge of each quad
        goes_on = (np.diff(quads) == 2) & (before[1:] == after[:-1]).all(axis=1)
        begins = np.append(True, ~goes_on)[: len(quads)]
        numbers = np.arange(len(quads))
        in_strip = numbers - np.maximum.accumulate(np.where(begins, numbers, 0))
        segment = np.cumsum(begins | (in_strip % QUADS_OF_SEGMENT == 0)) - 1
        needs = needs_clipping[before].any(axis=1) | needs_clipping[after].any(axis=1)
        quads = quads[np.bincount(segment, needs)[segment] > 0]
    order[quads], order[quads + 1] = quads + 1, quads
    return order


def begins_stipple(mode: int, n_triangles: int) -> np.ndarray:
    """Return which of the assembled triangles (T,) begin a primitive: there the line stipple begins anew."""
    begins = np.ones(n_triangles, bool)
    if mode in (gl.GL_QUADS, gl.GL_QUAD_STRIP):
        begins[1::2] = False
    elif mode == gl.GL_POLYGON:
        begins[1:] = False
    return begins


def pieces_begin_stipple(
    begins: np.ndarray, needs_clipping: np.ndarray, corners: np.ndarray, source: np.ndarray
) -> np.ndarray:
    """Return which pieces of clipped triangles begin the line stipple anew, (T',) bool.

    `begins` (T,) of the assembled triangles, with their `corners` (T, 3); `needs_clipping` (V,) bool, of the vertices;
    `source` (T',): the triangle that each piece comes from. Mesa lets the first piece of a triangle that is cut begin.
    """
    cut = needs_clipping[corners].any(axis=1)[source]
    return np.where(cut, np.diff(source, prepend=-1) != 0, begins[source])


def _quads(
    mode: int, n_vertices: int, in_clipped_segment: np.ndarray | None, across: bool, first_provokes: bool
) -> np.ndarray:
    if mode == gl.GL_QUADS:
        cuts = (FIRST_OF_QUAD, FIRST_OF_QUAD) if first_provokes else (QUAD_ACROSS if across else QUAD, QUAD_ACROSS)
    elif first_provokes:
        cuts = FIRST_OF_QUAD_STRIP, FIRST_OF_CLIPPED_QUAD_STRIP
    else:
        cuts = QUAD_OF_STRIP, CLIPPED_QUAD_OF_STRIP
    unclipped_cut, clipped_cut = cuts
    n_quads, stride = quads_and_stride(mode, n_vertices)
    rows = _repeat(unclipped_cut, n_quads, stride)
    if in_clipped_segment is not None:
        triangle_rows = np.repeat(in_clipped_segment, 2)
        rows[triangle_rows] = _repeat(clipped_cut, n_quads, stride)[triangle_rows]
    return rows


def _repeat(pattern: tuple[tuple[int, ...], ...], n_primitives: int, stride: int) -> np.ndarray:
    first = np.arange(n_primitives, dtype=np.int32) * stride
    return (first[:, None, None] + np.array(pattern, np.int32)).reshape(-1, 4)


def through_indices(triangles: Triangles, indices: np.ndarray) -> Triangles:
    """Return the triangles over the vertices that `indices` (N,) name."""
    return Triangles(indices[triangles.corners], indices[triangles.provoking])
