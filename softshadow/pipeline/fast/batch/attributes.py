"""The attributes of all draws of a run as arrays; equals `geometry.geometry.process_geometry`, see fast/test_batch.py.

An attribute is an array, or constant in each draw: that is the same for all draws of a run (`batch.run.Arrays`).
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain

import numpy as np

from softshadow.jit import read_only
from softshadow.pipeline.alike_draws import AlikeDraws, parts_of, vertices_of
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
        self._draws, self._of_draws = draws, parts_of(draws)
        self._parts = list(map(vertices_of, self._of_draws))

    def positions(self) -> np.ndarray:
        """Return the positions (V, 4)."""
        return _joined([each.positions for each in self._parts], NO_ROWS)

    def colors(self, is_array: bool) -> np.ndarray:
        """Return the colours (V, 4); no rows if they are constants."""
        return _joined([each.colors for each in self._parts], NO_ROWS) if is_array else NO_ROWS

    def normals(self, is_array: bool) -> np.ndarray:
        """Return the normals (V, 3); no rows if they are constants, or nobody reads them."""
        return _joined([each.normals for each in self._parts], NO_ROWS) if is_array else NO_ROWS

    def constant(self, name: str) -> np.ndarray:
        """Return the "color" or "normal" of each draw, where it is constant: (D, k), or (1, k) if all are the same."""
        return self._of_each([each.constant(name) for each in self._parts])

    def modelviews(self) -> np.ndarray:
        """Return the modelview matrix of each draw as a row of 16 numbers; one row if all have the same."""
        rows = []
        for part in self._of_draws:
            if type(part) is AlikeDraws:
                rows.append(part.modelviews.reshape(-1, 16))
            else:
                rows.append(matrices_of([draw.modelview for draw in part]))
        return self._of_each(rows)

    def _of_each(self, rows: list[np.ndarray]) -> np.ndarray:
        """Return a row for each draw; `rows` are those of each part, or one row for all of its draws."""
        if len(rows) == 1:
            return rows[0]
        counts = map(len, self._of_draws)
        of_parts = zip(rows, counts, strict=True)
        return np.concatenate([np.broadcast_to(own, (count, own.shape[1])) for own, count in of_parts])

    def indices(self) -> np.ndarray:
        """Return the indices of all draws that have some."""
        indices: list[np.ndarray] = []
        for part in self._of_draws:
            if type(part) is AlikeDraws:
                indices += part.indices or ()
            else:
                indices += [draw.indices for draw in part if draw.indices is not None]
        return _joined([indices], NO_INDICES)

    def texcoords(self, run: Run) -> np.ndarray:
        """Return the coordinates (U, V, 4) of the units of a run; those of a unit without an array are not set."""
        if not run.units:
            return NO_TEXCOORDS
        if len(run.units) == 1 and run.arrays.texcoords[0]:
            return _joined([each.texcoords(run.units[0].index) for each in self._parts], NO_ROWS)[np.newaxis]
        arrays = {
            n: [each.texcoords(unit.index) for each in self._parts]
            for n, unit in enumerate(run.units)
            if run.arrays.texcoords[n]
        }
        texcoords = np.empty((len(run.units), sum([sum(each.counts) for each in self._parts]), 4), REAL)
        for n, rows in arrays.items():
            np.concatenate(list(chain.from_iterable(rows)), out=texcoords[n])
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


def matrices_of(matrices: Sequence[np.ndarray]) -> np.ndarray:
    """Return matrices as rows of 16 numbers; one row if all draws have the same."""
    if len(set(map(id, matrices))) == 1:
        return matrices[0].reshape(1, 16)
    return np.concatenate(matrices).reshape(-1, 16)


def _optional(given: Sequence[tuple[np.ndarray | None, int]], initial: np.ndarray) -> np.ndarray:
    """Return the values of an attribute that not all vertices have, for so many vertices of each draw."""
    rows = [np.broadcast_to(initial, (count, *initial.shape)) if own is None else own for own, count in given]
    return read_only(np.concatenate(rows, dtype=REAL))


def _joined(lists: Sequence[list[np.ndarray]], nothing: np.ndarray) -> np.ndarray:
    """Return all arrays of several lists as one; `nothing` if there are none."""
    parts = lists[0] if len(lists) == 1 else list(chain.from_iterable(lists))
    if not parts:
        return nothing
    if len(parts) == 1:
        flags = parts[0].flags
        return parts[0] if flags.c_contiguous and not flags.writeable else read_only(np.ascontiguousarray(parts[0]))
    joined = scratch((sum(map(len, parts)), *parts[0].shape[1:]), parts[0].dtype)
    return read_only(np.concatenate(parts, out=joined))
