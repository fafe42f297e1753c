"""Mesa's vertex buffer of immediate mode: which glBegin ... glEnd pairs are drawn together, and when.

Mesa collects pairs until the buffer is full or a call separates them. This decides which vertices form one draw of the
driver (`softshadow.pipeline.mesa.driver_draws`), and so some bits of the image.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Mapping, Sequence
from operator import itemgetter
from typing import Any, Protocol

import numpy as np

from softshadow.context.joined_pairs import JoinedPairs
from softshadow.framebuffer import Storage
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.geometry.geometry import offset_mode_of
from softshadow.pipeline.mesa.driver_draws import (
    MAX_PAIRS,
    SEPARATE,
    CollectedPairs,
    DriverDraw,
    offset_depends_on_mode,
)

BYTES = 512 * 1024  # size of the vertex buffer (vbo_exec_draw.c)
LEAST_BYTES = 1024  # Mesa takes a new buffer when no more than these are left
NO_DRAW = DriverDraw()  # the driver has drawn all


class Waiting(Protocol):
    """Vertices of a primitive whose numbers are not computed yet (`softshadow.gl.evaluators`)."""

    def add(self, context: Any, primitive: Primitive, parameters: tuple[float, ...]) -> bool:
        """Add a vertex; return False, and do nothing, if it must be computed at once."""

    def compute(self, context: Any, primitive: Primitive) -> None:
        """Compute the numbers."""


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
        """Move the vertices of the pairs before to a primitive of their own, and return it.

        The next vertex sets `limit`, or the pair has ended.
        """
        before, start = Primitive(self.mode, self.from_list, self.materials), self.start
        before.positions, self.positions = self.positions[:start], self.positions[start:]
        for name, changes in self.changes.items():
            n_before = bisect_left(changes, start, key=itemgetter(0))
            before.changes[name] = changes[:n_before]
            first = (start, changes[n_before - 1][1])  # what the pair began with, unless it is changed there
            self.changes[name] = [(place - start, value) for place, value in (first, *changes[n_before:])]
        self.counted, self.start = self.counted - start // 4, 0
        return before

    def select(self, vertices: Sequence[int]) -> None:
        """Keep these vertices, in this order; the attributes of those that follow stay."""
        for name, changes in self.changes.items():
            values = self.values(name, None)
            kept = [(4 * number, values[vertex]) for number, vertex in enumerate(vertices)]
            self.changes[name] = [*kept, (4 * len(kept), changes[-1][1])]
        self.positions = [x for vertex in vertices for x in self.positions[4 * vertex : 4 * vertex + 4]]
        self.arrays = {}


class VertexBuffer:
    """The vertices that have been collected and not yet drawn.

    Attributes
    ----------
    sizes : dict             attribute: number of components in the collected vertices
    active_sizes : dict      attribute: number of components in the last call (Mesa's active_size)
    n_vertices : int         number of vertices collected since the last submission
    used_bytes : int         bytes of the buffer before these vertices
    joined_pairs : JoinedPairs or None    those that are not drawn yet, since more may follow
    paused : Primitive or None    the last of them, if the next pair of its mode may add its vertices to it
    pairs : CollectedPairs   glBegin ... glEnd pairs since the last submission
    driver_draw : DriverDraw the driver's draw that the next pair of the same mode belongs to

    Parameters
    ----------
    carry_out : callable     executes and records a draw
    carry_out_alike : callable    the same with several, which differ in their vertices only
    storage : Storage        buffers to draw to: a driver's draw chooses its polygon offset by them
    """

    def __init__(
        self,
        carry_out: Callable[[Draw], None],
        carry_out_alike: Callable[[Sequence[Draw]], None],
        storage: Storage,
    ) -> None:
        self._carry_out, self._carry_out_alike, self._storage = carry_out, carry_out_alike, storage
        self.sizes: dict[str, int] = {}
        self.active_sizes: dict[str, int] = {}
        self.n_vertices, self.used_bytes = 0, 0
        self.joined_pairs: JoinedPairs | None = None
        self.paused: Primitive | None = None
        self.pairs, self.driver_draw = CollectedPairs(), NO_DRAW

    @property
    def room(self) -> int:
        """The number of vertices like the last one that fit behind the submitted ones."""
        return self.room_for(self.sizes)

    def room_for(self, sizes: Mapping[str, int]) -> int:
        """Return how many vertices fit behind the submitted ones, if their attributes have so many components."""
        return (BYTES - self.used_bytes) // (4 * sum(sizes.values()))

    def draw(self, command: Draw) -> None:
        """Draw at once; consecutive draws of one mode are one draw of the driver."""
        driver_draw = self.driver_draw
        mode = command.called_mode
        if mode != driver_draw.mode:
            driver_draw = self.driver_draw = DriverDraw(mode)
        if not driver_draw.is_lost:
            self._carry_out(driver_draw.part(command, self._offset_mode_of))

    def draw_pairs(self, commands: Sequence[Draw]) -> None:
        """Draw glBegin ... glEnd pairs of one mode, none of which are joined, that differ in their vertices only."""
        mode, counts = commands[0].mode, [len(command.vertices.position) for command in commands]
        self.n_vertices += sum(counts)
        self.draw_joined_pairs()
        if mode != self.driver_draw.mode:
            self.driver_draw = DriverDraw(mode)
        if offset_depends_on_mode(commands[0].state):
            for command in commands:
                self.draw(command)
        elif not self.driver_draw.is_lost:
            self._carry_out_alike(commands)
        if self.pairs.add_several(mode, counts) >= MAX_PAIRS:
            self.submit()

    def _offset_mode_of(self, draw: Draw) -> int:
        return offset_mode_of(draw, self._storage)

    def can_join(self, mode: int) -> bool:
        """Return whether vertices of a mode can be joined to the pairs that are not drawn yet."""
        joined = self.joined_pairs
        return joined is not None and joined.first.mode == mode and joined.takes_more

    def begin_joined_pairs(self, first: Draw, n_vertices: int) -> None:
        """Draw the joined pairs, and begin new ones with a draw of so many vertices."""
        self.draw_joined_pairs()
        self.joined_pairs = JoinedPairs(first, n_vertices)

    def split(self, primitive: Primitive) -> None:
        """Leave the pairs before an open one, with which it began, to be drawn without it."""
        assert self.joined_pairs is not None
        self.joined_pairs.replace_primitive(primitive.split())
        self.paused = None

    def end_pair(self, mode: int, vertices: int) -> None:
        """Count a glBegin ... glEnd pair; draw if it is empty and of another mode, or the 64th."""
        if not vertices and self.pairs.mode != mode:
            self.draw_joined_pairs()
            self.driver_draw = DriverDraw(mode, is_lost=mode not in SEPARATE)
        if self.pairs.add(mode, vertices) >= MAX_PAIRS:
            self.submit()

    def draw_joined_pairs(self) -> None:
        """Draw the joined pairs, if there are any."""
        joined, self.joined_pairs, self.paused = self.joined_pairs, None, None
        if joined is not None:
            for command in joined.commands():
                self.draw(command)

    def submit(self) -> None:
        """Draw the collected vertices; those that follow lie behind them in Mesa's buffer."""
        if self.joined_pairs is not None:
            self.draw_joined_pairs()
        self.driver_draw = NO_DRAW
        if self.pairs.n_pairs:
            self.pairs.clear()
        if self.n_vertices:
            used = self.used_bytes + self.n_vertices * 4 * sum(self.sizes.values())
            self.used_bytes = used if used + LEAST_BYTES < BYTES else 0
            self.n_vertices = 0

    def flush(self) -> None:
        """Draw the collected vertices and reset the vertex format."""
        if self.n_vertices or self.joined_pairs is not None:  # pairs without vertices are still counted after this
            self.submit()
        self.sizes.clear()
