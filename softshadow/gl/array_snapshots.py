"""Snapshots of drawn arrays: indices and vertices that cannot change after they are recorded.

Immutable arrays are recorded without a copy. Others are copied; arrays that need a conversion are converted once.
"""

from __future__ import annotations

import hashlib
from typing import Any

import numpy as np

from softshadow.context import Context
from softshadow.gl.buffers import content_from, offset_of
from softshadow.gl.vertex_format import REST

LARGEST_FRACTION = (1 << 23) - 1  # llvmpipe fetches the upper 23 bits of an unsigned int


def snapshot_indices(context: Context, operation: str, count: int, dtype: np.dtype, indices: Any) -> np.ndarray:
    """Return immutable int32 indices: the caller's array itself if it is immutable and 32-bit, else a copy.

    Raises
    ------
    ValueError
        There are fewer than `count`.
    """
    if context.arrays.element_buffer:
        indices = content_from(context, context.arrays.element_buffer, offset_of(indices), dtype)
    elif isinstance(indices, bytes | bytearray | memoryview):
        indices = np.frombuffer(indices, dtype)
    numbers = np.ravel(indices)[:count]
    if len(numbers) < count:
        raise ValueError(f"{operation}(count={count}): got only {len(numbers)} indices")
    if numbers.dtype in (np.int32, np.uint32) and _is_immutable(numbers):
        return numbers.view(np.int32)
    copy = np.array(numbers, np.int32)
    copy.setflags(write=False)
    return copy


def index_range(indices: np.ndarray) -> tuple[int, int]:
    """Return the smallest and the largest index; 0 and -1 without indices.

    Every draw computes them anew: kernels do not check bounds, and the array's owner may have made it writeable.
    """
    return (int(indices.min()), int(indices.max())) if len(indices) else (0, -1)


def snapshot_rows(rows: np.ndarray, width: int, context: Context, normalized: bool) -> np.ndarray:
    """Return rows as read-only (V, width) in the context's precision; the same contents are converted only once."""
    if not _is_immutable(rows):
        content: Any = hashlib.blake2b(np.ascontiguousarray(rows).data, digest_size=16).digest()
    elif rows.shape[1] == width and rows.dtype == context.real and rows.flags.c_contiguous:
        return rows
    else:
        content = _memory_key(rows)
    key = (content, rows.shape, rows.dtype, width, normalized)
    return context.arrays.converted.get(key, _owner(rows), lambda: _converted(rows, width, context, normalized))


def repeat_row(row: np.ndarray, count: int) -> np.ndarray:
    """Return a read-only view of `count` equal rows: faster than `np.broadcast_to`, and each draw needs ten."""
    rows = np.ndarray((count, len(row)), row.dtype, row, strides=(0, row.itemsize))
    rows.flags.writeable = False
    return rows


def _memory_key(array: np.ndarray) -> tuple[Any, ...]:
    """Return a key that identifies the memory of a read-only array for as long as its owner lives."""
    return (id(_owner(array)), array.__array_interface__["data"][0], array.strides)


def _is_immutable(array: np.ndarray) -> bool:
    """Return whether nobody can write to the memory of an array; False if its owner is unknown."""
    owner = _owner(array)
    return not owner.flags.writeable and (owner.base is None or isinstance(owner.base, bytes))


def _owner(rows: np.ndarray) -> np.ndarray:
    """Return the array at the end of the chain of bases, which owns the memory or wraps a foreign buffer."""
    while isinstance(rows.base, np.ndarray):
        rows = rows.base
    return rows


def _converted(rows: np.ndarray, width: int, context: Context, normalized: bool) -> np.ndarray:
    """Return rows with `width` components: a missing fourth is 1, others 0."""
    full = np.empty((len(rows), width), context.real)
    full[:] = REST[:width]
    with np.errstate(over="ignore"):
        fractions = rows.dtype.kind in "iu" and normalized
        full[:, : rows.shape[1]] = _fractions(rows, context.real) if fractions else rows
    full.setflags(write=False)
    return full


def _fractions(rows: np.ndarray, real: type[np.floating]) -> np.ndarray:
    """Return integers as fractions: times the rounded step; of unsigned ints the upper 23 bits."""
    if rows.dtype == np.uint32:
        return (rows >> np.uint32(9)).astype(real) * real(1 / LARGEST_FRACTION)
    return rows.astype(real) * real(1 / np.iinfo(rows.dtype).max)
