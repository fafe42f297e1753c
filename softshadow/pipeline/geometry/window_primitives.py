"""The primitives of a draw as selection and feedback see them: clipped, culled, with polygon offset, in the window.

Mesa runs its vertex pipeline for these modes, without a rasterizer behind it (st_cb_feedback.c, draw_pipe_*.c). All
polygons are triangles.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.framebuffer import Storage
from softshadow.frozen import evolve
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.geometry.assembly import begins_stipple, pieces_begin_stipple
from softshadow.pipeline.geometry.clip import clip_triangles
from softshadow.pipeline.geometry.draw_primitives import (
    assembled_triangles,
    drawn_edges,
    has_no_edges,
    lines_or_points_of,
)
from softshadow.pipeline.geometry.geometry import positions_of, vertex_outputs, window_transform
from softshadow.pipeline.geometry.lines import LINES, clip_lines
from softshadow.pipeline.geometry.points import clip_points
from softshadow.pipeline.geometry.polygon_mode import Outlined, outline
from softshadow.pipeline.geometry.vertex import to_window
from softshadow.pipeline.mesa.polygon_rules import effective_modes
from softshadow.pipeline.mesa.provoking_vertex import first_provokes
from softshadow.programs.fixed_function import has_secondary
from softshadow.state import State

F32 = np.float32


class WindowPrimitives(NamedTuple):
    """Points, lines and triangles with 1, 2 or 3 vertices each, in drawing order.

    window (V, 4) float32: x, y (upwards), depth, clip w; colors, texcoords (V, 4) float32; primitives: vertex numbers.
    One without vertices means that the next line begins a stipple pattern.
    """

    window: np.ndarray
    colors: np.ndarray
    texcoords: np.ndarray
    primitives: list[list[int]]


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
            values = clipped.values[:, :8]
            if command.mode in LINES and _is_flat(command.state):
                ends = clipped.triangles
                values, window = values[ends].reshape(-1, 8), window[ends].reshape(-1, 4)
                other = slice(0, None, 2) if first_provokes(command.state) else slice(1, None, 2)
                values[0::2, :4] = values[1::2, :4] = values[other, :4].copy()
                clipped = clipped._replace(triangles=np.arange(ends.size).reshape(-1, 2))
            return _upright(window, values, clipped.triangles.tolist(), target.size[1], target.flipped)
        assembled = assembled_triangles(command, np.ones(len(clip), bool))
        edges = drawn_edges(command, assembled.corners)
        clipped = clip_triangles(clip, columns, assembled.corners, codes, planes, edges)
        window = np.concatenate([window, to_window(clipped.clip[len(clip) :], *window_transform(command, target))])
        flat = np.zeros(8, bool)
        flat[:4] = _is_flat(command.state)
        # of the polygon offset only the slope remains: no depth format is set for this pipeline
        state = evolve(command.state, polygon=evolve(command.state.polygon, units=0.0))

        first = begins_stipple(command.mode, len(assembled.corners))
        begins = pieces_begin_stipple(first, codes != 0, assembled.corners, clipped.source)

        def outlined_with(edges: np.ndarray) -> Outlined:
            return outline(
                window, np.ascontiguousarray(clipped.values[:, :8]),
                None if back is None else np.ascontiguousarray(clipped.values[:, 8:]), flat, clipped.triangles,
                edges, assembled.provoking[clipped.source], state, state.cull, target.depth,
                command.offset_slope, command.offset_unit, target.flipped, begins, command.offset_mode,
                has_no_edges(command),
            )  # fmt: skip

        outlined = outlined_with(clipped.edges)
        with_edges = outlined if is_filled(state) else outlined_with(np.ones_like(clipped.edges))
    of_triangle: list[tuple[int, list[int]]] = [(t[0] // 3, t) for t in outlined.triangles.tolist()]
    as_lines = dict.fromkeys((with_edges.lines[:, 0] // 3).tolist())
    of_triangle += [(triangle, []) for triangle in as_lines if begins[triangle]]
    of_triangle += [(line[0] // 3, line) for line in outlined.lines.tolist()]
    of_triangle += [(point // 3, [point]) for point in outlined.points.tolist()]
    of_triangle.sort(key=lambda each: each[0])
    return _upright(
        outlined.window, outlined.values, [vertices for _, vertices in of_triangle], target.size[1], target.flipped
    )


def _values(command: Draw, storage: Storage) -> tuple[np.ndarray, np.ndarray | None]:
    """Return colour and texture coordinates of unit 0 (V, 8) of front faces, and of back faces if they differ."""
    varyings, program, _ = vertex_outputs(command, storage)
    column = 7 if has_secondary(command.state) else 4
    in_use = any(unit.index == 0 for unit in program.units or [])
    texcoords = command.vertices.texcoords[0]

    def chosen(values: np.ndarray) -> np.ndarray:
        rest = values[:, column : column + 4] if in_use else texcoords
        return np.hstack([values[:, :4], rest]).astype(values.dtype)

    return chosen(varyings.values), None if varyings.back is None else chosen(varyings.back)


def _is_flat(state: State) -> bool:
    """Return whether Mesa makes colours flat here: for filled polygons it leaves this to the rasterizer."""
    return state.lighting.shade_model == gl.GL_FLAT and not is_filled(state)


def is_filled(state: State) -> bool:
    """Return whether all polygons that are drawn are filled."""
    return effective_modes(state) == (gl.GL_FILL, gl.GL_FILL)


def _upright(
    window: np.ndarray, values: np.ndarray, pieces: list[list[int]], height: int, flipped: bool
) -> WindowPrimitives:
    window = np.array(window, F32)
    if flipped:
        window[:, 1] = F32(height) - window[:, 1]
    with np.errstate(all="ignore"):
        window[:, 3] = F32(1) / window[:, 3]
    return WindowPrimitives(window, values[:, :4].astype(F32), values[:, 4:8].astype(F32), pieces)
