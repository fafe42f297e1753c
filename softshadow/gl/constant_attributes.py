"""Attributes without an array: all vertices of a draw get the current value.

Draws with the same current values share one view of it per number of vertices.
"""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from operator import is_
from typing import NamedTuple

import numpy as np

from softshadow.context import Context, CurrentVertex
from softshadow.context.arrays import COLOR, NORMAL, TEXCOORD
from softshadow.context.current_values import UNIT_OF
from softshadow.context.precision import LatestRows
from softshadow.pipeline.commands import Vertices
from softshadow.state import BLACK

MOST_VIEWS = 1024  # of one value, by the number of vertices
MOST_VALUES = 4096
MOST_DRAWN = 16384  # vertices that are kept besides one for each primitive: some 600 bytes of each are not arrays
OPTIONAL = {"edge": True, "secondary": BLACK, "fog_coordinate": 0.0}  # the last fields of `Vertices`: initial values
IS_OPTIONAL = frozenset(OPTIONAL)
Columns = tuple[np.ndarray, np.ndarray, tuple[np.ndarray, ...]]  # colour, normal, texture coordinates of each unit
NO_UNITS: tuple[tuple[int, str], ...] = ()
# 0 and -0 are different values, so values are compared by their bits
PACK_3, PACK_4, PACK_COLOR_AND_NORMAL = (struct.Struct(f"{count}d").pack for count in (3, 4, 7))


class Carried(NamedTuple):
    """Which attributes the vertices carry: `units` are (unit, name) of texture coordinates, `materials` names.

    `optional`: at least one that not every `Vertices` has, such as the edge flag. `columns` are the names of those that
    every one has.
    """

    color: bool
    normal: bool
    units: tuple[tuple[int, str], ...]
    materials: frozenset[str]
    optional: bool
    columns: tuple[str, ...]


@lru_cache(maxsize=1024)
def carried_of(names: tuple[str, ...]) -> Carried:
    """Return which attributes these are; the same object for the same names."""
    units = tuple([(UNIT_OF[name], name) for name in names if name in UNIT_OF])
    materials = frozenset([name for name in names if "." in name])
    columns = tuple([name for name in ("color", "normal", *UNIT_OF) if name in names])
    return Carried("color" in names, "normal" in names, units, materials, not IS_OPTIONAL.isdisjoint(names), columns)


@dataclass(eq=False, slots=True)
class ConstantAttribute:
    """One value, as a row in the context's precision; `views` by the number of vertices."""

    row: np.ndarray
    views: dict[int, np.ndarray] = field(default_factory=dict)

    def rows(self, count: int) -> np.ndarray:
        """Return a read-only view of `count` equal rows."""
        rows = self.views.get(count)
        if rows is None:
            if len(self.views) >= MOST_VIEWS:
                self.views.clear()
            rows = self.views[count] = repeat_row(self.row, count)
        return rows


@dataclass(eq=False, slots=True)
class ConstantTexcoords:
    """Values of the texture coordinates of all units; `columns` by the number of vertices."""

    attributes: tuple[ConstantAttribute, ...]
    columns: dict[int, tuple[np.ndarray, ...]] = field(default_factory=dict)

    def rows(self, count: int) -> tuple[np.ndarray, ...]:
        """Return `count` equal rows of each unit; the same object for the same number."""
        columns = self.columns.get(count)
        if columns is None:
            if len(self.columns) >= MOST_VIEWS:
                self.columns.clear()
            columns = self.columns[count] = tuple([attribute.rows(count) for attribute in self.attributes])
        return columns


@dataclass(eq=False, slots=True)
class ConstantSet:
    """Values of all attributes; `among` are all sets that are kept."""

    color: ConstantAttribute
    normal: ConstantAttribute
    texcoords: ConstantTexcoords
    among: ConstantAttributes

    @property
    def attributes(self) -> tuple[ConstantAttribute, ...]:
        """The attributes in the order of the slots: colour, normal, texture coordinates."""
        return self.color, self.normal, *self.texcoords.attributes

    def attribute(self, name: str) -> ConstantAttribute:
        """Return an attribute by its name: "color", "normal", "texcoord0" ..."""
        if name.startswith("texcoord"):
            return self.texcoords.attributes[UNIT_OF[name]]
        return self.color if name == "color" else self.normal

    def columns(self, count: int, own: Mapping[int, np.ndarray]) -> Columns:
        """Return `count` rows of colour, normal and texture coordinates: `own` arrays by slot, else equal rows.

        Without own texture coordinates, all draws of as many vertices have the same tuple.
        """
        texcoords = self.texcoords.rows(count)
        if own and max(own) >= TEXCOORD:
            texcoords = tuple([own.get(slot, column) for slot, column in enumerate(texcoords, TEXCOORD)])
        color, normal = own.get(COLOR), own.get(NORMAL)
        return (
            self.color.rows(count) if color is None else color,
            self.normal.rows(count) if normal is None else normal,
            texcoords,
        )


class DrawnVertices:
    """The vertices with which a primitive was drawn, by the set of the current values.

    A program calls a list or draws a sphere with as many colours in every frame as there are objects.
    """

    __slots__ = ("_among", "_by_set")

    def __init__(self) -> None:
        self._among: ConstantAttributes | None = None  # whose sets these are
        self._by_set: dict[ConstantSet, Vertices] = {}

    def get(self, constants: ConstantSet) -> Vertices | None:
        """Return the vertices of an earlier draw with these values."""
        return self._by_set.get(constants)

    def keep(self, constants: ConstantSet, vertices: Vertices) -> Vertices:
        """Keep the vertices, which are returned, as long as the set is kept."""
        if self._among is not constants.among:
            self._among = constants.among
            self._by_set.clear()
        if self._by_set:
            constants.among.n_drawn += 1
        self._by_set[constants] = vertices
        return vertices


class ConstantAttributes:
    """The current values as the last draw had them, and all sets of values; equal values have the same objects.

    `latest_color` and `latest_normal` are for draws that need no set. `n_drawn` counts the `DrawnVertices`, but for
    one of each primitive.
    """

    def __init__(self) -> None:
        initial = CurrentVertex()
        self.color: tuple[float, ...] = initial.color
        self.normal: tuple[float, ...] = initial.normal
        self.latest_color, self.latest_normal = LatestRows(), LatestRows()
        self.texcoords: tuple[tuple[float, float, float, float], ...] = ()
        self.texcoord_attributes = ConstantTexcoords(())
        self.known_texcoords: dict[tuple[bytes, ...], ConstantTexcoords] = {}
        self.known: dict[bytes, ConstantAttribute] = {}
        self.sets: dict[tuple[bytes, ConstantTexcoords], ConstantSet] = {}
        self.last: ConstantSet | None = None
        self.n_drawn = 0

    def find(self, context: Context, carried: Sequence[tuple[int, str]] = NO_UNITS) -> ConstantSet:
        """Return the set of the current values; for `carried` see `find_texcoords`."""
        color, normal, last = context.current.color, context.current.normal, self.last
        texcoords = self.find_texcoords(context, carried)
        if last is not None and texcoords is last.texcoords and color is self.color and normal is self.normal:
            return last
        key = PACK_COLOR_AND_NORMAL(*color, *normal), texcoords
        found = self.sets.get(key)
        if found is None:
            attributes = self._find(context, PACK_4(*color), color), self._find(context, PACK_3(*normal), normal)
            found = self.sets[key] = ConstantSet(*attributes, texcoords, self)
        self.color, self.normal, self.last = color, normal, found
        return found

    def find_texcoords(self, context: Context, carried: Sequence[tuple[int, str]]) -> ConstantTexcoords:
        """Return the current texture coordinates.

        Nobody asks for those of the units that are `carried`: they have values of an earlier draw, so that nothing is
        made for new ones.
        """
        current, known = context.current.texcoords, self.texcoords
        if carried and known:
            current = current.copy()
            for unit, _ in carried:
                current[unit] = known[unit]
        if not known or not all(map(is_, current, known)):
            self.texcoords = tuple(current)
            bits = tuple([PACK_4(*value) for value in current])
            found = self.known_texcoords.get(bits)
            if found is None:
                attributes = tuple([self._find(context, *each) for each in zip(bits, current, strict=True)])
                found = self.known_texcoords[bits] = ConstantTexcoords(attributes)
            self.texcoord_attributes = found
        return self.texcoord_attributes

    def _find(self, context: Context, bits: bytes, value: tuple[float, ...]) -> ConstantAttribute:
        attribute = self.known.get(bits)
        if attribute is None:
            attribute = self.known[bits] = ConstantAttribute(context.frozen(value))
        return attribute


def kept_constants(context: Context) -> ConstantAttributes:
    """Return what is kept of the attributes of earlier draws."""
    kept: ConstantAttributes | None = context.arrays.constants
    if kept is None or kept.n_drawn >= MOST_DRAWN or max(len(kept.sets), len(kept.known_texcoords)) >= MOST_VALUES:
        kept = context.arrays.constants = ConstantAttributes()
    return kept


def constant_attributes(context: Context, carried: Sequence[tuple[int, str]] = NO_UNITS) -> ConstantSet:
    """Return colour, normal and texture coordinates of the context; the same object for the same bits.

    The texture coordinates of `carried` units (unit, name) may be those of an earlier draw.
    """
    return kept_constants(context).find(context, carried)


def repeat_row(row: np.ndarray, count: int) -> np.ndarray:
    """Return a read-only view of `count` equal rows: faster than `np.broadcast_to`, and each draw needs ten."""
    rows = np.ndarray((count, len(row)), row.dtype, row, strides=(0, row.itemsize))
    rows.flags.writeable = False
    return rows
