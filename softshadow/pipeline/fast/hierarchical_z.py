"""Decides whole tiles of stencil-only draws; equals `raster.fill.fill_rows`, see fast/test_stencil_tiles.py.

The sides of shadow volumes are large and many, and change only the stencil buffer. Where the largest depth of a
triangle in a tile is less than the smallest stored there, all its fragments pass GL_LESS: nothing is read or compared,
and where the triangle covers the whole tile, one counter is increased in place of 1024 stencil values. The depth of a
triangle is monotone along rows and columns, rounding included, so its bounds are its values at two corners of the tile,
from `depth_at` like every fragment's: exact, without a margin.

The counters are applied after the last triangle, which changes the order of the updates: only draws whose stencil
updates are order-independent are filled in tiles (`order_independent`).
"""

from typing import NamedTuple

import numpy as np

from softshadow.jit import kernel
from softshadow.pipeline.raster.depth import depth_at, depth_units
from softshadow.pipeline.raster.fragment_ops import (
    ALWAYS,
    CLEAR,
    DECR,
    DECR_WRAP,
    GEQUAL,
    GREATER,
    INCR,
    INCR_WRAP,
    KEEP,
    LEQUAL,
    LESS,
    NEVER,
    NOTEQUAL,
    REPLACE,
    FragmentOps,
    compare,
)  # fmt: skip

COLUMNS_LOG2 = 6  # of a tile, 64
COLUMNS = 1 << COLUMNS_LOG2
ROWS_LOG2 = 4  # of a tile, 16
ROWS = 1 << ROWS_LOG2

FAIL, PASS, MIXED, NOTHING = range(4)
WRAPPING = {INCR_WRAP, DECR_WRAP}


class Tiles(NamedTuple):
    """The tiles of a draw's region, each array (rows, columns) of tiles.

    low, high: bounds of the stored depth, NaN where they are not computed yet; pending: how many stencil updates are
    still to be applied.
    """

    low: np.ndarray
    high: np.ndarray
    pending: np.ndarray


def order_independent(front: FragmentOps, back: FragmentOps) -> bool:
    """Return whether the stencil updates are order-independent, so that a draw may be filled in tiles.

    Only the stencil buffer is written, every fragment updates it, and all updates are the same operation, or add and
    subtract modulo 2**bits.
    """
    for ops in (front, back):
        if ops.alpha_test or ops.depth_write or not ops.stencil_test or ops.stencil_func != ALWAYS:
            return False
        if ops.write_mask != ops.stencil_largest:
            return False
    used = {op for ops in (front, back) for op in (ops.zfail, ops.zpass)} - {KEEP}
    if REPLACE in used and front.ref != back.ref:
        return False
    return len(used) <= 1 or used <= WRAPPING


@kernel
def tiles_of(region, real):
    """Return the tiles of a region: rows of tiles from its first row on, columns of tiles from column 0 on."""
    rows, columns = ((region.end_row - region.first_row - 1) >> ROWS_LOG2) + 1, ((region.right - 1) >> COLUMNS_LOG2) + 1
    low, high = np.full((rows, columns), np.nan, real), np.full((rows, columns), np.nan, real)
    return Tiles(low, high, np.zeros((rows, columns), np.int32))


@kernel
def rows_of(tile_row, region):
    """Return first and end row of a row of tiles."""
    top = region.first_row + (tile_row << ROWS_LOG2)
    return top, min(top + ROWS, region.end_row)


@kernel
def columns_of_tile(tile, region):
    """Return first and end column of a column of tiles."""
    return max(tile << COLUMNS_LOG2, region.left), min((tile + 1) << COLUMNS_LOG2, region.right)


@kernel
def decide(func, low, high, stored_low, stored_high):
    """Return PASS if all depths from `low` to `high` pass against all stored ones, FAIL if all fail, else MIXED."""
    if func == NEVER or func == ALWAYS:
        return PASS if func == ALWAYS else FAIL
    if func == LESS or func == LEQUAL:
        every, some = compare(func, high, stored_low), compare(func, low, stored_high)
    elif func == GREATER or func == GEQUAL:
        every, some = compare(func, low, stored_high), compare(func, high, stored_low)
    else:
        equal = low == high and stored_low == stored_high and low == stored_low
        apart = high < stored_low or low > stored_high
        every, some = (apart, not equal) if func == NOTEQUAL else (equal, not apart)
    return PASS if every else MIXED if some else FAIL


@kernel
def find_bounds(depth, first, end, left, right, scratch):
    """Return the smallest and largest depth of a tile; minus and plus infinity where a depth is infinite or NaN.

    First for each column (in `scratch`, (3, 64)), then of these: the loops over columns can be vectorised, a minimum of
    floats in one variable cannot.
    """
    low, high, odd = scratch[0], scratch[1], scratch[2]
    width = np.uint64(right - left)
    for k in range(width):
        low[k], high[k], odd[k] = np.inf, -np.inf, 0
    for row in range(first, end):
        stored = depth[row, left:right]
        for k in range(width):
            z = stored[k]
            low[k] = z if z < low[k] else low[k]
            high[k] = z if z > high[k] else high[k]
            odd[k] += z - z  # 0 for numbers
    lowest, highest = low[0], high[0]
    for k in range(width):
        if odd[k] != 0:
            return -np.inf, np.inf
        lowest, highest = min(lowest, low[k]), max(highest, high[k])
    return lowest, highest


@kernel
def outcome(ops, depth_range, z0, dz, dz_row, offset, left, right, first, end, stored_low, stored_high):
    """Return the depth test's result for a triangle's fragments from column `left` to `right`, row `first` to `end`.

    PASS or FAIL: all fragments; MIXED: it differs or is not known; NOTHING: no stencil value will change. The depth
    plane and all bounds (both ends included) are numbers in the precision of depth: passing an array would cost
    reference counting.
    """
    result = PASS
    if ops.depth_test:
        column_low, column_high = (left, right) if dz >= 0 else (right, left)
        row_low, row_high = (first, end) if dz_row >= 0 else (end, first)
        low = depth_at(z0, dz, dz_row, offset, column_low, row_low)
        high = depth_at(z0, dz, dz_row, offset, column_high, row_high)
        if not np.isfinite(low) or not np.isfinite(high):
            return MIXED  # planes that overflow, or are NaN, are not monotone
        low = depth_units(low, depth_range, ops.depth_largest)
        high = depth_units(high, depth_range, ops.depth_largest)
        result = decide(ops.depth_func, low, high, stored_low, stored_high)
    if result == PASS:
        return NOTHING if ops.zpass == KEEP else PASS
    if result == FAIL:
        return NOTHING if ops.zfail == KEEP else FAIL
    return MIXED


@kernel
def common_op(ops):
    """Return the one operation of an order-independent state; GL_INCR_WRAP for steps in both directions."""
    op = ops.zfail if ops.zpass == KEEP else ops.zpass
    return INCR_WRAP if op == DECR_WRAP else op


@kernel
def advance(op, s, n, ref, largest):
    """Return the stencil value after `n` operations: the same as calling `stencil_op` n times.

    All values uint8; for GL_INCR_WRAP and GL_DECR_WRAP, n counts increments less decrements.
    """
    if op == KEEP or n == 0:
        return s
    if op == CLEAR:
        return np.uint8(0)
    if op == REPLACE:
        return np.uint8(ref)
    if op == INCR_WRAP or op == DECR_WRAP:
        return np.uint8((int(s) + n) & int(largest))
    often = np.uint8(min(n, 255))  # only bytes: 64 of them fit into a vector
    if op == INCR:
        return np.uint8(s + min(np.uint8(largest - s), often))
    if op == DECR:
        return np.uint8(s - min(s, often))
    return np.uint8(s ^ largest if n & 1 else s)


@kernel
def apply_pending_updates(ops, tiles, region, stencil):
    """Apply the pending updates to whole tiles."""
    op = common_op(ops)
    ref, largest = np.uint8(ops.ref), np.uint8(ops.stencil_largest)
    for tile_row in range(tiles.pending.shape[0]):
        top, bottom = rows_of(tile_row, region)
        for tile in range(tiles.pending.shape[1]):
            n = tiles.pending[tile_row, tile]
            if n == 0:
                continue
            left, right = columns_of_tile(tile, region)
            for row in range(top, bottom):
                values = stencil[row, left:right]
                for k in range(np.uint64(right - left)):
                    values[k] = advance(op, values[k], n, ref, largest)
