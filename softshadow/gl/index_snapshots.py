"""Snapshots of index arrays: int32 copies that nobody can change, with the range of their indices.

Kernels do not check bounds, so the range belongs to the copy. At each draw the caller's array is compared with it; an
equal array is neither copied nor searched again.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from softshadow.context import Context
from softshadow.context.arrays import BufferObject, LatestIndices, RowSnapshot, VertexArray
from softshadow.gl.array_snapshots import SMALL, is_immutable, owner_of
from softshadow.gl.buffers import offset_of
from softshadow.pipeline.memory.comparison import same_memory

Rows = tuple[list[RowSnapshot], int, int]  # of each array, positions first, and which: [first, end)
BYTES_BEFORE = 64  # at both ends of the content; arrays with equal ones are compared


@dataclass(eq=False, slots=True)
class IndexSnapshot:
    """The indices of a draw: (N,) int32, read-only, counted from the smallest; 0 and -1 are the range without indices.

    A draw takes the vertices `lowest` to `highest` only, so that others of the same arrays are not processed. `content`
    is the source of a small array, `raw` that of a larger one, at `address`. `rows` are those of the latest draw, from
    `arrays` that are all in buffer objects: programs draw one mesh in many places.
    """

    indices: np.ndarray
    lowest: int
    highest: int
    content: bytes | None
    raw: np.ndarray
    address: int
    arrays: tuple[VertexArray, ...] = ()
    rows: Rows | None = None

    def keep(self, arrays: tuple[VertexArray, ...], rows: Rows) -> None:
        """Keep the rows of a draw if they are in buffer objects, where changed contents are other arrays."""
        if all(isinstance(array.owner, BufferObject) for array in arrays):
            self.arrays, self.rows = arrays, rows


@dataclass(eq=False, slots=True)
class IndexArray:
    """Indices as the caller has passed them, and their last snapshot; `owner` is the array, or the one behind a view.

    `flat` are the first numbers at `address`, or None if nobody can change them.
    """

    owner: Any
    dtype: Any
    flat: np.ndarray | None
    address: int
    snapshot: IndexSnapshot


def snapshot_indices(context: Context, operation: str, count: int, dtype: np.dtype, indices: Any) -> IndexSnapshot:
    """Return the first `count` indices of the caller's array or, at an offset, of the bound buffer object.

    Raises
    ------
    ValueError
        There are fewer than `count`.
    """
    arrays = context.arrays
    if arrays.element_buffer:
        bound, offset = context.buffers[arrays.element_buffer], offset_of(indices)
        place_in_buffer = offset, count, dtype.char
        stored: IndexSnapshot | None = bound.views.get(place_in_buffer)
        if stored is None:
            make = partial(_taken, context, operation, count, _numbers_at(bound.content, offset, dtype))
            stored = bound.view(place_in_buffer, make)
        return stored
    latest = arrays.latest_indices
    if latest is not None and latest.argument is indices and latest.n_indices == count and latest.dtype is dtype:
        found: IndexArray = latest.found
        if _has_bits(found, indices):
            return found.snapshot
    is_view = isinstance(indices, np.ndarray) and indices.flags.c_contiguous and is_immutable(indices)
    owner = owner_of(indices) if is_view else indices
    place = indices.__array_interface__["data"][0] if is_view else id(indices)  # views of an owner are equal by place
    key = place, is_view, count, dtype.char, indices.dtype.char if is_view else ""
    known: IndexArray | None = arrays.indices.get(key)
    if known is not None and known.owner is owner and _has_bits(known, indices):
        arrays.latest_indices = LatestIndices(indices, count, dtype, known)
        return known.snapshot
    if isinstance(indices, bytes | bytearray | memoryview):
        numbers = np.frombuffer(indices, dtype)[:count]
    else:
        numbers = np.ravel(indices)[:count]
    snapshot = _taken(context, operation, count, numbers)
    if isinstance(indices, np.ndarray) and indices.flags.c_contiguous and numbers.size:
        flat = indices.reshape(-1)[:count]
        entry = IndexArray(owner, indices.dtype, flat, flat.ctypes.data, snapshot)
        arrays.indices.put(key, entry, indices.nbytes + 2 * snapshot.raw.nbytes)
    elif isinstance(indices, bytes):
        entry = IndexArray(indices, None, None, 0, snapshot)
        arrays.indices.put(key, entry, len(indices) + 2 * snapshot.raw.nbytes)
    return snapshot


def _has_bits(known: IndexArray, indices: Any) -> bool:
    """Return whether an array still has the bits of its last snapshot."""
    if known.flat is None:
        return True
    if indices.dtype is not known.dtype:
        return False
    snapshot = known.snapshot
    if snapshot.content is not None:
        return known.flat.tobytes() == snapshot.content
    return same_memory(known.address, snapshot.address, known.flat.nbytes)


def _numbers_at(content: np.ndarray, offset: int, dtype: np.dtype) -> np.ndarray:
    """Return the contents of a buffer object from an offset on, as numbers; an incomplete last one is left out."""
    content = content[offset:]
    return content[: len(content) // dtype.itemsize * dtype.itemsize].view(dtype)


def _taken(context: Context, operation: str, count: int, numbers: np.ndarray) -> IndexSnapshot:
    """Return a snapshot of numbers; an equal one of another array is used again."""
    numbers = numbers[:count]
    if len(numbers) < count:
        raise ValueError(f"{operation}(count={count}): got only {len(numbers)} indices")
    numbers = np.ascontiguousarray(numbers)
    as_bytes = numbers.view(np.uint8) if numbers.size else numbers
    pool = context.arrays.snapshots
    key = "indices", numbers.dtype.char, count, as_bytes[:BYTES_BEFORE].tobytes(), as_bytes[-BYTES_BEFORE:].tobytes()
    content = numbers.tobytes() if numbers.nbytes <= SMALL else None
    found: IndexSnapshot | None = pool.use(key)
    if found is not None and (
        content == found.content
        if content is not None
        else same_memory(numbers.ctypes.data, found.address, numbers.nbytes)
    ):
        return found
    raw = numbers.copy()
    raw.setflags(write=False)
    address = 0 if content is not None else raw.ctypes.data
    if raw.dtype in (np.int32, np.uint32):
        copy = raw.view(np.int32)
    else:
        copy = np.array(raw, np.int32)
        copy.setflags(write=False)
    lowest, highest = (int(copy.min()), int(copy.max())) if count else (0, -1)
    if lowest > 0:
        copy = copy - np.int32(lowest)
        copy.setflags(write=False)
    snapshot = IndexSnapshot(copy, lowest, highest, content, raw, address)
    pool.put(key, snapshot, raw.nbytes + copy.nbytes)
    return snapshot
