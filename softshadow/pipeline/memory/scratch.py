"""Memory for arrays that live as long as a draw.

The pages of a large new array come from the operating system one by one, when they are first written: some 2 us for
4 KB, more than most kernels take for what they write there. So the memory of earlier draws is used again.
"""

import math
import sys
import threading
from typing import SupportsIndex

import numpy as np

SMALLEST = 1 << 16  # bytes; below, the allocator keeps memory by itself
KEPT = 128 << 20  # bytes; how much is kept for each thread that draws
_nobodys = [np.empty(0, np.uint8)]
UNUSED = sys.getrefcount(_nobodys[0])  # references to a block that nobody uses: from a list, and the call that counts


class _Blocks(threading.local):
    """The blocks of memory of this thread, by their size, a power of two."""

    def __init__(self) -> None:
        self.of_size: dict[int, list[np.ndarray]] = {}


_own = _Blocks()


def scratch(shape: SupportsIndex | tuple[SupportsIndex, ...], dtype: np.typing.DTypeLike) -> np.ndarray:
    """Return an array like that of ``np.empty``, if possible of memory that the process has used before.

    Nobody has to give it back: an array refers to its memory, which is lent again when nothing refers to it any more.
    """
    kind = np.dtype(dtype)
    size = math.prod(map(int, shape if isinstance(shape, tuple) else (shape,))) * kind.itemsize
    if not SMALLEST <= size <= KEPT // 2:
        return np.empty(shape, kind)
    whole = 1 << (size - 1).bit_length()  # pages that nobody writes to are not there
    blocks = _own.of_size.setdefault(whole, [])
    for n in range(len(blocks)):  # without a name for the block, which would be one more reference
        if sys.getrefcount(blocks[n]) == UNUSED:
            return blocks[n][:size].view(kind).reshape(shape)
    _make_room(whole)
    blocks.append(np.empty(whole, np.uint8))
    return blocks[-1][:size].view(kind).reshape(shape)


def _make_room(size: int) -> None:
    """Forget all blocks if one more would be too many: those that are in use live on until they are not."""
    of_size = _own.of_size
    if size + sum(each * len(blocks) for each, blocks in of_size.items()) > KEPT:
        for blocks in of_size.values():
            blocks.clear()
