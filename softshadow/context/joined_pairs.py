"""glBegin ... glEnd pairs that are not drawn yet: those in a row between which nothing changes are one draw.

Mesa joins points, lines, triangles and quads (`softshadow.pipeline.mesa.driver_draws`). Strips, fans, loops and
polygons it draws one by one; here they become one draw of separate triangles or lines, which has the same pixels and
costs less (`softshadow.pipeline.geometry.separate`). A program that draws each shape with its outline goes back and
forth between two modes: its pairs are joined, too, and become a draw for each change of the mode.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import groupby, pairwise
from typing import NamedTuple

import numpy as np

from softshadow.context.late_forms import LateDraw, LateForm
from softshadow.context.primitive import Primitive
from softshadow.pipeline.commands import Draw, Origin, Vertices
from softshadow.pipeline.geometry.separate import can_be_separated, separated
from softshadow.pipeline.mesa.driver_draws import CORNERS, SEPARATE
from softshadow.state import BLACK, State

OPTIONAL = {"edges": True, "secondary": BLACK, "fog_coordinates": 0.0}  # the last fields of `Vertices`: initial values

Told = tuple[str, Origin | None]  # the debug groups that a pair belongs to ("outer/inner"), and its origin


class LateVertices(NamedTuple):
    """The vertices of one or more pairs, as numbers; `vertices_of` makes their arrays."""

    primitive: Primitive
    vertices_of: Callable[[Primitive], Vertices]

    def vertices(self) -> Vertices:
        """Return them."""
        return self.vertices_of(self.primitive)


class JoinedPairs:
    """Joined pairs that are not drawn yet.

    Attributes
    ----------
    like : Draw              a draw with the state of all, and the mode of the last ones

    Parameters
    ----------
    first : Draw or LateDraw of the first pair, with `n_vertices` vertices
    before : JoinedPairs or None    those that this pair could not be joined to, if only its mode came between
    """

    __slots__ = ("_are_separable", "_counts", "_first", "_forms", "_n_vertices", "_parts", "_turns", "like")

    def __init__(self, first: Draw | LateDraw, n_vertices: int, before: JoinedPairs | None = None) -> None:
        self._first, self._n_vertices = first, n_vertices  # since the last turn
        self.like = first.form.like if isinstance(first, LateDraw) else first
        self._counts = [n_vertices]  # of each pair
        self._parts: list[tuple[Told, Vertices | LateVertices]] | None = None  # not needed before the second pair
        self._forms: dict[int, LateForm] = {}  # the latest by mode
        self._are_separable: dict[int, bool] = {}  # pairs of a mode
        if before is not None and before.like.state is self.like.state:
            self._forms, self._are_separable = before._forms, before._are_separable
        if isinstance(first, LateDraw):
            self._forms[self.like.mode] = first.form
        self._turns: list[tuple[int, LateForm]] = []  # the number of the first pair of another mode, and its form

    @property
    def parts(self) -> list[tuple[Told, Vertices | LateVertices]]:
        """The debug groups, the origin and the vertices of one or more pairs each."""
        if self._parts is None:
            first, told = self._first, (self.like.label, self.like.origin)
            if isinstance(first, LateDraw):
                self._parts = [(told, LateVertices(first.primitive, first.form.vertices_of))]
            else:
                self._parts = [(told, first.vertices)]
        return self._parts

    @property
    def only_late(self) -> LateDraw | None:
        """The draw of the only pair, if its arrays are not made yet."""
        return self._first if isinstance(self._first, LateDraw) and len(self._counts) == 1 else None

    def add(self, told: Told, vertices: Vertices, count: int) -> None:
        """Add a pair of `count` vertices."""
        self.parts.append((told, vertices))
        self.count(count)

    def count(self, count: int) -> None:
        """Count the vertices of a pair."""
        self._counts.append(count)
        self._n_vertices += count

    def last(self, told: Told) -> Vertices | LateVertices | None:
        """Return the vertices of the last part; None if it belongs to other debug groups or has another origin."""
        told_before, vertices = self.parts[-1]
        return vertices if told_before == told else None

    def replace_last(self, vertices: LateVertices) -> None:
        """Replace the last part by one to which pairs can be added."""
        self.parts[-1] = self.parts[-1][0], vertices

    def replace_primitive(self, primitive: Primitive) -> None:
        """Let the last part, whose arrays are not made yet, have the numbers of another primitive."""
        told, late = self.parts[-1]
        assert isinstance(late, LateVertices)
        self.parts[-1] = told, late._replace(primitive=primitive)
        if isinstance(self._first, LateDraw) and len(self.parts) == 1:
            self._first = self._first._replace(primitive=primitive)

    @property
    def takes_more(self) -> bool:
        """Whether another pair can be joined: only after complete primitives."""
        mode = self.like.mode
        corners = SEPARATE.get(mode)
        if corners is not None:
            return self._n_vertices % corners == 0
        if mode not in self._are_separable:
            self._are_separable[mode] = can_be_separated(self.like.state, mode)
        return self._are_separable[mode]

    # -- pairs of other modes ------------------------------------------------------------------------------------------
    def turn(self, mode: int, state: State) -> bool:
        """Let pairs of another mode follow; return False, and do nothing, if they are drawn after these.

        They follow if there were such pairs before, and if the numbers of all vertices are those of one primitive.
        """
        form = self._forms.get(mode)
        is_late = isinstance(self._first, LateDraw) and (self._parts is None or len(self._parts) == 1)
        if form is None or form.follows or form.like.state is not state or not (is_late and self.takes_more):
            return False
        self.unturn()
        if mode != self.like.mode:
            self._turns.append((len(self._counts), form))
            self.like, self._n_vertices = form.like, 0
        return True

    def unturn(self) -> None:
        """Undo the last turn if no pair has followed."""
        if self._turns and self._turns[-1][0] == len(self._counts):
            self._turns.pop()
            assert isinstance(self._first, LateDraw)
            first, form = self._turns[-1] if self._turns else (0, self._first.form)
            self.like, self._n_vertices = form.like, sum(self._counts[first:])

    def _in_turns(self, first: LateDraw) -> list[LateDraw]:
        """Return the draws: one for each turn."""
        bounds = [0, *[number for number, _ in self._turns], len(self._counts)]
        forms, draws, end = [first.form, *[form for _, form in self._turns]], [], 0
        others = first.primitive, first.color, first.normal, first.modelview, first.modelview_kind
        for form, (a, b) in zip(forms, pairwise(bounds), strict=True):
            counts, start = tuple(self._counts[a:b]), end
            end += 4 * sum(counts)
            are_separated = len(counts) > 1 and form.like.mode not in SEPARATE
            draws.append(LateDraw(form, *others, counts if are_separated else (), start, end))
        return draws

    def take_before_last_turn(self) -> list[LateDraw]:
        """Return the draws of the pairs before the last turn, which are no longer among these; pairs have followed."""
        if not self._turns:
            return []
        first = self._first
        assert isinstance(first, LateDraw)
        *before, last = self._in_turns(first)
        primitive = first.primitive
        primitive.start = last.start
        earlier, number = primitive.split(), self._turns[-1][0]
        self._first, self._counts, self._turns = last._replace(start=0, end=None), self._counts[number:], []
        return [draw._replace(primitive=earlier) for draw in before]

    def commands(self) -> Sequence[Draw | LateDraw]:
        """Return the draws: one if debug groups and origins of all pairs are equal, else one for each change."""
        self.unturn()
        first = self._first
        if len(self._counts) == 1:
            return [first]
        if isinstance(first, LateDraw) and self._turns:
            return self._in_turns(first)
        if isinstance(first, LateDraw) and len(self.parts) == 1:  # which has the vertices of all pairs
            return [first if self.like.mode in SEPARATE else first._replace(counts=tuple(self._counts))]
        parts = [(told, part.vertices() if isinstance(part, LateVertices) else part) for told, part in self.parts]
        if isinstance(first, LateDraw):
            first = first.made(parts[0][1])
        groups = [(told, [part for _, part in group]) for told, group in groupby(parts, lambda part: part[0])]
        commands, start, counts = [], 0, iter(self._counts)
        whole = join_vertices([vertices for _, vertices in parts]).position if len(groups) > 1 else None
        for (label, origin), group in groups:
            command = first._replace(vertices=join_vertices(group), label=label, origin=origin)
            end = start + len(command.vertices.position)
            if command.mode not in SEPARATE:
                command = separated(command, tuple(_counts_until(end - start, counts)))
            elif command.mode in CORNERS and whole is not None:
                command = command._replace(joined_positions=whole, joined_start=start)
            commands.append(command)
            start = end
        return commands


def _counts_until(sum_of_all: int, counts: Iterator[int]) -> Iterator[int]:
    """Take counts until their sum is reached."""
    while sum_of_all > 0:
        count = next(counts)
        sum_of_all -= count
        yield count


def join_vertices(parts: Sequence[Vertices]) -> Vertices:
    """Return the vertices of all parts, which have the same attributes; a constant attribute stays broadcast."""
    if len(parts) == 1:
        return parts[0]
    units = range(len(parts[0].texcoords))
    return Vertices(
        _concatenated([part.position for part in parts]),
        _concatenated([part.color for part in parts]),
        _concatenated([part.normal for part in parts]),
        tuple(_concatenated([part.texcoords[unit] for part in parts]) for unit in units),
        {name: _concatenated([part.materials[name] for part in parts]) for name in parts[0].materials},
        *(_optional(parts, name) for name in OPTIONAL),
    )


def _optional(parts: Sequence[Vertices], name: str) -> np.ndarray | None:
    """Return an attribute of all parts; None if all have its initial value."""
    rows = [getattr(part, name) for part in parts]
    known = next((each for each in rows if each is not None), None)
    if known is None:
        return None
    initial = np.array(OPTIONAL[name], known.dtype)
    return _concatenated(
        [
            np.broadcast_to(initial, (len(part.position), *initial.shape)) if each is None else each
            for part, each in zip(parts, rows, strict=True)
        ]
    )


def _concatenated(rows: Sequence[np.ndarray]) -> np.ndarray:
    if all(part.strides[0] == 0 for part in rows) and len({part[:1].tobytes() for part in rows}) == 1:
        return np.broadcast_to(rows[0][0], (sum(map(len, rows)), *rows[0].shape[1:]))
    whole = np.concatenate(rows)
    whole.setflags(write=False)
    return whole
