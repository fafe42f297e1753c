"""Primitives of display lists with calls among their vertices that no array can replace, such as glMaterial.

They are made of their calls. But those in a row that add vertices, and set the attributes of the next ones, are made at
once, and arrays of what these calls set are kept.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from itertools import groupby
from typing import Any

import numpy as np

from softshadow.context import Context, Primitive, thread
from softshadow.context.arrays import POSITION, SLOT_NAMES
from softshadow.gl.list_calls import CALLS, Values, value_of
from softshadow.gl.list_primitives import carry_out
from softshadow.gl.materials import material_values
from softshadow.gl.vertex_format import REST

NamedValues = Sequence[tuple[str, Values]]


class Numbers:
    """What calls add to a primitive.

    Attributes
    ----------
    positions : list         x, y, z, w of each vertex
    changes : dict           attribute: (place among the positions, value) of each change

    Parameters
    ----------
    values : of the calls
    """

    def __init__(self, values: NamedValues) -> None:
        self.positions: list[float] = []
        self.changes: dict[str, list[tuple[int, Values]]] = {}
        for name, value in values:
            if name == "position":
                self.positions += _complete(name, value)
            else:
                self.changes.setdefault(name, []).append((len(self.positions), _complete(name, value)))
        self._place = 0

    def changes_at(self, place: int) -> dict[str, list[tuple[int, Values]]]:
        """Return the changes for numbers that are added behind so many others, most often as many as before."""
        if place != self._place:
            by = place - self._place
            self.changes = {name: [(start + by, value) for start, value in each] for name, each in self.changes.items()}
            self._place = place
        return self.changes


class VertexRow:
    """Calls in a row, within a primitive, that add vertices and set their attributes.

    If the vertices before had as many components, all calls only add numbers. Else those up to the first vertex, and to
    the first call that sets each attribute, decide about the format of the others.
    """

    def __init__(self, calls: Sequence[Callable[[], Any]], values: NamedValues) -> None:
        names = [name for name, _ in values]
        n_first = 1 + max(names.index(name) for name in set(names))
        self._first, self._others = calls[:n_first], calls[n_first:]
        self._sizes = _sizes(values)
        self._of_all, self._of_others = Numbers(values), Numbers(values[n_first:])

    def __call__(self) -> None:
        """Make the calls."""
        if not self._add(self._of_all):
            carry_out(self._first)
            if not self._add(self._of_others):
                carry_out(self._others)

    def _add(self, numbers: Numbers) -> bool:
        """Add numbers to the open primitive; return False, and do nothing, if calls would do more than that."""
        context, sizes = thread.context, self._sizes
        primitive = context.primitive
        if sizes is None or primitive is None or primitive.waiting is not None:
            return False
        place = len(primitive.positions)
        if primitive.position_size != sizes["position"] or place + len(numbers.positions) >= primitive.limit:
            return False
        steady = primitive.steady
        if not all(steady.get(name) == sizes[name] for name in numbers.changes):
            return False
        for name, changes in numbers.changes_at(place).items():
            primitive.changes[name] += changes
            context.set_attribute(name, changes[-1][1])
        primitive.positions += numbers.positions
        return True


class MixedPrimitive:
    """A glBegin ... glEnd pair with other calls among its vertices.

    Parameters
    ----------
    context : Context        in whose precision the arrays are
    calls : from glBegin to glEnd
    """

    def __init__(self, context: Context, calls: Sequence[Any]) -> None:
        within = [(call, _named_value(call)) for call in calls[1:-1]]
        self._calls = [calls[0], *_with_rows(within), self._keep_arrays, calls[-1]]
        named = [each for call, value in within for each in ([value] if value is not None else material_values(call))]
        self._n_calls = Counter(name for name, _ in named)  # that set each attribute
        self._arrays = {} if _sizes(named) is None else _arrays_of(context, named)

    def __call__(self) -> None:
        """Make the calls."""
        carry_out(self._calls)

    def _keep_arrays(self) -> None:
        """Give the open primitive the arrays of what no other call has set."""
        primitive = thread.context.primitive
        if primitive is not None and primitive.from_list and self._has_only_own_vertices(primitive):
            changes, expected = primitive.changes, self._n_calls
            primitive.arrays = {
                name: rows
                for name, rows in self._arrays.items()
                if name == "position" or len(changes.get(name, ())) == 1 + expected[name]
            }

    def _has_only_own_vertices(self, primitive: Primitive) -> bool:
        """Return whether the vertices of an open primitive are those of the pair."""
        is_whole = not primitive.start and primitive.waiting is None
        return is_whole and bool(self._arrays) and len(primitive.positions) == 4 * self._n_calls["position"]


def _named_value(call: Any) -> tuple[str, Values] | None:
    """Return the name and the value of the attribute that a call sets; None if it does more, or only it can judge."""
    value = value_of(call) if getattr(call, "func", None) in CALLS else None
    return None if value is None else (SLOT_NAMES[value[0]], value[1])


def _with_rows(calls: Sequence[tuple[Any, tuple[str, Values] | None]]) -> list[Callable[[], Any]]:
    """Return calls, of which the values are given, with those in a row that add vertices as one."""
    result: list[Callable[[], Any]] = []
    for is_known, part in groupby(calls, lambda each: each[1] is not None):
        row = list(part)
        own, named = [call for call, _ in row], [value for _, value in row if value is not None]
        adds_vertices = is_known and any(name == "position" for name, _ in named)
        result += [VertexRow(own, named)] if adds_vertices else own
    return result


def _sizes(values: NamedValues) -> dict[str, int] | None:
    """Return how many components each attribute is set with; None if one is set with more and with fewer."""
    sizes = {name: len(value) for name, value in values}
    return sizes if all(len(value) == sizes[name] for name, value in values) else None


def _complete(name: str, value: Values) -> Values:
    return value if name == "normal" else (*value, *REST[len(value) :])


def _arrays_of(context: Context, values: NamedValues) -> dict[str, np.ndarray]:
    """Return the rows of the vertices: their positions, and the attributes that are set before the first one."""
    columns: dict[str, list[Values]] = {SLOT_NAMES[POSITION]: []}
    latest: dict[str, Values] = {}
    positions = columns["position"]
    for name, value in values:
        if name != "position":
            if name not in latest and not positions:
                columns[name] = []
            latest[name] = _complete(name, value)
            continue
        positions.append(_complete(name, value))
        for other, rows in columns.items():
            if other != name:
                rows.append(latest[other])
    return {name: context.frozen(rows) for name, rows in columns.items()} if positions else {}


__all__ = ["MixedPrimitive"]
