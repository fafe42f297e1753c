"""The glBegin ... glEnd pairs of a shape, kept with arrays of their vertices.

Programs draw the same spheres and cylinders again and again. A strip of one is drawn by its calls up to the first
vertex, which decide how Mesa collects the others; these are added at once, with arrays made before. Strips in a row are
drawn together without their calls where that is decided already (`similar_pairs`).
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import Any

from softshadow.context import Context, thread
from softshadow.gl.immediate import glBegin, glEnd, glVertex3f
from softshadow.gl.similar_pairs import PairVertices, SimilarPairs, first_pairs, similar_pairs
from softshadow.gl.texture_coordinates import glTexCoord2f
from softshadow.gl.vertex_attributes import glNormal3f

Call = tuple[Callable[..., None], tuple[float, ...]]
NAMES = {glNormal3f: "normal", glTexCoord2f: "texcoord0"}
SIZES = {"normal": 3, "texcoord0": 2}  # components that these calls set


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
        self._vertices: dict[Any, PairVertices] = {}

    def draw(self) -> None:
        """Draw the vertices."""
        thread.context.vertex_buffer.paused = None  # a primitive of its own can have arrays
        glBegin(self.mode)
        n_made, n_vertices = 0, 0
        for call, arguments in self.calls:
            call(*arguments)
            n_made += 1
            n_vertices += call is glVertex3f
            if n_vertices > self.latest:
                break
        if not self._add_rest(thread.context):
            for call, arguments in self.calls[n_made:]:
                call(*arguments)
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

    def _add_rest(self, context: Context) -> bool:
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
        arrays, starts = self.vertices_for(context).arrays, self.starts
        primitive.arrays = {name: rows for name, rows in arrays.items() if not starts.get(name)}
        return True

    def vertices_for(self, context: Context) -> PairVertices:
        """Return positions and attributes as arrays in the context's precision."""
        vertices = self._vertices.get(context.real)
        if vertices is None:
            n = len(self.positions)
            arrays = {"position": context.frozen(self.positions).reshape(-1, 4)}
            for name, changes in self.changes.items():
                starts = [0, *(start for start, _ in changes[1:])]  # rows before the first one are replaced
                ends = [*starts[1:], n]
                values = [value for _, value in changes]
                repeated = zip(values, starts, ends, strict=True)
                rows = [value for value, start, end in repeated for _ in range(start, end, 4)]
                arrays[name] = context.frozen(rows)
            vertices = self._vertices[context.real] = PairVertices(arrays, self.starts)
        return vertices


class Strips:
    """Strips of one mode in a row that set the same attributes; all but the first one set them at each vertex."""

    def __init__(self, first: Strip) -> None:
        self.strips = [first]
        self._vertices: dict[Any, list[PairVertices]] = {}

    def add(self, strip: Strip) -> bool:
        """Add a strip; return False, and do nothing, if it is another kind."""
        first = self.strips[0]
        if strip.mode != first.mode or strip.sizes != first.sizes or strip.latest:
            return False
        self.strips.append(strip)
        return True

    def draw_after(self, similar: SimilarPairs | None, n_done: int) -> int:
        """Draw similar pairs, from the strip `n_done` on, as many as possible; return how many are drawn then."""
        if similar is None or similar.sizes != self.strips[0].sizes:
            return n_done
        context, before = thread.context, n_done
        vertices = self._vertices_for(context)
        n_done += similar.add(self.strips[0].mode, vertices[n_done:] if n_done else vertices)
        if n_done > before:
            self.strips[n_done - 1].leave_attributes(context)
        return n_done

    def _vertices_for(self, context: Context) -> list[PairVertices]:
        vertices = self._vertices.get(context.real)
        if vertices is None:
            vertices = self._vertices[context.real] = [strip.vertices_for(context) for strip in self.strips]
        return vertices


class Calls:
    """The calls that draw a shape."""

    def __init__(self) -> None:
        self._parts: list[Strip | Call] = []
        self._strip: Strip | None = None

    def make(self) -> None:
        """Make the calls."""
        before: Strip | None = None  # drawn by its calls, with only strips and calls like its own since
        similar: SimilarPairs | None = None
        for part in self._strips_and_calls:
            if isinstance(part, Strips):
                first, n_done = part.strips[0], 0
                if before is None:
                    count = len(first.positions) // 4
                    similar = first_pairs(thread.context, first.mode, first.sizes, first.starts, count)
                    before = None if similar is None else first
                while n_done < len(part.strips):
                    if before is not None and similar is None:
                        similar = similar_pairs(thread.context, before.sizes)
                    n_done = part.draw_after(similar, n_done)
                    if n_done < len(part.strips):
                        before, similar = part.strips[n_done], None
                        before.draw()
                        n_done += 1
            else:
                call, arguments = part
                call(*arguments)
                if before is not None and NAMES[call] not in before.sizes:
                    before = similar = None

    @cached_property
    def _strips_and_calls(self) -> list[Strips | Call]:
        parts: list[Strips | Call] = []
        for part in self._parts:
            last = parts[-1] if parts else None
            if not isinstance(part, Strip):
                parts.append(part)
            elif not isinstance(last, Strips) or not last.add(part):
                parts.append(Strips(part))
        return parts

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
