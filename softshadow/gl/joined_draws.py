"""Strips, fans and lines of glMultiDraw...: one draw of separate triangles or lines, with the same pixels."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import repeat
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.gl.index_snapshots import IndexSnapshot, snapshot_indices
from softshadow.pipeline.geometry.separate import SEPARABLE, can_be_separated, separate_indices
from softshadow.state import State


def joins(state: State, mode: int) -> bool:
    """Return whether primitives of a mode from arrays have the same pixels, under a state, as separate ones.

    Not quad strips: how one is cut depends on all vertices between its lowest and its highest index. Not polygons, as
    it is known by the vertices of a triangle which one it belongs to, and those of arrays may be shared.
    """
    return mode in SEPARABLE and mode not in (gl.GL_QUAD_STRIP, gl.GL_POLYGON) and can_be_separated(state, mode)


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
    key = "indices", mode, tuple(counts[:1]), *map(id, parts)

    def join() -> IndexSnapshot:
        lowest, highest = min(part.lowest for part in parts), max(part.highest for part in parts)
        rows = [part.indices + np.int32(part.lowest - lowest) for part in parts]
        return _separate(mode, counts, rows, lowest, highest)

    return _kept(context, key, parts, join)


def joined_ranges(context: Context, mode: int, firsts: Sequence[int], counts: Sequence[int]) -> IndexSnapshot:
    """Return the indices of primitives of a mode, each of a number of vertices from the first on, as separate ones."""

    def join() -> IndexSnapshot:
        lowest, highest = min(firsts), max(map(sum, zip(firsts, counts, strict=True))) - 1
        each = zip(firsts, counts, strict=True)
        rows = [np.arange(first - lowest, first - lowest + count, dtype=np.int32) for first, count in each]
        return _separate(mode, counts, rows, lowest, highest)

    return _kept(context, ("ranges", mode, tuple(firsts), tuple(counts)), (), join)


def _kept(context: Context, key: tuple[Any, ...], parts: Any, join: Callable[[], IndexSnapshot]) -> IndexSnapshot:
    """Return what was joined before, if it is kept, together with the parts whose ids are in the key."""
    pool, key = context.arrays.snapshots, ("joined", *key)
    known = pool.use(key)
    if known is None:
        known = join(), parts
        pool.put(key, known, 2 * known[0].indices.nbytes)
    found: IndexSnapshot = known[0]
    return found


def _separate(mode: int, counts: Sequence[int], rows: Sequence[np.ndarray], lowest: int, highest: int) -> IndexSnapshot:
    indices = np.concatenate(rows)[separate_indices((mode,) * len(counts), tuple(counts))]
    indices.setflags(write=False)
    return IndexSnapshot(indices, lowest, highest, None, indices, 0)


__all__ = ["joined_indices", "joined_ranges", "joins"]
