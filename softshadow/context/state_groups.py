"""The state as dictionaries that calls change, and as an immutable `State` that is made when something reads it.

A call such as glDepthMask stores one value. Making a new `State` for it would cost ten times as much, and most states
between two draws are never used. Groups that have not changed are the same objects in the next `State`.
"""

from __future__ import annotations

import struct
from collections.abc import Mapping
from operator import is_
from typing import Any

from softshadow.frozen import evolve
from softshadow.programs import reflectances
from softshadow.state import TEXTURE_UNITS, Color, Lighting, LightState, State

# parts of groups that are groups themselves: (group, field)
PARTS = (
    ("stencil", "front"), ("stencil", "back"), ("stencil", "other_back"), ("lighting", "front"), ("lighting", "back"),
)  # fmt: skip
TUPLES: tuple[tuple[str, str], ...] = (
    ("lighting", "lights"),
    ("", "units"),
)  # fields of a group or of the state itself that are tuples of groups
UNITS = tuple(f"units.{index}" for index in range(TEXTURE_UNITS))  # names of the groups of the texture units
# fields that draws do not use: clear values, and the face that glStencilFunc sets
UNDRAWN = frozenset(("clear", "clear_accum", "active_back"))
PACK = struct.Struct("4d").pack
COLOR = struct.Struct("4f")
PAST = 1024  # values of each group that are kept


def affects_draws(before: Mapping[str, Any], after: Mapping[str, Any]) -> bool:
    """Return whether new values of fields of a group change what draws do."""
    return any(field not in UNDRAWN and value != before[field] for field, value in after.items())


def is_same(a: Any, b: Any) -> bool:
    """Return whether two values of a field have the same bits; -0.0 equals 0.0, but is another number."""
    if a is b:
        return True
    if a != b or type(a) is not type(b):
        return False
    if type(a) is tuple:
        are_plain = a and type(a[0]) is float and 0.0 not in a  # then equal numbers have the same bits
        return bool(are_plain) or all(map(is_same, a, b))
    return (type(a) is float and a != 0.0) or repr(a) == repr(b)


# glColor under GL_COLOR_MATERIAL: the sides whose material follows ("front" or "back"), its fields, the colour
Followed = tuple[tuple[str, ...], tuple[str, ...], Color]


class Group:
    """A group of the state: its fields, and its last immutable value.

    The latest values are kept: a program that goes back and forth between states gets the same objects again, and what
    was derived from them. `is_lighting` is true of the lighting and of each light, not of the materials.
    """

    __slots__ = (
        "_equal", "_is_kept", "field", "fields", "index", "is_lighting", "known", "parent", "parts", "tuples", "value",
    )  # fmt: skip

    def __init__(self, value: Any, parent: Group | None, field: str, index: int = -1) -> None:
        self.value, self.parent, self.field, self.index = value, parent, field, index
        self.is_lighting = isinstance(value, Lighting | LightState)
        self.fields: dict[str, Any] = dict(vars(value))
        self.parts: dict[str, list[Group]] = {}  # groups among the fields: equal ones are the same object
        self.tuples: dict[tuple[int, ...], tuple[Any, ...]] = {}  # of groups, by their identity
        # values by the identity of their fields, each with its `_key`
        self.known: dict[tuple[int, ...], tuple[Any, tuple[Any, ...] | None]] = {}
        self._equal: dict[tuple[Any, ...], list[Any]] = {}  # the same values by their key
        self._is_kept = False  # `value` is, or was, one of them

    def publish(self) -> bool:
        """Make the immutable value anew, and store it in the parent's fields; return whether it has changed."""
        ids = _ids(self.fields)
        known = self.known.get(ids)
        value = self._equal_or_new(ids) if known is None else known[0]
        if value is self.value:
            return False
        self.value = value
        if self.parent is not None:
            siblings = self.parent.fields
            if self.index >= 0:
                items = siblings[self.field]
                value = self.parent.same_tuple((*items[: self.index], value, *items[self.index + 1 :]))
            siblings[self.field] = value
        return True

    def same_tuple(self, items: tuple[Any, ...]) -> tuple[Any, ...]:
        """Return the tuple that had the same groups before: then the value that contains it is found again."""
        if len(self.tuples) >= PAST:
            self.tuples.clear()
        return self.tuples.setdefault(tuple(map(id, items)), items)

    def replace(self, value: Any) -> None:
        """Replace the immutable value, and those of the parts that differ."""
        before, self.value, self.fields = self.value.__dict__, value, dict(vars(value))
        self._is_kept = False
        for field, parts in self.parts.items():
            new = self.fields[field]
            if new is not before[field]:
                for part in parts:
                    item = new[part.index] if part.index >= 0 else new
                    if item is not part.value:
                        part.replace(item)

    def _equal_or_new(self, ids: tuple[int, ...]) -> Any:
        """Return an immutable value with the present fields: the last one or an earlier one if it has the same bits."""
        if not self._is_kept:
            before, self._is_kept = self.value.__dict__, True
            if _ids(before) not in self.known:
                self._keep(_ids(before), self.value, self._key(before))
            if all(map(is_, before.values(), self.fields.values())):
                return self.value
        key = self._key(self.fields)
        for value in self._equal.get(key, ()) if key is not None else ():
            if all(map(is_same, value.__dict__.values(), self.fields.values())):
                self.fields.update(value.__dict__)
                return value
        value = object.__new__(type(self.value))
        value.__dict__.update(self.fields)
        self._keep(ids, value, key)
        return value

    def _keep(self, ids: tuple[int, ...], value: Any, key: tuple[Any, ...] | None) -> None:
        if len(self.known) >= PAST:
            oldest, its_key = self.known.pop(next(iter(self.known)))
            if its_key is not None:
                self._equal[its_key] = [each for each in self._equal[its_key] if each is not oldest]
                if not self._equal[its_key]:
                    del self._equal[its_key]
        self.known[ids] = value, key
        if key is not None:
            self._equal.setdefault(key, []).append(value)

    def _key(self, fields: Mapping[str, Any]) -> tuple[Any, ...] | None:
        """Return equal keys for equal values; None for the whole state, known by the identity of its groups."""
        if self.parent is None:
            return None
        parts = self.parts
        return tuple([id(value) if name in parts else value for name, value in fields.items()])


def _ids(fields: Mapping[str, Any]) -> tuple[int, ...]:
    """Return by what a value is known: no other object gets these ids as long as it is kept."""
    return tuple(map(id, fields.values()))


class StateGroups:
    """All groups of the state of a context.

    Attributes
    ----------
    groups : dict of Group       "depth", "lighting", "stencil.front", "lighting.lights.0", "units.3" ...; "" is `State`
    changed : set of Group       those whose fields may differ from their values
    followed : Followed or None  colour that materials follow, but do not contain yet

    Parameters
    ----------
    state : State
    single : bool                whether the context's precision is float32
    """

    def __init__(self, state: State, single: bool) -> None:
        self._single = single
        self.followed: Followed | None = None
        self._asked: tuple[Any, Any, bool] = None, None, False  # the last question of `have_followed`, and its answer
        self.root = Group(state, None, "")
        self.groups: dict[str, Group] = {"": self.root}
        self.changed: set[Group] = set()
        for name, value in vars(state).items():
            if hasattr(value, "__dataclass_fields__"):
                self._add(name, self.root, name)
        for name, field in PARTS:
            self._add(f"{name}.{field}", self.groups[name], field)
        for name, field in TUPLES:
            parent = self.groups[name]
            for index in range(len(parent.fields[field])):
                self._add(f"{name}.{field}.{index}" if name else f"{field}.{index}", parent, field, index)

    def _add(self, name: str, parent: Group, field: str, index: int = -1) -> None:
        value = parent.fields[field]
        group = self.groups[name] = Group(value[index] if index >= 0 else value, parent, field, index)
        parent.parts.setdefault(field, []).append(group)

    def snapshot(self) -> State:
        """Return the state; the same object as before if nothing has changed."""
        if self.followed is not None:
            self.settle()
        return self.drawn()

    def drawn(self) -> State:
        """Return the state for a draw: materials may not contain yet the colour that they follow.

        A draw takes this colour from its vertices. So draws that differ in it alone have the same state.
        """
        changed, root = self.changed, self.root
        if len(changed) == 1:
            group: Group | None = changed.pop()
            while group is not None and group.publish():
                group = group.parent
        elif changed:
            parents = set()
            for group in changed:
                if group.parent is not root and group.parent is not None:
                    if group.publish():
                        parents.add(group.parent)
                else:
                    parents.add(group)
            for group in parents:
                if group is not root:
                    group.publish()
            changed.clear()
            root.publish()
        value: State = root.value
        return value

    def settle(self) -> None:
        """Store the colour in the materials that follow it. Programs set many colours that no draw uses."""
        if self.followed is None:
            return
        (sides, fields, color), self.followed = self.followed, None
        rounded = self._rounded(color)
        for side in sides:
            group = self.groups[f"lighting.{side}"]
            for field in fields:
                if PACK(*group.fields[field]) != PACK(*rounded):  # -0.0 equals 0.0, but has other bits
                    group.fields[field] = rounded
                    self.changed.add(group)

    def have_followed(self, color: Color, lighting: Lighting) -> bool:
        """Return whether the materials of the lighting of a draw, of which some follow colours, follow this one."""
        if self.followed is not None:
            return self.followed[2] == color
        asked_lighting, asked_color, answer = self._asked
        if lighting is asked_lighting and color is asked_color:
            return answer
        rounded, answer = self._rounded(color), True
        for side, material in (("front", lighting.front), ("back", lighting.back)):
            for field in reflectances.followed(lighting, side):
                answer = answer and getattr(material, field) == rounded
        self._asked = lighting, color, answer
        return answer

    def settled(self, lighting: Lighting, followed: Followed | None) -> Lighting:
        """Return an earlier lighting whose materials contain the colour that they followed then."""
        if followed is None:
            return lighting
        sides, fields, color = followed
        colors: Any = dict.fromkeys(fields, self._rounded(color))
        return evolve(lighting, **{side: evolve(getattr(lighting, side), **colors) for side in sides})

    def _rounded(self, color: Color) -> Color:
        return COLOR.unpack(COLOR.pack(*color)) if self._single else color

    def undo(self) -> None:
        """Take back the changes of which no state was made."""
        for group in self.changed:
            group.fields = dict(vars(group.value))
        self.changed.clear()

    def restore(self, state: State) -> None:
        """Replace the state by an immutable one; materials that follow a colour still follow it."""
        self.undo()
        if state is not self.root.value:
            self.root.replace(state)
