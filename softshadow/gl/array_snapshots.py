"""Snapshots of vertex arrays: rows as they are drawn, which cannot change after they are recorded.

Memory that nobody can write to is recorded without a copy. Other arrays are copied and converted once; at each draw,
the rows that it reads are compared with the copy, and equal rows are not copied again.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow.context import Context
from softshadow.context.arrays import (
    COLOR,
    EDGE,
    FOG_COORDINATE,
    NORMAL,
    POSITION,
    SECONDARY,
    ArrayLayout,
    RowSnapshot,
    VertexArray,
)
from softshadow.gl.constant_attributes import repeat_row
from softshadow.gl.vertex_format import REST
from softshadow.pipeline.memory.comparison import same_memory

LARGEST_FRACTION = (1 << 23) - 1  # llvmpipe fetches the upper 23 bits of an unsigned int
SMALL = 4096  # bytes: up to here, `tobytes` and a comparison of bytes are faster than a call of memcmp
CHUNK = 1 << 16  # rows that are compared at a time if they are not contiguous
WIDTHS = {NORMAL: 3, FOG_COORDINATE: 1}  # numbers of a vertex, where they are not 4
LARGEST_PART = 4  # a changed array is copied whole if a draw reads a fourth of it or more
ALWAYS_WHOLE = 1 << 16  # bytes: up to here, a new array is copied whole
MOST_SLICES = 4096  # of one snapshot
ENDLESS = 1 << 40  # rows of an array that has none of its own


# -- arrays ------------------------------------------------------------------------------------------------------------
def vertex_array(slot: int, rows: np.ndarray, layout: ArrayLayout, owner: Any) -> VertexArray:
    """Return the user's array of an attribute; `rows` keeps its memory alive, so its address stays valid."""
    root = owner_of(rows) if is_immutable(rows) else None
    if not rows.flags.c_contiguous or not rows.size:
        return VertexArray(slot, rows, layout, owner, root is not None, root)
    return VertexArray(slot, rows, layout, owner, root is not None, root, rows.ctypes.data, rows.strides[0])


def is_immutable(array: np.ndarray) -> bool:
    """Return whether nobody can write to the memory of an array; False if its owner is unknown."""
    owner = owner_of(array)
    return not owner.flags.writeable and (owner.base is None or isinstance(owner.base, bytes))


def owner_of(rows: np.ndarray) -> np.ndarray:
    """Return the array at the end of the chain of bases, which owns the memory or wraps a foreign buffer."""
    while isinstance(rows.base, np.ndarray):
        rows = rows.base
    return rows


# -- snapshots ---------------------------------------------------------------------------------------------------------
def snapshot_rows(array: VertexArray, first: int, end: int, context: Context) -> RowSnapshot:
    """Return a snapshot that has the rows [first, end) of an array as they are now."""
    if array.root is not None and array.root.flags.writeable:
        array.is_fixed, array.root, array.snapshot = False, None, None
    kept = array.snapshot
    if kept is not None and kept.first <= first and end <= kept.end:
        if array.is_fixed or is_unchanged(array, kept, first, end):
            return kept
        if (end - first) * LARGEST_PART >= kept.end - kept.first:
            first, end = kept.first, kept.end
    elif array.rows.nbytes <= ALWAYS_WHOLE:
        first, end = 0, len(array.rows)
    elif kept is not None:
        first, end = _grown(kept, first, end, len(array.rows))
    array.snapshot = _fixed(array, context) if array.is_fixed else _copied(array, first, end, context)
    return array.snapshot


def is_current(array: VertexArray, kept: RowSnapshot, first: int, end: int) -> bool:
    """Return whether a snapshot that has the rows [first, end) is the last one of an array, and they have its bits."""
    if array.snapshot is not kept or (array.root is not None and array.root.flags.writeable):
        return False
    return array.is_fixed or is_unchanged(array, kept, first, end)


def origins(first: int, end: int, context: Context) -> RowSnapshot:
    """Return the positions of vertices [first, end) that have none in an array."""
    rows = np.zeros((end - first, 4), context.real)
    rows[:, 3] = 1
    rows.setflags(write=False)
    return RowSnapshot(POSITION, first, end, rows)


def unset_array(slot: int, size: int) -> VertexArray:
    """Return the array of an attribute that is enabled, but has no pointer: its numbers are 0, as on Mesa.

    GL leaves open what is read; other drivers may end the process.
    """
    return VertexArray(slot, repeat_row(np.zeros(size, np.float32), ENDLESS), ArrayLayout(size), None, is_fixed=False)


def _grown(kept: RowSnapshot, first: int, end: int, length: int) -> tuple[int, int]:
    """Return which rows to copy where a draw reads [first, end) and the last snapshot has not all of them.

    Copies at least double, so that many draws of neighbouring parts copy an array only a few times; but a distant part
    is copied alone.
    """
    size, low, high = kept.end - kept.first, min(first, kept.first), max(end, kept.end)
    if high - low > LARGEST_PART * (size + end - first):
        return first, end
    return low, min(max(high, low + 2 * size), length)


def is_unchanged(array: VertexArray, kept: RowSnapshot, first: int, end: int) -> bool:
    """Return whether the rows [first, end) of an array have the bits of a snapshot that has them."""
    if kept.content is not None:
        if first == kept.first and end == kept.end:
            rows = array.rows
            if end - first != len(rows):
                rows = rows[first:end]
            return rows.tobytes() == kept.content
        row_bytes = len(kept.content) // (kept.end - kept.first)
        before = kept.content[(first - kept.first) * row_bytes : (end - kept.first) * row_bytes]
        return array.rows[first:end].tobytes() == before
    assert kept.raw is not None
    if array.row_bytes:
        then = kept.address + (first - kept.first) * array.row_bytes
        return same_memory(array.address + first * array.row_bytes, then, (end - first) * array.row_bytes)
    bits = f"u{array.rows.itemsize}"
    now, past = array.rows.view(bits), kept.raw.view(bits)
    return all(
        np.array_equal(now[row : min(row + CHUNK, end)], past[row - kept.first : min(row + CHUNK, end) - kept.first])
        for row in range(first, end, CHUNK)
    )


def _copied(array: VertexArray, first: int, end: int, context: Context) -> RowSnapshot:
    """Return a snapshot with a copy of rows; an equal one of another array is used again."""
    raw = array.rows[first:end].copy()
    pool, key = context.arrays.snapshots, (array.slot, first, *_fingerprint(raw))
    found: RowSnapshot | None = pool.use(key)
    small = raw.nbytes <= SMALL
    content = raw.tobytes() if small else None
    address = 0 if small or not raw.size else raw.ctypes.data
    if found is not None and (content == found.content if small else same_memory(address, found.address, raw.nbytes)):
        return found
    raw.setflags(write=False)
    rows = _converted(raw, array.slot, context)
    snapshot = RowSnapshot(array.slot, first, end, rows, content, None if small else raw, address)
    pool.put(key, snapshot, snapshot.bytes)
    return snapshot


def _fingerprint(rows: np.ndarray) -> tuple[Any, ...]:
    """Return a key by which equal rows are found: type, shape, and both ends of the content."""
    ends = rows[:4].tobytes() + rows[-4:].tobytes()
    return rows.dtype.char, rows.shape, ends


def _fixed(array: VertexArray, context: Context) -> RowSnapshot:
    """Return a snapshot of all rows of an array that nobody can change: the array itself, or a conversion."""
    rows = array.rows
    owner, address = owner_of(rows), rows.__array_interface__["data"][0]
    key = (array.slot, id(owner), address, rows.strides, rows.shape, rows.dtype.char)
    found = context.arrays.snapshots.use(key)
    if found is None:
        snapshot = RowSnapshot(array.slot, 0, len(rows), _converted(rows, array.slot, context))
        found = snapshot, owner  # no other array can get the id of the owner
        context.arrays.snapshots.put(key, found, snapshot.bytes + owner.nbytes)
    kept: RowSnapshot = found[0]
    return kept


def slice_of(snapshot: RowSnapshot, first: int, end: int) -> np.ndarray:
    """Return the rows [first, end) of an array from its snapshot; the same object for the same rows."""
    if first == snapshot.first and end == snapshot.end:
        return snapshot.rows
    rows = snapshot.slices.get((first, end))
    if rows is None:
        if len(snapshot.slices) >= MOST_SLICES:
            snapshot.slices.clear()
        rows = snapshot.slices[first, end] = snapshot.rows[first - snapshot.first : end - snapshot.first]
    return rows


# -- conversion --------------------------------------------------------------------------------------------------------
def _converted(rows: np.ndarray, slot: int, context: Context) -> np.ndarray:
    """Return rows as read-only (V, width) in the context's precision: a missing fourth component is 1, others 0.

    Edge flags become (V,) bool, fog coordinates (V,).
    """
    if slot == EDGE:
        flags = rows.reshape(-1) == 1  # llvmpipe takes other numbers for GL_FALSE
        flags.setflags(write=False)
        return flags
    width, real = WIDTHS.get(slot, 4), context.real
    fractions = slot in (COLOR, NORMAL, SECONDARY) and rows.dtype.kind in "iu"  # integers represent 0 to 1 or -1 to 1
    memory = rows.flags
    if rows.shape[1] == width and rows.dtype == real and memory.c_contiguous and memory.aligned:
        full = rows
    else:
        full = np.empty((len(rows), width), real)
        if rows.shape[1] < width:
            full[:, rows.shape[1] :] = REST[rows.shape[1] : width]
        if rows.dtype == real:
            full[:, : rows.shape[1]] = rows
        else:
            with np.errstate(over="ignore"):
                full[:, : rows.shape[1]] = _fractions(rows, real) if fractions else rows
    if slot == FOG_COORDINATE:
        full = full.reshape(-1)
    full.setflags(write=False)
    return full


def _fractions(rows: np.ndarray, real: type[np.floating]) -> np.ndarray:
    """Return integers as fractions: times the rounded step; of unsigned ints the upper 23 bits."""
    if rows.dtype == np.uint32:
        return (rows >> np.uint32(9)).astype(real) * real(1 / LARGEST_FRACTION)
    return rows.astype(real) * real(1 / np.iinfo(rows.dtype).max)
