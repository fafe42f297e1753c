"""From a run of draws to triangles in the window; equals `geometry.geometry.process_geometry`, see fast/test_batch.py.

Vertices, lighting and assembly of all draws take three calls of kernels; clipping and setup are those of single draws.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from softshadow import tokens as gl
from softshadow.framebuffer import Framebuffer, Storage
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.fast.batch.assembly import assemble_draws, triangle_count
from softshadow.pipeline.fast.batch.lighting import PLACED_COLUMNS
from softshadow.pipeline.fast.batch.table import Run, Table, table_of
from softshadow.pipeline.fast.batch.vertices import END, prepare_draws, process_vertices
from softshadow.pipeline.geometry.clip import clip_triangles
from softshadow.pipeline.geometry.geometry import filled_geometry, user_planes, window_transform
from softshadow.pipeline.geometry.program import program_of
from softshadow.pipeline.geometry.triangle_setup import NO_TRIANGLES
from softshadow.pipeline.geometry.vertex import VERTICES_PER_SPARE, append_rows, scale_and_shift, to_window
from softshadow.pipeline.memory.scratch import scratch
from softshadow.pipeline.memory.threads import parts_of, share
from softshadow.pipeline.records import Geometry

REAL = np.dtype(np.float32)


def geometry_of(run: Run, draws: Sequence[Draw], target: Framebuffer, storage: Storage) -> Geometry:
    """Return the triangles of all draws of a run, in drawing order, in the window of `target`."""
    command = run.command
    table = table_of(run, draws)
    clip, codes, window, values, back = _process_vertices(run, table, command, target)
    triangles, provoking = _assemble(table, draws, codes)
    k = values.shape[1]
    columns = values if back is None else np.hstack([values, back])
    clipped = clip_triangles(clip, columns, triangles, codes, user_planes(command))
    if len(clipped.clip) > len(clip):  # the new vertices of clipping come last
        window = append_rows(window, to_window(clipped.clip[len(clip) :], *window_transform(command, target)))
    program, uniforms = program_of(command, storage)
    geometry = Geometry(
        NO_TRIANGLES,
        window,
        np.ascontiguousarray(clipped.values[:, :k]),
        None if back is None else np.ascontiguousarray(clipped.values[:, k:]),
        _flat_columns(run, k),
        clipped.source,
        provoking[clipped.source],
        program,
        uniforms,
    )
    return filled_geometry(geometry, clipped, command, target, command.state.cull)


def _process_vertices(
    run: Run, table: Table, command: Draw, target: Framebuffer
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray | None]:
    """Return clip positions, clip codes, window positions, and the varyings of front and back faces."""
    layout, n = table.layout, int(table.numbers[-1, END])
    k = (7 if layout.separate else 4) + 4 * layout.units + layout.fog
    clip, codes, values = scratch((n, 4), REAL), scratch(n, np.int32), scratch((n, k), REAL)
    window = np.empty((n + n // VERTICES_PER_SPARE, 4), REAL)[:n]
    back = scratch((n, k), REAL) if layout.two_side else None
    placed = np.zeros((len(table.rows), table.lights.shape[1], PLACED_COLUMNS), REAL)
    prepare_draws(layout, table.numbers, table.rows, table.lights, table.flags, placed)
    scale, shift = scale_and_shift(*window_transform(command, target), REAL)
    parts = parts_of(n)
    share(
        lambda part: process_vertices(
            *parts[part], layout, table.numbers, table.rows, table.lights, table.materials, table.flags, placed,
            table.generated, table.planes, table.unit_rows, table.positions, table.colors, table.normals,
            table.texcoords, scale, shift, clip, codes, window, values, values if back is None else back,
        ),
        len(parts),
    )  # fmt: skip
    return clip, codes, window, values, back


def _assemble(table: Table, draws: Sequence[Draw], codes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the triangles (T, 3) of all draws over the vertices of the table, and their provoking vertices (T,)."""
    if len(draws) == 1 and draws[0].mode == gl.GL_TRIANGLES and draws[0].indices is not None:
        indices = table.indices[: len(table.indices) // 3 * 3].reshape(-1, 3)
        return indices, indices[:, 2]
    most = sum(
        triangle_count(draw.mode, len(draw.vertices.position) if draw.indices is None else len(draw.indices))
        for draw in draws
    )
    triangles, provoking = scratch((most, 3), np.int32), scratch(most, np.int32)
    assemble_draws(table.numbers, table.indices, codes, triangles, provoking)
    return triangles, provoking


def _flat_columns(run: Run, k: int) -> np.ndarray:
    """Return which columns of the varyings are not interpolated (`programs.fixed_function.process_vertices`)."""
    flat, lighting = np.zeros(k, bool), run.state.lighting
    n_color = k - 4 * len(run.units) - int(run.writes_color and run.state.fog.enabled)
    one_color = not lighting.enabled and not run.arrays.color
    flat[:n_color] = lighting.shade_model == gl.GL_FLAT or one_color
    for n, unit in enumerate(run.units):
        generates = any(gen.enabled for gen in run.state.units[unit.index].gen)
        is_constant = not run.arrays.texcoords[n] and run.arrays.identities[n] and not generates
        flat[n_color + 4 * n : n_color + 4 * n + 4] = is_constant
    return flat
