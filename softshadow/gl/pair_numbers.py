"""Vertices of glBegin ... glEnd pairs that are drawn together: their numbers become arrays when they are drawn.

A program that draws each tile or face between a glBegin and a glEnd of its own makes many pairs of a few vertices.
"""

from __future__ import annotations

import numpy as np

from softshadow.context import Context, Primitive
from softshadow.frozen import create
from softshadow.gl.constant_attributes import Carried, carried_of, kept_constants
from softshadow.gl.vertex_format import NONE, vertices_of
from softshadow.pipeline.commands import Vertices
from softshadow.state import BLACK

FEW = 64  # vertices of a pair whose numbers wait; arrays for more cost little in comparison


class PairNumbers:
    """The numbers of pairs that carry the same attributes, one pair after the other.

    Parameters
    ----------
    context : Context
    first : Vertices             the vertices of the first pair
    carried : Carried            which attributes all vertices carry; the others are the current values
    """

    __slots__ = ("_carried", "_color", "_columns", "_context", "_normal", "_positions", "_texcoords")

    def __init__(self, context: Context, first: Vertices, carried: Carried) -> None:
        self._context, self._carried = context, carried
        self._color, self._normal = context.current.color, context.current.normal
        self._texcoords = kept_constants(context).find_texcoords(context, carried.units)
        self._positions: list[float] = first.position.reshape(-1).tolist()
        rows = {name: first.texcoords[unit] for unit, name in carried.units}
        rows.update(color=first.color, normal=first.normal)
        self._columns: dict[str, list[float]] = {name: rows[name].reshape(-1).tolist() for name in carried.columns}

    def add(self, primitive: Primitive) -> None:
        """Add the numbers of another pair."""
        self._positions += primitive.positions
        for name, numbers in self._columns.items():
            numbers += primitive.components(name, self._context.attribute(name))

    def vertices(self) -> Vertices:
        """Return the vertices of all pairs."""
        carried, kept = self._carried, kept_constants(self._context)
        count = len(self._positions) // 4

        def rows(name: str, width: int = 4) -> np.ndarray:
            return self._context.packed(self._columns[name], count, width)

        texcoords = self._texcoords.rows(count)
        for unit, name in carried.units:
            texcoords = (*texcoords[:unit], rows(name), *texcoords[unit + 1 :])
        color, normal = (
            rows("color") if carried.color else kept.latest_color.of(self._context, self._color, count),
            rows("normal", 3) if carried.normal else kept.latest_normal.of(self._context, self._normal, count),
        )
        return create(
            Vertices,
            position=self._context.packed(self._positions, count, 4),
            color=color,
            normal=normal,
            texcoords=texcoords,
            materials=NONE,
            edges=None,
            secondary=None,
            fog_coordinates=None,
        )


def collect_pair(context: Context, mode: int, primitive: Primitive) -> None:
    """Collect a pair, to draw it together with pairs that follow."""
    buffer, count = context.vertex_buffer, len(primitive.positions) // 4
    if not buffer.can_join(mode):
        buffer.begin_joined_pairs(context.draw_command(mode, vertices_of(context, primitive)), count)
        return
    joined = buffer.joined_pairs
    assert joined is not None
    told = "/".join(context.labels) if context.labels else "", context.origin
    last, carried = joined.last(told), carried_of(tuple(buffer.sizes))
    are_many = count > FEW or (isinstance(last, Vertices) and len(last.position) > FEW)
    if last is None or are_many or not _is_plain(context, carried, primitive):
        joined.add(told, vertices_of(context, primitive), count)
        return
    if isinstance(last, Vertices):
        last = PairNumbers(context, last, carried)
        joined.replace_last(last)
    assert isinstance(last, PairNumbers)
    last.add(primitive)
    joined.count(count)


def _is_plain(context: Context, carried: Carried, primitive: Primitive) -> bool:
    """Return whether vertices have no more attributes than all `Vertices` have.

    Those of the pair before then have the same ones: a change of which attributes vertices carry, or of one that they
    do not carry, submits what is collected.
    """
    current = context.current
    return not (
        carried.optional
        or primitive.materials
        or not current.edge
        or current.secondary != BLACK
        or current.fog_coordinate
    )
