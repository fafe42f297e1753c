"""The primitives of a draw as selection and feedback see them: clipped, culled, with polygon offset, in the window.

Mesa runs its vertex pipeline for these modes, without a rasterizer behind it (st_cb_feedback.c, draw_pipe_*.c). All
polygons are triangles.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.framebuffer import Storage
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.geometry.assembly import edge_flags
from softshadow.pipeline.geometry.clip import Clipped, clip_triangles
from softshadow.pipeline.geometry.draw_primitives import assembled_triangles, lines_or_points_of
from softshadow.pipeline.geometry.geometry import positions_of, vertex_outputs, window_transform
from softshadow.pipeline.geometry.lines import LINES, clip_lines
from softshadow.pipeline.geometry.points import clip_points
from softshadow.pipeline.geometry.polygon_mode import is_filled, outline
from softshadow.pipeline.geometry.vertex import to_window
from softshadow.programs.fixed_function import is_separate

F32 = np.float32
TWICE_FIRST = (gl.GL_QUADS, gl.GL_QUAD_STRIP)  # two triangles each; the first one begins the primitive


class WindowPrimitives(NamedTuple):
    """Points, lines and triangles with 1, 2 or 3 vertices each, in drawing order.

    window (V, 4) float32: x, y (upwards), depth, clip w; colors, texcoords (V, 4) float32; primitives: vertex numbers,
    and whether a line begins a stipple pattern.
    """

    window: np.ndarray
    colors: np.ndarray
    texcoords: np.ndarray
    primitives: list[tuple[list[int], bool]]


def window_primitives(command: Draw, storage: Storage) -> WindowPrimitives:
    """Return the primitives of a draw in the window."""
    target = storage.framebuffers[command.state.draw_framebuffer]
    with np.errstate(all="ignore"):  # as in pipeline.draw
        values, back = _values(command, storage)
        clip, codes, window, planes = positions_of(command, target)
        columns = values if back is None else np.hstack([values, back])
        if command.mode in (gl.GL_POINTS, *LINES):
            cut = clip_points if command.mode == gl.GL_POINTS else clip_lines
            clipped = cut(clip, columns, lines_or_points_of(command), codes, planes)
            window = to_window(clipped.clip, *window_transform(command, target))
            pieces = [(piece, False) for piece in clipped.triangles.tolist()]
            return _upright(window, clipped.values[:, :8], pieces, target.size[1], target.flipped)
        assembled = assembled_triangles(command, np.ones(len(clip), bool))
        edges = edge_flags(command.mode, len(assembled.corners))
        clipped = clip_triangles(clip, columns, assembled.corners, codes, planes, edges)
        window = np.concatenate([window, to_window(clipped.clip[len(clip) :], *window_transform(command, target))])
        flat = np.zeros(8, bool)
        flat[:4] = command.state.lighting.shade_model == gl.GL_FLAT and not is_filled(command.state)
        outlined = outline(
            window, np.ascontiguousarray(clipped.values[:, :8]),
            None if back is None else np.ascontiguousarray(clipped.values[:, 8:]), flat, clipped.triangles,
            clipped.edges, assembled.provoking[clipped.source], command.state, command.state.cull, target.depth,
            command.offset_slope, command.offset_unit, target.flipped, command.offset_mode,
        )  # fmt: skip
    begins = _begins(command.mode, clipped)
    of_triangle: list[tuple[int, list[int], bool]] = [(t[0] // 3, t, False) for t in outlined.triangles.tolist()]
    last = -1
    for line in outlined.lines.tolist():
        triangle = line[0] // 3
        of_triangle.append((triangle, line, bool(begins[triangle]) and triangle != last))
        last = triangle
    of_triangle += [(point // 3, [point], False) for point in outlined.points.tolist()]
    of_triangle.sort(key=lambda each: each[0])
    pieces = [(vertices, resets) for _, vertices, resets in of_triangle]
    return _upright(outlined.window, outlined.values, pieces, target.size[1], target.flipped)


def _values(command: Draw, storage: Storage) -> tuple[np.ndarray, np.ndarray | None]:
    """Return colour and texture coordinates of unit 0 (V, 8) of front faces, and of back faces if they differ."""
    varyings, program, _ = vertex_outputs(command, storage)
    column = 7 if is_separate(command.state) else 4
    in_use = any(unit.index == 0 for unit in program.units or [])
    texcoords = command.vertices.texcoords[0]

    def chosen(values: np.ndarray) -> np.ndarray:
        rest = values[:, column : column + 4] if in_use else texcoords
        return np.hstack([values[:, :4], rest]).astype(values.dtype)

    return chosen(varyings.values), None if varyings.back is None else chosen(varyings.back)


def _begins(mode: int, clipped: Clipped) -> np.ndarray:
    """Return which triangles (T,) begin a primitive, or are the first piece of one that was clipped."""
    source = clipped.source
    is_first_piece = np.ones(len(source), bool)
    is_first_piece[1:] = source[1:] != source[:-1]
    if mode in TWICE_FIRST:
        first = source % 2 == 0
    elif mode == gl.GL_POLYGON:
        first = source == 0
    else:
        first = np.ones(len(source), bool)
    n_pieces = np.bincount(source) if len(source) else np.zeros(0, int)
    was_cut = n_pieces[source] > 1 if len(source) else np.zeros(0, bool)
    return is_first_piece & (first | was_cut)


def _upright(
    window: np.ndarray, values: np.ndarray, pieces: list[tuple[list[int], bool]], height: int, flipped: bool
) -> WindowPrimitives:
    window = np.array(window, F32)
    if flipped:
        window[:, 1] = F32(height) - window[:, 1]
    with np.errstate(all="ignore"):
        window[:, 3] = F32(1) / window[:, 3]
    return WindowPrimitives(window, values[:, :4].astype(F32), values[:, 4:8].astype(F32), pieces)
