"""Draws of glBegin ... glEnd pairs whose arrays are not made yet: those of many draws are made at once.

A program that draws each of many objects between a glBegin and a glEnd, under a matrix and in a colour of its own,
makes hundreds of draws of a few vertices in a frame. Making the arrays of one of them, and carrying it out, takes as
long as its calls. So such draws wait with their numbers until something else is drawn, or someone looks.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple, Protocol

import numpy as np

from softshadow.context.arrays import SLOTS, TEXCOORD
from softshadow.context.precision import LatestRows, Precision
from softshadow.pipeline.commands import Draw, Vertices
from softshadow.pipeline.geometry.separate import separated

# a draw that is kept for comparisons keeps the memory of all that waited with it
MOST_NUMBERS = 2048  # of positions
VERTICES, MODELVIEW, KIND = map(Draw._fields.index, ("vertices", "modelview", "modelview_kind"))
NO_ROWS = np.empty((0, 4), np.float32)
NO_VERTICES = Vertices(NO_ROWS, NO_ROWS, NO_ROWS, ())


class ConstantTexcoords(Protocol):
    """Values of the texture coordinates of all units."""

    def rows(self, count: int) -> tuple[np.ndarray, ...]:
        """Return `count` equal rows of each unit."""


class LateVertices(Protocol):
    """Vertices of pairs, whose arrays are made when they are drawn."""

    primitive: Any  # which has the numbers

    def vertices(self) -> Vertices:
        """Return them."""


class LateDraw(NamedTuple):
    """A draw with the numbers of its vertices.

    `like` is a draw that differs in its vertices and its modelview matrix only. The vertices carry the attributes
    `columns`, which are among the changes of their primitive; the others have the values `color`, `normal` and
    `texcoords`. It has neither debug groups nor an origin. Where it is of several strips, fans, loops or polygons,
    `counts` are their numbers of vertices.
    """

    like: Draw
    vertices: LateVertices
    columns: tuple[str, ...]
    color: tuple[float, ...]
    normal: tuple[float, ...]
    texcoords: ConstantTexcoords
    modelview: np.ndarray
    modelview_kind: int
    counts: tuple[int, ...] = ()

    def made(self, vertices: Vertices) -> Draw:
        """Return the draw with arrays."""
        fields: list[Any] = list(self.like)
        fields[VERTICES], fields[MODELVIEW], fields[KIND] = vertices, self.modelview, self.modelview_kind
        made = Draw._make(fields)
        return separated(made, self.counts) if self.counts else made


class LateDraws:
    """Draws that wait for their arrays.

    Attributes
    ----------
    draws : list             these, in their order
    likes : dict             what the latest one of each mode was like

    Parameters
    ----------
    precision : Precision    makes the arrays
    """

    def __init__(self, precision: Precision) -> None:
        self._precision = precision
        self.draws: list[LateDraw] = []
        self.likes: dict[int, Draw] = {}
        self._n_numbers = 0

    def add(self, draw: LateDraw) -> bool:
        """Let a draw wait; return whether so many wait that they should be taken."""
        self.draws.append(draw)
        self._n_numbers += len(draw.vertices.primitive.positions)
        return self._n_numbers >= MOST_NUMBERS

    def take(self) -> list[list[Draw]]:
        """Return the draws in their order, and forget them; those of a list differ in vertices and matrix only."""
        draws, self.draws, self._n_numbers = self.draws, [], 0
        rows, precision = iter(self._rows(draws)), self._precision
        lists: list[list[Draw]] = []
        like = None
        latest_color, latest_normal = LatestRows(), LatestRows()
        for draw in draws:
            if draw.like is not like:
                like = draw.like
                lists.append([])
            positions = next(rows)
            count = len(positions)
            color, normal, texcoords = None, None, draw.texcoords.rows(count)
            for name in draw.columns:
                if name == "color":
                    color = next(rows)
                elif name == "normal":
                    normal = next(rows)
                else:
                    unit = SLOTS[name] - TEXCOORD
                    texcoords = (*texcoords[:unit], next(rows), *texcoords[unit + 1 :])
            if color is None:
                color = latest_color.of(precision, draw.color, count)
            if normal is None:
                normal = latest_normal.of(precision, draw.normal, count)
            lists[-1].append(draw.made(Vertices(positions, color, normal, texcoords)))
        return lists

    def _rows(self, draws: Sequence[LateDraw]) -> list[np.ndarray]:
        """Return the positions of each draw, and behind them what its vertices carry, in the order of `columns`."""
        numbers: list[Sequence[float]] = []
        widths: list[int] = []
        for draw in draws:
            primitive = draw.vertices.primitive
            numbers.append(primitive.positions)
            widths.append(4)
            for name in draw.columns:
                numbers.append(primitive.components(name, ()))
                widths.append(3 if name == "normal" else 4)
        return self._precision.packed_parts(numbers, widths)
