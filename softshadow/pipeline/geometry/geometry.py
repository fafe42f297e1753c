"""From a draw command to triangles in the window: assembly, vertex stage, clipping, viewport, setup."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from softshadow import matrices
from softshadow import tokens as gl
from softshadow.framebuffer import Framebuffer, Storage
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.geometry.assembly import begins_stipple, pieces_begin_stipple
from softshadow.pipeline.geometry.clip import NO_EDGES, Clipped, clip_triangles
from softshadow.pipeline.geometry.clip_planes import user_planes
from softshadow.pipeline.geometry.draw_primitives import (
    drawn_edges,
    has_no_edges,
    lines_or_points_of,
    triangles_in_stages,
    triangles_of,
)
from softshadow.pipeline.geometry.facing import CULL_BACK, CULL_FRONT
from softshadow.pipeline.geometry.line_stipple import places_of
from softshadow.pipeline.geometry.lines import LINES, clip_lines
from softshadow.pipeline.geometry.lines_and_points import set_up_lines_of, set_up_points_of
from softshadow.pipeline.geometry.points import clip_points
from softshadow.pipeline.geometry.polygon_mode import Outlined, outline
from softshadow.pipeline.geometry.program import program_of
from softshadow.pipeline.geometry.triangle_setup import (
    NO_TRIANGLES,
    Offset,
    add_float_units,
    left_by_cull_stage,
    merge_by_id,
    offset_of,
    set_up,
    snapped_vertices,
    stored_culling,
)
from softshadow.pipeline.geometry.vertex import append_rows, process_vertices, to_window
from softshadow.pipeline.mesa.polygon_rules import is_stippled, offset_is_on, passes_stages
from softshadow.pipeline.mesa.provoking_vertex import first_provokes, order_for_setup, order_pieces
from softshadow.pipeline.records import Discards, Geometry, Setup
from softshadow.programs import Program, Varyings, VertexInputs
from softshadow.state import Cull, Polygon, State, Viewport

SIDE = 32  # rows and columns of a polygon stipple


class Positions(NamedTuple):
    """The vertices of a draw: clip (V, 4), codes (V,): `outcodes`, window (V, 4); and planes (P, 4): `user_planes`."""

    clip: np.ndarray
    codes: np.ndarray
    window: np.ndarray
    planes: np.ndarray


class VertexOutputs(NamedTuple):
    """What the program of a draw makes of its vertices; the uniforms include the textures."""

    varyings: Varyings
    program: Program
    uniforms: Mapping[str, Any]


def process_geometry(command: Draw, target: Framebuffer, storage: Storage, cull: Cull | None = None) -> Geometry:
    """Return the triangles of a draw in the window of `target`; lines and points are two triangles each.

    `cull` replaces the state's face culling: pixel histories show culled triangles, too.
    """
    return triangles_with_outputs(command, target, vertex_outputs(command, storage), cull)


def vertex_outputs(command: Draw, storage: Storage) -> VertexOutputs:
    """Return what the program of a draw makes of its vertices."""
    program, uniforms = program_of(command, storage)
    return VertexOutputs(program.vertex(vertex_inputs(command, uniforms)), program, uniforms)


def vertex_inputs(command: Draw, uniforms: Mapping[str, Any]) -> VertexInputs:
    """Return what the program of a draw makes its outputs of."""
    vertices = command.vertices
    arrays = (vertices.position, vertices.color, vertices.normal, vertices.texcoords)
    transforms = (command.modelview, command.projection, command.texture_matrices)
    optional = vertices.materials, vertices.secondary, vertices.fog_coordinates
    return VertexInputs(*arrays, *transforms, uniforms, command.modelview_kind, *optional)


def triangles_with_outputs(
    command: Draw, target: Framebuffer, outputs: VertexOutputs, cull: Cull | None = None
) -> Geometry:
    """Return the triangles of `process_geometry`, whose vertices have these outputs."""
    state, varyings = command.state, outputs.varyings
    cull = state.cull if cull is None else cull
    clip, codes, window, planes = positions_of(command, target)
    parts, sizes = [varyings.values], varyings.point_sizes
    parts += [] if varyings.back is None else [varyings.back]
    parts += [] if sizes is None else [sizes[:, None]]
    columns = parts[0] if len(parts) == 1 else np.hstack(parts)
    if command.mode in (gl.GL_POINTS, *LINES):
        primitives = lines_or_points_of(command)
        provoking = primitives[:, 0 if first_provokes(state) else -1]
        clip_primitives = clip_points if command.mode == gl.GL_POINTS else clip_lines
        clipped = clip_primitives(clip, columns, primitives, codes, planes)
    else:
        with_stages = passes_stages(state)
        across = varyings.flat_input and (bool(target.colors) or state.alpha.enabled)  # else Mesa does not shade
        assembled = triangles_of(command, target, codes, planes, across)
        provoking = assembled.provoking
        edges = drawn_edges(command, assembled.corners) if with_stages else NO_EDGES
        clipped = clip_triangles(clip, columns, assembled.corners, codes, planes, edges, command.linear)
        if state.cull.enabled and not with_stages:
            clipped = clipped.passing_stages(triangles_in_stages(command, codes, planes, assembled.corners))
        if first_provokes(state):
            clipped = in_provoking_order(clipped, codes, assembled.corners)
    window = with_new_vertices(window, clipped, command, target)
    k = varyings.values.shape[1]
    geometry = Geometry(
        NO_TRIANGLES,
        window,
        np.ascontiguousarray(clipped.values[:, :k]),
        None if varyings.back is None else np.ascontiguousarray(clipped.values[:, k : 2 * k]),
        varyings.flat,
        clipped.source,
        provoking[clipped.source],
        outputs.program,
        outputs.uniforms,
    )
    vertex_sizes = None if sizes is None else clipped.values[:, -1]
    if command.mode in (gl.GL_POINTS, *LINES):
        return points_and_lines_geometry(geometry, clipped, command, target, vertex_sizes)
    if not with_stages:
        return filled_geometry(geometry, clipped, command, target, cull)
    begins = None
    if is_stippled(state.lines):
        first = begins_stipple(command.mode, len(provoking))
        begins = pieces_begin_stipple(first, codes != 0, assembled.corners, clipped.source)
    return outlined_geometry(geometry, clipped, command, target, cull, begins, vertex_sizes)


def with_new_vertices(window: np.ndarray, clipped: Clipped, command: Draw, target: Framebuffer) -> np.ndarray:
    """Return the window positions of a draw's vertices and of those that clipping has made, which come last."""
    n_vertices = len(window)
    if len(clipped.clip) == n_vertices:
        return window
    return append_rows(window, to_window(clipped.clip[n_vertices:], *window_transform(command, target)))


def stipple_places(clipped: Clipped, command: Draw) -> np.ndarray:
    """Return the places (L,) of the clipped lines in the line stipple."""
    return places_of(clipped.source == 0 if command.mode != gl.GL_LINES else np.ones(len(clipped.source), bool))


def in_provoking_order(clipped: Clipped, codes: np.ndarray, corners: np.ndarray) -> Clipped:
    """Return the pieces of triangles (T, 3) in the order of GL_FIRST_VERTEX_CONVENTION."""
    cut = (codes[corners] != 0).any(axis=1)[clipped.source]
    triangles, edges = order_pieces(clipped.triangles, clipped.edges, cut)
    return clipped._replace(triangles=triangles, edges=edges)


def _corners_for_setup(window: np.ndarray, triangles: np.ndarray, state: State) -> np.ndarray:
    if not first_provokes(state) or not len(triangles):
        return triangles
    snapped, _ = snapped_vertices(window)
    a, b, c = (snapped[triangles[:, corner]].astype(np.int64) for corner in range(3))
    return order_for_setup(triangles, (a - b)[:, 0] * (c - a)[:, 1] - (c - a)[:, 0] * (a - b)[:, 1])


def positions_of(command: Draw, target: Framebuffer) -> Positions:
    """Return the positions and clip codes of a draw's vertices."""
    matrix, planes = matrices.multiply(command.projection, command.modelview), user_planes(command)
    clamp = command.state.depth.clamp
    positions = command.vertices.position
    return Positions(*process_vertices(matrix, positions, planes, clamp, *window_transform(command, target)), planes)


def window_transform(command: Draw, target: Framebuffer) -> tuple[Viewport, int, bool]:
    """Return the arguments of `to_window`: viewport, height of the framebuffer, whether row 0 is stored at the top."""
    return command.state.viewport, target.size[1], target.flipped


def filled_offset(command: Draw, target: Framebuffer) -> Offset:
    """Return the polygon offset of a draw's filled triangles."""
    real = command.vertices.position.dtype.type
    polygon, slope, unit = command.state.polygon, command.offset_slope, command.offset_unit
    return offset_of(polygon, target.depth, real, slope, unit, target.flipped)


def has_float_units(command: Draw, target: Framebuffer) -> bool:
    """Return whether the unit of the polygon offset depends on the triangle, see `add_float_units`."""
    has_floats = target.depth is not None and not target.depth.format.largest
    return has_floats and offset_is_on(command.state.polygon)


def filled_geometry(geometry: Geometry, clipped: Clipped, command: Draw, target: Framebuffer, cull: Cull) -> Geometry:
    """Return the geometry with its triangles set up."""
    window = geometry.window
    corners = _corners_for_setup(window, left_by_cull_stage(window, clipped, cull, target.flipped), command.state)
    triangles = set_up(window, corners, cull, filled_offset(command, target), target.flipped)
    if has_float_units(command, target):
        add_float_units(triangles.depth[:, 3], window[triangles.vertices, 2], command.state.polygon.units)
    if cull is not command.state.cull:
        _face_as_culled(triangles, clipped, window, command.state.cull, target.flipped)
    return geometry._replace(triangles=triangles)


def _face_as_culled(triangles: Setup, clipped: Clipped, window: np.ndarray, cull: Cull, flipped: bool) -> None:
    """Let those triangles that the cull stage leaves out face as it sees them, where culled ones are shown, too."""
    left, (culled, _) = left_by_cull_stage(window, clipped, cull, flipped), stored_culling(cull, flipped)
    if left is not clipped.triangles and culled in (CULL_FRONT, CULL_BACK):
        left_out = left[:, 0] == left[:, 1]
        triangles.front[left_out[triangles.ids]] = culled == CULL_FRONT


def points_and_lines_geometry(
    geometry: Geometry,
    clipped: Clipped,
    command: Draw,
    target: Framebuffer,
    sizes: np.ndarray | None = None,
    places: np.ndarray | None = None,
    widths: np.ndarray | None = None,
) -> Geometry:
    """Return the geometry with its points or lines set up; they are never culled.

    `sizes` (V,): of points, or None; `places` (L,): of lines of several draws in the line stipple; `widths` (L,): of
    lines whose draws differ in it, or None.
    """
    state, primitives = command.state, clipped.triangles
    ids = np.arange(len(primitives), dtype=np.int32)
    geometry = geometry._replace(back=None, faceless=True, stipple_place=command.stipple_place)
    if command.mode == gl.GL_POINTS:
        geometry, triangles = set_up_points_of(geometry, primitives[:, 0], ids, sizes, state, target.flipped)
    else:
        places = stipple_places(clipped, command) if places is None else places
        geometry, triangles = set_up_lines_of(geometry, primitives, ids, places, widths, state, target.flipped)
    return geometry._replace(triangles=triangles)


def outlined_geometry(
    geometry: Geometry,
    clipped: Clipped,
    command: Draw,
    target: Framebuffer,
    cull: Cull,
    begins: np.ndarray | None = None,
    sizes: np.ndarray | None = None,
    places: np.ndarray | None = None,
) -> Geometry:
    """Return the geometry of polygons that pass Mesa's stages; it has vertices of its own.

    `begins` (T',): the pieces at which the line stipple begins anew, None where lines are solid; `sizes` (V',): of
    points, or None; `places` (T',): of several draws in the line stipple, see `polygon_mode.outline`.
    """
    state, flipped = command.state, target.flipped
    begins = np.ones(len(clipped.source), bool) if begins is None else begins
    outlined = outline(
        geometry.window, geometry.values, geometry.back, geometry.flat, clipped.triangles, clipped.edges,
        geometry.provoking, state, cull, target.depth, command.offset_slope, command.offset_unit, flipped,
        begins, command.offset_mode, has_no_edges(command), places,
    )  # fmt: skip
    no_offset = offset_of(
        Polygon(), target.depth, outlined.window.dtype.type, command.offset_slope, command.offset_unit, flipped
    )
    corners = _corners_for_setup(outlined.window, outlined.triangles, state)
    filled = set_up(outlined.window, corners, cull, no_offset, flipped)
    filled = filled._replace(ids=outlined.triangles[filled.ids, 0] // 3)
    geometry = geometry._replace(
        window=outlined.window,
        values=outlined.values,
        back=None,
        provoking=np.arange(len(outlined.front), dtype=np.int32) * 3,
        faces=outlined.front,
        offset_mode=outlined.offset_mode,
        discards=stipple_of(state, outlined, target),
        stipple_place=command.stipple_place,
    )
    sizes = None if sizes is None else sizes[clipped.triangles].reshape(-1)
    point_ids, line_ids = outlined.points // 3, outlined.lines[:, 0] // 3
    geometry, points = set_up_points_of(geometry, outlined.points, point_ids, sizes, state, flipped)
    geometry, lines = set_up_lines_of(geometry, outlined.lines, line_ids, outlined.places, None, state, flipped)
    place = 0 if outlined.ends_stipple else geometry.stipple_place
    return geometry._replace(triangles=merge_by_id([filled, lines, points]), stipple_place=place)


def stipple_of(state: State, outlined: Outlined, target: Framebuffer) -> Discards | None:
    """Return the polygon stipple of a draw by the rows of the target; None without a filled polygon."""
    if not state.polygon.stippled or not len(outlined.triangles):
        return None
    pattern = np.unpackbits(np.frombuffer(state.polygon.stipple, np.uint8)).reshape(SIDE, SIDE).astype(bool)
    if target.flipped:
        pattern = pattern[(target.size[1] - 1 - np.arange(SIDE)) % SIDE]
    return Discards(pattern)  # also for lines and points of the same draw: Mesa draws all with one shader


def offset_mode_of(command: Draw, storage: Storage) -> int:
    """Return the polygon mode whose offset a draw of unfilled polygons applies, 0 where no triangle decides it."""
    target = storage.framebuffers[command.state.draw_framebuffer]
    with np.errstate(all="ignore"):  # as in pipeline.draw
        return process_geometry(command, target, storage).offset_mode
