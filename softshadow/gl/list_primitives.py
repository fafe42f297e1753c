"""Primitives in display lists: arrays instead of calls.

A list is compiled once and called often. `list_compiling` makes arrays of its primitives; each call of the list then
draws them at once.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import groupby
from operator import is_
from typing import Any, NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, current
from softshadow.context.arrays import COLOR, NORMAL, POSITION, SLOT_NAMES, TEXCOORD
from softshadow.gl.constant_attributes import ConstantAttribute, ConstantSet, DrawnVertices, constant_attributes
from softshadow.gl.errors import GLError, fail
from softshadow.gl.framebuffers import can_be_drawn_to
from softshadow.gl.list_calls import Values
from softshadow.gl.materials import follow_color
from softshadow.gl.moved_draws import continue_draw, draw_maybe_later
from softshadow.gl.pair_numbers import can_be_joined
from softshadow.pipeline.commands import Draw, Vertices
from softshadow.pipeline.geometry.separate import SEPARABLE, STRIPS, can_be_separated, pairs_mode_of, separate_indices
from softshadow.pipeline.mesa.driver_draws import SEPARATE
from softshadow.pipeline.mesa.segments import INDEXED_SEGMENT
from softshadow.state import TEXTURE_UNITS

MOST_DRAWN = 16  # current values that a primitive was drawn with


class LatestDraw(NamedTuple):
    """How a primitive was drawn: its vertices, the draw that it continued, and the current values, which it left."""

    vertices: Vertices
    before: Draw
    color: tuple[float, ...]
    normal: tuple[float, ...]
    texcoords: tuple[tuple[float, ...], ...]

    def has_values_of(self, context: Context) -> bool:
        """Return whether these values are the current ones, the same objects, and none is pending."""
        current, pending = context.current, context.pending
        if current.color is not self.color or current.normal is not self.normal:
            return False
        if pending.old_values or pending.names or pending.hidden or pending.before_following or pending.settled:
            return False
        return all(map(is_, current.texcoords, self.texcoords))


@dataclass(eq=False)
class ListPrimitive:
    """A glBegin ... glEnd pair of a list, or a draw from arrays.

    Attributes
    ----------
    calls : list                 what it stands for
    rows : dict                  slot: one row per vertex, read-only; `indices` name equal vertices several times
    starts : dict                slot: the first vertex that has a value of the list; those before have the current one
    last : dict                  slot: the value after the pair
    sizes : dict                 name: components in the last call
    drawn : DrawnVertices        by all current values
    made : dict                  the same by those that the vertices have
    leaves_values : bool         whether its last values become current: not those of arrays, nor of pairs right before
    slots : tuple of int         the keys of `starts`
    drawn_color : tuple          the current colour at the last draw
    latest : LatestDraw or None  a draw that the next one may repeat
    carried_units : (unit, name) of the texture coordinates that all vertices have from the list
    """

    calls: list[Callable[[], Any]]
    mode: int
    rows: dict[int, np.ndarray]
    starts: dict[int, int]
    last: dict[int, Values]
    sizes: dict[str, int]
    indices: np.ndarray
    drawn: DrawnVertices = field(default_factory=DrawnVertices)
    made: dict[tuple[ConstantAttribute, ...], Vertices] = field(default_factory=dict)
    leaves_values: bool = True
    drawn_color: tuple[float, ...] | None = None
    latest: LatestDraw | None = None

    def __post_init__(self) -> None:
        units, self.slots = range(TEXTURE_UNITS), tuple(self.starts)
        self.carried_units = tuple([(unit, SLOT_NAMES[TEXCOORD + unit]) for unit in units
                                    if self.starts.get(TEXCOORD + unit) == 0])  # fmt: skip

    def __call__(self) -> None:
        """Draw the primitive, and make its last attributes current."""
        context = current()
        if _is_left_out(context):
            fail(gl.GL_INVALID_OPERATION, "glCallList", "a list that begins a primitive, between glBegin and glEnd")
            return
        if not is_between_primitives(context):
            carry_out(self.calls)
            return
        self.draw(context)

    def draw(self, context: Context) -> None:
        """Draw the primitive, between others."""
        current, values = context.current, None
        if current.color is self.drawn_color:  # else the next call will hardly be the same
            values = current.color, current.normal, tuple(current.texcoords)
        self.drawn_color = current.color
        constants = self.begin_draw(context)
        vertices = self.vertices(constants)
        before = draw_maybe_later(context, self.mode, vertices, self.indices, self.slots)
        if values is not None and before is not None:
            latest = LatestDraw(vertices, before, *values)
            self.latest = latest if latest.has_values_of(context) else None

    def draws_again(self, context: Context) -> bool:
        """Draw the primitive if only the modelview matrix has changed since `latest`; return whether it has been drawn.

        What the primitive leaves is current already, but for the numbers of components.
        """
        latest = self.latest
        if latest is None or not (context.ready and latest.has_values_of(context) and can_be_drawn_to(context)):
            return False
        if not continue_draw(context, latest.before, latest.vertices, self.indices):
            return False
        if self.leaves_values:
            context.vertex_buffer.active_sizes.update(self.sizes)
        return True

    def begin_draw(self, context: Context) -> ConstantSet:
        """Make the last attributes current; return the values of those that the list does not set."""
        if context.pending.names:
            context.reset_attributes()
        constants = constant_attributes(context, self.carried_units)
        self.make_current(context)
        return constants

    def make_current(self, context: Context) -> None:
        """Make the last attributes of the primitive current, if it leaves them; none are pending before.

        Hidden materials return with the next flush. If there are any, the attributes are pending until then.
        """
        pending, values = context.pending, context.current
        old_values = pending.old_values
        if self.leaves_values:
            for slot, value in self.last.items():
                if slot == COLOR:
                    old_values["color"], values.color = values.color, value  # type: ignore[assignment]
                elif slot == NORMAL:
                    old_values["normal"], values.normal = values.normal, value  # type: ignore[assignment]
                else:
                    texcoords, unit = values.texcoords, slot - TEXCOORD
                    old_values[SLOT_NAMES[slot]], texcoords[unit] = texcoords[unit], value  # type: ignore[assignment]
            context.vertex_buffer.active_sizes.update(self.sizes)
        follow_color(context)
        if pending.hidden:
            pending.names.update(old_values)
            for name in old_values:
                pending.hidden.pop(name, None)
            pending.reset_due = pending.has_vertices = True
            context.ready = False
        else:
            context.reset_attributes()

    def vertices(self, constants: ConstantSet) -> Vertices:
        """Return the vertices; the same object for the same current values."""
        return self.drawn.get(constants) or self.drawn.keep(constants, self._vertices(constants))

    def _vertices(self, constants: ConstantSet) -> Vertices:
        count = len(self.rows[POSITION])
        key = tuple(each for slot, each in enumerate(constants.attributes, 1) if self.starts.get(slot, 1))
        vertices = self.made.get(key)
        if vertices is None:
            own = {slot: self.rows[slot] for slot in self.starts}
            for slot, start in self.starts.items():
                if start:
                    own[slot] = own[slot].copy()
                    own[slot][:start] = constants.attributes[slot - 1].row
                    own[slot].setflags(write=False)
            if len(self.made) >= MOST_DRAWN:
                self.made.clear()
            vertices = self.made[key] = Vertices(self.rows[POSITION], *constants.columns(count, own))
        return vertices


@dataclass(eq=False)
class SimilarPrimitives:
    """Primitives in a row of a list that set the same attributes at their first vertices, but no colour.

    No colour, as materials may follow it. So their draws differ in modes and vertices only. Those of one mode, and
    strips and fans, are one draw of separate primitives, where that has the same pixels.
    """

    primitives: list[ListPrimitive]

    def __call__(self) -> None:
        """Draw the primitives, and make the attributes of the last one current."""
        context = current()
        if _is_left_out(context) or not is_between_primitives(context):
            carry_out(self.primitives)
            return
        first, others = self.primitives[0], self.primitives[1:]
        constants = first.begin_draw(context)
        if self.separate is not None and self.are_separate_in(context):
            joined = self.separate
            vertices = joined.vertices(constants)
            draw_maybe_later(context, joined.mode, vertices, joined.indices, joined.slots, self.pairs_mode)
        else:
            draw = context.draw(first.mode, first.vertices(constants), first.indices)
            context.draw_like(draw, [(each.mode, each.vertices(constants), each.indices) for each in others])
        self.primitives[-1].make_current(context)
        context.separate()

    def are_separate_in(self, context: Context) -> bool:
        """Return whether `separate`, if they can be that, have the same pixels under the current state."""
        return can_be_joined(context) and can_be_separated(context.drawn_state, *self.modes)

    @cached_property
    def modes(self) -> tuple[int, frozenset[int]]:
        """The mode of the first one, and the modes of all."""
        return self.primitives[0].mode, frozenset(primitive.mode for primitive in self.primitives)

    @cached_property
    def pairs_mode(self) -> int:
        """Their `Draw.pairs_mode`: none for primitives that are separate already."""
        first, modes = self.modes
        return 0 if first in SEPARATE else pairs_mode_of([*modes])

    @cached_property
    def separate(self) -> ListPrimitive | None:
        """All of them as separate primitives; None if they cannot be."""
        first, modes = self.modes
        if len(modes) > 1 and not STRIPS.issuperset(modes):
            return None
        if not all(_can_be_separate(primitive) for primitive in self.primitives):
            return None
        joined = joined_primitive(self.primitives, SEPARABLE.get(first, first), np.empty(0, np.int32))
        parts, start = [], 0
        for primitive in self.primitives:
            indices = primitive.indices + np.int32(start)
            if primitive.mode in SEPARABLE:
                indices = indices[separate_indices((primitive.mode,), (len(indices),))]
            parts.append(indices)
            start += len(primitive.rows[POSITION])
        joined.indices = np.concatenate(parts)
        joined.indices.setflags(write=False)
        return joined


def _can_be_separate(primitive: ListPrimitive) -> bool:
    """Return whether a primitive may become separate ones.

    Separate quads with indices are always cut in one way, those of a strip as they are only up to the first segment.
    """
    mode, count = primitive.mode, len(primitive.indices)
    if mode in SEPARATE:
        return count % SEPARATE[mode] == 0
    return mode != gl.GL_QUAD_STRIP or count <= INDEXED_SEGMENT


def joined_primitive(members: Sequence[ListPrimitive], mode: int, indices: np.ndarray) -> ListPrimitive:
    """Return primitives in a row as one: its `indices` are those of a mode in the vertices of all members."""
    last = members[-1]
    rows = {slot: np.concatenate([member.rows[slot] for member in members]) for slot in last.rows}
    for array in (*rows.values(), indices):
        array.setflags(write=False)
    calls = [call for member in members for call in member.calls]
    starts, leaves_values = members[0].starts, last.leaves_values
    return ListPrimitive(calls, mode, rows, starts, last.last, last.sizes, indices, leaves_values=leaves_values)


def with_similar_joined(calls: list[Callable[[], Any]]) -> list[Callable[[], Any]]:
    """Return the calls of a list with primitives in a row that are similar as one call."""
    result: list[Callable[[], Any]] = []
    for key, part in groupby(calls, similarity):
        similar: list[Any] = list(part)
        result += [SimilarPrimitives(similar)] if key is not None and len(similar) > 1 else similar
    return result


def similarity(call: Callable[[], Any]) -> tuple[object, ...] | None:
    """Return what similar primitives have in common, None for other calls."""
    if not isinstance(call, ListPrimitive) or COLOR in call.starts or any(call.starts.values()):
        return None
    return tuple(call.sizes.items())


def _is_left_out(context: Context) -> bool:
    """Return whether Mesa refuses the whole pair, where the calls would add their vertices to another pair."""
    return context.primitive is not None


def is_between_primitives(context: Context) -> bool:
    """Return whether a glBegin would begin a primitive, in an empty vertex buffer."""
    buffer = context.vertex_buffer
    if context.primitive is not None or not context.list_depth:
        return False
    if buffer.sizes:
        if "position" in buffer.sizes or buffer.n_vertices or buffer.joined_pairs is not None:
            return False
    elif buffer.n_vertices or buffer.joined_pairs is not None:
        return False
    if not can_be_drawn_to(context):
        return False
    buffer.sizes.clear()
    return True


def carry_out(calls: Iterable[Callable[[], Any]]) -> None:
    """Make all calls, then raise the first of their errors: GL does not stop at an error."""
    first_error = None
    for call in calls:
        try:
            call()
        except GLError as error:
            first_error = first_error or error
    if first_error is not None:
        raise first_error


__all__ = [
    "ListPrimitive",
    "SimilarPrimitives",
    "carry_out",
    "is_between_primitives",
    "joined_primitive",
    "similarity",
    "with_similar_joined",
]
