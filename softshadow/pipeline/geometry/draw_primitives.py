"""The primitives of a draw over its vertices; llvmpipe decides how quads are cut and which triangles are left out."""

from __future__ import annotations

import numpy as np

from softshadow import matrices
from softshadow import tokens as gl
from softshadow.framebuffer import Framebuffer
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.geometry.assembly import (
    Triangles,
    assemble,
    edge_flags,
    edges_of_joined_polygons,
    order_of_joined_strips,
    separate_triangles,
    through_indices,
)
from softshadow.pipeline.geometry.clip import NO_STAGES, outcodes
from softshadow.pipeline.geometry.lines import LINES, assemble_lines
from softshadow.pipeline.geometry.vertex import to_clip, to_window
from softshadow.pipeline.mesa.polygon_rules import passes_stages
from softshadow.pipeline.mesa.provoking_vertex import first_provokes
from softshadow.pipeline.mesa.rectangles import LAST_NINE, is_left_out, start_of_last_nine
from softshadow.pipeline.mesa.segments import in_clipped_segment, quads_and_stride


def triangles_of(command: Draw, target: Framebuffer, codes: np.ndarray, planes: np.ndarray, across: bool) -> Triangles:
    """Return the triangles of a draw, without those that llvmpipe leaves out.

    `codes` (V,) are the outcodes of the vertices, `planes` (P, 4) the user's clip planes; `across`: see
    `assembled_triangles`.
    """
    joined_needs, flags = joined_needs_clipping(command, planes), clipping_flags(command)
    needs = codes != 0 if flags is None else (codes != 0) | flags
    assembled = assembled_triangles(command, needs, joined_needs, across)
    in_setup = flags is None and not passes_stages(command.state)
    if in_setup and not across and last_three_are_left_out(command, target, planes):
        return without_last_three(command, assembled)
    return assembled


def clipping_flags(command: Draw) -> np.ndarray | None:
    """Return the edge flags (V,) bool where a true one takes the way of clipped vertices; None where flags do not.

    Mesa's vertex program writes flags of vertices where a polygon mode is not GL_FILL, though all faces of that mode be
    culled, and llvmpipe keeps a flag beside the clip codes: where any of them is set, it takes the stages that clip
    (draw_llvm.c, generate_clipmask).
    """
    flags, polygon = command.vertices.edges, command.state.polygon
    has_modes = polygon.mode_front != gl.GL_FILL or polygon.mode_back != gl.GL_FILL
    return flags if has_modes and flags is not None and flags.strides[0] else None


def triangles_in_stages(command: Draw, codes: np.ndarray, planes: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Return which assembled triangles (T, 3) of filled polygons pass Mesa's stages, (T,) uint8; empty for none.

    Those of the segments in which a vertex needs clipping do (`mesa.segments`).
    """
    joined_needs = joined_needs_clipping(command, planes)
    needs = codes != 0 if joined_needs is None else joined_needs
    if not needs.any() or not len(corners):
        return NO_STAGES
    if command.pairs_mode:  # each strip, fan or polygon is a segment: no other one has its vertices
        begins = np.append(True, corners.min(axis=1)[1:] > np.maximum.accumulate(corners.max(axis=1))[:-1])
        pair = np.cumsum(begins) - 1
        return (np.bincount(pair, needs[corners].any(axis=1)) > 0)[pair].view(np.uint8)
    clipped = in_clipped_segment(command.mode, needs, command.indices)
    are_quads = command.mode in (gl.GL_QUADS, gl.GL_QUAD_STRIP)
    first = command.joined_start // (2 if are_quads else 3)  # of all joined draws, which are of quads or triangles
    return (np.repeat(clipped, 2) if are_quads else clipped)[first : first + len(corners)].view(np.uint8)


def joined_needs_clipping(command: Draw, planes: np.ndarray) -> np.ndarray | None:
    """Return which vertices (N,) of all joined draws need clipping; None for a draw that is not joined."""
    if command.joined_positions is None:
        return None
    clip = to_clip(matrices.multiply(command.projection, command.modelview), command.joined_positions)
    return outcodes(clip, command.state.depth.clamp, planes) != 0


def assembled_triangles(
    command: Draw, needs_clipping: np.ndarray, joined_needs_clipping: np.ndarray | None = None, across: bool = False
) -> Triangles:
    """Return the triangles of a draw over its vertices.

    `needs_clipping` (V,) bool, of the draw's vertices; `joined_needs_clipping` (N,), of the vertices of all joined
    draws; `across`: cut quads along the other diagonal (`Varyings.flat_input`).
    """
    indices, first = command.indices, first_provokes(command.state)
    if command.mode == gl.GL_TRIANGLES and indices is not None:
        triangles = separate_triangles(indices, first)
        if command.pairs_mode != gl.GL_QUAD_STRIP:
            return triangles
        order = order_of_joined_strips(triangles.corners, needs_clipping, passes_stages(command.state))
        return Triangles(triangles.corners[order], triangles.provoking[order])
    n_vertices = len(needs_clipping) if indices is None else len(indices)
    if command.mode not in (gl.GL_QUADS, gl.GL_QUAD_STRIP):
        if command.mode == gl.GL_TRIANGLE_FAN and n_vertices == 4 and not across:
            first = first and not _as_rectangle(command, needs_clipping)
        assembled = assemble(command.mode, n_vertices, first_provokes=first)
    else:
        all_needs_clipping = needs_clipping if joined_needs_clipping is None else joined_needs_clipping
        clipped_quads = (
            in_clipped_segment(command.mode, all_needs_clipping, indices) if all_needs_clipping.any() else None
        )
        if clipped_quads is not None and joined_needs_clipping is not None:
            clipped_quads = clipped_quads[command.joined_start // 4 :][: n_vertices // 4]
        if passes_stages(command.state):
            clipped_quads = np.ones(quads_and_stride(command.mode, n_vertices)[0], bool)  # cut like clipped ones
        across = across or indices is not None
        assembled = assemble(command.mode, n_vertices, clipped_quads, across=across, first_provokes=first)
    return assembled if indices is None else through_indices(assembled, indices)


def _as_rectangle(command: Draw, needs_clipping: np.ndarray) -> bool:
    """Return whether llvmpipe tries a fan of two triangles as a rectangle, whatever the convention."""
    return command.indices is None and not needs_clipping.any() and not passes_stages(command.state)


def drawn_edges(command: Draw, corners: np.ndarray) -> np.ndarray:
    """Return which edges of triangles (T, 3) glPolygonMode draws, (T, 3) uint8: from corner i to corner i + 1."""
    flags = command.vertices.edges
    if command.pairs_mode == gl.GL_POLYGON:
        edges = edges_of_joined_polygons(corners)
    else:
        mode = gl.GL_QUAD_STRIP if command.pairs_mode == gl.GL_QUAD_STRIP else command.mode
        edges = edge_flags(mode, len(corners), first_provokes(command.state))
    return edges if flags is None else np.ascontiguousarray(edges & flags[corners].astype(np.uint8))


def has_no_edges(command: Draw) -> bool:
    """Return whether the edge flag of all vertices is one current value, GL_FALSE."""
    flags = command.vertices.edges
    return flags is not None and flags.strides[0] == 0 and not flags.any()


def last_three_are_left_out(command: Draw, target: Framebuffer, planes: np.ndarray) -> bool:
    """Return whether llvmpipe leaves out the last three triangles of the joined draws."""
    positions = command.vertices.position if command.joined_positions is None else command.joined_positions
    first = start_of_last_nine(len(positions))
    if command.mode != gl.GL_TRIANGLES or command.indices is not None or first < 0:
        return False
    clip = to_clip(matrices.multiply(command.projection, command.modelview), positions[first : first + LAST_NINE])
    if outcodes(clip, command.state.depth.clamp, planes).any():
        return False
    return is_left_out(to_window(clip, command.state.viewport, target.size[1], target.flipped))


def without_last_three(command: Draw, assembled: Triangles) -> Triangles:
    """Return the triangles of a draw without the last three of the joined draws."""
    n_vertices = len(command.vertices.position if command.joined_positions is None else command.joined_positions)
    end_triangle = max(start_of_last_nine(n_vertices) - command.joined_start, 0) // 3
    return Triangles(assembled.corners[:end_triangle], assembled.provoking[:end_triangle])


def primitive_count(command: Draw) -> int:
    """Return the number of triangles, lines or points of a draw before clipping."""
    if command.mode in (gl.GL_POINTS, *LINES):
        return len(lines_or_points_of(command))
    n_vertices = len(command.vertices.position) if command.indices is None else len(command.indices)
    return len(assemble(command.mode, n_vertices).corners)


def lines_or_points_of(command: Draw) -> np.ndarray:
    """Return the lines (L, 2) or points (P, 1) of a draw over its vertices."""
    indices = command.indices
    n_vertices = len(command.vertices.position) if indices is None else len(indices)
    if command.mode == gl.GL_POINTS:
        primitives = np.arange(n_vertices, dtype=np.int32)[:, None]
    else:
        primitives = assemble_lines(command.mode, n_vertices)
    return primitives if indices is None else indices[primitives]
