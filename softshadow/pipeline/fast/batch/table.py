"""Draws that are processed together, as one table; equals `geometry.geometry.process_geometry`, see fast/test_batch.py.

The draws of a run have the same state but for their lighting, so they share a viewport, a program of the fixed function
and all that happens to fragments. Their matrices, vertices, current attributes and lights differ.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from copy import copy
from dataclasses import fields
from operator import attrgetter
from typing import NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.framebuffer import Framebuffer, Storage
from softshadow.jit import read_only
from softshadow.kernel_cache import KernelGroup
from softshadow.pipeline.commands import Draw, Vertices
from softshadow.pipeline.fast.batch import lighting
from softshadow.pipeline.fast.batch.assembly import MODES, POLYGONS
from softshadow.pipeline.fast.batch.vertices import (
    COLOR,
    END,
    EYE_LINEAR,
    FLOATS,
    HAS_ARRAY,
    MODELVIEW,
    NORMAL,
    NORMAL_MAP,
    NUMBERS,
    OBJECT_LINEAR,
    PROJECTION,
    REFLECTION_MAP,
    SPHERE_MAP,
    UNIT_COLUMNS,
    UNIT_CONSTANT,
    UNIT_IS_IDENTITY,
    UNIT_MATRIX,
    Layout,
)
from softshadow.pipeline.geometry.clip import NEAR_FAR
from softshadow.pipeline.geometry.geometry import user_planes
from softshadow.pipeline.geometry.program import bound_textures
from softshadow.pipeline.memory.scratch import scratch
from softshadow.pipeline.mesa.polygon_rules import passes_stages
from softshadow.pipeline.mesa.provoking_vertex import first_provokes
from softshadow.pipeline.mesa.rectangles import start_of_last_nine
from softshadow.programs import reflectances
from softshadow.programs.fixed_function import Unit, has_secondary, needs_vertex_color, units_in_use
from softshadow.programs.inverse import UNKNOWN
from softshadow.programs.texture_coordinates import IN_EYE_SPACE, needs_normals, reflects_r
from softshadow.programs.vertex_color_use import reads_primary_color
from softshadow.state import Lighting, Lines, MaterialState, Points, State

BATCH_KERNELS = KernelGroup("batch")
GENERATED = {
    gl.GL_OBJECT_LINEAR: OBJECT_LINEAR, gl.GL_EYE_LINEAR: EYE_LINEAR, gl.GL_SPHERE_MAP: SPHERE_MAP,
    gl.GL_REFLECTION_MAP: REFLECTION_MAP, gl.GL_NORMAL_MAP: NORMAL_MAP,
}  # fmt: skip
GROUPS = tuple(group.name for group in fields(State) if group.name not in ("lighting", "read_framebuffer"))
groups_of = attrgetter(*GROUPS)
# groups that concern fragments only, but for whether depths are clamped; alpha test and colour mask decide more
OF_TESTS = ("scissor", "stencil", "depth", "blend")
other_groups_of = attrgetter(*(group for group in GROUPS if group not in OF_TESTS))
LIGHT_MODEL = tuple(field.name for field in fields(Lighting) if field.name not in ("front", "back"))
MATERIAL = tuple(field.name for field in fields(MaterialState))
PLAIN_LINES, PLAIN_POINTS = Lines(), Points()
IDENTITY = np.eye(4, dtype=np.float32)


class Arrays(NamedTuple):
    """Which attributes of a draw are arrays, not constants: colour, normal, coordinates of each unit in use.

    `identities` says of each unit whether its texture matrix is the identity.
    """

    color: bool
    normal: bool
    texcoords: tuple[bool, ...]
    identities: tuple[bool, ...]


class Run:
    """What the draws of a run have in common.

    Attributes
    ----------
    state : State            of the first draw; the others differ at most in lights and materials
    command : Draw           the first draw
    units : the texture units in use
    writes_color : bool      else no colours are computed
    arrays : Arrays          of all draws
    across : bool            quads are cut along the other diagonal even without indices (`Varyings.flat_input`)
    layout, generated, planes, user_planes : of its `Table`
    """

    def __init__(self, command: Draw, storage: Storage, writes_color: bool) -> None:
        self.command, self.state, self.writes_color = command, command.state, writes_color
        bound = bound_textures(command, storage) if writes_color else {}
        self.units: list[Unit] = units_in_use(self.state, bound) if bound else []
        self._unit_numbers = [unit.index for unit in self.units]
        self.arrays = self._arrays_of(command)
        self._last = command  # taken
        is_flat = writes_color and self.state.lighting.shade_model == gl.GL_FLAT
        self.generated, self.planes, in_eye_space = _generation(self)
        self.user_planes = user_planes(command)
        self.layout = self._layout(in_eye_space)
        self.across = is_flat and (
            bool(self.layout.separate)
            or ((self.lit or self.arrays.color) and needs_vertex_color(self.state, self.units))
        )

    def _arrays_of(self, command: Draw) -> Arrays:
        vertices = command.vertices
        numbers = self._unit_numbers
        return Arrays(
            vertices.color.strides[0] != 0,
            vertices.normal.strides[0] != 0,
            tuple([vertices.texcoords[number].strides[0] != 0 for number in numbers]),
            tuple([self._is_identity(command.texture_matrices[number]) for number in numbers]),
        )

    def _layout(self, in_eye_space: bool) -> Layout:
        state, lit = self.state, self.lit
        settings = [state.units[number] for number in self._unit_numbers]
        return Layout(
            lit=int(lit),
            separate=int(lit and has_secondary(state)),
            two_side=int(lit and state.lighting.two_side),
            fog=int(self.writes_color and state.fog.enabled),
            colors=int(self.arrays.color),
            normals=int(self.arrays.normal),
            units=len(self.units),
            in_eye_space=int(in_eye_space),
            maps_normals=int(any(map(needs_normals, settings))),
            reflects_r=int(any(map(reflects_r, settings))),
            ignored=NEAR_FAR if state.depth.clamp else 0,
        )

    @staticmethod
    def _is_identity(matrix: np.ndarray) -> bool:
        return bool((matrix == IDENTITY).all())

    @property
    def lit(self) -> bool:
        """Whether vertices are lit."""
        return self.writes_color and self.state.lighting.enabled

    @property
    def reads_normals(self) -> bool:
        """Whether the colours or texture coordinates of vertices depend on their normals."""
        return self.lit or bool(self.layout.maps_normals)

    def _has_same_clip_planes(self, command: Draw, projection: np.ndarray, kind: int) -> bool:
        """Return whether the clip planes are those of the run in clip space, by a projection that has these."""
        if not len(self.user_planes):
            return True
        return command.projection_kind == kind and (
            command.projection is projection or command.projection.tobytes() == projection.tobytes()
        )

    def takes(self, command: Draw) -> bool:
        """Return whether a draw of the same kind as the others continues the run."""
        if self._is_like_last(command):
            return True
        if command.state is not self.state and groups_of(command.state) != groups_of(self.state):
            return False
        if not self._is_alike(command):
            return False
        self._last = command
        return True

    def under(self, command: Draw) -> Run | None:
        """Return the run that begins with a draw whose state has other tests or blending; None if more differs."""
        state, first = command.state, self.state
        if other_groups_of(state) != other_groups_of(first) or state.depth.clamp != first.depth.clamp:
            return None
        if not self._is_alike(command):
            return None
        run = copy(self)
        run.command, run.state, run._last = command, state, command
        return run

    def has_tests_of(self, state: State) -> bool:
        """Return whether a state that differs in tests or blending only has other scissor boxes at most."""
        return (
            state.depth is self.state.depth and state.stencil is self.state.stencil and state.blend is self.state.blend
        )

    def _is_alike(self, command: Draw) -> bool:
        """Return whether a draw continues the run as far as the groups of its state do not decide it."""
        if width_of(command.mode) != width_of(self.command.mode):
            return False
        if _structure(command.state.lighting) != _structure(self.state.lighting):
            return False
        if not self._has_same_clip_planes(command, self.command.projection, self.command.projection_kind):
            return False
        return self._arrays_of(command) == self.arrays and can_run(command)

    def _is_like_last(self, command: Draw) -> bool:
        """Return whether a draw differs from the last one only in what every run allows, as far as is seen at once."""
        last = self._last
        if command.state is not last.state or command.texture_matrices is not last.texture_matrices:
            return False
        if command.mode != last.mode or command.modelview_kind & UNKNOWN or command.joined_positions is not None:
            return False
        if command.mode == gl.GL_TRIANGLES and command.indices is None:
            return False
        if not self._has_same_clip_planes(command, last.projection, last.projection_kind):
            return False
        one, other, numbers = command.vertices, last.vertices, self._unit_numbers
        return one is other or (
            one.color.strides == other.color.strides
            and one.normal.strides == other.normal.strides
            and (
                one.texcoords is other.texcoords
                or [one.texcoords[n].strides for n in numbers] == [other.texcoords[n].strides for n in numbers]
            )
            and not one.materials
        )


def width_of(mode: int) -> int:
    """Return how many vertices a primitive has that reaches the setup: 3 for polygons, which are cut into triangles."""
    return 3 if mode in POLYGONS else 1 if mode == gl.GL_POINTS else 2


def key_of(state: State, *, with_tests: bool = True) -> tuple[int, ...]:
    """Return by what to look for a run that may take draws of a state: the identities of its groups."""
    return tuple(map(id, groups_of(state) if with_tests else other_groups_of(state)))


def _structure(lights: Lighting) -> tuple[object, ...]:
    """Return what decides which columns the varyings have."""
    shading = lights.shade_model, lights.provoking_vertex
    return lights.enabled, lights.two_side, lights.color_control, lights.color_material, *shading


def geometry_structure(run: Run) -> tuple[Hashable, ...]:
    """Return what the geometry of a run's draws depends on in their state and in which arrays they have."""
    state = run.state
    return (
        state.draw_framebuffer, state.viewport, state.polygon, state.depth.clamp, *_structure(state.lighting),
        run.layout, run.arrays, run.generated.tobytes(), run.planes.tobytes(), run.user_planes.tobytes(), run.across,
        run.writes_color,
        tuple([unit.index for unit in run.units]), width_of(run.command.mode),
    )  # fmt: skip


def can_run(command: Draw) -> bool:
    """Return whether a draw can be processed in a table, as far as its vertices and its primitives decide it."""
    if command.mode not in MODES or command.program_name or command.linear or command.joined_positions is not None:
        return False
    vertices, lights = command.vertices, command.state.lighting
    if vertices.materials or vertices.position.dtype != np.float32 or command.modelview_kind & UNKNOWN:
        return False
    if command.mode == gl.GL_TRIANGLES and command.indices is None and start_of_last_nine(len(vertices.position)) >= 0:
        return False  # triangles that llvmpipe leaves out (mesa.rectangles)
    # Mesa's back materials that follow the colour of each vertex have stale products (programs.stale_registers)
    return not (lights.enabled and lights.two_side and lights.color_material and vertices.color.strides[0])


def can_begin_run(command: Draw, target: Framebuffer) -> bool:
    """Return whether a draw can be processed in a table, as far as its state decides it."""
    state = command.state
    if not can_run(command) or not target.attachments or passes_stages(state):
        return False
    if state.lines != PLAIN_LINES or state.points != PLAIN_POINTS or first_provokes(state):
        return False
    fog, polygon = state.fog, state.polygon
    if fog.color_sum or fog.source != gl.GL_FRAGMENT_DEPTH:
        return False
    if polygon.mode_front != gl.GL_FILL or polygon.mode_back != gl.GL_FILL:
        return False  # edge flags may decide how quads are cut (geometry.draw_primitives)
    if not state.lighting.enabled and any(map(reads_primary_color, state.units)):
        return False
    modes = [gen.mode for unit in state.units for gen in unit.gen if gen.enabled]
    return all(mode in GENERATED for mode in modes)


class Table(NamedTuple):
    """The draws of a run as arrays, see the columns in `batch.vertices`.

    numbers (D, 9) int64; rows (D, 72), unit_rows (D, U, 21): matrices and constants; lights (L, N, 23), materials
    (L, 2, 20), flags (L, 9): each distinct `Lighting`; generated (U, 5), planes (U, 4, 4): generation of coordinates;
    user_planes (P, 4): those of the user in clip space, of all draws;
    positions (V, 4), colors (V, 4), normals (V, 3), texcoords (U, V, 4): of all draws one after the other, no rows
    where they are constants; indices (I,) int32.
    """

    layout: Layout
    numbers: np.ndarray
    rows: np.ndarray
    unit_rows: np.ndarray
    lights: np.ndarray
    materials: np.ndarray
    flags: np.ndarray
    generated: np.ndarray
    planes: np.ndarray
    user_planes: np.ndarray
    positions: np.ndarray
    colors: np.ndarray
    normals: np.ndarray
    texcoords: np.ndarray
    indices: np.ndarray


def table_of(run: Run, draws: Sequence[Draw]) -> Table:
    """Return the draws of a run as arrays."""
    arrays, vertices = run.arrays, [draw.vertices for draw in draws]
    rows = np.empty((len(draws), FLOATS), np.float32)
    rows[:, MODELVIEW:PROJECTION] = _matrices([draw.modelview for draw in draws])
    rows[:, PROJECTION:COLOR] = _matrices([draw.projection for draw in draws])
    if not arrays.color:
        rows[:, COLOR:NORMAL] = np.concatenate([each.color[:1] for each in vertices])
    if not arrays.normal:
        rows[:, NORMAL : NORMAL + 3] = np.concatenate([each.normal[:1] for each in vertices])
    numbers, lightings = _numbers(draws, run)
    return Table(
        run.layout,
        numbers,
        rows,
        _unit_rows(run, draws),
        *_lighting_arrays(lightings),
        run.generated,
        run.planes,
        run.user_planes,
        _joined([each.position for each in vertices], True),
        _joined([each.color for each in vertices], arrays.color),
        _joined([each.normal for each in vertices], arrays.normal and run.reads_normals),
        _texcoords(run, vertices, int(numbers[-1, END])),
        _joined([draw.indices for draw in draws if draw.indices is not None], True, NO_INDICES),
    )


def _matrices(matrices: Sequence[np.ndarray]) -> np.ndarray:
    """Return matrices as rows of 16 numbers; one row if all draws have the same."""
    if len(set(map(id, matrices))) == 1:
        return matrices[0].reshape(1, 16)
    return np.concatenate(matrices).reshape(-1, 16)


NO_ROWS, NO_INDICES = np.empty((0, 4), np.float32), np.empty(0, np.int32)


def _joined(parts: list[np.ndarray], is_array: bool, nothing: np.ndarray = NO_ROWS) -> np.ndarray:
    if not is_array or not parts:
        return read_only(nothing)
    if len(parts) == 1:
        return read_only(np.ascontiguousarray(parts[0]))
    joined = scratch((sum(map(len, parts)), *parts[0].shape[1:]), parts[0].dtype)
    return read_only(np.concatenate(parts, out=joined))


def _numbers(draws: Sequence[Draw], run: Run) -> tuple[np.ndarray, list[Lighting]]:
    """Return the numbers of each draw, and the states of lighting that kernels can tell apart."""
    reads_normals, across, last = run.reads_normals, run.across, draws[0].state.lighting
    table: list[int] = []  # in the order of the columns
    lightings, start, index_start = [last], 0, 0
    for draw in draws:
        indices, lights = draw.indices, draw.state.lighting
        end, indexed = start + len(draw.vertices.position), indices is not None
        index_end = index_start if indices is None else index_start + len(indices)
        if lights is not last and reads_normals and not _same_rows(lights, last):
            last = lights
            lightings.append(lights)
        row = len(lightings) - 1
        table += (start, end, draw.mode, index_start, index_end, indexed, draw.modelview_kind, row, across or indexed)
        start, index_start = end, index_end
    return np.array(table, np.int64).reshape(-1, NUMBERS), lightings


def _same_rows(a: Lighting, b: Lighting) -> bool:
    """Return whether two states of lighting have the same rows: a colour that follows glColor does not matter."""
    one, other = a.__dict__, b.__dict__
    if any(one[name] is not other[name] and one[name] != other[name] for name in LIGHT_MODEL):
        return False
    for side in ("front", "back"):
        followed = reflectances.followed(a, side)
        x, y = one[side].__dict__, other[side].__dict__
        if any(x[name] != y[name] for name in MATERIAL if name not in followed):
            return False
    return True


_rows_of: dict[int, tuple[Lighting, lighting.LightingRows]] = {}  # of the latest states of lighting, by id
KNOWN_LIGHTINGS = 256


def _rows(lights: Lighting) -> lighting.LightingRows:
    known = _rows_of.get(id(lights))
    if known is None or known[0] is not lights:
        if len(_rows_of) >= KNOWN_LIGHTINGS:
            _rows_of.clear()
        known = _rows_of[id(lights)] = (lights, lighting.lighting_rows(lights))
    return known[1]


def _lighting_arrays(lightings: list[Lighting]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return lights, materials and flags of all states of lighting."""
    rows = [_rows(each) for each in lightings]
    if len(rows) == 1:
        return rows[0].lights[np.newaxis], rows[0].materials[np.newaxis], rows[0].flags[np.newaxis]
    most = max(len(each.lights) for each in rows)
    lights = np.zeros((len(rows), most, lighting.LIGHT_COLUMNS), np.float32)
    for row, each in zip(lights, rows, strict=True):
        row[: len(each.lights)] = each.lights
    materials = np.array([each.materials for each in rows])
    flags = np.array([each.flags for each in rows])
    return lights, materials, flags


def _generation(run: Run) -> tuple[np.ndarray, np.ndarray, bool]:
    """Return how the coordinates of each unit are generated, the planes, and whether that is in eye space."""
    generated = np.zeros((len(run.units), 5), np.int64)
    planes, in_eye_space = np.zeros((len(run.units), 4, 4), np.float32), False
    for row, unit in enumerate(run.units):
        generated[row, HAS_ARRAY] = run.arrays.texcoords[row]
        for c, gen in enumerate(run.state.units[unit.index].gen):
            if gen.enabled:
                generated[row, c] = GENERATED[gen.mode]
                planes[row, c] = gen.object_plane if gen.mode == gl.GL_OBJECT_LINEAR else gen.eye_plane
                in_eye_space |= gen.mode in IN_EYE_SPACE
    return generated, planes, in_eye_space


def _unit_rows(run: Run, draws: Sequence[Draw]) -> np.ndarray:
    rows = np.zeros((len(draws), len(run.units), UNIT_COLUMNS), np.float32)
    for n, unit in enumerate(run.units):
        matrices = [draw.texture_matrices[unit.index] for draw in draws]
        rows[:, n, UNIT_MATRIX:UNIT_CONSTANT] = _matrices(matrices)
        rows[:, n, UNIT_IS_IDENTITY] = run.arrays.identities[n]
        if not run.arrays.texcoords[n]:
            rows[:, n, UNIT_CONSTANT:UNIT_IS_IDENTITY] = [draw.vertices.texcoords[unit.index][0] for draw in draws]
    return rows


def _texcoords(run: Run, vertices: Sequence[Vertices], n_vertices: int) -> np.ndarray:
    """Return the arrays of coordinates (U, V, 4); those of a unit without one are not set."""
    if len(run.units) == 1 and run.arrays.texcoords[0]:
        return _joined([each.texcoords[run.units[0].index] for each in vertices], True)[np.newaxis]
    texcoords = np.empty((len(run.units), n_vertices, 4), np.float32)
    for n, unit in enumerate(run.units):
        if run.arrays.texcoords[n]:
            np.concatenate([each.texcoords[unit.index] for each in vertices], out=texcoords[n])
    return read_only(texcoords)
