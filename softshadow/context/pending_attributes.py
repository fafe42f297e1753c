"""Attributes that have been set, but that Mesa has not yet made current values.

glPopAttrib depends on the difference: it replaces only current values, and only in groups that have changed since the
push (vbo_exec_api.c; NeedFlush in mtypes.h). `Context` updates this record.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

SHININESSES = frozenset(("front.shininess", "back.shininess"))


@dataclass
class PendingAttributes:
    """The attributes set since Mesa last updated its current values.

    Attributes
    ----------
    names : set of str       "color", "normal", "texcoord0", "front.diffuse" ...: attributes set since the last reset
    old_values : dict        name: the current value before the attribute was set
    hidden : dict            name: the value that was set, where glPopAttrib or glColor has put another current value
    before_following         the materials before they followed a colour that is not yet current: as
                             `StateGroups.followed`, or their values by name
    settled                  the colour that materials followed last, stored in them since: as `StateGroups.followed`
    never_set : frozenset    "front.shininess", "back.shininess", as long as they have their first value: setting it
                             counts as a change then, even to an equal value. Mesa compares four numbers of each
                             attribute; the fourth is 0 in the initial shininess, and 1 in any that was set.
    reset_due : bool         whether the next change of state resets the attributes
    has_vertices : bool      whether it does so because of vertices, not of a query of current values
    """

    names: set[str] = field(default_factory=set)
    old_values: dict[str, Any] = field(default_factory=dict)
    hidden: dict[str, Any] = field(default_factory=dict)
    before_following: Any = None
    settled: Any = None
    never_set: frozenset[str] = SHININESSES
    reset_due: bool = False
    has_vertices: bool = False
