"""From a draw command to triangles in the window: assembly, vertex stage, clipping, viewport, setup."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from softshadow import matrices, programs
from softshadow import tokens as gl
from softshadow.framebuffer import Framebuffer, Storage
from softshadow.pipeline.geometry.assembly import (
    Triangles,
    assemble,
    edge_flags,
    in_clipped_batch,
    quads_of,
    separate,
    through_indices,
)
from softshadow.pipeline.geometry.clip import NO_EDGES, Clipped, clip_triangles, outcodes
from softshadow.pipeline.geometry.lines import LINES, NO_VERTEX, assemble_lines, clip_lines, set_up_lines
from softshadow.pipeline.geometry.points import clip_points, set_up_points
from softshadow.pipeline.geometry.polygon_mode import drawn_modes, outline
from softshadow.pipeline.geometry.triangle_setup import (
    Offset,
    Setup,
    add_float_units,
    in_order,
    offset_is_on,
    offset_of,
    set_up,
)
from softshadow.pipeline.geometry.vertex import process_vertices, to_clip, to_window, with_rows
from softshadow.pipeline.mesa.rectangles import ALL, is_left_out, segment_of_three
from softshadow.pipeline.raster.fill import Region
from softshadow.pipeline.raster.spans import DepthRange
from softshadow.programs import Program, VertexInputs
from softshadow.programs.inverse import inverse
from softshadow.state import Cull, Polygon, State, Viewport
from softshadow.texture import Texture, stored_name

if TYPE_CHECKING:
    from softshadow.pipeline.commands import Draw

NOTHING = Setup(
    np.empty((0, 6), np.int32),
    np.empty((0, 3), np.int32),
    np.empty((0, 4), np.float32),
    np.empty(0, np.uint8),
    np.empty(0, np.int32),
)


class Positions(NamedTuple):
    """The vertices of a draw: clip (V, 4), codes (V,) `outcodes`, window (V, 4); and planes (P, 4): `user_planes`."""

    clip: np.ndarray
    codes: np.ndarray
    window: np.ndarray
    planes: np.ndarray


class Geometry(NamedTuple):
    """What the fill and shade stages need of a draw.

    triangles: those that are not culled and have an area; window (V', 4): x, y, z, 1/w; values, back (V', k) and flat
    (k,): what the vertex stage hands on; source (T',) which assembled primitive each clipped one is a piece of;
    provoking (T',); faces: of which polygons, (T',) bool, the lines and points of glPolygonMode are the front, or None;
    offset_mode: the mode of unfilled polygons whose offset applies, or 0.
    """

    triangles: Setup
    window: np.ndarray
    values: np.ndarray
    back: np.ndarray | None
    flat: np.ndarray
    source: np.ndarray
    provoking: np.ndarray
    program: Program
    uniforms: Mapping[str, Any]
    faces: np.ndarray | None = None
    offset_mode: int = 0

    def facing(self, row: int) -> bool | None:
        """Return whether a row of `triangles` belongs to a front face; None for lines and points, which have none."""
        if self.faces is not None:
            return bool(self.faces[self.triangles.ids[row]])
        return bool(self.triangles.front[row]) if self.triangles.vertices[row, 2] != NO_VERTEX else None


def process_geometry(command: Draw, target: Framebuffer, storage: Storage, cull: Cull | None = None) -> Geometry:
    """Return the triangles of a draw in the window of `target`; lines and points are two triangles each.

    `cull` is what is left out, for histories, which want all; without, what the command's state says.
    """
    state, vertices = command.state, command.vertices
    cull = state.cull if cull is None else cull
    program, uniforms = program_of(command, storage)
    arrays = (vertices.position, vertices.color, vertices.normal, vertices.texcoords)
    transforms = (command.modelview, command.projection, command.texture_matrices)
    varyings = program.vertex(VertexInputs(*arrays, *transforms, uniforms, command.modelview_kind, vertices.materials))
    clip, codes, window, planes = positions = positions_of(command, target)
    columns = varyings.values if varyings.back is None else np.hstack([varyings.values, varyings.back])
    if command.mode in (gl.GL_POINTS, *LINES):
        make, primitives = _points_and_lines, _indexed_lines_or_points(command)
        provoking = primitives[:, -1]
        clip_primitives = clip_points if command.mode == gl.GL_POINTS else clip_lines
        clipped = clip_primitives(clip, columns, primitives, codes, planes)
    else:
        make = _filled if is_filled(state) else _outlined
        across = varyings.flat_input and (bool(target.colors) or state.alpha.enabled)  # else Mesa shades nothing
        assembled = triangles_of(command, target, positions, across)
        provoking = assembled.provoking
        edges = edge_flags(command.mode, len(provoking)) if make is _outlined else NO_EDGES
        clipped = clip_triangles(clip, columns, assembled.corners, codes, planes, edges, command.linear)
    if len(clipped.clip) > len(clip):  # the cuts' own vertices come after all others
        window = with_rows(window, to_window(clipped.clip[len(clip) :], *stored_rows(command, target)))
    k = varyings.values.shape[1]
    made = Geometry(
        NOTHING,
        window,
        np.ascontiguousarray(clipped.values[:, :k]),
        None if varyings.back is None else np.ascontiguousarray(clipped.values[:, k:]),
        varyings.flat,
        clipped.source,
        provoking[clipped.source],
        program,
        uniforms,
    )
    return make(made, clipped, command, target, cull)


def positions_of(command: Draw, target: Framebuffer) -> Positions:
    """Return where the vertices of a draw are."""
    matrix, planes = matrices.multiply(command.projection, command.modelview), user_planes(command)
    clamp = command.state.depth.clamp
    moved = process_vertices(matrix, command.vertices.position, planes, clamp, *stored_rows(command, target))
    return Positions(*moved, planes)


def stored_rows(command: Draw, target: Framebuffer) -> tuple[Viewport, int, bool]:
    """Return what `to_window` asks for: viewport, height of the framebuffer, whether its rows are stored top first."""
    return command.state.viewport, target.size[1], target.flipped


def is_filled(state: State) -> bool:
    return drawn_modes(state) == (gl.GL_FILL, gl.GL_FILL)


def triangles_of(command: Draw, target: Framebuffer, positions: Positions, across: bool) -> Triangles:
    """Return the assembled triangles of a draw without those that llvmpipe leaves out.

    `across` as in `assembled_triangles`.
    """
    planes = positions.planes
    assembled = assembled_triangles(command, positions.codes != 0, batch_needs_clipping(command, planes), across)
    if is_filled(command.state) and not across and three_are_left_out(command, target, planes):
        return without_last_three(command, assembled)
    return assembled


def offset_in(command: Draw, target: Framebuffer) -> Offset:
    """Return the polygon offset of a draw's filled triangles."""
    real = command.vertices.position.dtype.type
    polygon, slope, unit = command.state.polygon, command.offset_slope, command.offset_unit
    return offset_of(polygon, target.depth, real, slope, unit, target.flipped)


def has_float_units(command: Draw, target: Framebuffer) -> bool:
    """Return whether the unit of the offset depends on the triangle: `add_float_units`."""
    has_floats = target.depth is not None and not target.depth.format.largest
    return has_floats and offset_is_on(command.state.polygon)


def _filled(made: Geometry, clipped: Clipped, command: Draw, target: Framebuffer, cull: Cull) -> Geometry:
    """Return the geometry with its triangles set up."""
    window = made.window
    triangles = set_up(window, clipped.triangles, cull, offset_in(command, target), target.flipped)
    if has_float_units(command, target):
        add_float_units(triangles.depth[:, 3], window[triangles.vertices, 2], command.state.polygon.units)
    return made._replace(triangles=triangles)


def _points_and_lines(made: Geometry, clipped: Clipped, command: Draw, target: Framebuffer, cull: Cull) -> Geometry:
    """Return the geometry with its points or lines set up; nothing culls them."""
    polygon, primitives = command.state.polygon, clipped.triangles
    ids = np.arange(len(primitives), dtype=np.int32)
    if command.mode == gl.GL_POINTS:
        triangles = set_up_points(made.window, primitives[:, 0], ids, polygon.point_size, target.flipped)
    else:
        triangles = set_up_lines(made.window, primitives, ids, polygon.line_width)
    return made._replace(triangles=triangles)


def _outlined(made: Geometry, clipped: Clipped, command: Draw, target: Framebuffer, cull: Cull) -> Geometry:
    """Return the geometry of polygons that are not all filled, over vertices of its own."""
    state, flipped = command.state, target.flipped
    drawn = outline(
        made.window, made.values, made.back, made.flat, clipped.triangles, clipped.edges, made.provoking, state, cull,
        target.depth, command.offset_slope, command.offset_unit, flipped, command.offset_mode,
    )  # fmt: skip
    window, polygon = drawn.window, state.polygon
    none = offset_of(Polygon(), target.depth, window.dtype.type, command.offset_slope, command.offset_unit, flipped)
    filled = set_up(window, drawn.triangles, cull, none, flipped)
    filled = filled._replace(ids=drawn.triangles[filled.ids, 0] // 3)
    lines = set_up_lines(window, drawn.lines, drawn.lines[:, 0] // 3, polygon.line_width)
    points = set_up_points(window, drawn.points, drawn.points // 3, polygon.point_size, flipped)
    return made._replace(
        triangles=in_order([filled, lines, points]),
        window=window,
        values=drawn.values,
        back=None,
        provoking=np.arange(len(drawn.front), dtype=np.int32) * 3,
        faces=drawn.front,
        offset_mode=drawn.offset_mode,
    )


def _indexed_lines_or_points(command: Draw) -> np.ndarray:
    """Return the lines (L, 2) or points (P, 1) of a draw over its vertices."""
    indices = command.indices
    count = len(command.vertices.position) if indices is None else len(indices)
    if command.mode == gl.GL_POINTS:
        primitives = np.arange(count, dtype=np.int32)[:, None]
    else:
        primitives = assemble_lines(command.mode, count)
    return primitives if indices is None else indices[primitives]


def user_planes(command: Draw) -> np.ndarray:
    """Return the enabled clip planes (P, 4) in clip space: those of eye space times the inverse projection."""
    planes = command.state.clip_planes
    enabled = [equation for on, equation in zip(planes.enabled, planes.equations, strict=True) if on]
    made = np.empty((len(enabled), 4), np.float32)
    if enabled:
        m = inverse(command.projection, command.projection_kind)
        for row, (a, b, c, d) in zip(made, np.array(enabled, np.float32), strict=True):
            row[:] = ((a * m[0] + b * m[1]) + c * m[2]) + d * m[3]
    return made


def batch_needs_clipping(command: Draw, planes: np.ndarray) -> np.ndarray | None:
    """Return which vertices (N,) of the whole batch need clipping; None where the draw is the batch."""
    if command.batch is None:
        return None
    clip = to_clip(matrices.multiply(command.projection, command.modelview), command.batch)
    return outcodes(clip, command.state.depth.clamp, planes) != 0


def assembled_triangles(
    command: Draw, needs_clipping: np.ndarray, in_batch: np.ndarray | None = None, across: bool = False
) -> Triangles:
    """Return the triangles of a draw over its vertices.

    `needs_clipping` (V,) bool; `in_batch` (N,) the same for the batch of quads that the draw is a part of; `across`
    says to cut quads along the other diagonal (`Varyings.flat_input`).
    """
    indices = command.indices
    if command.mode == gl.GL_TRIANGLES and indices is not None:
        return separate(indices)
    count = len(needs_clipping) if indices is None else len(indices)
    if command.mode not in (gl.GL_QUADS, gl.GL_QUAD_STRIP):
        assembled = assemble(command.mode, count)
    else:
        whole = needs_clipping if in_batch is None else in_batch
        clipped = in_clipped_batch(command.mode, whole, indices) if whole.any() else None
        if clipped is not None and in_batch is not None:
            clipped = clipped[command.batch_start // 4 :][: count // 4]
        if not is_filled(command.state):
            clipped = np.ones(quads_of(command.mode, count)[0], bool)  # cut where clipped ones are
        assembled = assemble(command.mode, count, clipped, across=across or indices is not None)
    return assembled if indices is None else through_indices(assembled, indices)


def three_are_left_out(command: Draw, target: Framebuffer, planes: np.ndarray) -> bool:
    """Return whether the last three triangles of a batch are ones that llvmpipe does not draw."""
    positions = command.vertices.position if command.batch is None else command.batch
    first = segment_of_three(len(positions))
    if command.mode != gl.GL_TRIANGLES or command.indices is not None or first < 0:
        return False
    clip = to_clip(matrices.multiply(command.projection, command.modelview), positions[first : first + ALL])
    if outcodes(clip, command.state.depth.clamp, planes).any():
        return False
    return is_left_out(to_window(clip, command.state.viewport, target.size[1], target.flipped))


def without_last_three(command: Draw, assembled: Triangles) -> Triangles:
    """Return the triangles of a draw without the last three of its batch."""
    count = len(command.vertices.position if command.batch is None else command.batch)
    kept = max(segment_of_three(count) - command.batch_start, 0) // 3
    return Triangles(assembled.corners[:kept], assembled.provoking[:kept])


def primitive_count(command: Draw) -> int:
    """Return how many triangles, lines or points a draw hands in."""
    if command.mode in (gl.GL_POINTS, *LINES):
        return len(_indexed_lines_or_points(command))
    count = len(command.vertices.position) if command.indices is None else len(command.indices)
    return len(assemble(command.mode, count).corners)


def program_of(command: Draw, storage: Storage) -> tuple[Program, Mapping[str, Any]]:
    """Return the program of a draw and its uniforms, samplers resolved to textures."""
    bound = bound_textures(command.state, storage)
    if not command.program_name:
        from softshadow.programs import fixed_function

        return fixed_function.program(command.state, bound), command.uniforms
    program = programs.get(command.program_name)
    textures = {
        name: bound.get((value, gl.GL_TEXTURE_CUBE_MAP if name in program.cube_samplers else gl.GL_TEXTURE_2D))
        for name, value in command.uniforms.items()
        if name in program.samplers
    }
    blocks = any(texture is not None and programs.needs_blocks(texture) for texture in textures.values())
    program = replace(program, blocks=True) if blocks else program
    return program, {**command.uniforms, **textures}


def bound_textures(state: State, storage: Storage) -> dict[tuple[int, int], Texture]:
    """Return what is bound by (unit, target), as the units sample it."""
    bound = {}
    for index, unit in enumerate(state.units):
        for target, name in ((gl.GL_TEXTURE_2D, unit.bound_2d), (gl.GL_TEXTURE_CUBE_MAP, unit.bound_cube)):
            texture = storage.textures.get(stored_name(target, name))
            if texture is not None:
                bound[index, target] = texture.in_unit(unit.lod_bias, state.cube_maps.seamless)
    return bound


def region_of(state: State, target: Framebuffer) -> Region:
    """Return where a draw may write: the buffers, inside the scissor box if that test is on."""
    width, height = target.size
    left, right, bottom, top = 0, width, 0, height
    if state.scissor.enabled:
        box = state.scissor
        left, right = max(left, box.x), min(right, box.x + box.width)
        bottom, top = max(bottom, box.y), min(top, box.y + box.height)
    right, top = max(left, right), max(bottom, top)
    first, end = (height - top, height - bottom) if target.flipped else (bottom, top)
    return Region(left, right, first, end, int(target.flipped))


def depth_range_of(state: State, real: type) -> DepthRange:
    """Return what z is clamped to:

    [0, 1], with GL_DEPTH_CLAMP the depth range as the viewport's scale and shift give it.
    """
    if not state.depth.clamp:
        return DepthRange(real(0), real(1))
    near, far = real(state.viewport.near), real(state.viewport.far)
    scale, shift = real(0.5) * (far - near), real(0.5) * (far + near)
    return DepthRange(min(shift - scale, shift + scale), max(shift - scale, shift + scale))
