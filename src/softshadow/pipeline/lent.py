"""Memory for arrays that live as long as a draw.

The pages of a large new array come from the operating system one by one, when they are first written: some 2 us for
4 KB, more than most kernels take for what they write there. So the memory of earlier draws is used again.
"""

import math
import sys
import threading

import numpy as np

SMALLEST = 1 << 16  # bytes; below, the allocator keeps memory by itself
KEPT = 128 << 20  # bytes; how much is kept for each thread that draws
_nobodys = [np.empty(0, np.uint8)]
UNUSED = sys.getrefcount(_nobodys[0])  # references to a block that nobody uses: from a list, and the call that counts


class _Blocks(threading.local):
    """The blocks of memory of this thread, those used last at the end."""

    def __init__(self) -> None:
        self.blocks: list[np.ndarray] = []


_own = _Blocks()


def lent(shape: int | tuple[int, ...], dtype: np.typing.DTypeLike) -> np.ndarray:
    """Return an array like that of ``np.empty``, if possible of memory that the process has used before.

    Nobody has to give it back: an array refers to its memory, which is lent again when nothing refers to it any more.
    """
    kind = np.dtype(dtype)
    size = math.prod(shape) * kind.itemsize if isinstance(shape, tuple) else shape * kind.itemsize
    if not SMALLEST <= size <= KEPT // 2:
        return np.empty(shape, kind)
    blocks = _own.blocks
    found = -1
    for n in range(len(blocks)):  # without a name for the block, which would be one more reference
        fits = len(blocks[n]) >= size and (found < 0 or len(blocks[n]) <= len(blocks[found]))
        if fits and sys.getrefcount(blocks[n]) == UNUSED:
            found = n
    if found < 0:
        _make_room(size)
        blocks.append(np.empty(size, np.uint8))
    else:
        blocks.append(blocks.pop(found))
    return blocks[-1][:size].view(kind).reshape(shape)


def _make_room(size: int) -> None:
    """Forget blocks until there is room for one more among those that are kept, first what was used longest ago.

    A block that is still in use lives on until its last user is done with it.
    """
    blocks = _own.blocks
    while blocks and sum(map(len, blocks)) + size > KEPT:
        del blocks[0]
