"""Small draws that differ in their vertices and modelview matrix only: they are made when someone looks at them.

A program that draws each of many objects under a matrix of its own makes hundreds of draws of a few vertices in a
frame. To make them one by one would take as long as to carry them out. So they stay arrays of all until a question
about the recording is asked: the triangles of all are set up together (`pipeline.fast.batch`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cached_property
from itertools import accumulate, chain, pairwise, repeat
from typing import Any, NamedTuple, Protocol, overload

import numpy as np

from softshadow.pipeline.commands import Draw, Vertices, moved_draws


class ConstantTexcoords(Protocol):
    """Values of the texture coordinates of all units."""

    def rows(self, count: int) -> tuple[np.ndarray, ...]:
        """Return `count` equal rows of each unit."""


class Attribute(NamedTuple):
    """Colours or normals of the vertices of several draws, read-only.

    rows : (V, k) of all vertices; where they are constant, (D, k) with a row for each draw, or (1, k) with one for all.
    """

    rows: np.ndarray
    is_constant: bool

    def split(self, ends: Sequence[int]) -> Iterable[np.ndarray]:
        """Return the rows of each draw; `ends` are those of the vertices before, and of each draw."""
        if not self.is_constant:
            return split(self.rows, ends)
        rows, counts = self.rows, [end - start for start, end in pairwise(ends)]
        if len(rows) == 1:
            views = {count: _repeated(rows, 0, count) for count in set(counts)}
            return map(views.__getitem__, counts)
        return [_repeated(rows, number, count) for number, count in enumerate(counts)]

    def of_first(self, count: int) -> Attribute:
        """Return that of the first draw, which has so many vertices."""
        return Attribute(self.rows[: 1 if self.is_constant else count], self.is_constant)


def split(rows: np.ndarray, ends: Sequence[int]) -> list[np.ndarray]:
    """Return the rows of each draw; `ends` are those of the vertices before, and of each draw."""
    return [rows[start:end] for start, end in pairwise(ends)]


def _repeated(rows: np.ndarray, number: int, count: int) -> np.ndarray:
    """Return a read-only view of `count` times the same row."""
    width, size = rows.shape[1], rows.itemsize
    return np.ndarray((count, width), rows.dtype, rows, number * width * size, (0, size))


class AlikeVertices(NamedTuple):
    """The vertices of several draws, with the same attributes: those that all `Vertices` have.

    counts: of the vertices of each draw; positions (V, 4) of all, one draw after the other; texcoords: of the texture
    units that are not in `units`: there, by unit, are coordinates (V, 4).
    """

    counts: Sequence[int]
    positions: np.ndarray
    colors: Attribute
    normals: Attribute
    texcoords: ConstantTexcoords
    units: dict[int, np.ndarray]

    def split(self) -> Iterator[Vertices]:
        """Return the vertices of each draw."""
        ends = list(accumulate(self.counts, initial=0))
        texcoords: Iterable[tuple[np.ndarray, ...]] = map(self.texcoords.rows, self.counts)
        for unit, rows in self.units.items():
            parts = zip(texcoords, split(rows, ends), strict=True)
            texcoords = [(*each[:unit], own, *each[unit + 1 :]) for each, own in parts]
        columns = split(self.positions, ends), self.colors.split(ends), self.normals.split(ends)
        return map(Vertices, *columns, texcoords)

    @property
    def first(self) -> Vertices:
        """The vertices of the first draw."""
        count = self.counts[0]
        own = AlikeVertices(
            (count,),
            self.positions[:count],
            self.colors.of_first(count),
            self.normals.of_first(count),
            self.texcoords,
            {unit: rows[:count] for unit, rows in self.units.items()},
        )
        return next(own.split())

    @property
    def arrays(self) -> list[np.ndarray]:
        """All arrays that have a row for each vertex."""
        attributes = [each.rows for each in (self.colors, self.normals) if not each.is_constant]
        return [self.positions, *attributes, *self.units.values()]


class AlikeDraws(Sequence[Draw]):
    """Draws that differ from `like` in their vertices and modelview matrices, and from each other in nothing else.

    Parameters
    ----------
    like : Draw              its vertices and its matrix are nobody's
    vertices : AlikeVertices
    modelviews : sequence of (4, 4)
    kinds : sequence of int  of these matrices
    """

    def __init__(
        self, like: Draw, vertices: AlikeVertices, modelviews: Sequence[np.ndarray], kinds: Sequence[int]
    ) -> None:
        self.like, self.vertices, self.modelviews, self.kinds = like, vertices, modelviews, kinds

    def __len__(self) -> int:
        return len(self.kinds)

    @overload
    def __getitem__(self, index: int) -> Draw: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[Draw]: ...
    def __getitem__(self, index: Any) -> Any:
        return self.first if index == 0 else self.draws[index]

    def __iter__(self) -> Iterator[Draw]:
        return iter(self.draws)

    @cached_property
    def first(self) -> Draw:
        """The first draw."""
        (draw,) = moved_draws(self.like, [(self.vertices.first, None, self.modelviews[0], self.kinds[0])])
        return draw

    @cached_property
    def draws(self) -> list[Draw]:
        """All draws."""
        made = zip(self.vertices.split(), repeat(None), self.modelviews, self.kinds, strict=False)
        return [self.first, *moved_draws(self.like, made)[1:]]


class DrawList(Sequence[Draw]):
    """Draws one after the other, some of which are `AlikeDraws`.

    Attributes
    ----------
    parts : list             of lists of draws, and of alike ones
    """

    def __init__(self) -> None:
        self.parts: list[list[Draw] | AlikeDraws] = []
        self._n_draws = 0

    def add(self, draws: Sequence[Draw]) -> None:
        """Append draws."""
        self._n_draws += len(draws)
        if isinstance(draws, AlikeDraws):
            self.parts.append(draws)
        elif self.parts and isinstance(self.parts[-1], list):
            self.parts[-1] += draws
        else:
            self.parts.append(list(draws))

    def __len__(self) -> int:
        return self._n_draws

    @overload
    def __getitem__(self, index: int) -> Draw: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[Draw]: ...
    def __getitem__(self, index: Any) -> Any:
        return self.parts[0][0] if index == 0 else list(self)[index]

    def __iter__(self) -> Iterator[Draw]:
        return chain.from_iterable(self.parts)


def parts_of(draws: Sequence[Draw]) -> Sequence[Sequence[Draw]]:
    """Return the parts of a sequence of draws, each a list or `AlikeDraws`."""
    return draws.parts if isinstance(draws, DrawList) else (draws,)


def of_each(draws: Sequence[Draw], value: Callable[[Draw], Any]) -> list[Any]:
    """Return a value of each draw that depends neither on its vertices nor on its modelview matrix."""
    values: list[Any] = []
    for part in parts_of(draws):
        values += [value(part.like)] * len(part) if isinstance(part, AlikeDraws) else map(value, part)
    return values


def vertex_counts(draws: Sequence[Draw]) -> list[int]:
    """Return the number of vertices of each draw."""
    counts: list[int] = []
    for part in parts_of(draws):
        if isinstance(part, AlikeDraws):
            counts += part.vertices.counts
        else:
            counts += [len(draw.vertices.position) for draw in part]
    return counts
