"""The vertices between glBegin and glEnd, as numbers."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Mapping, Sequence
from operator import itemgetter
from typing import Any, Protocol

import numpy as np


class Waiting(Protocol):
    """Vertices of a primitive whose numbers are not computed yet (`softshadow.gl.evaluators`)."""

    def add(self, context: Any, primitive: Primitive, parameters: tuple[float, ...]) -> bool:
        """Add a vertex; return False, and do nothing, if it must be computed at once."""

    def compute(self, context: Any, primitive: Primitive) -> None:
        """Compute the numbers."""


class Deferred(Protocol):
    """A glBegin ... glEnd pair for which the work of its calls is deferred (`softshadow.gl.deferred_pairs`)."""

    def store_first(self) -> bool:
        """Let the first vertex carry what is expected; return False if it is stored already."""

    def end(self) -> bool:
        """Do what glEnd does; return False if that is left to do."""

    def draw(self) -> None:
        """Draw the pair after its glEnd, maybe later."""


class Primitive:
    """The vertices between glBegin and glEnd, and before them those of the pairs that are drawn together with this one.

    A vertex costs four numbers; its attributes are stored when they change. So glVertex after glVertex is cheap, and
    an array of attributes is made once, when the vertices are drawn.

    Attributes
    ----------
    from_list : bool         glBegin was called by a display list
    continued : bool         a part of the primitive has already been submitted
    positions : list         x, y, z, w of each vertex
    start : int              how many of these numbers belong to pairs before
    changes : dict           "color", "texcoord0", "front.diffuse" ...: (length of `positions`, value) of each change;
                             the first one has length 0. Attributes without an entry have their current value.
    materials : frozenset    names of the materials that the vertices carry
    steady : dict            attribute: components of a call that needs no change of the vertex format
    position_size : int      the same for positions: such calls append to `positions`, up to `limit` numbers
    counted : int            vertices that `VertexBuffer.n_vertices` includes
    arrays : mapping         "position", "normal" ...: arrays of all vertices, where they exist already
    waiting : Waiting        vertices whose numbers are not computed yet, or None
    """

    __slots__ = (
        "arrays",
        "changes",
        "continued",
        "counted",
        "from_list",
        "limit",
        "materials",
        "mode",
        "position_size",
        "positions",
        "start",
        "steady",
        "waiting",
    )  # fmt: skip

    def __init__(self, mode: int, from_list: bool, materials: frozenset[str]) -> None:
        self.mode, self.from_list, self.materials = mode, from_list, materials
        self.positions: list[float] = []
        self.changes: dict[str, list[tuple[int, Any]]] = {}
        self.steady: dict[str, int] = {}
        self.arrays: Mapping[str, np.ndarray] = {}
        self.waiting: Waiting | None = None
        self.continued, self.position_size, self.limit, self.counted, self.start = False, 0, 0, 0, 0

    def __len__(self) -> int:
        return len(self.positions) // 4

    def change(self, name: str, before: Any, value: Any) -> None:
        """Set an attribute of the vertices that follow."""
        changes = self.changes.get(name)
        if changes is None:
            changes = self.changes[name] = [(0, before)]
        changes.append((len(self.positions), value))

    def values(self, name: str, current: Any) -> list[Any]:
        """Return the value of an attribute at each vertex."""
        changes = self.changes.get(name)
        if changes is None:
            return [current] * len(self)
        ends = [*(start for start, _ in changes[1:]), len(self.positions)]
        return [value for (start, value), end in zip(changes, ends, strict=True) for _ in range(start, end, 4)]

    def components(self, name: str, current: tuple[float, ...]) -> list[float]:
        """Return the components of an attribute at each vertex, one after the other."""
        changes = self.changes.get(name)
        if changes is None:
            return [*current] * len(self)
        components: list[float] = []
        start, value = changes[0]
        for end, following in changes[1:]:
            components += value if end - start == 4 else value * ((end - start) // 4)
            start, value = end, following
        components += value * ((len(self.positions) - start) // 4)
        return components

    def split(self) -> Primitive:
        """Move the vertices of the pairs before to a primitive of their own, and return it."""
        before, start = Primitive(self.mode, self.from_list, self.materials), self.start
        before.positions, self.positions = self.positions[:start], self.positions[start:]
        for name, changes in self.changes.items():
            n_before = bisect_left(changes, start, key=itemgetter(0))
            before.changes[name] = changes[:n_before]
            first = (start, changes[n_before - 1][1])  # what the pair began with, unless it is changed there
            self.changes[name] = [(place - start, value) for place, value in (first, *changes[n_before:])]
        self.counted, self.limit, self.start = self.counted - start // 4, self.limit - start, 0
        return before

    def select(self, vertices: Sequence[int]) -> None:
        """Keep these vertices, in this order; the attributes of those that follow stay."""
        for name, changes in self.changes.items():
            values = self.values(name, None)
            kept = [(4 * number, values[vertex]) for number, vertex in enumerate(vertices)]
            self.changes[name] = [*kept, (4 * len(kept), changes[-1][1])]
        self.positions = [x for vertex in vertices for x in self.positions[4 * vertex : 4 * vertex + 4]]
        self.arrays = {}
