"""Counts stencil updates, and makes them at the end; equals `raster.fill.fill_rows`, see fast/test_stencil_tiles.py.

Under a state that is `order_independent`, only the number of updates of each pixel counts. Where all fragments of a
triangle in a tile have the same outcome, the updates are not made but counted: those of a whole tile in one number,
those of rows as differences, one more from the first column of a row on, and one less from its end on. So a row takes
two additions, however wide it is: tiles that many narrow triangles cross, the sides of the shadow volume of a fine
mesh, take some 0.6 of the time. At the end, the sums of the differences along a row are the numbers of updates.
"""

from typing import NamedTuple

import numpy as np

from softshadow.jit import kernel, wide_kernel
from softshadow.pipeline.fast.fragment_numbers import LARGEST, UNMASKED_REF, update_of, updated
from softshadow.pipeline.fast.hierarchical_z import (
    COLUMNS,
    COLUMNS_LOG2,
    ROWS,
    ROWS_LOG2,
    columns_of_tile,
    common_op,
    rows_of,
)  # fmt: skip
from softshadow.pipeline.memory.scratch import scratch
from softshadow.pipeline.raster.fragment_ops import INCR_WRAP, KEEP
from softshadow.pipeline.records import Region

FEW = 4  # parts of triangles in a tile that are updated at once: for a few, differences take longer
MOST = (1 << 16) - 1  # triangles whose updates of a pixel can be counted
PITCH = COLUMNS + 16  # differences of a row; a triangle that ends with the tile has one behind the last column


class PendingUpdates(NamedTuple):
    """Numbers of updates in each tile of a region, (rows, columns) of tiles.

    whole : int32, updates of all its pixels; negative for those that subtract
    parts : int32, triangles that update a part of it
    differences : (rows, columns, ROWS * PITCH) uint16, modulo 2**16; not initialised before a tile needs them
    """

    whole: np.ndarray
    parts: np.ndarray
    differences: np.ndarray

    @classmethod
    def none(cls, region: Region) -> "PendingUpdates":
        """Return those of a region in which no update is pending."""
        rows = max(-(-region.end_row >> ROWS_LOG2) - (region.first_row >> ROWS_LOG2), 0)
        columns = max(-(-region.right >> COLUMNS_LOG2), 0)
        whole, parts = np.zeros((2, rows, columns), np.int32)
        return cls(whole, parts, scratch((rows, columns, ROWS * PITCH), np.uint16))


@kernel
def can_count(op, n_triangles):
    """Return whether rows of so many triangles can be counted under the `common_op` of a state, modulo 2**16.

    Sums, which threads may share, can always be.
    """
    return op == INCR_WRAP or n_triangles <= MOST


@kernel
def count_rows(n, n_parts, first, end, tile_row, tile, left, right, lefts, rights, differences):
    """Count `n` updates, 1 or -1, of a triangle's rows [first, end) in the columns [left, right) of a tile.

    `n_parts` is the tile's number of parts with this one, `lefts` and `rights` are the ends of the triangle's rows.
    """
    if n_parts == FEW:
        for k in range(ROWS * PITCH):
            differences[np.uint64(k)] = np.uint16(0)
    more = np.uint16(n & MOST)
    at = ((np.int64(first) - (np.int64(tile_row) << ROWS_LOG2)) * PITCH) - (np.int64(tile) << COLUMNS_LOG2)
    for row in range(np.int64(first), np.int64(end)):
        j = np.uint64(row)
        begin = min(max(np.int64(lefts[j]), np.int64(left)), np.int64(right))
        stop = max(min(np.int64(rights[j]), np.int64(right)), begin)
        i, behind = np.uint64(at + begin), np.uint64(at + stop)
        differences[i] = np.uint16(differences[i] + more)
        differences[behind] = np.uint16(differences[behind] - more)
        at += PITCH


@wide_kernel
def apply_pending_updates(ops, byte_ops, pending, region, stencil):
    """Update the stencil values; the arguments: see `stencil_tiles.fill_in_tiles`."""
    op, ref, largest = common_op(ops), byte_ops[0, UNMASKED_REF], byte_ops[0, LARGEST]
    first_tile_row = region.first_row >> ROWS_LOG2
    for tile_row in range(pending.whole.shape[0]):
        top, bottom = rows_of(first_tile_row + tile_row, region)
        for tile in range(pending.whole.shape[1]):
            n = pending.whole[tile_row, tile]
            left, right = columns_of_tile(tile, region)
            if pending.parts[tile_row, tile] >= FEW:
                differences = pending.differences[tile_row, tile]
                for row in range(top, bottom):
                    values = stencil[row, left:right]
                    at = ((row & (ROWS - 1)) * PITCH) + (left & (COLUMNS - 1))
                    apply_differences(op, ref, largest, n, differences[at:], values)
            elif n != 0 and op != KEEP:
                update = update_of(op, n, ref, largest)
                for row in range(top, bottom):
                    values = stencil[row, left:right]
                    for k in range(np.uint64(right - left)):
                        values[k] = updated(update, values[k], largest)


@kernel
def apply_differences(op, ref, largest, n, differences, values):
    """Update a row of stencil values `n` times, and by the sums of its differences."""
    width, count = np.uint64(values.shape[0]), np.uint16(n & MOST)
    for k in range(width):
        count = np.uint16(count + differences[k])
        differences[k] = count
    if op == INCR_WRAP:
        for k in range(width):
            values[k] = np.uint8(np.uint8(values[k] + np.uint8(differences[k])) & largest)
        return
    for k in range(width):
        after = updated(update_of(op, differences[k], ref, largest), values[k], largest)
        values[k] = after if differences[k] != 0 else values[k]
