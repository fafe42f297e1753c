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

FEW = 16  # vertices of a pair whose numbers wait; arrays for more cost little in comparison
NO_VERTICES = Vertices(np.empty((0, 4)), np.empty((0, 4)), np.empty((0, 3)), ())  # until the numbers are arrays


class PairNumbers:
    """The numbers of pairs that carry the same attributes, one pair after the other.

    Parameters
    ----------
    context : Context                its current values are those of the first pair
    primitive : Primitive            the first pair, whose lists grow
    carried : Carried                which attributes the vertices carry
    """

    __slots__ = ("_carried", "_color", "_columns", "_context", "_normal", "_positions", "_texcoords")

    def __init__(self, context: Context, primitive: Primitive, carried: Carried) -> None:
        self._context, self._carried = context, carried
        self._color, self._normal = context.current.color, context.current.normal
        self._texcoords = kept_constants(context).find_texcoords(context, carried.units)
        self._positions = primitive.positions
        self._columns = {name: primitive.components(name, context.attribute(name)) for name in carried.columns}

    def takes(self, carried: Carried) -> bool:
        """Return whether a pair with these attributes can be added.

        The others have not changed: their first change submits the collected vertices.
        """
        return carried is self._carried

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
    """Collect a pair of separate primitives, to draw it together with pairs that follow."""
    buffer, count = context.vertex_buffer, len(primitive.positions) // 4
    told = "/".join(context.labels) if context.labels else "", context.origin
    joined = buffer.joined_pairs if buffer.can_join(mode) else None
    carried = carried_of(tuple(buffer.sizes))
    if count > FEW or not _is_plain(context, carried, primitive):
        vertices = vertices_of(context, primitive)
        if joined is None:
            joined = buffer.begin_joined_pairs(context.draw_command(mode, vertices))
        joined.add(told, vertices, count)
        return
    last = joined.last(told) if joined is not None else None
    if joined is not None and isinstance(last, PairNumbers) and last.takes(carried):
        joined.n_vertices += count
        last.add(primitive)
        return
    if joined is None:
        joined = buffer.begin_joined_pairs(context.draw_command(mode, NO_VERTICES))
    joined.add(told, PairNumbers(context, primitive, carried), count)


def _is_plain(context: Context, carried: Carried, primitive: Primitive) -> bool:
    """Return whether vertices have no more than colours, normals and texture coordinates, and materials follow none."""
    current = context.current
    return not (
        carried.optional
        or primitive.materials
        or primitive.arrays
        or context.groups["lighting"].fields["color_material"]
        or not current.edge
        or current.secondary != BLACK
        or current.fog_coordinate
    )
