"""The glBegin ... glEnd pairs of a shape, kept with arrays of their vertices.

Programs draw the same spheres and cylinders again and again. A strip of one is drawn by its calls up to the first
vertex, which decide how Mesa collects the others; these are added at once, with arrays made before. Strips in a row are
drawn together without their calls where that is decided already (`similar_pairs`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import cached_property
from typing import Any

import numpy as np

from softshadow.context import Context, thread
from softshadow.context.arrays import SLOTS
from softshadow.context.display_list import DisplayList
from softshadow.gl.immediate import consecutive_indices, glBegin, glEnd, glVertex3f
from softshadow.gl.list_compiling import is_open
from softshadow.gl.list_primitives import ListPrimitive
from softshadow.gl.similar_pairs import PairSeries, PairVertices, first_pairs, similar_pairs
from softshadow.gl.texture_coordinates import glTexCoord2f
from softshadow.gl.vertex_attributes import glNormal3f

Call = tuple[Callable[..., None], tuple[float, ...]]
NAMES = {glNormal3f: "normal", glTexCoord2f: "texcoord0"}
SIZES = {"normal": 3, "texcoord0": 2}  # components that these calls set


def make_all(calls: Iterable[Call]) -> None:
    """Make calls."""
    for call, arguments in calls:
        call(*arguments)


def complete(values: tuple[float, ...]) -> tuple[float, ...]:
    """Return what the arguments of a call that sets an attribute make of it: two are texture coordinates."""
    return values if len(values) == 3 else (*values, 0.0, 1.0)


class Strip:
    """A glBegin ... glEnd pair.

    Attributes
    ----------
    calls : list             between glBegin and glEnd
    positions : list         x, y, z, w of each vertex
    changes : dict           attribute: (length of `positions`, value) of each call that sets it
    """

    def __init__(self, mode: int) -> None:
        self.mode = mode
        self.calls: list[Call] = []
        self.positions: list[float] = []
        self.changes: dict[str, list[tuple[int, tuple[float, ...]]]] = {}

    def draw(self, vertices: PairVertices) -> None:
        """Draw the vertices, of which there are arrays."""
        thread.context.vertex_buffer.paused = None  # a primitive of its own can have arrays
        glBegin(self.mode)
        n_made, n_vertices = 0, 0
        for call, arguments in self.calls:
            call(*arguments)
            n_made += 1
            n_vertices += call is glVertex3f
            if n_vertices > self.latest:
                break
        if not self._add_rest(thread.context, vertices):
            make_all(self.calls[n_made:])
        glEnd()

    def listed(self, arrays: Mapping[str, np.ndarray]) -> ListPrimitive:
        """Return the strip as display lists have it; `arrays` are the rows of its vertices."""
        rows = {SLOTS[name]: array for name, array in arrays.items()}
        starts = {SLOTS[name]: start for name, start in self.starts.items()}
        last = {SLOTS[name]: changes[-1][1] for name, changes in self.changes.items()}
        indices = consecutive_indices(len(self.positions) // 4)
        return ListPrimitive([self._make], self.mode, rows, starts, last, self.sizes.copy(), indices)

    def _make(self) -> None:
        """Make the calls, with glBegin and glEnd."""
        glBegin(self.mode)
        make_all(self.calls)
        glEnd()

    def leave_attributes(self, context: Context) -> None:
        """Make the values of the last calls the current ones."""
        for name, changes in self.changes.items():
            context.set_attribute(name, changes[-1][1])

    @cached_property
    def sizes(self) -> dict[str, int]:
        """Components of positions and attributes that the calls set."""
        return {"position": 3} | {name: SIZES[name] for name in self.changes}

    @cached_property
    def starts(self) -> dict[str, int]:
        """The first vertex that has a value of each attribute; those before have the current one."""
        return {name: changes[0][0] // 4 for name, changes in self.changes.items()}

    @cached_property
    def latest(self) -> int:
        """The first vertex that has values of all attributes."""
        return max(self.starts.values(), default=0)

    def _add_rest(self, context: Context, vertices: PairVertices) -> bool:
        """Do what the calls after the vertex `latest` do; return False where that is more than to add numbers."""
        primitive, made = context.primitive, 4 * self.latest + 4
        if primitive is None or len(primitive.positions) != made or primitive.position_size != 3:
            return False
        if len(self.positions) >= primitive.limit:
            return False
        numbers = {name: sum(start < made for start, _ in changes) for name, changes in self.changes.items()}
        for name, number in numbers.items():
            if primitive.steady.get(name) != SIZES[name] or len(primitive.changes[name]) != number + 1:
                return False
        primitive.positions += self.positions[made:]
        for name, changes in self.changes.items():
            primitive.changes[name] += changes[numbers[name] :]
            context.set_attribute(name, changes[-1][1])
        arrays, starts = vertices.arrays, self.starts
        primitive.arrays = {name: rows for name, rows in arrays.items() if not starts.get(name)}
        return True

    def rows(self, name: str, before: Any) -> list[Any]:
        """Return the value of an attribute at each vertex; `before` until it is set for the first time."""
        changes = self.changes[name]
        starts, ends = [0, *(start for start, _ in changes)], [*(start for start, _ in changes), len(self.positions)]
        repeated = zip([before, *(value for _, value in changes)], starts, ends, strict=True)
        return [value for value, start, end in repeated for _ in range(start, end, 4)]


class Strips:
    """Strips in a row whose vertices set the same attributes, with the calls before each of them.

    The calls before the first strip may set any attribute, those before others only attributes of their vertices.
    """

    def __init__(self, first: Strip, calls: list[Call]) -> None:
        self.strips, self._calls = [first], [calls]
        self._series: dict[Any, PairSeries] = {}

    def add(self, strip: Strip, calls: list[Call]) -> bool:
        """Add a strip and the calls before it; return False, and do nothing, if it is another kind."""
        sizes = self.strips[0].sizes
        if strip.sizes != sizes or not all(NAMES[call] in sizes for call, _ in calls):
            return False
        self.strips.append(strip)
        self._calls.append(calls)
        return True

    def draw(self) -> None:
        """Draw them, as many as possible without their calls, or record them in the list that is being compiled."""
        context, first, n_done = thread.context, self.strips[0], 0
        compiled = context.compiled_list
        if compiled is not None and not compiled.executes and not is_open(compiled.calls):
            self._record(context, compiled)
            return
        make_all(self._calls[0])
        similar = first_pairs(context, first.mode, first.sizes, first.starts, len(first.positions) // 4)
        while n_done < len(self.strips):
            if n_done and similar is None:
                similar = similar_pairs(context, first.sizes)
            if similar is not None:
                before, n_done = n_done, similar.add(self._series_for(context), n_done)
                if n_done > before:
                    self.strips[n_done - 1].leave_attributes(context)
            if n_done < len(self.strips):
                self._draw_by_calls(n_done)
                similar, n_done = None, n_done + 1

    def _record(self, context: Context, compiled: DisplayList) -> None:
        """Add the strips to a list as `list_compiling` makes them of their calls."""
        series = self._series_for(context)
        for number, (strip, calls) in enumerate(zip(self.strips, self._calls, strict=True)):
            make_all(calls)
            compiled.calls.append(strip.listed(series.part(number, number + 1).arrays))

    def _draw_by_calls(self, number: int) -> None:
        """Draw a strip by its calls; those before the first one have been made."""
        if number:
            make_all(self._calls[number])
        self.strips[number].draw(self._series_for(thread.context).part(number, number + 1))

    def _series_for(self, context: Context) -> PairSeries:
        """Return positions and attributes as arrays in the context's precision."""
        series = self._series.get(context.real)
        if series is None:
            strips, first = self.strips, self.strips[0]
            arrays = {"position": context.frozen([x for strip in strips for x in strip.positions]).reshape(-1, 4)}
            for name in first.changes:
                arrays[name] = context.frozen(self._rows(name))
            counts = [len(strip.positions) // 4 for strip in strips]
            modes = [strip.mode for strip in strips]
            series = self._series[context.real] = PairSeries(arrays, modes, counts, first.starts)
        return series

    def _rows(self, name: str) -> list[Any]:
        """Return the value of an attribute at each vertex of all strips; any value before the first one is set."""
        rows: list[Any] = []
        latest: tuple[float, ...] = self.strips[0].changes[name][0][1]
        for strip, calls in zip(self.strips, self._calls, strict=True):
            latest = next((complete(value) for call, value in reversed(calls) if NAMES[call] == name), latest)
            rows += strip.rows(name, latest)
            latest = strip.changes[name][-1][1]
        return rows


class Calls:
    """The calls that draw a shape."""

    def __init__(self) -> None:
        self._parts: list[Strip | Call] = []
        self._strip: Strip | None = None

    def make(self) -> None:
        """Make the calls."""
        rows, calls_after = self._in_rows
        for strips in rows:
            strips.draw()
        make_all(calls_after)

    @cached_property
    def _in_rows(self) -> tuple[list[Strips], list[Call]]:
        """The strips in rows of a kind, and the calls after the last one."""
        rows: list[Strips] = []
        calls: list[Call] = []
        for part in self._parts:
            if not isinstance(part, Strip):
                calls.append(part)
                continue
            if not (rows and rows[-1].add(part, calls)):
                rows.append(Strips(part, calls))
            calls = []
        return rows, calls

    def begin(self, mode: int) -> None:
        """Add glBegin."""
        self._strip = Strip(mode)
        self._parts.append(self._strip)

    def end(self) -> None:
        """Add glEnd."""
        self._strip = None

    def vertex(self, x: float, y: float, z: float) -> None:
        """Add glVertex3f, after `begin`."""
        assert self._strip is not None
        self._strip.calls.append((glVertex3f, (x, y, z)))
        self._strip.positions += (x, y, z, 1.0)

    def normal(self, x: float, y: float, z: float) -> None:
        """Add glNormal3f."""
        self._attribute("normal", (glNormal3f, (x, y, z)))

    def coordinates(self, s: float, t: float) -> None:
        """Add glTexCoord2f."""
        self._attribute("texcoord0", (glTexCoord2f, (s, t)))

    def _attribute(self, name: str, call: Call) -> None:
        if self._strip is None:
            self._parts.append(call)
            return
        self._strip.calls.append(call)
        self._strip.changes.setdefault(name, []).append((len(self._strip.positions), complete(call[1])))


__all__ = ["Calls", "Strip"]
