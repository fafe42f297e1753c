"""Draws that wait until someone looks at the buffers, and then are carried out together.

A thousand draws of twelve triangles cost a thousand times what Python needs for one. The triangles of all draws whose
geometry depends on the same state are set up at once, as a batch; consecutive draws under one state, a segment, are
filled and shaded at once. Draws wait only if they cannot fail (`plan.begin_run`), so errors appear at the calls that
make them. Clears among them wait, too: a program with many views clears a part of the window for each.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from itertools import count
from typing import NamedTuple

import numpy as np

from softshadow import pipeline
from softshadow import tokens as gl
from softshadow.framebuffer import DEFAULT, Framebuffer, Storage
from softshadow.jit import announce_compiling
from softshadow.pipeline.buffers.clear import clear
from softshadow.pipeline.choose import joins_others
from softshadow.pipeline.commands import Clear, Draw
from softshadow.pipeline.geometry.program import textures_of
from softshadow.pipeline.plan import (
    MOST_DRAWS,
    MOST_VERTICES,
    SHORT_CUTS_EXIST,
    Plan,
    begin_run,
    may_wait,
    plan_draw,
)
from softshadow.pipeline.records import FragmentCounts
from softshadow.state import State

try:
    from softshadow.pipeline.fast.any_state import FILL_KERNELS
    from softshadow.pipeline.fast.batch.geometry import Setting, geometry_of, setting_of
    from softshadow.pipeline.fast.batch.run import WORTH_COMPARING, Run, key_of, structure_of, width_of
    from softshadow.pipeline.fast.batch.segments import Part, cut, geometry_key, whole
    from softshadow.pipeline.fast.batch.table import BATCH_KERNELS
    from softshadow.pipeline.fast.map_visibility_kernel import VISIBILITY_KERNEL
    from softshadow.pipeline.fast.segment_groups import Group
except ModuleNotFoundError:  # the folder can be deleted: then no draw waits
    pass


KNOWN_KINDS = 1024
KNOWN_VERTICES = 64 * MOST_VERTICES  # about, of the draws that kinds keep


class Kind(NamedTuple):
    """A state of draws that wait, with all that depends on it: run and setting for their geometry, plan for the rest.

    Kinds of one `batch` share batches: all that their geometry depends on is equal. `counting` keeps the plan of draws
    whose fragments an occlusion query counts.
    """

    run: Run
    setting: Setting
    plan: Plan
    batch: int
    counting: list[Plan]


@dataclass(eq=False, slots=True)
class Segment:
    """Consecutive draws of one kind with one viewport and one scissor box, which are those of `command`.

    `first` and `end` are the places of the first one, and of the one after the last, in their batch; `query` counts
    their fragments, if it is not 0.
    """

    kind: Kind
    command: Draw
    first: int
    end: int
    query: int

    def continues_with(self, state: State, query: int) -> bool:
        """Return whether a draw of the kind has the same viewport, scissor box and query."""
        own = self.command.state
        is_in_place = own is state or (own.scissor is state.scissor and own.viewport is state.viewport)
        return is_in_place and self.query == query


def _key_without_tests(command: Draw) -> tuple[int, ...]:
    """Return by what to look for a kind that may differ in tests and blending only."""
    return *key_of(command, with_tests=False), width_of(command.mode)


class DrawQueue:
    """The draws of a context that are not carried out yet.

    Parameters
    ----------
    storage : Storage        what they will be drawn to
    compiles : bool          whether to compile kernels at the first use: for one picture some of them do not pay
    """

    def __init__(self, storage: Storage, compiles: bool = True) -> None:
        self._storage, self._compiles = storage, compiles
        if compiles and SHORT_CUTS_EXIST:
            FILL_KERNELS.want()
            VISIBILITY_KERNEL.want()
        # by the identity of what they depend on; the latest by all but their tests and blending
        self._known: dict[tuple[int, ...], list[Kind]] = {}
        self._latest: dict[tuple[int, ...], Kind] = {}
        # the latest, and a draw of it: by its mode and what of its state matters; by the identity of the state and the
        # mode, if the draw is small, as nobody counts the vertices that are kept so
        self._of_states: dict[tuple[object, ...], tuple[Kind, Draw]] = {}
        self._of_state: dict[tuple[int, int], tuple[Kind, Draw]] = {}
        self._batch_numbers: dict[Hashable, int] = {}  # by geometry key
        self._next_number = count()
        self._known_vertices = 0
        self._kind: Kind | None = None  # of the last draw
        self._like: Draw  # a draw of this kind
        self._batches: dict[int, list[Draw]] = {}  # by their numbers
        self._segments: list[Segment | Clear] = []  # in drawing order
        self._segment: Segment | None = None  # the last one, if no clear follows it
        self._queries: set[int] = set()  # that count fragments of these; 0 if some are not counted
        self._textures: set[int] = set()  # names of those that they may read
        self._states: dict[int, State] = {}  # by their units' identity, where these names are not added yet
        self._framebuffers: set[int] = set()  # that they, and clears among them, write to
        self._n_commands, self._n_vertices, self._are_small = 0, 0, True

    def add(self, command: Draw) -> bool:
        """Let a draw wait; return False if it must be carried out at once (all draws before it have been, then)."""
        n_vertices = len(command.vertices.position)
        if self._n_vertices + n_vertices > MOST_VERTICES:
            self.carry_out()
        kind = self._kind
        if kind is None or not kind.run.continues(command, self._like):
            kind = self._kind_of(command)
            if kind is None:
                self.carry_out()
                return False
            # large meshes are drawn again under other states: alone, they are found to be equal
            if kind is not self._kind and not (self._are_small and n_vertices < WORTH_COMPARING):
                self.carry_out()
            self._kind, self._like = kind, command
        batch = self._batches.get(kind.batch)
        if batch is None:
            batch = self._batches[kind.batch] = []
        batch.append(command)
        last, query = self._segment, self._storage.active_query
        if last is not None and last.kind is kind and last.continues_with(command.state, query):
            last.end += 1
        else:
            self._segment = Segment(kind, command, len(batch) - 1, len(batch), query)
            self._segments.append(self._segment)
            self._queries.add(query)
            state = command.state
            self._states[id(state.units)] = state
            self._framebuffers.add(state.draw_framebuffer)
        self._n_commands += 1
        self._n_vertices += n_vertices
        self._are_small = self._are_small and n_vertices < WORTH_COMPARING
        if self._n_commands == MOST_DRAWS:
            self.carry_out()
        return True

    def add_alike(self, commands: Sequence[Draw]) -> int:
        """Let draws wait that differ from the first one in vertices and indices only; return how many do, from it on.

        Where the first one has an array of an attribute, all have one, and where it has one value, all have one.
        """
        if not self.add(commands[0]):
            return 0
        others, counts = commands[1:], [len(command.vertices.position) for command in commands]
        n_vertices = sum(counts) - counts[0]
        is_full = self._n_commands + len(others) >= MOST_DRAWS or self._n_vertices + n_vertices > MOST_VERTICES
        if is_full or max(counts) >= WORTH_COMPARING or self._kind is None or self._segment is None:
            return 1
        self._batches[self._kind.batch] += others
        self._segment.end += len(others)
        self._n_commands += len(others)
        self._n_vertices += n_vertices
        return len(commands)

    def add_clear(self, command: Clear) -> bool:
        """Let a clear wait behind draws; return False if it must be carried out at once (all draws have been, then).

        A clear of the whole window begins a picture, so what it hides need not wait any longer.
        """
        state = command.state
        if state.draw_framebuffer == DEFAULT and command.mask & gl.GL_COLOR_BUFFER_BIT and not state.scissor.enabled:
            self.carry_out()
        if not self._segments:
            return False
        self._segments.append(command)
        self._segment = None
        self._framebuffers.add(state.draw_framebuffer)
        self._n_commands += 1
        if self._n_commands == MOST_DRAWS:
            self.carry_out()
        return True

    def _kind_of(self, command: Draw) -> Kind | None:
        """Return the kind of a draw, or None if it cannot wait."""
        if not may_wait(command) or not (self._compiles or BATCH_KERNELS.are_compiled()):
            return None
        state = command.state
        known = self._of_state.get((id(state), command.mode))
        if known is not None and known[0].run.continues(command, known[1]):
            return known[0]
        kind = self._kind_of_equal_state(command)
        if kind is not None and len(command.vertices.position) < WORTH_COMPARING:
            if len(self._of_state) >= KNOWN_KINDS:
                self._of_state.clear()
            self._of_state[id(state), command.mode] = kind, command
        return kind

    def _kind_of_equal_state(self, command: Draw) -> Kind | None:
        key = key_of(command)
        place = *key, *structure_of(command.state.lighting), command.mode
        known = self._of_states.get(place)
        if known is not None and known[0].run.continues_under(command, known[1]):
            return known[0]
        kind = next((each for each in self._known.get(key, ()) if each.run.takes(command)), None)
        is_new = kind is None
        if kind is None:
            target = self._storage.framebuffers[command.state.draw_framebuffer]
            kind = self._with_other_tests(command, target) or self._new_kind(command, target)
        if kind is not None:
            if len(self._known) >= KNOWN_KINDS or self._known_vertices > KNOWN_VERTICES:
                self.forget()
                self._batch_numbers.clear()
            if len(self._of_states) >= KNOWN_KINDS:
                self._of_states.clear()
            if is_new:
                self._known.setdefault(key, []).append(kind)
            self._of_states[place] = kind, command
            self._known_vertices += len(command.vertices.position)
        return kind

    def _with_other_tests(self, command: Draw, target: Framebuffer) -> Kind | None:
        """Return the kind of a draw by one that differs in tests and blending only."""
        similar = self._latest.get(_key_without_tests(command))
        run = None if similar is None else similar.run.under(command)
        if similar is None or run is None:
            return None
        same_tests = similar.run.has_tests_of(command.state)
        if same_tests:
            return similar._replace(run=run)
        return similar._replace(run=run, plan=plan_draw(command, target), counting=[])

    def _new_kind(self, command: Draw, target: Framebuffer) -> Kind | None:
        run = begin_run(command, target, self._storage)
        if run is None:
            return None
        setting = setting_of(run, target, self._storage)
        batch = self._batch_numbers.setdefault(geometry_key(run, setting), next(self._next_number))
        kind = Kind(run, setting, plan_draw(command, target), batch, [])
        self._latest[_key_without_tests(command)] = kind
        return kind

    def forget(self) -> None:
        """Forget the kinds of runs, when a texture or a framebuffer object changes; draws that wait keep theirs."""
        self._kind = None
        self._known.clear()
        self._latest.clear()
        self._of_states.clear()
        self._of_state.clear()
        self._known_vertices = 0
        if not self._segments:
            self._batch_numbers.clear()

    def may_use(self, texture: int) -> bool:
        """Return whether draws or clears that wait may read a texture object, or write to it."""
        if not self._framebuffers <= {DEFAULT}:
            return True
        for state in self._states.values():
            self._textures |= textures_of(state)
        self._states.clear()
        return texture in self._textures

    def finish_query(self, query: int) -> None:
        """Carry out the draws that wait if an occlusion query counts fragments of some; 0 stands for no query."""
        if query and query in self._queries:
            self.carry_out()

    def carry_out(self) -> None:
        """Carry out the draws that wait."""
        batches, segments = self._batches, self._segments
        if not segments:
            return
        self._kind, self._batches, self._queries = None, {}, set()
        self._segments, self._segment = [], None
        self._states, self._textures, self._framebuffers = {}, set(), set()
        self._n_commands, self._n_vertices, self._are_small = 0, 0, True
        if not BATCH_KERNELS.are_compiled():
            announce_compiling()
        with np.errstate(all="ignore"):  # as in pipeline.draw
            parts = self._parts(batches, [each for each in segments if isinstance(each, Segment)])
            BATCH_KERNELS.note_compiled()
            group: Group | None = None
            for segment in segments:
                if isinstance(segment, Clear):
                    if group:
                        group.draw()
                    group = None
                    clear(segment, self._storage)
                elif (part := parts[id(segment)]).end > part.first:
                    group = self._draw_segment(segment, part, group)
            if group:
                group.draw()

    def _draw_segment(self, segment: Segment, part: Part, group: Group | None) -> Group | None:
        """Draw the triangles of a segment, or add them to a group, which may be a new one; return the group.

        The draws of a group that has been drawn, or could not take them, come first.
        """
        plan, command, query, storage = segment.kind.plan, segment.command, segment.query, self._storage
        state, target = command.state, storage.framebuffers[command.state.draw_framebuffer]
        counts = FragmentCounts.zero(only_passed=True) if query else None
        if counts is not None:
            if not segment.kind.counting:
                segment.kind.counting.append(plan_draw(command, target, counts))
            (plan,) = segment.kind.counting
        numbers = joins_others(plan, state, target, part)
        if numbers is None:
            if group:
                group.draw()
            pipeline.draw_geometry(plan, command, target, storage, part.geometry(), counts)
            if counts is not None:
                storage.note_passed(query, counts.passed)
            return None
        if group and group.takes(state, numbers, part, target, query):
            return group
        if group:
            group.draw()
        group = Group(target, storage)
        group.takes(state, numbers, part, target, query)
        return group

    def _parts(self, batches: dict[int, list[Draw]], segments: list[Segment]) -> dict[int, Part]:
        """Return the triangles of each segment, by its identity."""
        parts: dict[int, Part] = {}
        of_batch: dict[int, list[Segment]] = {number: [] for number in batches}
        for segment in segments:
            of_batch[segment.kind.batch].append(segment)
        for number, own in of_batch.items():
            draws, kind = batches[number], own[0].kind
            target = self._storage.framebuffers[kind.run.state.draw_framebuffer]
            batch = geometry_of(kind.run, kind.setting, draws, target, self._storage)
            if len(own) == 1:
                parts[id(own[0])] = whole(batch)
                continue
            firsts, settings = [segment.first for segment in own], [segment.kind.setting for segment in own]
            parts.update(zip(map(id, own), cut(batch, draws, firsts, settings), strict=True))
        return parts
