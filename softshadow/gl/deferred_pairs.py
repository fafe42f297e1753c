"""glBegin ... glEnd pairs like the one before, where a matrix call or a change of state draws each at once.

A program that draws each object between a glBegin and a glEnd, under a matrix of its own, makes hundreds of such pairs.
With each call of one, the vertex buffer changes, and so do the attributes that wait to become current; when the pair is
drawn, both become again what they were. So for a pair that is expected to be like the one before, this work is
deferred: until the pair is drawn, stand-ins take the places of both in the context. Drawn next, the pair leaves behind
what it would have left. If anything else uses a stand-in, the pair is settled first: all that its calls would have done
is done.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, cast

from softshadow import tokens as gl
from softshadow.context import Context, Primitive, VertexBuffer
from softshadow.context.late_forms import LateDraw
from softshadow.context.pending_attributes import PendingAttributes
from softshadow.context.vertex_buffer import NO_FORMAT
from softshadow.gl.materials import follow_color
from softshadow.gl.pair_numbers import FEW, counted_mode, form_of, is_collected
from softshadow.gl.vertex_format import (
    NO_MATERIALS,
    add_vertex,
    carry_attribute,
    forget_outside,
    set_attribute,
    set_limit,
)

ONE_VERTEX, MOST_NUMBERS = 4, 4 * FEW


class _StandIn:
    """Stands for an object of the context: its first use settles the pair that is deferred."""

    def __init__(self, real: Any, settle: Callable[[], None]) -> None:
        self.__dict__.update(_real=real, _settle=settle)

    def __getattr__(self, name: str) -> Any:
        self._settle()
        return getattr(self._real, name)

    def __setattr__(self, name: str, value: Any) -> None:
        self._settle()
        setattr(self._real, name, value)


class DeferredPair:
    """The pair of a context for which the work of its calls is deferred: `Context.deferred` is this as long as it is.

    Parameters
    ----------
    context : Context
    """

    def __init__(self, context: Context) -> None:
        self._context, self._buffer, self._pending = context, context.vertex_buffer, context.pending
        self._buffer_stand_in = cast(VertexBuffer, _StandIn(self._buffer, self.settle))
        self._pending_stand_in = cast(PendingAttributes, _StandIn(self._pending, self.settle))
        self._format = NO_FORMAT
        self._primitive: Primitive
        self._draw: LateDraw | None = None  # after glEnd
        self._has_vertex = False

    def begin(self, mode: int) -> bool:
        """Begin a pair; return False, and do nothing, if its calls must do their work at once."""
        context, pending, expected = self._context, self._pending, self._buffer.expected
        if pending.names or pending.hidden or pending.reset_due or context.stream.text is not None:
            return False
        if context.list_depth or context.executes_list or not self._buffer.expects_alike(FEW):
            return False
        primitive = Primitive(mode, False, NO_MATERIALS)
        for name, size in expected.sizes.items():
            primitive.steady[name] = size
            primitive.changes[name] = [(0, context.attribute(name))]
        primitive.position_size, primitive.limit = expected.position_size, ONE_VERTEX
        self._format, self._primitive, self._draw, self._has_vertex = expected, primitive, None, False
        context.primitive, context.ready, context.deferred = primitive, False, self
        context.vertex_buffer, context.pending = self._buffer_stand_in, self._pending_stand_in
        return True

    def store_first(self) -> bool:
        """Let the first vertex carry what is expected; return False if it has been stored, and nothing is done.

        If calls have not set all of that, the pair is settled, with its vertex.
        """
        primitive = self._primitive
        if self._has_vertex:
            return False
        changes = primitive.changes
        if not [name for name in self._format.sizes if len(changes[name]) == 1]:
            self._has_vertex, primitive.limit = True, MOST_NUMBERS
            return True
        coordinates = primitive.positions[: self._format.position_size]
        primitive.positions.clear()
        self.settle()
        add_vertex(self._context, *coordinates)
        return True

    def end(self) -> bool:
        """Do what glEnd does; return False if the pair is settled, and glEnd has to do it."""
        context, primitive = self._context, self._primitive
        mode, count = primitive.mode, len(primitive.positions) // 4
        is_plain = self._has_vertex and not (primitive.arrays or primitive.materials)
        becomes_triangles = mode != gl.GL_TRIANGLES == counted_mode(mode, count)
        if is_plain and not becomes_triangles and is_collected(context, mode):
            if context.groups["lighting"].fields["color_material"]:
                self._let_materials_follow()
            form = form_of(context, mode, self._format.carried)
            if context.deferred is not self:
                return False  # the state has been read, which settles the pair
            if form is not None:
                current, matrix = context.current, context.modelview_stack.drawn_bytes()
                self._draw = LateDraw(form, primitive, current.color, current.normal, *matrix)
                context.primitive = None
                return True
        self.settle()
        return False

    def draw(self) -> None:
        """Draw the pair, maybe later, and leave behind what it would have left."""
        context, buffer, pending, expected = self._context, self._buffer, self._pending, self._format
        self._restore()
        assert self._draw is not None
        context.stream.add_late(self._draw)
        buffer.note_drawn(expected, len(self._primitive.positions) // 4)
        if pending.names:
            context.reset_attributes()
        elif expected.sizes:
            pending.settled = None
            if not context.touched & gl.GL_CURRENT_BIT:
                changes = self._primitive.changes
                if any(changes[name][0][1] != changes[name][-1][1] for name in expected.sizes):
                    context.touched |= gl.GL_CURRENT_BIT

    def settle(self) -> None:
        """Do all that the calls of the pair would have done, if it is not done yet."""
        context, buffer, primitive, expected = self._context, self._buffer, self._primitive, self._format
        if context.deferred is not self:
            return
        self._restore()
        buffer.forget_format()
        if not self._has_vertex:
            made, primitive.changes = primitive.changes, {}
            primitive.steady.clear()
            primitive.position_size = primitive.limit = 0
            for name, ((_, before), *calls) in made.items():
                context.set_attribute(name, before)
                for _, value in calls:
                    carry_attribute(context, name, expected.sizes[name])
                    set_attribute(context, name, expected.sizes[name], value)
            return
        self._note_attributes()
        buffer.carry(expected)
        buffer.n_vertices = primitive.counted = len(primitive.positions) // 4
        set_limit(buffer, primitive)
        if self._draw is not None:
            self._pending.reset_due = self._pending.has_vertices = True
            buffer.begin_joined_pairs(self._draw, primitive.counted)
            buffer.paused = primitive
            buffer.end_pair(counted_mode(primitive.mode, primitive.counted), primitive.counted)

    def _restore(self) -> None:
        context = self._context
        context.vertex_buffer, context.pending, context.deferred = self._buffer, self._pending, None

    def _let_materials_follow(self) -> None:
        context = self._context
        if "color" in self._format.sizes:
            self._note_attributes()
            context.pending = self._pending
            follow_color(context)
            context.pending = self._pending_stand_in
        else:  # then they follow it already, and `follow_color` does no more
            self._pending.settled = None

    def _note_attributes(self) -> None:
        """Note that the calls have set the attributes."""
        pending, changes = self._pending, self._primitive.changes
        pending.names.update(self._format.sizes)
        for name in self._format.sizes:
            pending.old_values[name] = changes[name][0][1]


def defer(context: Context, mode: int) -> bool:
    """Begin a pair whose work is deferred; return False, and do nothing, if its calls must do their work at once."""
    if context.vertex_buffer.expected is NO_FORMAT:
        return False
    forget_outside(context)
    pair = context.deferred_before
    if pair is None:
        pair = context.deferred_before = DeferredPair(context)
    return bool(pair.begin(mode))
