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
MOST_LIKES = 1024  # as many as there are states that are found again
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
    likes : dict             what the latest one of each mode and state, by its identity, was like

    Parameters
    ----------
    precision : Precision    makes the arrays
    """

    def __init__(self, precision: Precision) -> None:
        self._precision = precision
        self.draws: list[LateDraw] = []
        self.likes: dict[tuple[int, int], Draw] = {}
        self._n_numbers = 0

    def keep_like(self, like: Draw) -> None:
        """Keep what a draw is like, for others under its state."""
        if len(self.likes) >= MOST_LIKES:
            self.likes.clear()
        self.likes[like.mode, id(like.state)] = like

    def add(self, draw: LateDraw) -> bool:
        """Let a draw wait; return whether so many wait that they should be taken."""
        self.draws.append(draw)
        self._n_numbers += len(draw.vertices.primitive.positions)
        return self._n_numbers >= MOST_NUMBERS

    def take(self) -> tuple[list[list[Draw]], list[np.ndarray]]:
        """Return the draws in their order, and forget them; those of a list differ in vertices and matrix only.

        And the memory of their arrays, which they share.
        """
        draws, self.draws, self._n_numbers = self.draws, [], 0
        fours, threes = self._rows(draws)
        fours_at = threes_at = 0
        precision, latest_color, latest_normal = self._precision, LatestRows(), LatestRows()
        lists: list[list[Draw]] = []
        like = None
        for draw in draws:
            if draw.like is not like:
                like = draw.like
                lists.append([])
            count = len(draw.vertices.primitive.positions) // 4
            positions, fours_at = fours[fours_at : fours_at + count], fours_at + count
            color, normal, texcoords = None, None, draw.texcoords.rows(count)
            for name in draw.columns:
                if name == "normal":
                    normal, threes_at = threes[threes_at : threes_at + count], threes_at + count
                    continue
                column, fours_at = fours[fours_at : fours_at + count], fours_at + count
                if name == "color":
                    color = column
                else:
                    unit = SLOTS[name] - TEXCOORD
                    texcoords = (*texcoords[:unit], column, *texcoords[unit + 1 :])
            if color is None:
                color = latest_color.of(precision, draw.color, count)
            if normal is None:
                normal = latest_normal.of(precision, draw.normal, count)
            lists[-1].append(draw.made(Vertices(positions, color, normal, texcoords)))
        return lists, [memory for rows in (fours, threes) if (memory := rows.base) is not None and memory.size]

    def _rows(self, draws: Sequence[LateDraw]) -> tuple[np.ndarray, np.ndarray]:
        """Return the rows of four numbers, and those of three.

        They are the positions of each draw, and behind them what its vertices carry, in the order of `columns`.
        """
        fours, threes = self._precision.numbers(), self._precision.numbers()
        for draw in draws:
            primitive = draw.vertices.primitive
            fours.extend(primitive.positions)
            for name in draw.columns:
                (threes if name == "normal" else fours).extend(primitive.components(name, ()))
        return self._precision.rows(fours, 4), self._precision.rows(threes, 3)
