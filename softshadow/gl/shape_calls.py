"""The glBegin ... glEnd pairs of a shape, kept with arrays of their vertices.

Programs draw the same spheres and cylinders again and again. A strip of one is drawn by its calls up to the first
vertex, which decide how Mesa collects the others; these are added at once, with arrays made before.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from softshadow.context import Context, thread
from softshadow.gl.immediate import glBegin, glEnd, glVertex3f
from softshadow.gl.texture_coordinates import glTexCoord2f
from softshadow.gl.vertex_attributes import glNormal3f

Call = tuple[Callable[..., None], tuple[float, ...]]
SIZES = {"normal": 3, "texcoord0": 2}  # components that the calls of a shape set


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
        self._arrays: dict[Any, dict[str, np.ndarray]] = {}

    def draw(self) -> None:
        """Draw the vertices."""
        glBegin(self.mode)
        n_made = 0
        for call, arguments in self.calls:
            call(*arguments)
            n_made += 1
            if call is glVertex3f:
                break
        if not self._add_rest(thread.context):
            for call, arguments in self.calls[n_made:]:
                call(*arguments)
        glEnd()

    def _add_rest(self, context: Context) -> bool:
        """Do what the calls after the first vertex do; return False where that is more than to add numbers."""
        primitive = context.primitive
        if primitive is None or len(primitive.positions) != 4 or primitive.position_size != 3:
            return False
        if len(self.positions) >= primitive.limit:
            return False
        for name in self.changes:
            if primitive.steady.get(name) != SIZES[name] or len(primitive.changes[name]) != 2:
                return False
        primitive.positions += self.positions[4:]
        for name, changes in self.changes.items():
            primitive.changes[name] += changes[1:]
            context.set_attribute(name, changes[-1][1])
        primitive.arrays = self._arrays_of(context)
        return True

    def _arrays_of(self, context: Context) -> Mapping[str, np.ndarray]:
        """Return positions and attributes as arrays, one row for each vertex, in the context's precision."""
        arrays = self._arrays.get(context.real)
        if arrays is None:
            n = len(self.positions)
            arrays = self._arrays[context.real] = {"position": context.packed(self.positions, n // 4, 4)}
            for name, changes in self.changes.items():
                ends = [*(start for start, _ in changes[1:]), n]
                rows = [value for (start, value), end in zip(changes, ends, strict=True) for _ in range(start, end, 4)]
                arrays[name] = context.packed([x for row in rows for x in row], n // 4, len(rows[0]))
        return arrays


class Calls:
    """The calls that draw a shape."""

    def __init__(self) -> None:
        self._parts: list[Strip | Call] = []
        self._strip: Strip | None = None

    def make(self) -> None:
        """Make the calls."""
        for part in self._parts:
            if isinstance(part, Strip):
                part.draw()
            else:
                part[0](*part[1])

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
        self._attribute("normal", (x, y, z), (glNormal3f, (x, y, z)))

    def coordinates(self, s: float, t: float) -> None:
        """Add glTexCoord2f."""
        self._attribute("texcoord0", (s, t, 0.0, 1.0), (glTexCoord2f, (s, t)))

    def _attribute(self, name: str, value: tuple[float, ...], call: Call) -> None:
        if self._strip is None:
            self._parts.append(call)
            return
        self._strip.calls.append(call)
        self._strip.changes.setdefault(name, []).append((len(self._strip.positions), value))


__all__ = ["Calls", "Strip"]
