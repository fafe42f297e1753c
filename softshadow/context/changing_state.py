"""The part of a context that reads and changes the state.

Vertices of immediate mode are collected, to be drawn together. A change of the state that would change how they are
drawn draws them first.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from softshadow import tokens as gl
from softshadow.context.command_stream import CommandStream
from softshadow.context.pending_attributes import PendingAttributes
from softshadow.context.primitive import Deferred, Primitive
from softshadow.context.state_groups import UNDRAWN, Followed, Group, StateGroups, affects_draws
from softshadow.context.vertex_buffer import VertexBuffer
from softshadow.frozen import evolve
from softshadow.state import Lighting, State


class ChangingState:
    """The state of a context, and the changes of it.

    Attributes
    ----------
    state_groups : StateGroups   the state as calls change it
    groups : dict of Group       its groups by name
    changed : set of Group       those whose fields may differ from their values: without any, the state is that of ""
    ready : bool                 no list is compiled, no primitive is open, nothing is collected: a call may change the
        state at once; not always True then, but always False otherwise
    """

    state_groups: StateGroups
    groups: dict[str, Group]
    changed: set[Group]
    ready: bool
    pending: PendingAttributes
    touched: int
    primitive: Primitive | None  # between glBegin and glEnd
    deferred: Deferred | None  # while there is one, stand-ins take the places of `pending` and `vertex_buffer`
    vertex_buffer: VertexBuffer  # immediate mode
    stream: CommandStream  # its bitmaps come before the collected vertices

    def flush(self) -> None:
        """Draw the collected bitmaps and vertices."""
        raise NotImplementedError

    def separate(self) -> None:
        """Draw them, maybe later: what follows is not joined to them."""
        raise NotImplementedError

    @property
    def has_collected(self) -> bool:
        """Whether vertices or bitmaps are collected, or attributes wait for the next change of the state."""
        if self.deferred is not None:
            return True
        return bool(self.vertex_buffer.sizes or self.pending.reset_due or self.stream.text is not None)

    @property
    def state(self) -> State:
        """The state, immutable; the same object until something changes."""
        groups = self.state_groups
        if self.changed or groups.followed is not None:
            self._settle()
            return groups.snapshot()
        state: State = groups.root.value
        return state

    @state.setter
    def state(self, state: State) -> None:
        self.state_groups.restore(state)

    @property
    def drawn_state(self) -> State:
        """The state as draws have it: materials may not contain yet the colour that they follow (`followed`)."""
        groups = self.state_groups
        if self.changed:
            return groups.drawn()
        state: State = groups.root.value
        return state

    def settled(self, lighting: Lighting, followed: Followed | None) -> Lighting:
        """Return an earlier lighting whose materials contain the colour that they followed then."""
        return self.state_groups.settled(lighting, followed)

    def change_field(self, group: str, name: str, value: Any) -> None:
        """Set a field of a group of the state; if the change affects draws, draw the collected vertices first."""
        changed = self.groups[group]
        fields = changed.fields
        if fields[name] is not value:
            if not self.ready and name not in UNDRAWN and fields[name] != value and self.has_collected:
                self.separate()
            if changed.is_lighting and fields[name] != value:
                self.mark_materials()
            fields[name] = value
            self.changed.add(changed)

    def change(self, group: str, **fields: Any) -> None:
        """Set fields of a group of the state, as `change_field` does."""
        self.change_fields(group, fields)

    def change_fields(self, group: str, fields: Mapping[str, Any]) -> None:
        """Set fields of a group of the state, as `change_field` does."""
        if not self.ready and self._would_redraw((group,), fields):
            self.separate()
        changed = self.groups[group]
        if changed.is_lighting and not fields.items() <= changed.fields.items():
            self.mark_materials()
        changed.fields.update(fields)
        self.changed.add(changed)

    def mark_materials(self) -> None:
        """Mark materials that follow colours as changed, with the lighting: glPopAttrib restores them together.

        It does so also if all else has its value from the push again.
        """
        if self.groups["lighting"].fields["color_material"]:
            self.touched |= gl.GL_LIGHTING_BIT

    def change_groups(self, groups: Sequence[str], fields: Mapping[str, Any]) -> None:
        """Set the same fields in several groups of the state, as `change_field` does."""
        if not self.ready and self._would_redraw(groups, fields):
            self.separate()
        by_name, mark = self.groups, self.changed.add
        for name in groups:
            group = by_name[name]
            group.fields.update(fields)
            mark(group)

    def _would_redraw(self, groups: Sequence[str], fields: Mapping[str, Any]) -> bool:
        """Return whether new values of fields would change how the collected vertices are drawn."""
        return self.has_collected and any(affects_draws(self.groups[name].fields, fields) for name in groups)

    def _settle(self) -> None:
        """Store the colour in the materials that follow it. Hidden materials still return before it."""
        if self.state_groups.followed is not None:
            self.pending.settled = self.state_groups.followed
            self.state_groups.settle()

    def change_state(self, state: State) -> None:
        """Replace the state; if the change affects draws, draw the collected vertices first."""
        if self.has_collected and self.primitive is None and _draw_state(state) != _draw_state(self.state):
            before = self.state
            self.flush()
            if self.state is not before:  # the flush has made pending materials current
                materials: Any = {"front": self.state.lighting.front, "back": self.state.lighting.back}
                state = evolve(state, lighting=evolve(state.lighting, **materials))
        self.state = state


def _draw_state(state: State) -> State:
    """Return the state without the fields that draws do not use: clear values and the active stencil face."""
    return evolve(
        state,
        color=evolve(state.color, clear=State().color.clear, clear_accum=State().color.clear_accum),
        depth=evolve(state.depth, clear=State().depth.clear),
        stencil=evolve(state.stencil, clear=State().stencil.clear, active_back=False),
    )
