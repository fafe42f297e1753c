"""Strips, fans and lines of glMultiDrawElements: one draw of separate triangles or lines, with the same pixels."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import repeat
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.gl.index_snapshots import IndexSnapshot, snapshot_indices
from softshadow.pipeline.geometry.separate import SEPARABLE, can_be_separated, separate_indices
from softshadow.state import State


def joins_indexed(state: State, mode: int) -> bool:
    """Return whether indexed primitives of a mode under a state have the same pixels as separate ones.

    Not quad strips: how they are cut depends on all vertices between the lowest and the highest index of each.
    """
    return mode in SEPARABLE and mode != gl.GL_QUAD_STRIP and can_be_separated(state, mode)


def joined_indices(
    context: Context, operation: str, mode: int, dtype: np.dtype, counts: Sequence[int], places: Any
) -> IndexSnapshot:
    """Return the indices of primitives of a mode, each with a number of indices and their place, as separate ones.

    The rows of an array as places are read at once.

    Raises
    ------
    ValueError
        At a place there are fewer indices.
    """
    if isinstance(places, np.ndarray) and places.ndim == 2 and {*counts} == {places.shape[1]}:
        rows = places[: len(counts)]
        parts = [snapshot_indices(context, operation, rows.size, dtype, rows)]
    else:
        places = list(places)[: len(counts)]
        parts = [snapshot_indices(context, operation, *each) for each in zip(counts, repeat(dtype), places)]
    pool, key = context.arrays.snapshots, ("joined", mode, counts[0], *map(id, parts))
    known = pool.use(key)
    if known is None:
        joined = _joined(mode, counts, parts)
        known = joined, parts  # which keep their ids
        pool.put(key, known, 2 * joined.indices.nbytes)
    found: IndexSnapshot = known[0]
    return found


def _joined(mode: int, counts: Sequence[int], parts: Sequence[IndexSnapshot]) -> IndexSnapshot:
    lowest, highest = min(part.lowest for part in parts), max(part.highest for part in parts)
    flat = np.concatenate([part.indices + np.int32(part.lowest - lowest) for part in parts])
    indices = flat[separate_indices((mode,) * len(counts), tuple(counts))]
    indices.setflags(write=False)
    return IndexSnapshot(indices, lowest, highest, None, indices, 0)


__all__ = ["joined_indices", "joins_indexed"]
