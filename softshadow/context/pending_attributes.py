"""Attributes that were given and not yet handed on to the current values, which Mesa keeps elsewhere.

That decides what glPopAttrib brings back: it takes the current values along, and sees as changed what was handed on
(vbo_exec_api.c; NeedFlush in mtypes.h).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from softshadow import tokens as gl

if TYPE_CHECKING:
    from softshadow.context.context import Context


@dataclass
class PendingAttributes:
    """What was given, until it is handed on to the current values.

    Attributes
    ----------
    names : set of str       "color", "normal", "texcoord0", "front.diffuse" ...: given since they were last forgotten
    before : dict            name: the current value, of those given and not handed on
    waiting : dict           name: what was given, where glPopAttrib has brought another current value back since
    stored : bool            whether the next change of state hands them on and forgets them
    """

    names: set[str] = field(default_factory=set)
    before: dict[str, Any] = field(default_factory=dict)
    waiting: dict[str, Any] = field(default_factory=dict)
    stored: bool = False

    def about_to_give(self, name: str, context: Context) -> None:
        """Remember that an attribute is given, and over which current value."""
        if name not in self.before:
            self.names.add(name)
            self.before[name] = context.attribute(name)
            self.waiting.pop(name, None)

    def hand_on(self, context: Context) -> None:
        """Make current what was given, and mark the groups of attributes that this changes."""
        for name, value in self.waiting.items():
            self.before.setdefault(name, context.attribute(name))
            context.set_attribute(name, value)
        for name, before in self.before.items():
            if before != context.attribute(name):
                context.touched |= gl.GL_LIGHTING_BIT if "." in name else gl.GL_CURRENT_BIT
        self.waiting.clear()
        self.before.clear()

    def read(self, context: Context) -> None:
        """Hand on what was given since the last time, as queries of current values do."""
        if self.before:
            self.hand_on(context)
            self.stored = True

    def forget(self, context: Context) -> None:
        """Hand on what was given; the vertices to come do not carry it by themselves any more."""
        self.hand_on(context)
        self.names.clear()
        self.stored = False
