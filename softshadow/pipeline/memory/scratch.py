"""Scratch arrays that live as long as a draw, in memory that earlier draws have used.

The pages of a large new array come from the operating system one by one, when they are first written: some 2 us for
4 KB, more than most kernels take for what they write there.
"""

import math
import threading
import weakref
from typing import Any

import numpy as np

SMALLEST = 1 << 16  # bytes; below, the allocator reuses memory by itself
LARGEST_NUMBER = 16  # bytes of any dtype here
LINE = 128  # bytes; two cache lines, which processors fetch together
POOLED = 128 << 20  # bytes in the pool of each thread that draws


class _Block(np.ndarray):
    """Bytes of the pool.

    The base of a view of an array in it is that array, not the block: NumPy passes over bases of its own type only.
    """


class _Pool(threading.local):
    """The blocks of one thread that are not in use, by size, a power of two; `n_bytes` are those of all its blocks."""

    def __init__(self) -> None:
        self.unused: dict[int, list[_Block]] = {}
        self.n_bytes = 0


_pool = _Pool()
# for each array in use, what calls `_release` when it and its views are gone; its block, and the list that this enters
_in_use: dict[int, tuple[weakref.ref[np.ndarray], _Block, list[_Block]]] = {}


def scratch(shape: int | tuple[int, ...], dtype: np.typing.DTypeLike) -> np.ndarray:
    """Return an uninitialised array, like ``np.empty``, if possible in pooled memory.

    A block is used again once the array in it and the views of that are gone. Caches use some for long.
    """
    numbers = math.prod(shape) if isinstance(shape, tuple) else shape
    if numbers * LARGEST_NUMBER < SMALLEST:
        return np.empty(shape, dtype)
    kind = np.dtype(dtype)
    size = int(numbers) * kind.itemsize
    if not SMALLEST <= size <= POOLED // 2:
        return np.empty(shape, kind)
    whole = 1 << (size - 1).bit_length()  # pages that are never written take no memory
    unused = _pool.unused.get(whole) or _with_new_block(whole)
    block = unused.pop()
    array: np.ndarray = np.ndarray(shape, kind, block)
    reference = weakref.ref(array, _release)
    _in_use[id(reference)] = reference, block, unused
    return array


def _release(reference: Any) -> None:
    _, block, unused = _in_use.pop(id(reference))
    unused.append(block)


def _with_new_block(size: int) -> list[_Block]:
    """Return the unused blocks of a size, after one is added; all others leave the pool if they leave no room for it.

    Those in use live as long as their arrays.
    """
    if _pool.n_bytes + size > POOLED:
        _pool.unused, _pool.n_bytes = {}, 0
    _pool.n_bytes += size
    unused = _pool.unused.setdefault(size, [])
    unused.append(_Block(size, np.uint8))
    return unused


def apart(shape: int | tuple[int, ...], dtype: np.typing.DTypeLike) -> np.ndarray:
    """Return an uninitialised small array, like ``np.empty``, in cache lines that hold nothing else.

    For what a kernel writes again and again: if another thread uses the same cache line, each write waits for its core.
    Small arrays lie side by side, and NumPy gives a thread the memory of those that another one has released.
    """
    kind, numbers = np.dtype(dtype), math.prod(shape) if isinstance(shape, tuple) else shape
    return np.ndarray(shape, kind, np.empty(numbers * kind.itemsize + 2 * LINE, np.uint8), LINE)


class _RowColumns(threading.local):
    """What `row_columns` returns, for each thread."""

    def __init__(self) -> None:
        self.arrays = apart((2, 1), np.int32)


_row_columns = _RowColumns()


def row_columns(end_row: int) -> np.ndarray:
    """Return scratch (2, end_row or more) int32 for a first and an end column of each row.

    All calls of a thread return the same memory, for one kernel after the other.
    """
    if _row_columns.arrays.shape[1] < end_row:
        _row_columns.arrays = apart((2, end_row), np.int32)
    return _row_columns.arrays
