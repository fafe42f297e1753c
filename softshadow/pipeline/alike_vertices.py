"""The vertices of several draws that have arrays of the same attributes (`pipeline.alike_draws`)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cached_property
from itertools import accumulate, pairwise, repeat
from typing import NamedTuple, Protocol

import numpy as np

from softshadow.pipeline.commands import Vertices


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

    def split(self, counts: Sequence[int], ends: Sequence[int]) -> Iterable[np.ndarray]:
        """Return the rows of each draw, by its number of vertices; `ends` as for `split`."""
        if not self.is_constant:
            return split(self.rows, ends)
        rows = self.rows
        if len(rows) > 1:
            return map(_repeated, rows, counts)
        if len(set(counts)) == 1:
            return repeat(_repeated(rows[0], counts[0]), len(counts))
        return [_repeated(rows[0], count) for count in counts]

    def of(self, draws: slice, vertices: slice) -> Attribute:
        """Return that of some draws, which have these vertices."""
        if not self.is_constant:
            return Attribute(self.rows[vertices], False)
        return self if len(self.rows) == 1 else Attribute(self.rows[draws], True)


def split(rows: np.ndarray, ends: Sequence[int]) -> list[np.ndarray]:
    """Return the rows of each draw; `ends` are those of the vertices before, and of each draw."""
    return [rows] if len(ends) == 2 else [rows[start:end] for start, end in pairwise(ends)]


def _repeated(row: np.ndarray, count: int) -> np.ndarray:
    """Return a read-only view of `count` times the same row."""
    return np.ndarray((count, len(row)), row.dtype, row, 0, (0, row.itemsize))


class JoinedVertices(NamedTuple):
    """The vertices of several draws in arrays of all; they have the attributes that all `Vertices` have.

    counts: how many each draw has; position (V, 4): of all, one draw after the other; units: the texture coordinates
    (V, 4) by unit; constants: those of the other units.
    """

    counts: Sequence[int]
    position: np.ndarray
    color: Attribute
    normal: Attribute
    constants: ConstantTexcoords
    units: dict[int, np.ndarray]

    @property
    def positions(self) -> list[np.ndarray]:
        """The positions (V, 4) of all draws, as a list of arrays to be joined."""
        return [self.position]

    @property
    def colors(self) -> list[np.ndarray]:
        """The colours, as `positions`."""
        return [self.color.rows]

    @property
    def normals(self) -> list[np.ndarray]:
        """The normals, as `positions`."""
        return [self.normal.rows]

    def constant(self, name: str) -> np.ndarray:
        """Return the "color" or "normal" of each draw, where it is constant: (D, k), or (1, k) if all are equal."""
        return (self.color if name == "color" else self.normal).rows

    def texcoords(self, unit: int) -> list[np.ndarray]:
        """Return the coordinates of a texture unit, as `positions`."""
        return [self.units[unit]]

    def constant_texcoords(self, unit: int) -> Sequence[np.ndarray]:
        """Return the coordinates (4,) of a texture unit in each draw, where they are constants."""
        return [self.constants.rows(1)[unit][0]] * len(self.counts)

    def split(self) -> list[Vertices]:
        """Return the vertices of each draw."""
        counts = self.counts
        ends = list(accumulate(counts, initial=0))
        texcoords: Iterable[tuple[np.ndarray, ...]] = map(self.constants.rows, counts)
        for unit, rows in self.units.items():
            parts = zip(texcoords, split(rows, ends), strict=True)
            texcoords = [(*each[:unit], own, *each[unit + 1 :]) for each, own in parts]
        columns = split(self.position, ends), self.color.split(counts, ends), self.normal.split(counts, ends)
        return list(map(Vertices, *columns, texcoords))

    def of(self, first: int, end: int) -> JoinedVertices:
        """Return those of the draws from one to another."""
        if end - first == len(self.counts):
            return self
        start = sum(self.counts[:first])
        draws, vertices = slice(first, end), slice(start, start + sum(self.counts[first:end]))
        units = {unit: rows[vertices] for unit, rows in self.units.items()}
        color, normal = self.color.of(draws, vertices), self.normal.of(draws, vertices)
        return JoinedVertices(self.counts[draws], self.position[vertices], color, normal, self.constants, units)

    @property
    def first(self) -> Vertices:
        """The vertices of the first draw."""
        (own,) = self.of(0, 1).split()
        return own

    @property
    def arrays(self) -> list[np.ndarray]:
        """All arrays that have a row for each vertex."""
        attributes = [each.rows for each in (self.color, self.normal) if not each.is_constant]
        return [self.position, *attributes, *self.units.values()]


class GivenVertices:
    """Vertices of several draws whose arrays exist already, as `JoinedVertices`.

    Parameters
    ----------
    vertices : sequence of Vertices    of each draw
    """

    def __init__(self, vertices: Sequence[Vertices]) -> None:
        self.vertices = vertices

    @cached_property
    def counts(self) -> list[int]:
        """How many vertices each draw has."""
        return list(map(len, self.positions))

    @property
    def positions(self) -> list[np.ndarray]:
        """The positions of each draw."""
        return [each.position for each in self.vertices]

    @property
    def colors(self) -> list[np.ndarray]:
        """The colours of each draw."""
        return [each.color for each in self.vertices]

    @property
    def normals(self) -> list[np.ndarray]:
        """The normals of each draw."""
        return [each.normal for each in self.vertices]

    def constant(self, name: str) -> np.ndarray:
        """Return the "color" or "normal" of each draw, where it is constant: (D, k), or (1, k) if all are the same."""
        rows = self.colors if name == "color" else self.normals
        return rows[0][:1] if len(set(map(id, rows))) == 1 else np.concatenate([each[:1] for each in rows])

    def texcoords(self, unit: int) -> list[np.ndarray]:
        """Return the coordinates of a texture unit in each draw."""
        return [each.texcoords[unit] for each in self.vertices]

    def constant_texcoords(self, unit: int) -> list[np.ndarray]:
        """Return the coordinates (4,) of a texture unit in each draw, where they are constants."""
        return [each.texcoords[unit][0] for each in self.vertices]

    def split(self) -> Sequence[Vertices]:
        """Return the vertices of each draw."""
        return self.vertices

    @property
    def first(self) -> Vertices:
        """The vertices of the first draw."""
        return self.vertices[0]
