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

from softshadow.image import Image
from softshadow.jit import inlined, kernel
from softshadow.pipeline.constants import INFINITY, ZERO
from softshadow.pipeline.fast.fragment_numbers import ZFAIL_OP, ZPASS_OP
from softshadow.pipeline.raster.depth import depth_at, depth_units
from softshadow.pipeline.raster.fragment_ops import (
    ALWAYS,
    DECR_WRAP,
    GEQUAL,
    GREATER,
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


class TileBounds(NamedTuple):
    """Bounds of the stored depth in each tile of an image, (rows, columns) of tiles, NaN where not computed yet.

    width: how many columns the image has without padding.
    """

    low: np.ndarray
    high: np.ndarray
    width: int


def tile_bounds(depth: Image | None, shape: tuple[int, int], real: np.dtype) -> TileBounds:
    """Return the tile bounds of a depth buffer with so many rows and columns; they are kept until its cells change."""
    bounds: TileBounds | None = None if depth is None else depth.tile_bounds
    if bounds is None:
        tiles = ((shape[0] - 1) >> ROWS_LOG2) + 1, ((shape[1] - 1) >> COLUMNS_LOG2) + 1
        bounds = TileBounds(
            np.full(tiles, np.nan, real), np.full(tiles, np.nan, real), shape[1] if depth is None else depth.width
        )
        if depth is not None:
            depth.tile_bounds = bounds
    return bounds


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


def only_counts(front: FragmentOps, back: FragmentOps) -> bool:
    """Return whether an order-independent state only adds and subtracts modulo 2**bits."""
    return {op for ops in (front, back) for op in (ops.zfail, ops.zpass)} <= {KEEP} | WRAPPING


@kernel
def rows_of(tile_row, region):
    """Return first and end row of a row of tiles, within the region."""
    return max(tile_row << ROWS_LOG2, region.first_row), min((tile_row + 1) << ROWS_LOG2, region.end_row)


@kernel
def columns_of_tile(tile, region):
    """Return first and end column of a column of tiles, within the region."""
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
        low[k], high[k], odd[k] = INFINITY, -INFINITY, ZERO
    for row in range(first, end):
        stored = depth[row, left:right]
        for k in range(width):
            z = stored[k]
            lower, higher = z if z < low[k] else low[k], z if z > high[k] else high[k]
            low[k], high[k] = lower + ZERO, higher + ZERO  # plus 0: else they are masked stores, see `any_state`
            odd[k] += z - z  # 0 for numbers
    lowest, highest = low[0], high[0]
    for k in range(width):
        if odd[k] != 0:
            return -INFINITY, INFINITY
        lowest, highest = min(lowest, low[k]), max(highest, high[k])
    return lowest, highest


@inlined
def write_tile_bounds(depth, tile_row, tile, lows, highs, width, scratch):
    """Write the bounds of a whole tile, as they outlive the region of a draw."""
    lows[tile_row, tile], highs[tile_row, tile] = find_bounds(
        depth, tile_row << ROWS_LOG2, min((tile_row + 1) << ROWS_LOG2, depth.shape[0]), tile << COLUMNS_LOG2,
        min((tile + 1) << COLUMNS_LOG2, width), scratch,
    )  # fmt: skip


@kernel
def complete_bounds(depth, tile_row, region, lows, highs, width, scratch):
    """Write the bounds that are missing in a row of tiles of the region."""
    for tile in range(region.left >> COLUMNS_LOG2, ((region.right - 1) >> COLUMNS_LOG2) + 1):
        if np.isnan(lows[tile_row, tile]):
            write_tile_bounds(depth, tile_row, tile, lows, highs, width, scratch)


@kernel
def outcome(
    func, zfail, zpass, depth_range, largest, z0, dz, dz_row, offset, left, right, first, end, stored_low, stored_high
):  # fmt: skip
    """Return the depth test's result for a triangle's fragments from column `left` to `right`, row `first` to `end`.

    PASS or FAIL: all fragments; MIXED: it differs or is not known; NOTHING: no stencil value will change. The depth
    plane and all bounds (both ends included) are numbers in the precision of depth: passing an array would cost
    reference counting.
    """
    result = PASS
    if func != ALWAYS:
        column_low, column_high = (left, right) if dz >= 0 else (right, left)
        row_low, row_high = (first, end) if dz_row >= 0 else (end, first)
        low = depth_at(z0, dz, dz_row, offset, column_low, row_low)
        high = depth_at(z0, dz, dz_row, offset, column_high, row_high)
        if not np.isfinite(low) or not np.isfinite(high):
            return MIXED  # planes that overflow, or are NaN, are not monotone
        low, high = depth_units(low, depth_range, largest), depth_units(high, depth_range, largest)
        result = decide(func, low, high, stored_low, stored_high)
    if result == PASS:
        return NOTHING if zpass == KEEP else PASS
    if result == FAIL:
        return NOTHING if zfail == KEEP else FAIL
    return MIXED


@kernel
def common_op(ops):
    """Return the one operation of an order-independent state; GL_INCR_WRAP for steps in both directions."""
    op = KEEP
    for facing in range(2):
        for which in (ZFAIL_OP, ZPASS_OP):
            op = op if ops[facing, which] == KEEP else int(ops[facing, which])
    return INCR_WRAP if op == DECR_WRAP else op
