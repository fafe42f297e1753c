"""How the commands that have waited in the queue are carried out: in their order, draws as batches and segments.

The triangles of all draws whose geometry depends on the same state are set up at once, as a batch. Its consecutive
draws under one state are a segment, and segments of few fragments are drawn as groups.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from softshadow import pipeline
from softshadow.framebuffer import Storage
from softshadow.jit import announce_compiling
from softshadow.pipeline.alike_draws import DrawList
from softshadow.pipeline.choose import can_join_others, joins_others
from softshadow.pipeline.commands import Command, DefineImage, Draw, UpdateImage
from softshadow.pipeline.draw_kinds import Kind
from softshadow.pipeline.execute import execute
from softshadow.pipeline.plan import plan_draw
from softshadow.pipeline.records import FragmentCounts
from softshadow.state import State

try:
    from softshadow.pipeline.fast.batch.geometry import geometry_of
    from softshadow.pipeline.fast.batch.segments import Part, cut, whole
    from softshadow.pipeline.fast.batch.table import BATCH_KERNELS
    from softshadow.pipeline.fast.segment_groups import Group
except ModuleNotFoundError:  # the folder can be deleted: then no draw waits
    pass


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


def execute_waiting(batches: Mapping[int, DrawList], commands: Sequence[Segment | Command], storage: Storage) -> None:
    """Carry out commands; `batches` has the draws of all segments among them, by the numbers of their kinds."""
    if not BATCH_KERNELS.are_compiled():
        announce_compiling()
    with np.errstate(all="ignore"):  # as in pipeline.draw
        parts = _parts_of([each for each in commands if isinstance(each, Segment)], batches, storage)
        BATCH_KERNELS.note_compiled()
        group: Group | None = None
        for command in commands:
            if isinstance(command, Segment):
                part = parts[id(command)]
                if part.end > part.first:
                    group = _draw_segment(command, part, group, storage, len(commands) == 1)
                continue
            if group and not (isinstance(command, UpdateImage | DefineImage) and group.keeps(command.texture)):
                group.draw()
                group = None
            execute(command, storage)
        if group:
            group.draw()


def _parts_of(segments: Sequence[Segment], batches: Mapping[int, DrawList], storage: Storage) -> dict[int, Part]:
    """Return the triangles of each segment, by its identity."""
    parts: dict[int, Part] = {}
    of_batch: dict[int, list[Segment]] = {number: [] for number in batches}
    for segment in segments:
        of_batch[segment.kind.batch].append(segment)
    for number, own in of_batch.items():
        draws, kind = batches[number].plain, own[0].kind
        target = storage.framebuffers[kind.run.state.draw_framebuffer]
        batch = geometry_of(kind.run, kind.setting, draws, target, storage)
        if len(own) == 1:
            parts[id(own[0])] = whole(batch)
            continue
        firsts, settings = [segment.first for segment in own], [segment.kind.setting for segment in own]
        parts.update(zip(map(id, own), cut(batch, draws, firsts, settings), strict=True))
    return parts


def _draw_segment(segment: Segment, part: Part, group: Group | None, storage: Storage, is_alone: bool) -> Group | None:
    """Draw the triangles of a segment, or add them to a group, which may be a new one; return the group.

    The draws of a group that has been drawn, or could not take them, come first. A segment that `is_alone` needs no
    group.
    """
    plan, command, query = segment.kind.plan, segment.command, segment.query
    state, target = command.state, storage.framebuffers[command.state.draw_framebuffer]
    if group and not query and can_join_others(plan, part) and group.takes_again(command, part):
        return group
    counts = FragmentCounts.zero(only_passed=True) if query else None
    if counts is not None:
        if not segment.kind.counting:
            segment.kind.counting.append(plan_draw(command, target, counts))
        (plan,) = segment.kind.counting
    numbers = None if is_alone else joins_others(plan, state, target, part)
    if numbers is None:
        if group:
            group.draw()
        pipeline.draw_geometry(plan, command, target, storage, part.geometry(), counts)
        if counts is not None:
            storage.note_passed(query, counts.passed)
        return None
    if group and group.takes(command, numbers, part, target, query):
        return group
    if group:
        group.draw()
    group = Group(target, storage)
    group.takes(command, numbers, part, target, query)
    return group
