"""Small draws that differ in vertices, indices and modelview matrix only: they are made when someone looks at them.

A program that draws each of many objects under a matrix of its own makes hundreds of draws of a few vertices in a
frame. To make them one by one would take as long as to carry them out. So they stay arrays of all until a question
about the recording is asked: the triangles of all are set up together (`pipeline.fast.batch`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cached_property
from itertools import chain, repeat
from typing import Any, overload

import numpy as np

from softshadow.pipeline.alike_vertices import GivenVertices, JoinedVertices
from softshadow.pipeline.commands import Draw, moved_draws


class AlikeDraws(Sequence[Draw]):
    """Draws that differ from `like` in vertices, indices and modelview matrix, and from each other in nothing else.

    Parameters
    ----------
    like : Draw              its vertices, indices and matrix are nobody's
    vertices : JoinedVertices or GivenVertices
    modelviews : (D, 4, 4) array, or (1, 4, 4) if all draws have the same matrix
    kinds : sequence of int  of these matrices
    indices : sequence or None    those of each draw; None if they have none
    """

    def __init__(
        self,
        like: Draw,
        vertices: JoinedVertices | GivenVertices,
        modelviews: np.ndarray,
        kinds: Sequence[int],
        indices: Sequence[np.ndarray] | None = None,
    ) -> None:
        self.like, self.vertices, self.modelviews, self.kinds = like, vertices, modelviews, kinds
        self.indices = indices

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
        indices = None if self.indices is None else self.indices[0]
        (draw,) = moved_draws(self.like, [(self.vertices.first, indices, self.modelviews[0], self.kinds[0])])
        return draw

    @cached_property
    def draws(self) -> list[Draw]:
        """All draws."""
        indices = repeat(None) if self.indices is None else self.indices
        modelviews = each_of(self.modelviews, len(self))
        moved = zip(self.vertices.split(), indices, modelviews, self.kinds, strict=False)
        return [self.first, *moved_draws(self.like, moved)[1:]]

    @property
    def counts(self) -> Sequence[int]:
        """How many vertices each draw names."""
        return self.vertices.counts if self.indices is None else list(map(len, self.indices))


def each_of(matrices: np.ndarray, count: int) -> Iterable[np.ndarray]:
    """Return the matrix of each of so many draws, of (D, 4, 4) matrices, or (1, 4, 4) if all have the same."""
    return repeat(matrices[0], count) if len(matrices) == 1 else matrices


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
        if type(draws) is AlikeDraws:
            self.parts.append(draws)
        elif self.parts and type(self.parts[-1]) is list:
            self.parts[-1] += draws
        else:
            self.parts.append(list(draws))

    @property
    def plain(self) -> Sequence[Draw]:
        """The only part, if there is one; else this."""
        return self.parts[0] if len(self.parts) == 1 else self

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
    return draws.parts if type(draws) is DrawList else (draws,)


def vertices_of(part: Sequence[Draw]) -> JoinedVertices | GivenVertices:
    """Return the vertices of such a part."""
    return part.vertices if type(part) is AlikeDraws else GivenVertices([draw.vertices for draw in part])


def of_each(draws: Sequence[Draw], value: Callable[[Draw], Any]) -> list[Any]:
    """Return a value of each draw that depends on nothing in which alike draws differ."""
    if type(draws) is list:
        return list(map(value, draws))
    values: list[Any] = []
    for part in parts_of(draws):
        values += repeat(value(part.like), len(part)) if type(part) is AlikeDraws else map(value, part)
    return values


def vertex_counts(draws: Sequence[Draw]) -> list[int]:
    """Return the number of vertices of each draw."""
    counts: list[int] = []
    for part in parts_of(draws):
        if type(part) is AlikeDraws:
            counts += part.vertices.counts
        else:
            counts += [len(draw.vertices.position) for draw in part]
    return counts
