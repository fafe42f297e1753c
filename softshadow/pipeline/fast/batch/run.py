"""Which draws form a run; its triangles equal `geometry.geometry.process_geometry`, see fast/test_batch.py.

The draws of a run are processed together. They have the same state but for their lighting, clip planes, viewport and
scissor box, so they share a program of the fixed function and nearly all that happens to fragments. Their matrices,
vertices, current attributes, viewports and lights differ, and the widths of lines and sizes of points.
"""

from __future__ import annotations

from collections.abc import Hashable
from copy import copy
from dataclasses import fields
from operator import attrgetter
from typing import NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.framebuffer import Storage
from softshadow.pipeline.commands import Draw, Vertices
from softshadow.pipeline.fast.batch.admission import (
    can_run,
    is_filled,
    is_long,
    is_outlined_alone,
    leaves_out_triangles,
)
from softshadow.pipeline.fast.batch.assembly import POLYGONS, WIDTH_OF_LINES, WIDTH_OF_POLYGONS, width_of
from softshadow.pipeline.fast.batch.vertices import (
    BY_COORDINATE,
    BY_DISTANCE,
    GENERATED,
    HAS_ARRAY,
    NO_FOG,
    Layout,
)
from softshadow.pipeline.geometry.clip import NEAR_FAR
from softshadow.pipeline.geometry.program import bound_textures
from softshadow.pipeline.mesa.polygon_rules import effective_modes, is_stippled, passes_stages
from softshadow.programs.fixed_function import (
    Unit,
    has_secondary,
    is_replaced,
    needs_vertex_color,
    repeats_primary,
    units_in_use,
)
from softshadow.programs.inverse import UNKNOWN
from softshadow.programs.texture_coordinates import IN_EYE_SPACE, needs_normals, reflects_r
from softshadow.state import Lighting, Polygon, State

# lights, materials and planes differ between the draws of a run; other viewports and scissor boxes begin a segment
DIFFERENT = ("lighting", "clip_planes", "viewport", "scissor", "read_framebuffer")
GROUPS = tuple(group.name for group in fields(State) if group.name not in DIFFERENT)
_groups_of = attrgetter(*GROUPS)
POLYGON = GROUPS.index("polygon")
# groups that concern fragments only, but for whether depths are clamped; alpha test and colour mask decide more
OF_TESTS = ("stencil", "depth", "blend")
OTHERS = tuple(number for number, group in enumerate(GROUPS) if group not in OF_TESTS)
PLAIN_POLYGON = Polygon()
NO_NAMES: frozenset[str] = frozenset()
IDENTITY = np.eye(4, dtype=np.float32)
IDENTITY_BYTES = IDENTITY.tobytes()


class Arrays(NamedTuple):
    """Which attributes of a draw are arrays, not constants: colour, normal, coordinates of each unit in use.

    `secondary` is true only where the colours depend on secondary ones. `identities` says of each unit whether its
    texture matrix is the identity. `materials` are the names of those that lit vertices have.
    """

    color: bool
    normal: bool
    secondary: bool
    texcoords: tuple[bool, ...]
    identities: tuple[bool, ...]
    materials: frozenset[str]


class Run:
    """What the draws of a run have in common.

    Attributes
    ----------
    state : State            of the first draw; the others differ at most in what `DIFFERENT` names
    command : Draw           the first draw
    units : the texture units in use
    repeats_primary : bool   the primary colour is among the varyings twice
    writes_color : bool      else no colours are computed
    reads_secondaries : bool    the colours depend on the secondary colours of the vertices
    arrays : Arrays          of all draws
    unfilled : bool          polygons are stippled, or drawn as their edges or corners (glPolygonMode)
    stippled : bool          lines are cut into pieces by a pattern
    across : bool            quads are cut along the other diagonal even without indices (`Varyings.flat_input`)
    layout, generated, planes : of its `Table`
    """

    def __init__(self, command: Draw, storage: Storage, writes_color: bool) -> None:
        self.command, self.state, self.writes_color = command, command.state, writes_color
        bound = bound_textures(command, storage) if writes_color else {}
        self.units: list[Unit] = units_in_use(self.state, bound) if bound else []
        self._unit_numbers = [unit.index for unit in self.units]
        self.reads_secondaries = writes_color and self.state.fog.color_sum and not self.state.lighting.enabled
        self.repeats_primary = writes_color and repeats_primary(self.state, self.units)
        self.arrays = self._arrays_of(command)
        self.unfilled = width_of(command.mode) == WIDTH_OF_POLYGONS and passes_stages(self.state)
        self.stippled = width_of(command.mode) == WIDTH_OF_LINES and is_stippled(self.state.lines)
        is_flat = writes_color and self.state.lighting.shade_model == gl.GL_FLAT
        self.generated, self.planes, in_eye_space = _generation(self)
        self._fills = is_filled(self.state.polygon)
        self.layout = self._layout(in_eye_space)
        self.across = is_flat and (
            bool(self.lit and self.layout.secondary)
            or self.arrays.secondary
            or self.repeats_primary
            or ((self.lit or self.arrays.color) and needs_vertex_color(self.state, self.units))
        )

    def _arrays_of(self, command: Draw) -> Arrays:
        vertices = command.vertices
        numbers = self._unit_numbers
        return Arrays(
            vertices.color.strides[0] != 0,
            vertices.normal.strides[0] != 0,
            self.reads_secondaries and has_secondaries(vertices),
            tuple([vertices.texcoords[number].strides[0] != 0 for number in numbers]),
            self._identities_of(command),
            frozenset(vertices.materials) if self.lit and vertices.materials else NO_NAMES,
        )

    def _identities_of(self, command: Draw) -> tuple[bool, ...]:
        """Return of each unit in use whether its texture matrix is the identity."""
        return tuple([self._is_identity(command.texture_matrices[number]) for number in self._unit_numbers])

    def _layout(self, in_eye_space: bool) -> Layout:
        state, lit = self.state, self.lit
        settings = [state.units[number] for number in self._unit_numbers]
        return Layout(
            lit=int(lit),
            separate=int(lit and state.lighting.color_control == gl.GL_SEPARATE_SPECULAR_COLOR),
            secondary=int(self.writes_color and has_secondary(state)),
            two_side=int(lit and state.lighting.two_side),
            fog=self._fog(),
            colors=int(self.arrays.color),
            normals=int(self.arrays.normal),
            units=len(self.units),
            in_eye_space=int(in_eye_space),
            maps_normals=int(any(map(needs_normals, settings))),
            reflects_r=int(any(map(reflects_r, settings))),
            repeats_primary=int(self.repeats_primary),
            ignored=NEAR_FAR if state.depth.clamp else 0,
        )

    def _fog(self) -> int:
        fog = self.state.fog
        if not (self.writes_color and fog.enabled):
            return NO_FOG
        return BY_DISTANCE if fog.source == gl.GL_FRAGMENT_DEPTH else BY_COORDINATE

    @staticmethod
    def _is_identity(matrix: np.ndarray) -> bool:
        return matrix.tobytes() == IDENTITY_BYTES or bool((matrix == IDENTITY).all())

    @property
    def lit(self) -> bool:
        """Whether vertices are lit."""
        return self.writes_color and self.state.lighting.enabled

    @property
    def reads_normals(self) -> bool:
        """Whether the colours or texture coordinates of vertices depend on their normals."""
        return self.lit or bool(self.layout.maps_normals)

    def takes(self, command: Draw) -> bool:
        """Return whether a draw of the same kind as the others continues the run."""
        has_state = command.state is self.state or groups_of(command) == groups_of(self.command)
        return has_state and self._is_alike(command)

    def under(self, command: Draw) -> Run | None:
        """Return the run that begins with a draw whose tests or blending differ; None if more does."""
        state, first = command.state, self.state
        if _without_tests(groups_of(command)) != _without_tests(groups_of(self.command)):
            return None
        if state.depth.clamp != first.depth.clamp:
            return None
        if not self._is_alike(command):
            return None
        run = copy(self)
        run.command, run.state = command, state
        return run

    def has_tests_of(self, state: State) -> bool:
        """Return whether a state that differs in tests or blending at most has the same tests."""
        return (
            state.depth is self.state.depth and state.stencil is self.state.stencil and state.blend is self.state.blend
        )

    def _is_alike(self, command: Draw) -> bool:
        """Return whether a draw continues the run as far as the groups of its state do not decide it."""
        if width_of(command.mode) != width_of(self.command.mode) or self._goes_in_chunks(command):
            return False
        if structure_of(command.state.lighting) != structure_of(self.state.lighting):
            return False
        return self._arrays_of(command) == self.arrays and can_run(command)

    def _goes_in_chunks(self, command: Draw) -> bool:
        return not self.writes_color and is_long(command)

    def continues(self, command: Draw, taken: Draw) -> bool:
        """Return whether a draw differs from one of the run only in what every run allows, as is seen at once."""
        return command.state is taken.state and self.continues_under(command, taken)

    def continues_under(self, command: Draw, taken: Draw) -> bool:
        """Return what `continues` returns of a draw whose state has the groups and `structure_of` of the other's."""
        mode = command.mode
        if mode != taken.mode or command.modelview_kind & UNKNOWN or command.joined_positions is not None:
            return False
        if self._goes_in_chunks(command):
            return False
        has_same_matrices = command.texture_matrices is taken.texture_matrices
        if not has_same_matrices and self._identities_of(command) != self.arrays.identities:
            return False
        if mode == gl.GL_TRIANGLES and leaves_out_triangles(command):
            return False
        if not self._fills and is_outlined_alone(command):
            return False
        one, other, numbers = command.vertices, taken.vertices, self._unit_numbers
        return one is other or (
            one.color.strides == other.color.strides
            and one.normal.strides == other.normal.strides
            and (not self.reads_secondaries or has_secondaries(one) == has_secondaries(other))
            and (
                one.texcoords is other.texcoords
                or [one.texcoords[n].strides for n in numbers] == [other.texcoords[n].strides for n in numbers]
            )
            and one.materials.keys() == other.materials.keys()
        )


def has_secondaries(vertices: Vertices) -> bool:
    """Return whether vertices have secondary colours that may differ."""
    return vertices.secondary is not None and vertices.secondary.strides[0] != 0


def groups_of(command: Draw) -> tuple[object, ...]:
    """Return the groups of a draw's state that are those of the run, without what does not matter.

    That is all of `Polygon` for lines and points.
    """
    state = command.state
    groups: tuple[object, ...] = _groups_of(state)
    if command.mode not in POLYGONS:
        groups = (*groups[:POLYGON], PLAIN_POLYGON, *groups[POLYGON + 1 :])
    return groups


def _without_tests(groups: tuple[object, ...]) -> tuple[object, ...]:
    return tuple([groups[number] for number in OTHERS])


def key_of(command: Draw, *, with_tests: bool = True) -> tuple[int, ...]:
    """Return by what to look for a run that may take a draw: the identities of its state's groups."""
    groups = groups_of(command)
    return tuple(map(id, groups if with_tests else _without_tests(groups)))


def structure_of(lights: Lighting) -> tuple[object, ...]:
    """Return what decides which columns the varyings have."""
    shading = lights.shade_model, lights.provoking_vertex
    return lights.enabled, lights.two_side, lights.color_control, lights.color_material, *shading


def geometry_structure(run: Run) -> tuple[Hashable, ...]:
    """Return what the geometry of a run's draws depends on in their state and in which arrays they have."""
    state = run.state
    return (
        state.draw_framebuffer, groups_of(run.command)[POLYGON], state.depth.clamp, *structure_of(state.lighting),
        run.layout, run.arrays, run.generated.tobytes(), run.planes.tobytes(), run.across,
        run.writes_color, effective_modes(state), state.lines, state.points,
        tuple([unit.index for unit in run.units]), width_of(run.command.mode),
    )  # fmt: skip


def _generation(run: Run) -> tuple[np.ndarray, np.ndarray, bool]:
    """Return how the coordinates of each unit are generated, the planes, and whether that is in eye space."""
    generated = np.zeros((len(run.units), 5), np.int64)
    planes, in_eye_space = np.zeros((len(run.units), 4, 4), np.float32), False
    for row, unit in enumerate(run.units):
        if is_replaced(run.state, unit.index):
            continue
        generated[row, HAS_ARRAY] = run.arrays.texcoords[row]
        for c, gen in enumerate(run.state.units[unit.index].gen):
            if gen.enabled:
                generated[row, c] = GENERATED[gen.mode]
                planes[row, c] = gen.object_plane if gen.mode == gl.GL_OBJECT_LINEAR else gen.eye_plane
                in_eye_space |= gen.mode in IN_EYE_SPACE
    return generated, planes, in_eye_space
