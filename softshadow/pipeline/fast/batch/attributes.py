"""The attributes of all draws of a run as arrays; equals `geometry.geometry.process_geometry`, see fast/test_batch.py.

An attribute is an array, or constant in each draw: that is the same for all draws of a run (`batch.run.Arrays`).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import chain

import numpy as np

from softshadow.jit import read_only
from softshadow.pipeline.alike_draws import AlikeDraws, Rows, parts_of, vertices_of
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.fast.batch.run import Run
from softshadow.pipeline.memory.scratch import scratch
from softshadow.state import BLACK

REAL = np.dtype(np.float32)
NO_ROWS, NO_INDICES, NO_COORDINATES, NO_TEXCOORDS = map(
    read_only, (np.empty((0, 4), REAL), np.empty(0, np.int32), np.empty(0, REAL), np.empty((0, 0, 4), REAL))
)
NO_SECONDARY, NO_FOG_COORDINATE = np.array(BLACK, REAL), np.zeros((), REAL)


class Attributes:
    """The attributes of the vertices of draws.

    Parameters
    ----------
    draws : sequence of Draw    those of a run
    """

    def __init__(self, draws: Sequence[Draw]) -> None:
        self._draws = draws
        self._parts = list(map(vertices_of, parts_of(draws)))

    def positions(self) -> np.ndarray:
        """Return the positions (V, 4)."""
        return _joined(chain.from_iterable([each.positions for each in self._parts]), NO_ROWS)

    def colors(self, is_array: bool) -> np.ndarray:
        """Return the colours (V, 4); no rows if they are constants."""
        return _joined([rows for each in self._parts for rows, _ in each.colors], NO_ROWS) if is_array else NO_ROWS

    def normals(self, is_array: bool) -> np.ndarray:
        """Return the normals (V, 3); no rows if they are constants, or nobody reads them."""
        return _joined([rows for each in self._parts for rows, _ in each.normals], NO_ROWS) if is_array else NO_ROWS

    def constant_colors(self) -> np.ndarray:
        """Return the constant colours (D, 4), or one row if all draws have the same."""
        return _constants([rows for each in self._parts for rows in each.colors])

    def constant_normals(self) -> np.ndarray:
        """Return the constant normals (D, 3), or one row if all draws have the same."""
        return _constants([rows for each in self._parts for rows in each.normals])

    def texcoords(self, run: Run) -> np.ndarray:
        """Return the coordinates (U, V, 4) of the units of a run; those of a unit without an array are not set."""
        if not run.units:
            return NO_TEXCOORDS
        arrays = {
            n: [rows for each in self._parts for rows in each.texcoords(unit.index)]
            for n, unit in enumerate(run.units)
            if run.arrays.texcoords[n]
        }
        if len(run.units) == len(arrays) == 1:
            return _joined(arrays[0], NO_ROWS)[np.newaxis]
        texcoords = np.empty((len(run.units), sum([sum(each.counts) for each in self._parts]), 4), REAL)
        for n, rows in arrays.items():
            np.concatenate(rows, out=texcoords[n])
        return read_only(texcoords)

    def constant_texcoords(self, unit: int) -> np.ndarray:
        """Return the constant coordinates (D, 4) of a unit."""
        return np.array([row for each in self._parts for row in each.constant_texcoords(unit)])

    def secondaries(self) -> np.ndarray:
        """Return the secondary colours (V, 4)."""
        return _optional([(draw.vertices.secondary, len(draw.vertices.position)) for draw in self._draws], NO_SECONDARY)

    def fog_coordinates(self) -> np.ndarray:
        """Return the fog coordinates (V,)."""
        given = [(draw.vertices.fog_coordinates, len(draw.vertices.position)) for draw in self._draws]
        return _optional(given, NO_FOG_COORDINATE)


def indices_of(draws: Sequence[Draw]) -> np.ndarray:
    """Return the indices of all draws that have some."""
    indices: list[np.ndarray] = []
    for part in parts_of(draws):
        if isinstance(part, AlikeDraws):
            indices += part.indices or ()
        else:
            indices += [draw.indices for draw in part if draw.indices is not None]
    return _joined(indices, NO_INDICES)


def _constants(parts: Sequence[Rows]) -> np.ndarray:
    """Return a row for each draw, or one row if all draws have the same."""
    (first, count), *others = parts
    if not others:
        return first[:count]
    if count == 1 and all(rows is first for rows, _ in others):
        return first[:1]
    return np.concatenate([rows[:1] if count == 1 else _row_of_each(rows, count) for rows, count in parts])


def _row_of_each(rows: np.ndarray, count: int) -> np.ndarray:
    return np.broadcast_to(rows, (count, rows.shape[1]))


def _optional(given: Sequence[tuple[np.ndarray | None, int]], initial: np.ndarray) -> np.ndarray:
    """Return the values of an attribute that not all vertices have, for so many vertices of each draw."""
    rows = [np.broadcast_to(initial, (count, *initial.shape)) if own is None else own for own, count in given]
    return read_only(np.concatenate(rows, dtype=REAL))


def _joined(arrays: Iterable[np.ndarray], nothing: np.ndarray) -> np.ndarray:
    parts = list(arrays)
    if not parts:
        return nothing
    if len(parts) == 1:
        flags = parts[0].flags
        return parts[0] if flags.c_contiguous and not flags.writeable else read_only(np.ascontiguousarray(parts[0]))
    joined = scratch((sum(map(len, parts)), *parts[0].shape[1:]), parts[0].dtype)
    return read_only(np.concatenate(parts, out=joined))
