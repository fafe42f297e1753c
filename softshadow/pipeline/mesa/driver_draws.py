"""Which glBegin ... glEnd pairs Mesa hands to the driver as one draw.

Consecutive pairs of points, lines, triangles or quads with nothing between them are joined to one list of primitives
(`JoinedPairs`). How llvmpipe cuts a quad into triangles depends on whether any vertex of the joined pairs is clipped,
so all pairs must be known before the first one is drawn (`softshadow.pipeline.mesa.quad_cuts`). Which triangles it
draws depends on their number (`softshadow.pipeline.mesa.rectangles`).

Pairs of other modes are not joined, but those of one mode in a row are still one draw of the driver (`DriverDraw`), in
which the first triangle decides the polygon offset of all.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import Protocol

import numpy as np

from softshadow import tokens as gl
from softshadow.frozen import evolve
from softshadow.pipeline.commands import Draw, Origin, Vertices
from softshadow.pipeline.mesa.polygon_rules import effective_modes, offset_is_on
from softshadow.state import BLACK

CORNERS = {gl.GL_TRIANGLES: 3, gl.GL_QUADS: 4}  # vertices per primitive, where the number of all decides what is drawn
SEPARATE = {gl.GL_POINTS: 1, gl.GL_LINES: 2, **CORNERS}  # vertices per primitive, for the modes whose pairs are joined
OPTIONAL = {"edges": True, "secondary": BLACK, "fog_coordinates": 0.0}  # the last fields of `Vertices`: initial values
MAX_PAIRS = 64  # with so many collected pairs, Mesa draws them (VBO_MAX_PRIM)


Told = tuple[str, Origin | None]  # the debug groups that a pair belongs to ("outer/inner"), and its origin


class LateVertices(Protocol):
    """Vertices of pairs, whose arrays are made when they are drawn."""

    def vertices(self) -> Vertices:
        """Return them."""


class JoinedPairs:
    """Joined pairs that are not drawn yet.

    Attributes
    ----------
    first : Draw             the command of the first one, with the state of all
    n_vertices : int         of all pairs
    parts : list             the debug groups, the origin and the vertices of one or more pairs
    """

    __slots__ = ("first", "n_vertices", "parts")

    def __init__(self, first: Draw, n_vertices: int) -> None:
        self.first, self.n_vertices = first, n_vertices
        self.parts: list[tuple[Told, Vertices | LateVertices]] = [((first.label, first.origin), first.vertices)]

    def add(self, told: Told, vertices: Vertices, count: int) -> None:
        """Add a pair of `count` vertices."""
        self.parts.append((told, vertices))
        self.n_vertices += count

    def last(self, told: Told) -> Vertices | LateVertices | None:
        """Return the vertices of the last part; None if it belongs to other debug groups or has another origin."""
        told_before, vertices = self.parts[-1]
        return vertices if told_before == told else None

    def replace_last(self, vertices: LateVertices) -> None:
        """Replace the last part by one to which pairs can be added."""
        self.parts[-1] = self.parts[-1][0], vertices

    @property
    def takes_more(self) -> bool:
        """Whether another pair can be joined: only after complete primitives."""
        return self.n_vertices % SEPARATE[self.first.mode] == 0

    def commands(self) -> list[Draw]:
        """Return the draws: one if debug groups and origins of all pairs are equal, else one for each change."""
        if len(self.parts) == 1 and self.parts[0][1] is self.first.vertices:
            return [self.first]
        parts = [(told, part if isinstance(part, Vertices) else part.vertices()) for told, part in self.parts]
        groups = [(told, [part for _, part in group]) for told, group in groupby(parts, lambda part: part[0])]
        if len(groups) == 1:
            return [evolve(self.first, vertices=join_vertices(groups[0][1]))]
        whole = join_vertices([vertices for _, vertices in parts]).position
        commands, start = [], 0
        for (label, origin), group in groups:
            vertices = join_vertices(group)
            command = evolve(self.first, vertices=vertices, label=label, origin=origin)
            if command.mode in CORNERS:
                command = evolve(command, joined_positions=whole, joined_start=start)
            commands.append(command)
            start += len(vertices.position)
        return commands


@dataclass(slots=True)
class CollectedPairs:
    """The glBegin ... glEnd pairs that Mesa has collected: their number, and mode and number of vertices of the last.

    Joined pairs count as one. Too many pairs are drawn, and later ones are not joined to them (vbo_exec_api.c,
    _mesa_End).
    """

    n_pairs: int = 0
    mode: int = -1
    n_vertices: int = 0

    def clear(self) -> None:
        """Forget all pairs: they have been drawn."""
        self.n_pairs, self.mode, self.n_vertices = 0, -1, 0

    def add(self, mode: int, n_vertices: int) -> int:
        """Add a pair, or join it to the one before; return the number of pairs."""
        if mode == self.mode and mode in SEPARATE and self.n_vertices % SEPARATE[mode] == 0:
            self.n_vertices += n_vertices
        else:
            self.n_pairs, self.mode, self.n_vertices = self.n_pairs + 1, mode, n_vertices
        return self.n_pairs


@dataclass(slots=True)
class DriverDraw:
    """Draws of one mode that Mesa hands to the driver as one (st_draw_gallium_multimode).

    `is_lost`: it begins with a pair without vertices, so Mesa takes all of it for empty. `offset_mode` is the polygon
    mode of the first triangle that is not culled, whose offset applies to all, or 0 before that.
    """

    mode: int = -1
    is_lost: bool = False
    offset_mode: int = 0

    def part(self, command: Draw, offset_mode_of: Callable[[Draw], int]) -> Draw:
        """Return a draw with the offset mode that an earlier part has decided; the first part decides it.

        `offset_mode_of` returns the mode that a draw decides (`softshadow.pipeline.geometry.geometry`).
        """
        if not offset_is_on(command.state.polygon):
            return command
        front, back = effective_modes(command.state)
        if front == back:
            return command
        part = evolve(command, offset_mode=self.offset_mode)
        if not self.offset_mode:
            self.offset_mode = offset_mode_of(part)
        return part


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
