"""From a draw command to triangles in the window: assembly, vertex stage, clipping, viewport, setup."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from softshadow import matrices, programs
from softshadow import tokens as gl
from softshadow.errors import StateError
from softshadow.framebuffer import Framebuffer, Storage
from softshadow.pipeline.clip import clip_triangles, outcodes
from softshadow.pipeline.fill import DepthRange, Region
from softshadow.pipeline.primitives import Triangles, assemble, in_clipped_batch, through_indices
from softshadow.pipeline.setup import Setup, add_float_units, offset_of, set_up
from softshadow.pipeline.vertex import to_clip, to_window
from softshadow.programs import Program, VertexInputs
from softshadow.programs.inverse import inverse
from softshadow.state import State

if TYPE_CHECKING:
    from softshadow.pipeline.commands import Draw

FILLED = (gl.GL_TRIANGLES, gl.GL_TRIANGLE_STRIP, gl.GL_TRIANGLE_FAN, gl.GL_QUADS, gl.GL_QUAD_STRIP, gl.GL_POLYGON)


class Geometry(NamedTuple):
    """What the fill and shade stages need of a draw.

    triangles: those that are not culled and have an area; window (V', 4): x, y, z, 1/w; values, back (V', k) and flat
    (k,): what the vertex stage hands on; source (T',) which assembled triangle each clipped one is a piece of;
    provoking (T',).
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


def process_geometry(command: Draw, target: Framebuffer, storage: Storage) -> Geometry:
    """Return the triangles of a draw in the window of `target`.

    Raises
    ------
    StateError
        The draw asks for something that is not part of this subset.
    """
    state, vertices = command.state, command.vertices
    if command.mode not in FILLED or (state.polygon.mode_front, state.polygon.mode_back) != (gl.GL_FILL, gl.GL_FILL):
        raise StateError("points, lines and glPolygonMode other than GL_FILL are not part of this subset yet")
    program, uniforms = program_of(command, storage)
    arrays = (vertices.position, vertices.color, vertices.normal, vertices.texcoords)
    transforms = (command.modelview, command.projection, command.texture_matrices)
    varyings = program.vertex(VertexInputs(*arrays, *transforms, uniforms, command.modelview_kind, vertices.materials))
    clip = to_clip(matrices.multiply(command.projection, command.modelview), vertices.position)
    planes = user_planes(command)
    codes = outcodes(clip, state.depth.clamp, planes)
    assembled = assembled_triangles(command, codes != 0, batch_needs_clipping(command, planes))
    columns = varyings.values if varyings.back is None else np.hstack([varyings.values, varyings.back])
    clipped = clip_triangles(clip, columns, assembled.corners, codes, planes)
    window = to_window(clipped.clip, state.viewport, target.size[1], target.flipped)
    offset = offset_of(
        state.polygon, target.depth, window.dtype.type, command.offset_slope, command.offset_unit, target.flipped
    )
    triangles = set_up(window, clipped.triangles, state.cull, offset, target.flipped)
    if state.polygon.offset_fill and target.depth is not None and not target.depth.format.largest:
        add_float_units(triangles.depth[:, 3], window[triangles.vertices, 2], state.polygon.units)
    k = varyings.values.shape[1]
    return Geometry(
        triangles,
        window,
        np.ascontiguousarray(clipped.values[:, :k]),
        None if varyings.back is None else np.ascontiguousarray(clipped.values[:, k:]),
        varyings.flat,
        clipped.source,
        assembled.provoking[clipped.source],
        program,
        uniforms,
    )


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


def assembled_triangles(command: Draw, needs_clipping: np.ndarray, in_batch: np.ndarray | None = None) -> Triangles:
    """Return the triangles of a draw over its vertices.

    `needs_clipping` (V,) bool; `in_batch` (N,) the same for the batch of quads that the draw is a part of.
    """
    indices = command.indices
    count = len(needs_clipping) if indices is None else len(indices)
    if command.mode not in (gl.GL_QUADS, gl.GL_QUAD_STRIP):
        assembled = assemble(command.mode, count)
    else:
        varying_color = command.vertices.color.strides[0] != 0  # a constant is spread with stride 0
        flat = command.state.lighting.shade_model == gl.GL_FLAT and varying_color
        whole = needs_clipping if in_batch is None else in_batch
        clipped = in_clipped_batch(command.mode, whole, indices) if whole.any() else None
        if clipped is not None and in_batch is not None:
            clipped = clipped[command.batch_start // 4 :][: count // 4]
        assembled = assemble(command.mode, count, clipped, across=flat or indices is not None)
    return assembled if indices is None else through_indices(assembled, indices)


def program_of(command: Draw, storage: Storage) -> tuple[Program, Mapping[str, Any]]:
    """Return the program of a draw and its uniforms, samplers resolved to textures."""
    units = command.state.units
    bound = {i: storage.textures[u.bound_2d] for i, u in enumerate(units) if u.bound_2d in storage.textures}
    if not command.program_name:
        from softshadow.programs import fixed_function

        used = {i: texture for i, texture in bound.items() if units[i].enabled_2d}
        return fixed_function.program(command.state, used), command.uniforms
    program = programs.get(command.program_name)
    textures = {name: bound.get(value) for name, value in command.uniforms.items() if name in program.samplers}
    blocks = any(texture is not None and programs.needs_blocks(texture) for texture in textures.values())
    return replace(program, blocks=program.blocks or blocks), {**command.uniforms, **textures}


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
