"""Draws that are made later, many at once: those of glBegin ... glEnd pairs, and of small arrays and lists.

A program that draws each of many objects under a matrix and in a colour of its own makes hundreds of draws of a few
vertices in a frame. Making one of them (for a pair, with its arrays) and carrying it out takes as long as its calls. So
such draws wait with their numbers or arrays until something else is drawn, or someone looks.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator, Sequence
from itertools import chain, groupby, islice, repeat
from typing import Any, NamedTuple, cast, overload

import numpy as np

from softshadow.context.arrays import SLOTS, TEXCOORD
from softshadow.context.precision import Precision
from softshadow.context.primitive import Primitive
from softshadow.pipeline.alike_draws import AlikeDraws, Attribute, ConstantTexcoords, GivenVertices, JoinedVertices
from softshadow.pipeline.commands import Draw, Vertices, moved_draws
from softshadow.pipeline.geometry.separate import separated

# a draw that is kept for comparisons keeps the memory of all that waited with it
MOST_NUMBERS = 2048  # of positions
SEVERAL = 4  # draws that are made later: fewer are made at once in less time
MOVED_NUMBERS = 16  # as which a draw counts whose arrays have been made
SINGLE = 64  # bytes of a matrix in single precision
MOST_FORMS = 1024  # as many as there are states that are found again
NO_ROWS = np.empty((0, 4), np.float32)
NO_VERTICES = Vertices(NO_ROWS, NO_ROWS, NO_ROWS, ())


class LateForm(NamedTuple):
    """What draws of pairs have in common: all but the numbers of their vertices and their matrix.

    `like` is a draw that differs from them in its vertices and its modelview matrix only; it has neither debug groups
    nor an origin. Their vertices carry the attributes `columns`, among them texture coordinates of `units`; those of
    the others are `texcoords`, which were `current`. `follows`: materials follow their colours. `vertices_of` makes all
    arrays of a primitive.
    """

    like: Draw
    columns: tuple[str, ...]
    texcoords: ConstantTexcoords
    current: tuple[tuple[float, ...], ...]
    units: tuple[int, ...]
    follows: bool
    vertices_of: Callable[[Primitive], Vertices]


class LateDraw(NamedTuple):
    """A draw with the numbers of its vertices: those of `primitive`, from `start` to `end` among its positions.

    The columns of its form are among the changes of the primitive; the other attributes have the values `color` and
    `normal`. Where it is of several strips, fans, loops or polygons, `counts` are their numbers of vertices.
    """

    form: LateForm
    primitive: Primitive
    color: tuple[float, ...]
    normal: tuple[float, ...]
    modelview: bytes
    modelview_kind: int
    counts: tuple[int, ...] = ()
    start: int = 0
    end: int | None = None

    @property
    def n_numbers(self) -> int:
        """How many numbers the positions are."""
        return (len(self.primitive.positions) if self.end is None else self.end) - self.start

    @property
    def positions(self) -> list[float]:
        """x, y, z, w of each vertex."""
        positions = self.primitive.positions
        return positions if self.end is None else positions[self.start : self.end]

    def made(self, vertices: Vertices) -> Draw:
        """Return the draw with arrays."""
        (draw,) = moved_draws(self.form.like, [(vertices, None, _matrices([self])[0], self.modelview_kind)])
        return separated(draw, self.counts) if self.counts else draw


class MovedDraw(NamedTuple):
    """A draw that differs from an earlier one, `like`, in its vertices, indices and modelview matrix only.

    Its vertices have arrays of the same attributes.
    """

    like: Draw
    vertices: Vertices
    indices: np.ndarray | None
    modelview: bytes
    modelview_kind: int


def _moved(draws: Sequence[MovedDraw]) -> Sequence[Draw]:
    """Return draws that are alike."""
    like, vertices, indices = draws[0].like, [draw.vertices for draw in draws], [draw.indices for draw in draws]
    matrices, kinds = _matrices(draws), [draw.modelview_kind for draw in draws]
    own = [each for each in indices if each is not None]
    if len(draws) < SEVERAL or 0 < len(own) < len(draws):
        return moved_draws(like, zip(vertices, indices, matrices, kinds, strict=True))
    return AlikeDraws(like, GivenVertices(vertices), matrices, kinds, own or None)


def _matrices(draws: Sequence[LateDraw | MovedDraw]) -> np.ndarray:
    """Return the modelview matrices (D, 4, 4), read-only."""
    dtype = np.float32 if len(draws[0].modelview) == SINGLE else np.float64
    return np.frombuffer(b"".join([draw.modelview for draw in draws]), dtype).reshape(-1, 4, 4)


class LateCommands(Sequence[Draw]):
    """Late draws in their order, which are made when someone looks at them.

    Attributes
    ----------
    parts : list             each of draws that differ from each other in vertices, indices and modelview matrix only:
                             `AlikeDraws` or a list. The vertices of each part have arrays of the same attributes.
    turns : list             (number of a part, number of its next draws), in drawing order
    """

    def __init__(self, parts: Sequence[Sequence[Draw]], turns: Sequence[tuple[int, int]]) -> None:
        self.parts, self.turns = parts, turns

    def __len__(self) -> int:
        return sum([count for _, count in self.turns])

    def __iter__(self) -> Iterator[Draw]:
        parts = list(map(iter, self.parts))
        return chain.from_iterable(islice(parts[number], count) for number, count in self.turns)

    @overload
    def __getitem__(self, index: int) -> Draw: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[Draw]: ...
    def __getitem__(self, index: Any) -> Any:
        return list(self)[index]


def _is_stippled(draw: LateDraw | MovedDraw) -> bool:
    """Return whether a draw is not taken with others, as a pattern goes on from one to the next."""
    return type(draw) is LateDraw and draw.form.like.state.lines.stippled


class LateDraws:
    """Draws that wait.

    Attributes
    ----------
    draws : list             these, in their order
    earlier : dict           draws that others may continue, by their modes, the identity of their state, and the slots
                             of their arrays (`softshadow.gl.moved_draws`)
    forms : dict             the latest ones, by their mode, the identity of their state, and what the vertices carry

    Parameters
    ----------
    precision : Precision    makes the arrays
    """

    def __init__(self, precision: Precision) -> None:
        self._precision = precision
        self.draws: list[LateDraw | MovedDraw] = []
        self.earlier: dict[tuple[int, int, int, tuple[int, ...]], Draw] = {}
        self.forms: dict[tuple[Hashable, ...], LateForm] = {}
        self._n_numbers = 0

    def keep_form(self, key: tuple[Hashable, ...], form: LateForm) -> None:
        """Keep a form, which keeps its state, for other draws."""
        if len(self.forms) >= MOST_FORMS:
            self.forms.clear()
        self.forms[key] = form

    def add(self, draw: LateDraw | MovedDraw) -> bool:
        """Let a draw wait; return whether so many wait that they should be taken."""
        self.draws.append(draw)
        self._n_numbers += draw.n_numbers if type(draw) is LateDraw else MOVED_NUMBERS
        return self._n_numbers >= MOST_NUMBERS

    def take(self) -> Iterator[LateCommands]:
        """Yield the draws in their order, and forget them."""
        draws, self.draws, self._n_numbers = self.draws, [], 0
        keys = [id(draw[0]) for draw in draws]  # of their form, or of the draw that they are like
        if not any(map(_is_stippled, dict(zip(keys, draws, strict=True)).values())):
            if draws:
                yield self._commands_of(draws, keys)
            return
        for _, same in groupby(zip(draws, keys, strict=True), lambda each: _is_stippled(each[0])):
            yield self._commands_of(*zip(*same, strict=True))

    def _commands_of(self, draws: Sequence[LateDraw | MovedDraw], keys: Sequence[int]) -> LateCommands:
        """Return draws, of which those with equal keys are a part."""
        numbers: dict[int, int] = {}
        alike: list[list[LateDraw | MovedDraw]] = []
        for key, draw in zip(keys, draws, strict=True):
            number = numbers.setdefault(key, len(alike))
            if number == len(alike):
                alike.append([])
            alike[number].append(draw)
        turns = [(numbers[key], len(list(same))) for key, same in groupby(keys)]
        parts: dict[int, Sequence[Draw]] = {}
        pairs: dict[Hashable, list[tuple[int, list[LateDraw]]]] = {}
        for number, same in enumerate(alike):
            if isinstance(same[0], MovedDraw):
                parts[number] = _moved(cast(list[MovedDraw], same))
            else:
                group = pairs.setdefault((same[0].form.columns, id(same[0].form.texcoords)), [])
                group.append((number, cast(list[LateDraw], same)))
        for group in pairs.values():
            group.sort(key=lambda part: len(part[1]) >= SEVERAL)
            parts.update(zip([number for number, _ in group], self._pairs([own for _, own in group]), strict=True))
        return LateCommands([parts[number] for number in range(len(alike))], turns)

    def _pairs(self, parts: Sequence[Sequence[LateDraw]]) -> Iterator[Sequence[Draw]]:
        """Yield parts of draws of pairs: their vertices have the same attributes; those of few draws come first."""
        draws = [draw for part in parts for draw in part]
        vertices, matrices, kinds = self._vertices(draws), _matrices(draws), [draw.modelview_kind for draw in draws]
        n_few = sum([len(part) for part in parts if len(part) < SEVERAL])
        few, start = iter(vertices.of(0, n_few).split()), 0
        for part in parts:
            like, end = part[0].form.like, start + len(part)
            made: Sequence[Draw]
            if end <= n_few:
                own = islice(few, len(part))
                made = moved_draws(like, zip(own, repeat(None), matrices[start:end], kinds[start:end], strict=False))
            else:
                made = AlikeDraws(like, vertices.of(start, end), matrices[start:end], kinds[start:end])
            counts = [draw.counts for draw in part]
            if any(counts):
                made = [
                    separated(each, several) if several else each for each, several in zip(made, counts, strict=True)
                ]
            yield made
            start = end

    def _vertices(self, draws: Sequence[LateDraw]) -> JoinedVertices:
        """Return the vertices of draws with the same attributes."""
        form, positions = draws[0].form, [draw.positions for draw in draws]
        numbers = self._precision.numbers()
        for each in positions:
            numbers.extend(each)
        units = {
            SLOTS[name] - TEXCOORD: self._rows(draws, name, 4) for name in form.columns if name.startswith("texcoord")
        }
        return JoinedVertices(
            [len(each) // 4 for each in positions],
            self._precision.rows(numbers, 4),
            self._attribute(draws, "color"),
            self._attribute(draws, "normal"),
            form.texcoords,
            units,
        )

    def _attribute(self, draws: Sequence[LateDraw], name: str) -> Attribute:
        """Return the colours or normals of draws."""
        values = [draw.color if name == "color" else draw.normal for draw in draws]
        width = len(values[0])
        if name in draws[0].form.columns:
            return Attribute(self._rows(draws, name, width), False)
        if len(set(map(id, values))) == 1:
            return Attribute(self._precision.constant(values[0], 1), True)
        numbers = self._precision.numbers()
        numbers.extend(chain.from_iterable(values))
        return Attribute(self._precision.rows(numbers, width), True)

    def _rows(self, draws: Sequence[LateDraw], name: str, width: int) -> np.ndarray:
        """Return an attribute of all vertices of draws, which is among the changes of their primitives."""
        numbers, whole = self._precision.numbers(), {}
        for draw in draws:
            primitive, end = draw.primitive, draw.end
            if end is None:
                numbers.extend(primitive.components(name, ()))
                continue
            if id(primitive) not in whole:
                whole[id(primitive)] = primitive.components(name, ())
            numbers.extend(whole[id(primitive)][draw.start * width // 4 : end * width // 4])
        return self._precision.rows(numbers, width)
