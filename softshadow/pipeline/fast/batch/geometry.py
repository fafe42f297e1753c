"""From a run of draws to triangles in the window; equals `geometry.geometry.process_geometry`, see fast/test_batch.py.

Vertices, lighting and assembly of all draws take three calls of kernels; clipping and setup are those of single draws.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from itertools import groupby
from operator import attrgetter
from typing import Any, NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.framebuffer import Framebuffer, Storage
from softshadow.jit import read_only
from softshadow.pipeline.alike_draws import of_each, vertex_counts
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.fast.batch.admission import least_compared
from softshadow.pipeline.fast.batch.assembly import (
    WIDTH_OF_LINES,
    WIDTH_OF_POLYGONS,
    assemble_draws,
    assemble_lines_and_points,
    let_first_provoke,
    primitive_counts,
    primitives_of,
    width_of,
)
from softshadow.pipeline.fast.batch.lines_and_points import (
    sizes_of_points,
    stipple_of_polygons,
    stipple_places,
    widths_of_lines,
)
from softshadow.pipeline.fast.batch.planes import Planes, planes_of
from softshadow.pipeline.fast.batch.run import Run
from softshadow.pipeline.fast.batch.small_runs import place_new, set_up_pieces, set_up_run
from softshadow.pipeline.fast.batch.table import REAL, Table, Views, table_of, views_of
from softshadow.pipeline.fast.batch.vertex_stage import Outputs, empty_outputs, inputs_of, write_outputs
from softshadow.pipeline.fast.batch.vertices import END, FIRST_PLANE, VIEW
from softshadow.pipeline.fast.geometry_cache import recent_of
from softshadow.pipeline.fast.recent_triangles import triangles_key, window_key
from softshadow.pipeline.geometry.assembly import edge_flags, edges_of_joined_polygons
from softshadow.pipeline.geometry.clip import CUT, NO_EDGES, NO_STAGES, NO_STARTS, Clipped, clip_triangles, write_sides
from softshadow.pipeline.geometry.draw_primitives import triangles_in_stages
from softshadow.pipeline.geometry.geometry import (
    filled_geometry,
    filled_offset,
    has_float_units,
    in_provoking_order,
    outlined_geometry,
    points_and_lines_geometry,
)
from softshadow.pipeline.geometry.lines import clip_lines
from softshadow.pipeline.geometry.points import clip_points
from softshadow.pipeline.geometry.program import program_of
from softshadow.pipeline.geometry.triangle_setup import NO_TRIANGLES, Offset, empty_setup, stored_culling
from softshadow.pipeline.geometry.vertex import append_rows
from softshadow.pipeline.memory.scratch import scratch
from softshadow.pipeline.mesa.polygon_rules import is_stippled
from softshadow.pipeline.mesa.provoking_vertex import first_provokes
from softshadow.pipeline.records import Geometry, Setup
from softshadow.programs import Program
from softshadow.programs.fixed_function import is_replaced

SMALL = 1 << 12  # vertices, and triangles, of a run that one kernel sets up
MOST_COMPARED = 32  # draws of a run that is compared with recent ones


class Setting(NamedTuple):
    """What the geometry of a run depends on besides its draws.

    culled, positive_is_front, offset: see `triangle_setup.set_up_triangles`; flat (k,): the columns of the varyings
    that are not interpolated.
    """

    culled: int
    positive_is_front: int
    offset: Offset
    flat: np.ndarray
    program: Program
    uniforms: Mapping[str, Any]


def setting_of(run: Run, target: Framebuffer, storage: Storage) -> Setting:
    """Return what the geometry of a run depends on besides its draws."""
    facing = stored_culling(run.state.cull, target.flipped)
    return Setting(*facing, filled_offset(run.command, target), _flat_columns(run), *program_of(run.command, storage))


class Batch(NamedTuple):
    """The triangles of draws that are processed together.

    geometry : all triangles, in drawing order; fragments: about how many they have, -1 where that is not known;
    vertices (T',): by the ids of triangles, a vertex of their draw, numbered through all draws.
    """

    geometry: Geometry
    fragments: int
    vertices: np.ndarray


class RunTriangles(NamedTuple):
    """The triangles of a run, to be used again: `setups` by culling.

    cut (3 C,): the vertices of the triangles that are cut; None for a run without colours.
    """

    geometry: Geometry
    clipped: Clipped
    cut: np.ndarray | None
    setups: dict[tuple[int, int], Setup]


def geometry_of(
    run: Run, setting: Setting, draws: Sequence[Draw], target: Framebuffer, storage: Storage | None = None
) -> Batch:
    """Return the triangles of all draws of a run, in the window of `target`.

    With a `storage`, the triangles of a recent run are used again if they are the same.
    """
    recent = recent_of(storage) if _may_be_repeated(draws) else None
    views, planes = views_of(draws, target), planes_of(draws)
    key = _key_of(run, setting, draws, views, planes, target) if recent else ()
    known: RunTriangles | None = recent.look_up(key) if recent else None
    if known and setting.culled and known.clipped.in_stages is None:
        known = None
    if known and (known.cut is not None or not run.writes_color):
        return _batch(_repeated_geometry(run, setting, draws, views, planes, target, known))
    table, most = table_of(run, draws, views, planes), sum(primitive_counts(draws))
    n = len(table.positions)
    command, width, outputs = run.command, width_of(run.command.mode), empty_outputs(n, table, len(setting.flat))
    inputs = inputs_of(table)
    triangles, provoking = scratch((most, 3), np.int32), scratch(most, np.int32)
    unset = Geometry(
        NO_TRIANGLES, *outputs[2:], setting.flat, provoking, provoking, setting.program, setting.uniforms
    )  # fmt: skip
    is_polygons, is_filled = width == WIDTH_OF_POLYGONS, not run.unfilled
    is_first = first_provokes(run.state)
    is_small = is_polygons and is_filled and max(n, most) <= SMALL and not is_first
    is_small = is_small and not has_float_units(command, target)
    if is_small:
        setup = empty_setup(most, REAL)
        n_triangles, n_drawn, area = set_up_run(
            *inputs, *outputs.for_kernels, table.indices, triangles, read_only(triangles), provoking,
            np.empty((n, 2), np.int32), setting.culled, setting.positive_is_front, setting.offset, *setup,
        )  # fmt: skip
        if n_drawn >= 0:
            return _batch(unset._replace(triangles=Setup(*[array[:n_drawn] for array in setup])), area >> 8)
    else:
        write_outputs(table, inputs, outputs)
        if is_polygons:
            n_triangles = assemble_draws(table.numbers, table.indices, outputs.codes, triangles, provoking)
            if is_first:
                counts = np.array(primitive_counts(draws))
                let_first_provoke(table.numbers, counts, outputs.codes, triangles, provoking)
    clip, codes, columns = outputs.clip, outputs.codes, outputs.columns
    if is_polygons:
        edges = NO_EDGES if is_filled else _drawn_edges(draws, triangles[:n_triangles])
        starts = _starts_of_planes(table, triangles[:n_triangles, 0])
        clipped = clip_triangles(clip, columns, triangles[:n_triangles], codes, planes.rows, edges, starts=starts)
        if is_filled and setting.culled:
            clipped = clipped.passing_stages(_in_stages(draws, codes, planes, triangles[:n_triangles]))
        if is_first:
            clipped = in_provoking_order(clipped, codes, triangles[:n_triangles])
        if is_small and not recent:
            geometry = unset._replace(source=clipped.source, provoking=provoking[clipped.source])
            geometry = _with_values(geometry, clipped.values, outputs)
            return _batch(*_with_pieces(geometry, clipped, setting, table))
    else:
        primitives, clip_primitives = _lines_or_points(table, most, width), clip_points if width == 1 else clip_lines
        sizes = sizes_of_points(run, draws) if width == 1 else None
        with_sizes = columns if sizes is None else np.hstack([columns, sizes[:, np.newaxis]])
        provoking = primitives[:, 0 if is_first else -1]
        starts = _starts_of_planes(table, primitives[:, 0])
        clipped = clip_primitives(clip, with_sizes, primitives, codes, planes.rows, starts)
    window, of_pieces = outputs.window, provoking[clipped.source]
    if len(clipped.clip) > n:  # the new vertices of clipping come last
        new = np.empty_like(clipped.clip[n:])
        place_new(clipped.clip[n:], _views_of_new(clipped, of_pieces, table), table.scales, table.shifts, new)
        window = append_rows(window, new)
    geometry = unset._replace(window=window, source=clipped.source, provoking=of_pieces)
    geometry = _with_values(geometry, clipped.values[:, : columns.shape[1]], outputs)
    if not is_polygons:
        sizes = None if sizes is None else clipped.values[:, -1]
        places = stipple_places(draws, clipped.source) if run.stippled else None
        widths = widths_of_lines(run, draws, clipped.source) if width == WIDTH_OF_LINES else None
        return _batch(points_and_lines_geometry(geometry, clipped, command, target, sizes, places, widths))
    if not is_filled:
        begins, places = None, None
        if is_stippled(run.state.lines):
            begins, places = stipple_of_polygons(draws, codes, triangles[:n_triangles], clipped.source)
        outlined = outlined_geometry(geometry, clipped, command, target, command.state.cull, begins, places=places)
        return Batch(outlined, -1, geometry.provoking)
    geometry = filled_geometry(geometry, clipped, command, target, command.state.cull)
    if recent:
        bare = clipped._replace(clip=clip[:0], values=columns[:0])
        cut = _cut_vertices(triangles[:n_triangles], codes) if run.writes_color else None
        known = RunTriangles(geometry, bare, cut, {})
        known.setups[setting.culled, setting.positive_is_front] = geometry.triangles
        arrays = geometry.window, geometry.values, geometry.source, geometry.provoking, *geometry.triangles
        alive = [(draw.vertices.position, draw.indices) for draw in draws]
        recent.add(key, known, (*arrays, clipped.triangles), alive)
    return _batch(geometry)


def _batch(geometry: Geometry, fragments: int = -1) -> Batch:
    """Return a batch whose geometry has the vertices of its draws."""
    return Batch(geometry, fragments, geometry.provoking)


def _drawn_edges(draws: Sequence[Draw], triangles: np.ndarray) -> np.ndarray:
    """Return which edges of the assembled triangles (T, 3) of all draws are drawn."""
    edges = []
    for (mode, pairs_mode), same in groupby(draws, attrgetter("mode", "pairs_mode")):
        if pairs_mode == gl.GL_POLYGON:
            edges += [
                edges_of_joined_polygons(draw.indices.reshape(-1, 3)) for draw in same if draw.indices is not None
            ]
            continue
        counts = [primitives_of(draw) for draw in same]
        mode = gl.GL_QUAD_STRIP if pairs_mode == gl.GL_QUAD_STRIP else mode
        # the triangles of other modes have the same edges in a draw of their own
        edges += [edge_flags(mode, count) for count in (counts if mode == gl.GL_POLYGON else [sum(counts)])]
    drawn = edges[0] if len(edges) == 1 else np.concatenate(edges)
    if all(draw.vertices.edges is None for draw in draws):
        return drawn
    all_vertices = [draw.vertices for draw in draws]
    flags = [np.ones(len(each.position), bool) if each.edges is None else each.edges for each in all_vertices]
    return np.ascontiguousarray(drawn & np.concatenate(flags)[triangles].view(np.uint8))


def _in_stages(draws: Sequence[Draw], codes: np.ndarray, planes: Planes, triangles: np.ndarray) -> np.ndarray:
    """Return which triangles (T, 3) of all draws pass Mesa's cull stage, (T,) uint8; empty for none."""
    if not codes.any():
        return NO_STAGES
    in_stages, start, first = np.zeros(len(triangles), np.uint8), 0, 0
    for draw, first_plane, end_plane in zip(draws, planes.firsts, planes.ends, strict=True):
        end = start + len(draw.vertices.position)
        last = first + primitives_of(draw)
        if codes[start:end].any():
            own_planes = planes.rows[first_plane:end_plane]
            of_draw = triangles_in_stages(draw, codes[start:end], own_planes, triangles[first:last] - start)
            in_stages[first : first + len(of_draw)] = of_draw
        start, first = end, last
    return in_stages


def _views_of_new(clipped: Clipped, provoking: np.ndarray, table: Table) -> np.ndarray:
    """Return the row of the viewport of each vertex that clipping has made.

    provoking (T',): a vertex of the primitive that each piece comes from.
    """
    n = len(table.positions)
    if len(table.scales) == 1:
        return np.zeros(len(clipped.clip) - n, np.int64)
    views = np.zeros(len(clipped.clip), np.int64)
    views[clipped.triangles] = table.numbers[_draws_of(table, provoking), VIEW, np.newaxis]
    return views[n:]


def _draws_of(table: Table, vertices: np.ndarray) -> np.ndarray:
    """Return the number of the draw of each vertex."""
    return np.searchsorted(table.numbers[:, END], vertices, side="right")


def _starts_of_planes(table: Table, vertices: np.ndarray) -> np.ndarray:
    """Return the row of the first clip plane of each primitive, by one of its vertices; empty if all have row 0."""
    firsts = table.numbers[:, FIRST_PLANE]
    return firsts[_draws_of(table, vertices)].astype(np.int32) if firsts.any() else NO_STARTS


def _with_pieces(geometry: Geometry, clipped: Clipped, setting: Setting, table: Table) -> tuple[Geometry, int]:
    """Return a geometry with the triangles that clipping has left, set up, and about how many fragments they have."""
    views = _views_of_new(clipped, geometry.provoking, table)
    window, setup = np.empty_like(clipped.clip), empty_setup(len(clipped.triangles), REAL)
    n_drawn, area = set_up_pieces(
        clipped.clip, geometry.window, views, table.scales, table.shifts, window, np.empty((len(window), 2), np.int32),
        clipped.triangles, read_only(clipped.triangles), NO_STAGES if clipped.in_stages is None else clipped.in_stages,
        setting.culled, setting.positive_is_front, setting.offset, *setup,
    )  # fmt: skip
    return geometry._replace(window=window, triangles=Setup(*[array[:n_drawn] for array in setup])), area >> 8


def _may_be_repeated(draws: Sequence[Draw]) -> bool:
    """Return whether a run is large enough to be compared with recent ones: of large draws of triangles."""
    if width_of(draws[0].mode) != WIDTH_OF_POLYGONS or len(draws) > MOST_COMPARED:
        return False
    return sum(vertex_counts(draws)) >= sum(of_each(draws, least_compared))


def _key_of(
    run: Run, setting: Setting, draws: Sequence[Draw], views: Views, planes: Planes, target: Framebuffer
) -> Hashable:
    """Return what the triangles of a run depend on, but for its culling."""
    image = target.depth
    return (
        *map(triangles_key, draws), window_key(run.command, target), *planes.firsts, *planes.ends,
        planes.rows.tobytes(), *views.of_draws, views.scales.tobytes(), views.shifts.tobytes(), repr(setting.offset),
        run.across, None if image is None else image.format,
    )  # fmt: skip


def _repeated_geometry(
    run: Run,
    setting: Setting,
    draws: Sequence[Draw],
    views: Views,
    planes: Planes,
    target: Framebuffer,
    known: RunTriangles,
) -> Geometry:
    """Return the triangles of a run that has those of a recent one; vertices are lit anew, and triangles culled."""
    geometry, facing = known.geometry, (setting.culled, setting.positive_is_front)
    if facing not in known.setups:
        command = run.command
        filled = filled_geometry(geometry, known.clipped, command, target, command.state.cull)
        known.setups[facing] = filled.triangles
    geometry = geometry._replace(triangles=known.setups[facing])
    if not run.writes_color:
        return geometry
    table = table_of(run, draws, views, planes, reads_indices=False)
    n = len(table.positions)
    outputs = empty_outputs(n, table, len(setting.flat))
    write_outputs(table, inputs_of(table), outputs)
    columns = outputs.columns
    if len(geometry.window) > n and known.cut is not None:
        cut, clip, codes = known.cut, outputs.clip, outputs.codes
        own = np.arange(len(cut), dtype=np.int32).reshape(-1, 3)
        starts = _starts_of_planes(table, cut[::3])
        pieces = clip_triangles(clip[cut], columns[cut], own, codes[cut], planes.rows, starts=starts)
        columns = np.concatenate([columns, pieces.values[len(cut) :]])
    geometry = geometry._replace(flat=setting.flat, program=setting.program, uniforms=setting.uniforms)
    return _with_values(geometry, columns, outputs)


def _with_values(geometry: Geometry, columns: np.ndarray, outputs: Outputs) -> Geometry:
    """Return the geometry with the values of all vertices; `columns` are `Outputs.columns`, with those of new ones."""
    k = outputs.values.shape[1]
    back = np.ascontiguousarray(columns[:, k:]) if columns.shape[1] > k else outputs.back
    return geometry._replace(values=np.ascontiguousarray(columns[:, :k]), back=back)


def _cut_vertices(triangles: np.ndarray, codes: np.ndarray) -> np.ndarray:
    """Return the vertices (3 C,) of the triangles that clipping cuts."""
    if not codes.any():
        return np.empty(0, np.int32)
    sides = np.empty(len(triangles), np.uint8)
    write_sides(read_only(triangles), codes, 0, len(triangles), sides)
    return triangles.take(np.flatnonzero(sides == CUT), axis=0).reshape(-1)


def _lines_or_points(table: Table, most: int, width: int) -> np.ndarray:
    """Return the lines (L, 2) or points (P, 1) of all draws over the vertices of the table."""
    primitives = np.empty((most, width), np.int32)
    return primitives[: assemble_lines_and_points(table.numbers, table.indices, primitives)]


def _flat_columns(run: Run) -> np.ndarray:
    """Return which columns of the varyings are not interpolated (`programs.fixed_function.process_vertices`)."""
    lighting, n_color = run.state.lighting, 7 if run.layout.secondary else 4
    others = int(run.writes_color and run.state.fog.enabled) + 4 * run.repeats_primary
    flat = np.zeros(n_color + 4 * len(run.units) + others, bool)
    one_color = not lighting.enabled and not run.arrays.color
    flat[:4] = lighting.shade_model == gl.GL_FLAT or one_color
    flat[4:n_color] = lighting.shade_model == gl.GL_FLAT or not (lighting.enabled or run.arrays.secondary)
    for n, unit in enumerate(run.units):
        generates = any(gen.enabled for gen in run.state.units[unit.index].gen)
        is_constant = not run.arrays.texcoords[n] and run.arrays.identities[n] and not generates
        is_constant = is_constant and not is_replaced(run.state, unit.index)
        flat[n_color + 4 * n : n_color + 4 * n + 4] = is_constant
    if run.repeats_primary:
        flat[-4:] = lighting.shade_model == gl.GL_FLAT
    return flat
