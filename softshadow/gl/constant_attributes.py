"""Attributes without an array: all vertices of a draw get the current value.

Draws with the same current values share one view of it per number of vertices.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass, field
from operator import is_

import numpy as np

from softshadow.context import Context

MOST_VIEWS = 1024  # of one value, by the number of vertices
MOST_VALUES = 4096


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
class ConstantAttributes:
    """The current values, in the order of the slots, and what stands for them; equal values have the same object."""

    values: tuple[tuple[float, ...], ...]  # colour, normal, texture coordinates
    attributes: tuple[ConstantAttribute, ...]
    known: dict[bytes, ConstantAttribute]
    sets: dict[tuple[ConstantAttribute, ...], tuple[ConstantAttribute, ...]]
    columns: dict[tuple[tuple[ConstantAttribute, ...], int], tuple[np.ndarray, ...]]


def constant_attributes(context: Context) -> tuple[ConstantAttribute, ...]:
    """Return colour, normal and texture coordinates of the context; the same tuple for the same bits."""
    current, kept = context.current, context.arrays.constants
    values = (current.color, current.normal, *current.texcoords)
    if kept is None:
        kept = context.arrays.constants = ConstantAttributes((), (), {}, {}, {})
    elif all(map(is_, values, kept.values)):
        return kept.attributes
    if len(kept.known) >= MOST_VALUES or len(kept.sets) >= MOST_VALUES:
        kept.known, kept.sets, kept.values, kept.attributes = {}, {}, (), ()
    found = []
    old_values = kept.values or (None,) * len(values)
    for value, old_value, attribute in zip(values, old_values, kept.attributes or old_values, strict=True):
        if value is not old_value:
            bits = struct.pack(f"{len(value)}d", *value)  # 0 and -0 are different values
            attribute = kept.known.get(bits)
            if attribute is None:
                attribute = kept.known[bits] = ConstantAttribute(context.frozen(value))
        found.append(attribute)
    attributes = tuple(found)
    kept.values, kept.attributes = values, kept.sets.setdefault(attributes, attributes)
    return kept.attributes


def constant_columns(context: Context, constants: tuple[ConstantAttribute, ...], count: int) -> list[np.ndarray]:
    """Return `count` rows of each attribute."""
    known = context.arrays.constants.columns
    columns: tuple[np.ndarray, ...] | None = known.get((constants, count))
    if columns is None:
        if len(known) >= MOST_VALUES:
            known.clear()
        columns = known[constants, count] = tuple(constant.rows(count) for constant in constants)
    return list(columns)


def repeat_row(row: np.ndarray, count: int) -> np.ndarray:
    """Return a read-only view of `count` equal rows: faster than `np.broadcast_to`, and each draw needs ten."""
    rows = np.ndarray((count, len(row)), row.dtype, row, strides=(0, row.itemsize))
    rows.flags.writeable = False
    return rows
