"""What a recording keeps of the arrays that are drawn: indices and vertices that nobody can change any more.

Arrays that are read-only already are kept as they are; others are copied, or converted once for the same content.
"""

from __future__ import annotations

import hashlib
from typing import Any

import numpy as np

from softshadow.context import Context
from softshadow.gl.buffers import content_from, offset_of
from softshadow.gl.vertex_format import REST

LARGEST_FRACTION = (1 << 23) - 1  # llvmpipe fetches as many bits of an unsigned int as float32 has


def owned_indices(context: Context, operation: str, count: int, dtype: np.dtype, indices: Any) -> np.ndarray:
    """Return indices that the caller cannot change, read-only int32: the caller's own where they are that already.

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
        raise ValueError(f"{operation}(count={count}): only {len(numbers)} indices are there")
    if numbers.dtype in (np.int32, np.uint32) and _is_frozen(numbers):
        return numbers.view(np.int32)
    owned = np.array(numbers, np.int32)
    owned.setflags(write=False)
    return owned


def extremes(indices: np.ndarray) -> tuple[int, int]:
    """Return the smallest and the largest index, 0 and -1 where there are none.

    Found for each draw: kernels do not check bounds, and an array's owner could make it writable in between.
    """
    return (int(indices.min()), int(indices.max())) if len(indices) else (0, -1)


def full_rows(rows: np.ndarray, width: int, context: Context, normalized: bool) -> np.ndarray:
    """Return rows as read-only (V, width) of the context's precision; the same content is converted once."""
    if not _is_frozen(rows):
        content: Any = hashlib.blake2b(np.ascontiguousarray(rows).data, digest_size=16).digest()
    elif rows.shape[1] == width and rows.dtype == context.real and rows.flags.c_contiguous:
        return rows
    else:
        content = _identity(rows)
    key = (content, rows.shape, rows.dtype, width, normalized)
    return context.arrays.converted.get(key, _root(rows), lambda: _converted(rows, width, context, normalized))


def spread(row: np.ndarray, count: int) -> np.ndarray:
    """Return `count` times the same row, read-only, without its copies: `np.broadcast_to`, of which draws need ten."""
    made = np.ndarray((count, len(row)), row.dtype, row, strides=(0, row.itemsize))
    made.flags.writeable = False
    return made


def _identity(array: np.ndarray) -> tuple[Any, ...]:
    """Return what tells read-only arrays apart while the memory they lie in is kept."""
    return (id(_root(array)), array.__array_interface__["data"][0], array.strides)


def _is_frozen(array: np.ndarray) -> bool:
    """Return whether the memory of an array is read-only, as far as it is known whose it is."""
    root = _root(array)
    return not root.flags.writeable and (root.base is None or isinstance(root.base, bytes))


def _root(rows: np.ndarray) -> np.ndarray:
    """Return the array that owns the memory, as far as NumPy tells."""
    while isinstance(rows.base, np.ndarray):
        rows = rows.base
    return rows


def _converted(rows: np.ndarray, width: int, context: Context, normalized: bool) -> np.ndarray:
    """Return rows with all their components: a missing fourth is 1, others 0."""
    full = np.empty((len(rows), width), context.real)
    full[:] = REST[:width]
    with np.errstate(over="ignore"):
        fractions = rows.dtype.kind in "iu" and normalized
        full[:, : rows.shape[1]] = _fractions(rows, context.real) if fractions else rows
    full.setflags(write=False)
    return full


def _fractions(rows: np.ndarray, real: type[np.floating]) -> np.ndarray:
    """Return integers as the fractions they stand for: times the rounded step; of unsigned ints the upper 23 bits."""
    if rows.dtype == np.uint32:
        return (rows >> np.uint32(9)).astype(real) * real(1 / LARGEST_FRACTION)
    return rows.astype(real) * real(1 / np.iinfo(rows.dtype).max)
