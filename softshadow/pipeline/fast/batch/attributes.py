"""The attributes of all draws of a run as arrays; equals `geometry.geometry.process_geometry`, see fast/test_batch.py.

An attribute is an array, or constant in each draw: that is the same for all draws of a run (`batch.run.Arrays`).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from softshadow.jit import read_only
from softshadow.pipeline.alike_draws import AlikeDraws, parts_of, vertex_counts
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.fast.batch.run import Run
from softshadow.pipeline.memory.scratch import scratch
from softshadow.state import BLACK

REAL = np.dtype(np.float32)
NO_ROWS, NO_INDICES, NO_COORDINATES, NO_TEXCOORDS = map(
    read_only, (np.empty((0, 4), REAL), np.empty(0, np.int32), np.empty(0, REAL), np.empty((0, 0, 4), REAL))
)
NO_SECONDARY, NO_FOG_COORDINATE = np.array(BLACK, REAL), np.zeros((), REAL)


def positions_of(draws: Sequence[Draw]) -> np.ndarray:
    """Return the positions (V, 4) of all draws."""
    arrays: list[np.ndarray] = []
    for part in parts_of(draws):
        if isinstance(part, AlikeDraws):
            arrays.append(part.vertices.positions)
        else:
            arrays += [draw.vertices.position for draw in part]
    return _joined(arrays, NO_ROWS)


def colors_of(draws: Sequence[Draw], is_array: bool) -> np.ndarray:
    """Return the colours (V, 4) of all draws; no rows if they are constants."""
    return _joined([rows for rows, _ in _colors(draws)], NO_ROWS) if is_array else NO_ROWS


def normals_of(draws: Sequence[Draw], is_array: bool) -> np.ndarray:
    """Return the normals (V, 3) of all draws; no rows if they are constants."""
    return _joined([rows for rows, _ in _normals(draws)], NO_ROWS) if is_array else NO_ROWS


def constant_colors(draws: Sequence[Draw]) -> np.ndarray:
    """Return the constant colours (D, 4), or one row if all draws have the same."""
    return _constants(list(_colors(draws)))


def constant_normals(draws: Sequence[Draw]) -> np.ndarray:
    """Return the constant normals (D, 3), or one row if all draws have the same."""
    return _constants(list(_normals(draws)))


Rows = tuple[np.ndarray, int]  # of some draws: see `pipeline.alike_draws.Attribute`; and how many draws these are


def _colors(draws: Sequence[Draw]) -> Iterator[Rows]:
    for part in parts_of(draws):
        if isinstance(part, AlikeDraws):
            yield part.vertices.colors.rows, len(part)
        else:
            yield from [(draw.vertices.color, 1) for draw in part]


def _normals(draws: Sequence[Draw]) -> Iterator[Rows]:
    for part in parts_of(draws):
        if isinstance(part, AlikeDraws):
            yield part.vertices.normals.rows, len(part)
        else:
            yield from [(draw.vertices.normal, 1) for draw in part]


def _constants(parts: Sequence[Rows]) -> np.ndarray:
    """Return a row for each draw, or one row if all draws have the same."""
    (first, count), *others = parts
    if not others:
        return first if count > 1 else first[:1]
    if all(rows is first for rows, _ in others):
        return first[:1]
    return np.concatenate([np.broadcast_to(rows[:count], (count, rows.shape[1])) for rows, count in parts])


def texcoords_of(run: Run, draws: Sequence[Draw]) -> np.ndarray:
    """Return the arrays of coordinates (U, V, 4); those of a unit without one are not set."""
    if not run.units:
        return NO_TEXCOORDS
    if len(run.units) == 1 and run.arrays.texcoords[0]:
        return _joined(_texcoords(draws, run.units[0].index), NO_ROWS)[np.newaxis]
    texcoords = np.empty((len(run.units), sum(vertex_counts(draws)), 4), REAL)
    for n, unit in enumerate(run.units):
        if run.arrays.texcoords[n]:
            np.concatenate(_texcoords(draws, unit.index), out=texcoords[n])
    return read_only(texcoords)


def _texcoords(draws: Sequence[Draw], unit: int) -> list[np.ndarray]:
    arrays: list[np.ndarray] = []
    for part in parts_of(draws):
        if isinstance(part, AlikeDraws):
            arrays.append(part.vertices.units[unit])
        else:
            arrays += [draw.vertices.texcoords[unit] for draw in part]
    return arrays


def constant_texcoords(draws: Sequence[Draw], unit: int) -> np.ndarray:
    """Return the constant coordinates (D, 4) of a unit."""
    rows: list[np.ndarray] = []
    for part in parts_of(draws):
        if isinstance(part, AlikeDraws):
            rows += [part.vertices.texcoords.rows(1)[unit][0]] * len(part)
        else:
            rows += [draw.vertices.texcoords[unit][0] for draw in part]
    return np.array(rows)


def indices_of(draws: Sequence[Draw]) -> np.ndarray:
    """Return the indices of all draws that have some."""
    lists = [part for part in parts_of(draws) if not isinstance(part, AlikeDraws)]
    return _joined([draw.indices for part in lists for draw in part if draw.indices is not None], NO_INDICES)


def secondaries_of(draws: Sequence[Draw]) -> np.ndarray:
    """Return the secondary colours (V, 4) of all draws."""
    return _optional([(draw.vertices.secondary, len(draw.vertices.position)) for draw in draws], NO_SECONDARY)


def fog_coordinates_of(draws: Sequence[Draw]) -> np.ndarray:
    """Return the fog coordinates (V,) of all draws."""
    given = [(draw.vertices.fog_coordinates, len(draw.vertices.position)) for draw in draws]
    return _optional(given, NO_FOG_COORDINATE)


def _optional(given: Sequence[tuple[np.ndarray | None, int]], initial: np.ndarray) -> np.ndarray:
    """Return the values of an attribute that not all vertices have, for so many vertices of each draw."""
    rows = [np.broadcast_to(initial, (count, *initial.shape)) if own is None else own for own, count in given]
    return read_only(np.concatenate(rows, dtype=REAL))


def _joined(parts: list[np.ndarray], nothing: np.ndarray) -> np.ndarray:
    if not parts:
        return nothing
    if len(parts) == 1:
        flags = parts[0].flags
        return parts[0] if flags.c_contiguous and not flags.writeable else read_only(np.ascontiguousarray(parts[0]))
    joined = scratch((sum(map(len, parts)), *parts[0].shape[1:]), parts[0].dtype)
    return read_only(np.concatenate(parts, out=joined))
