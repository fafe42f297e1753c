"""Scratch arrays that live as long as a draw, in memory that earlier draws have used.

The pages of a large new array come from the operating system one by one, when they are first written: some 2 us for
4 KB, more than most kernels take for what they write there.
"""

import math
import sys
import threading
from collections import deque

import numpy as np

SMALLEST = 1 << 16  # bytes; below, the allocator reuses memory by itself
LARGEST_NUMBER = 16  # bytes of any dtype here
LINE = 128  # bytes; two cache lines, which processors fetch together
POOLED = 128 << 20  # bytes in the pool of each thread that draws
_unused = deque([np.empty(0, np.uint8)])
UNUSED_REFERENCES = sys.getrefcount(_unused[0])  # to a block that is not in use: the deque, and this call


class _Blocks(threading.local):
    """The memory blocks of one thread by size, a power of two."""

    def __init__(self) -> None:
        self.of_size: dict[int, deque[np.ndarray]] = {}


_thread_blocks = _Blocks()


def scratch(shape: int | tuple[int, ...], dtype: np.typing.DTypeLike) -> np.ndarray:
    """Return an uninitialised array, like ``np.empty``, if possible in pooled memory.

    A block is reused once its last reference is gone. Blocks that are found in use go to the end: caches use some for
    long.
    """
    numbers = math.prod(shape) if isinstance(shape, tuple) else shape
    if numbers * LARGEST_NUMBER < SMALLEST:
        return np.empty(shape, dtype)
    kind = np.dtype(dtype)
    size = int(numbers) * kind.itemsize
    if not SMALLEST <= size <= POOLED // 2:
        return np.empty(shape, kind)
    whole = 1 << (size - 1).bit_length()  # pages that are never written take no memory
    of_size = _thread_blocks.of_size
    blocks = of_size.get(whole)
    if blocks is None:
        blocks = of_size[whole] = deque()
    for _ in range(len(blocks)):
        if sys.getrefcount(blocks[0]) == UNUSED_REFERENCES:  # no variable for it: that would be one more reference
            return np.ndarray(shape, kind, blocks[0])
        blocks.rotate(-1)
    _make_room(whole)
    blocks.appendleft(np.empty(whole, np.uint8))
    return np.ndarray(shape, kind, blocks[0])


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


def _make_room(size: int) -> None:
    """Empty the pool if one more block does not fit; blocks in use live until their last reference is gone."""
    of_size = _thread_blocks.of_size
    if size + sum(each * len(blocks) for each, blocks in of_size.items()) > POOLED:
        for blocks in of_size.values():
            blocks.clear()
