"""A glBegin ... glEnd pair of a shape: arrays of what its calls set, from which the calls can be made."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import cached_property
from typing import NamedTuple

import numpy as np

from softshadow.context import Context, thread
from softshadow.context.arrays import SLOTS
from softshadow.gl.immediate import consecutive_indices, glBegin, glEnd, glVertex3f
from softshadow.gl.list_primitives import ListPrimitive
from softshadow.gl.similar_pairs import PairVertices
from softshadow.gl.texture_coordinates import glTexCoord2f
from softshadow.gl.vertex_attributes import glNormal3f

Call = tuple[Callable[..., None], tuple[float, ...]]
# in the order in which they stand before a vertex
CALLS: dict[str, Callable[..., None]] = {"normal": glNormal3f, "texcoord0": glTexCoord2f}
NAMES = {call: name for name, call in CALLS.items()}
SIZES = {"normal": 3, "texcoord0": 2}  # components that these calls set
REST = {"normal": (), "texcoord0": (0.0, 1.0)}  # the other components


def make_all(calls: Iterable[Call]) -> None:
    """Make calls."""
    for call, arguments in calls:
        call(*arguments)


class Changes(NamedTuple):
    """Calls that set an attribute: `places` (M,), the vertices right behind them, and `values` (M, 2 or 3) float64."""

    places: np.ndarray
    values: np.ndarray


class Strip:
    """A glBegin ... glEnd pair.

    Parameters
    ----------
    mode : GL_POINTS ... GL_POLYGON
    positions : (N, 3) float64
    changes : dict           attribute: its `Changes`
    """

    def __init__(self, mode: int, positions: np.ndarray, changes: Mapping[str, Changes]) -> None:
        self.mode, self.positions = mode, positions
        self.changes = {name: changes[name] for name in CALLS if name in changes}

    @property
    def count(self) -> int:
        """The number of vertices."""
        return len(self.positions)

    @cached_property
    def sizes(self) -> dict[str, int]:
        """Components of positions and attributes that the calls set."""
        return {"position": 3} | {name: SIZES[name] for name in self.changes}

    @cached_property
    def starts(self) -> dict[str, int]:
        """The first vertex that has a value of each attribute; those before have the current one."""
        return {name: int(changes.places[0]) for name, changes in self.changes.items()}

    @cached_property
    def latest(self) -> int:
        """The first vertex that has values of all attributes."""
        return max(self.starts.values(), default=0)

    @cached_property
    def last(self) -> dict[str, tuple[float, ...]]:
        """The values after the last vertex."""
        return {name: (*changes.values[-1].tolist(), *REST[name]) for name, changes in self.changes.items()}

    def calls(self, start: int = 0, end: int | None = None) -> list[Call]:
        """Return the calls between glBegin and glEnd: those of the vertices [start, end)."""
        stop, made = self.count if end is None else end, list[Call]()
        before = [
            (CALLS[name], dict(zip(changes.places.tolist(), map(tuple, changes.values.tolist()), strict=True)))
            for name, changes in self.changes.items()
        ]
        for vertex, position in enumerate(self.positions[start:stop].tolist(), start):
            made += [(call, values[vertex]) for call, values in before if vertex in values]
            made.append((glVertex3f, tuple(position)))
        return made

    def draw(self, vertices: PairVertices) -> None:
        """Draw the vertices, of which there are arrays."""
        thread.context.vertex_buffer.paused = None  # a primitive of its own can have arrays
        glBegin(self.mode)
        make_all(self._first_calls)
        if not self._add_rest(thread.context, vertices):
            make_all(self.calls(self.latest + 1))
        glEnd()

    def make(self) -> None:
        """Make the calls, with glBegin and glEnd."""
        glBegin(self.mode)
        make_all(self.calls())
        glEnd()

    def listed(self, arrays: Mapping[str, np.ndarray]) -> ListPrimitive:
        """Return the strip as display lists have it; `arrays` are the rows of its vertices."""
        rows = {SLOTS[name]: array for name, array in arrays.items()}
        starts = {SLOTS[name]: start for name, start in self.starts.items()}
        last = {SLOTS[name]: value for name, value in self.last.items()}
        return ListPrimitive(
            [self.make], self.mode, rows, starts, last, self.sizes.copy(), consecutive_indices(self.count)
        )

    def leave_attributes(self, context: Context) -> None:
        """Make the values of the last calls the current ones."""
        for name, value in self.last.items():
            context.set_attribute(name, value)

    def rows(self, name: str, before: np.ndarray) -> np.ndarray:
        """Return the values (N, 2 or 3) of an attribute at each vertex; `before` until it is set for the first time."""
        places, values = self.changes[name]
        if len(places) == self.count and places[0] == 0:
            return values
        latest = np.searchsorted(places, np.arange(self.count), side="right")
        return np.concatenate([before[np.newaxis], values])[latest]

    @cached_property
    def _first_calls(self) -> list[Call]:
        return self.calls(0, self.latest + 1)

    @cached_property
    def _numbers(self) -> tuple[list[float], dict[str, list[tuple[int, tuple[float, ...]]]]]:
        """x, y, z, w of all vertices; and of each attribute the place in these and the value of each call."""
        numbers: dict[str, list[tuple[int, tuple[float, ...]]]] = {}
        for name, (places, values) in self.changes.items():
            rows = zip((4 * places).tolist(), values.tolist(), strict=True)
            numbers[name] = [(place, (*value, *REST[name])) for place, value in rows]
        return np.insert(self.positions, 3, 1.0, axis=1).ravel().tolist(), numbers

    def _add_rest(self, context: Context, vertices: PairVertices) -> bool:
        """Do what the calls after the vertex `latest` do; return False where that is more than to add numbers."""
        primitive, made = context.primitive, 4 * self.latest + 4
        if primitive is None or len(primitive.positions) != made or primitive.position_size != 3:
            return False
        if 4 * self.count >= primitive.limit:
            return False
        positions, all_changes = self._numbers
        numbers = {name: sum(start < made for start, _ in changes) for name, changes in all_changes.items()}
        for name, number in numbers.items():
            if primitive.steady.get(name) != SIZES[name] or len(primitive.changes[name]) != number + 1:
                return False
        primitive.positions += positions[made:]
        for name, changes in all_changes.items():
            primitive.changes[name] += changes[numbers[name] :]
        self.leave_attributes(context)
        arrays, starts = vertices.arrays, self.starts
        primitive.arrays = {name: rows for name, rows in arrays.items() if not starts.get(name)}
        return True


__all__ = ["CALLS", "NAMES", "REST", "Call", "Changes", "Strip", "make_all"]
