"""The glBegin ... glEnd pairs of a shape, kept with arrays of their vertices.

Programs draw the same spheres and cylinders again and again. A strip of one is drawn by its calls up to the first
vertex, which decide how Mesa collects the others; these are added at once, with arrays made before. Strips in a row are
drawn together without their calls where that is decided already (`similar_pairs`).
"""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

from softshadow.context import Context, thread
from softshadow.context.display_list import DisplayList
from softshadow.gl.list_compiling import is_open
from softshadow.gl.shape_strips import CALLS, NAMES, REST, Call, Changes, Strip, make_all
from softshadow.gl.similar_pairs import PairSeries, first_pairs, similar_pairs

STRIP_BYTES, VERTEX_BYTES = 2500, 160  # of a strip and its vertices, with all arrays that are made of them


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
        similar = first_pairs(context, first.mode, first.sizes, first.starts, first.count)
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
            positions = np.concatenate([strip.positions for strip in strips])
            arrays = {"position": context.frozen(np.insert(positions, 3, 1.0, axis=1))}
            for name in first.changes:
                values = self._rows(name)
                rest = np.broadcast_to(np.array(REST[name]), (len(values), len(REST[name])))
                arrays[name] = context.frozen(np.hstack([values, rest]))
            counts, modes = [strip.count for strip in strips], [strip.mode for strip in strips]
            series = self._series[context.real] = PairSeries(arrays, modes, counts, first.starts)
        return series

    def _rows(self, name: str) -> np.ndarray:
        """Return the values of an attribute at each vertex of all strips; any value before the first one is set."""
        rows = []
        latest = self.strips[0].changes[name].values[0]
        for strip, calls in zip(self.strips, self._calls, strict=True):
            latest = next((np.array(value) for call, value in reversed(calls) if NAMES[call] == name), latest)
            rows.append(strip.rows(name, latest))
            latest = strip.changes[name].values[-1]
        return np.concatenate(rows)


class Calls:
    """The calls that draw a shape."""

    def __init__(self) -> None:
        self._parts: list[Strip | Call] = []

    @property
    def bytes(self) -> int:
        """About how much memory the shape takes when it has been drawn."""
        counts = [part.count for part in self._parts if isinstance(part, Strip)]
        return STRIP_BYTES * len(counts) + VERTEX_BYTES * sum(counts)

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

    def set(self, name: str, *value: float) -> None:
        """Add the call that sets an attribute, before the next strip."""
        self._parts.append((CALLS[name], tuple(map(float, value))))

    def strip(self, mode: int, positions: np.ndarray, **changes: Changes) -> None:
        """Add a glBegin ... glEnd pair of vertices at positions (N, 3), whose calls make changes of attributes."""
        self._parts.append(Strip(mode, np.asarray(positions, np.float64), changes))


__all__ = ["Calls"]
