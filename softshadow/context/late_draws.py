"""Draws that are made later, many at once: those of glBegin ... glEnd pairs, and of small arrays and lists.

A program that draws each of many objects under a matrix and in a colour of its own makes hundreds of draws of a few
vertices in a frame. Making one of them (for a pair, with its arrays) and carrying it out takes as long as its calls. So
such draws wait with their numbers or arrays until something else is drawn, or someone looks.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence
from itertools import chain, groupby, repeat
from typing import NamedTuple, Protocol

import numpy as np

from softshadow.context.arrays import SLOTS, TEXCOORD
from softshadow.context.precision import Precision
from softshadow.context.primitive import Primitive
from softshadow.pipeline.commands import Draw, Vertices, moved_draws
from softshadow.pipeline.geometry.separate import separated

# a draw that is kept for comparisons keeps the memory of all that waited with it
MOST_NUMBERS = 2048  # of positions
MOVED_NUMBERS = 16  # as which a draw counts whose arrays have been made
MOST_FORMS = 1024  # as many as there are states that are found again
NO_ROWS = np.empty((0, 4), np.float32)
NO_VERTICES = Vertices(NO_ROWS, NO_ROWS, NO_ROWS, ())


class ConstantTexcoords(Protocol):
    """Values of the texture coordinates of all units."""

    def rows(self, count: int) -> tuple[np.ndarray, ...]:
        """Return `count` equal rows of each unit."""


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
    """A draw with the numbers of its vertices: those of `primitive`.

    The columns of its form are among the changes of the primitive; the other attributes have the values `color` and
    `normal`. Where it is of several strips, fans, loops or polygons, `counts` are their numbers of vertices.
    """

    form: LateForm
    primitive: Primitive
    color: tuple[float, ...]
    normal: tuple[float, ...]
    modelview: np.ndarray
    modelview_kind: int
    counts: tuple[int, ...] = ()

    def made(self, vertices: Vertices) -> Draw:
        """Return the draw with arrays."""
        return _made([(self, vertices)])[0]


class MovedDraw(NamedTuple):
    """A draw that differs from an earlier one, `like`, in its vertices, indices and modelview matrix only.

    Its vertices have arrays of the same attributes.
    """

    like: Draw
    vertices: Vertices
    indices: np.ndarray | None
    modelview: np.ndarray
    modelview_kind: int


def _made(alike: Sequence[tuple[LateDraw, Vertices]]) -> list[Draw]:
    """Return the draws with their arrays; they are like the same one."""
    moved = [(vertices, None, draw.modelview, draw.modelview_kind) for draw, vertices in alike]
    made = moved_draws(alike[0][0].form.like, moved)
    return [separated(each, draw.counts) if draw.counts else each for each, (draw, _) in zip(made, alike, strict=True)]


class LateCommands(NamedTuple):
    """Late draws, of which those with equal `keys` differ in vertices, indices and modelview matrix only.

    Vertices of equal keys have arrays of the same attributes. `are_pairs` says which draws are those of pairs: the
    arrays of these are parts of `memory`.
    """

    draws: list[Draw]
    keys: Sequence[Hashable]
    are_pairs: Sequence[bool]
    memory: list[np.ndarray]


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
        self._n_numbers += len(draw.primitive.positions) if type(draw) is LateDraw else MOVED_NUMBERS
        return self._n_numbers >= MOST_NUMBERS

    def take(self) -> Iterator[LateCommands]:
        """Yield the draws in their order, and forget them."""
        draws, self.draws, self._n_numbers = self.draws, [], 0
        for _, same in groupby(draws, _is_stippled):
            yield self._commands_of(list(same))

    def _commands_of(self, draws: Sequence[LateDraw | MovedDraw]) -> LateCommands:
        """Return draws with their arrays; those that are alike are made together."""
        memory: list[np.ndarray] = []
        keys: list[Hashable] = []
        pairs: dict[Hashable, list[LateDraw]] = {}
        moved: dict[Hashable, list[MovedDraw]] = {}
        for draw in draws:
            if isinstance(draw, LateDraw):
                key: Hashable = id(draw.form.like), draw.form.columns
                pairs.setdefault(key, []).append(draw)
            else:
                key = id(draw.like)
                moved.setdefault(key, []).append(draw)
            keys.append(key)
        of_pairs = [draw for same in pairs.values() for draw in same]
        vertices = self._vertices_of(of_pairs, memory)
        made = {key: iter(_made([(draw, next(vertices)) for draw in same])) for key, same in pairs.items()}
        for key, alike in moved.items():
            made[key] = iter(moved_draws(alike[0].like, [draw[1:] for draw in alike]))
        return LateCommands([next(made[key]) for key in keys], keys, [key in pairs for key in keys], memory)

    def _vertices_of(self, draws: Sequence[LateDraw], memory: list[np.ndarray]) -> Iterator[Vertices]:
        """Return the vertices of each of the draws; add their memory."""
        forms: dict[Hashable, list[LateDraw]] = {}
        keys = [(len(draw.primitive.positions), draw.form.columns, id(draw.form.texcoords)) for draw in draws]
        for key, draw in zip(keys, draws, strict=True):
            forms.setdefault(key, []).append(draw)
        vertices = {key: iter(self._vertices(same, memory)) for key, same in forms.items()}
        return (next(vertices[key]) for key in keys)

    def _vertices(self, draws: Sequence[LateDraw], memory: list[np.ndarray]) -> Iterable[Vertices]:
        """Return the vertices of draws with as many vertices and the same attributes; add their memory."""
        form, n_draws = draws[0].form, len(draws)
        count = len(draws[0].primitive.positions) // 4
        names = ["position", *[name for name in form.columns if name != "normal"]]
        fours, threes = self._rows(draws)
        memory += [base for rows in (fours, threes) if (base := rows.base) is not None and base.size]
        by_draw = fours.reshape(n_draws, len(names), count, 4)
        columns: dict[str, Iterable[np.ndarray]] = {name: by_draw[:, place] for place, name in enumerate(names)}
        if "normal" in form.columns:
            columns["normal"] = threes.reshape(n_draws, count, 3)
        else:
            columns["normal"] = self._constants([draw.normal for draw in draws], count)
        if "color" not in columns:
            columns["color"] = self._constants([draw.color for draw in draws], count)
        texcoords: Iterable[tuple[np.ndarray, ...]] = repeat(form.texcoords.rows(count))
        units = [(SLOTS[name] - TEXCOORD, columns[name]) for name in names if name.startswith("texcoord")]
        for unit, column in units:
            texcoords = [(*each[:unit], rows, *each[unit + 1 :]) for each, rows in zip(texcoords, column, strict=False)]
        return map(Vertices, columns["position"], columns["color"], columns["normal"], texcoords)

    def _constants(self, values: Sequence[tuple[float, ...]], count: int) -> Iterable[np.ndarray]:
        """Return read-only views of `count` equal rows for each value."""
        if len(set(map(id, values))) == 1:
            return repeat(self._precision.constant(values[0], count))
        numbers, width = self._precision.numbers(), len(values[0])
        numbers.extend(chain.from_iterable(values))
        rows = self._precision.rows(numbers, width)
        return np.broadcast_to(rows[:, np.newaxis], (len(values), count, width))

    def _rows(self, draws: Sequence[LateDraw]) -> tuple[np.ndarray, np.ndarray]:
        """Return the rows of four numbers, and those of three.

        They are the positions of each draw, and behind them what its vertices carry, in the order of its columns.
        """
        fours, threes = self._precision.numbers(), self._precision.numbers()
        for draw in draws:
            primitive = draw.primitive
            fours.extend(primitive.positions)
            for name in draw.form.columns:
                (threes if name == "normal" else fours).extend(primitive.components(name, ()))
        return self._precision.rows(fours, 4), self._precision.rows(threes, 3)
