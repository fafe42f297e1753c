"""The primitives of a draw over its vertices, cut and left out as llvmpipe does it."""

from __future__ import annotations

import numpy as np

from softshadow import matrices
from softshadow import tokens as gl
from softshadow.framebuffer import Framebuffer
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.geometry.assembly import Triangles, assemble, separate, through_indices
from softshadow.pipeline.geometry.clip import outcodes
from softshadow.pipeline.geometry.lines import LINES, assemble_lines
from softshadow.pipeline.geometry.polygon_mode import is_filled
from softshadow.pipeline.geometry.vertex import to_clip, to_window
from softshadow.pipeline.mesa.quad_cuts import in_clipped_segment, quads_of
from softshadow.pipeline.mesa.rectangles import ALL, is_left_out, segment_of_three


def triangles_of(command: Draw, target: Framebuffer, codes: np.ndarray, planes: np.ndarray, across: bool) -> Triangles:
    """Return the assembled triangles of a draw without those that llvmpipe leaves out.

    `codes` (V,) are the outcodes of the vertices, `planes` (P, 4) the user's clip planes; `across` as in
    `assembled_triangles`.
    """
    joined = joined_needs_clipping(command, planes)
    assembled = assembled_triangles(command, codes != 0, joined, across)
    if is_filled(command.state) and not across and three_are_left_out(command, target, planes):
        return without_last_three(command, assembled)
    return assembled


def joined_needs_clipping(command: Draw, planes: np.ndarray) -> np.ndarray | None:
    """Return which vertices (N,) of all joined draws need clipping; None where the draw is not joined to others."""
    if command.joined_positions is None:
        return None
    clip = to_clip(matrices.multiply(command.projection, command.modelview), command.joined_positions)
    return outcodes(clip, command.state.depth.clamp, planes) != 0


def assembled_triangles(
    command: Draw, needs_clipping: np.ndarray, in_joined: np.ndarray | None = None, across: bool = False
) -> Triangles:
    """Return the triangles of a draw over its vertices.

    `needs_clipping` (V,) bool; `in_joined` (N,) the same for all joined draws; `across`
    says to cut quads along the other diagonal (`Varyings.flat_input`).
    """
    indices = command.indices
    if command.mode == gl.GL_TRIANGLES and indices is not None:
        return separate(indices)
    count = len(needs_clipping) if indices is None else len(indices)
    if command.mode not in (gl.GL_QUADS, gl.GL_QUAD_STRIP):
        assembled = assemble(command.mode, count)
    else:
        whole = needs_clipping if in_joined is None else in_joined
        clipped = in_clipped_segment(command.mode, whole, indices) if whole.any() else None
        if clipped is not None and in_joined is not None:
            clipped = clipped[command.joined_start // 4 :][: count // 4]
        if not is_filled(command.state):
            clipped = np.ones(quads_of(command.mode, count)[0], bool)  # cut where clipped ones are
        assembled = assemble(command.mode, count, clipped, across=across or indices is not None)
    return assembled if indices is None else through_indices(assembled, indices)


def three_are_left_out(command: Draw, target: Framebuffer, planes: np.ndarray) -> bool:
    """Return whether the last three triangles of the joined draws are ones that llvmpipe does not draw."""
    positions = command.vertices.position if command.joined_positions is None else command.joined_positions
    first = segment_of_three(len(positions))
    if command.mode != gl.GL_TRIANGLES or command.indices is not None or first < 0:
        return False
    clip = to_clip(matrices.multiply(command.projection, command.modelview), positions[first : first + ALL])
    if outcodes(clip, command.state.depth.clamp, planes).any():
        return False
    return is_left_out(to_window(clip, command.state.viewport, target.size[1], target.flipped))


def without_last_three(command: Draw, assembled: Triangles) -> Triangles:
    """Return the triangles of a draw without the last three of the joined draws."""
    count = len(command.vertices.position if command.joined_positions is None else command.joined_positions)
    end = max(segment_of_three(count) - command.joined_start, 0) // 3
    return Triangles(assembled.corners[:end], assembled.provoking[:end])


def primitive_count(command: Draw) -> int:
    """Return how many triangles, lines or points a draw has before clipping."""
    if command.mode in (gl.GL_POINTS, *LINES):
        return len(lines_or_points_of(command))
    count = len(command.vertices.position) if command.indices is None else len(command.indices)
    return len(assemble(command.mode, count).corners)


def lines_or_points_of(command: Draw) -> np.ndarray:
    """Return the lines (L, 2) or points (P, 1) of a draw over its vertices."""
    indices = command.indices
    count = len(command.vertices.position) if indices is None else len(indices)
    if command.mode == gl.GL_POINTS:
        primitives = np.arange(count, dtype=np.int32)[:, None]
    else:
        primitives = assemble_lines(command.mode, count)
    return primitives if indices is None else indices[primitives]
