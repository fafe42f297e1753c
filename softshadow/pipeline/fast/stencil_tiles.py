"""Fill stencil-only draws tile by tile; equals `raster.fill.fill_triangles`, see fast/test_stencil_tiles.py.

Tiles that their depth bounds (`hierarchical_z.py`) do not decide are filled row by row, in chunks of 32 columns: first
the depth test in floats, 16 to a vector, then the stencil update in bytes, 32 to a vector.
"""

from collections.abc import Iterable

import numpy as np

from softshadow.image import Image
from softshadow.jit import wide_kernel
from softshadow.pipeline.fast.any_state import CHUNK, CHUNK_LOG2
from softshadow.pipeline.fast.fragment_numbers import (
    ALL,
    DEPTH_FUNC,
    LARGEST,
    NONE,
    ZFAIL,
    ZFAIL_OP,
    ZPASS,
    ZPASS_OP,
    depth_of,
    depth_passes,
    depth_test_of,
    numbers_of,
    stencil_update_of,
    updated,
)  # fmt: skip
from softshadow.pipeline.fast.hierarchical_z import (
    COLUMNS,
    COLUMNS_LOG2,
    MIXED,
    NOTHING,
    PASS,
    ROWS,
    ROWS_LOG2,
    TileBounds,
    columns_of_tile,
    common_op,
    complete_bounds,
    outcome,
    rows_of,
    tile_bounds,
    write_tile_bounds,
)  # fmt: skip
from softshadow.pipeline.fast.narrow_rows import WIDEST, extent_of_rows, fill_narrow
from softshadow.pipeline.fast.pending_updates import (
    FEW,
    PendingUpdates,
    apply_pending_updates,
    can_count,
    count_rows,
)  # fmt: skip
from softshadow.pipeline.fast.small_triangles import columns_of, is_small, small_fill_for
from softshadow.pipeline.memory.scratch import apart, row_columns, scratch
from softshadow.pipeline.memory.threads import share, threads
from softshadow.pipeline.raster.coverage import bounds, row_spans
from softshadow.pipeline.raster.fill import FillKernel
from softshadow.pipeline.raster.fragment_ops import ALWAYS, DECR_WRAP, INCR_WRAP, LESS, FragmentOps
from softshadow.pipeline.records import DepthRange, FillBuffers, Region, Setup

SHARED_TRIANGLES = 1 << 9  # that a thread takes in one go at most, where threads share the triangles
CHUNKS_PER_THREAD = 8
WORTH_SHARING = 1 << 20  # pixels from which several threads complete the bounds of tiles


def tiles_kernel(depth_image: Image | None = None) -> FillKernel:
    """Return the kernel that fills in tiles under an order-independent state; the image keeps its tile bounds."""

    def fill_kernel(
        front: FragmentOps,
        back: FragmentOps,
        triangles: Setup,
        numbers: np.ndarray,
        region: Region,
        depth_range: DepthRange,
        buffers: FillBuffers,
    ) -> None:
        rest = region, depth_range, buffers, _bounds_of(depth_image, buffers)
        _fill_chunks([numbers], numbers_of(front, back), front.depth_largest, triangles, *rest, buffers.stencil)

    return fill_kernel


def shared_tiles_kernel(depth_image: Image | None = None) -> FillKernel:
    """Return the same for threads that share the triangles, under a state that `only_counts`.

    Sums do not depend on their order: all threads but one count in buffers of their own, which are added at the end. So
    no triangle is set up twice, as where threads share the rows.
    """

    def fill_kernel(
        front: FragmentOps,
        back: FragmentOps,
        triangles: Setup,
        numbers: np.ndarray,
        region: Region,
        depth_range: DepthRange,
        buffers: FillBuffers,
    ) -> None:
        bounds, rows = _bounds_of(depth_image, buffers), slice(region.first_row, region.end_row)
        n_threads = threads()
        rooms = [apart((3, COLUMNS), buffers.depth.dtype) for _ in range(n_threads)]
        tile_rows = range(region.first_row >> ROWS_LOG2, ((region.end_row - 1) >> ROWS_LOG2) + 1)

        def complete(n: int) -> None:  # each n has rows of its own
            for tile_row in tile_rows[n::n_threads]:
                complete_bounds(buffers.depth, tile_row, region, *bounds, rooms[n])

        n_pixels = (region.end_row - region.first_row) * buffers.depth.shape[1]
        share(complete, n_threads, n_pixels >= WORTH_SHARING)
        size = min(len(numbers) // (CHUNKS_PER_THREAD * n_threads) + 1, SHARED_TRIANGLES)
        chunks = iter([numbers[at : at + size] for at in range(0, len(numbers), size)])
        counts = [buffers.stencil, *(scratch(buffers.stencil.shape, np.uint8) for _ in range(1, n_threads))]

        def fill_some(n: int) -> None:
            if n:
                counts[n][rows] = 0
            ops = numbers_of(front, back), front.depth_largest
            _fill_chunks(chunks, *ops, triangles, region, depth_range, buffers, bounds, counts[n])

        share(fill_some, n_threads)
        for each in counts[1:]:
            buffers.stencil[rows] += each[rows]
        if front.stencil_largest < ALL:
            buffers.stencil[rows] &= np.uint8(front.stencil_largest)

    return fill_kernel


def _bounds_of(depth_image: Image | None, buffers: FillBuffers) -> TileBounds:
    return tile_bounds(depth_image, buffers.depth.shape, buffers.depth.dtype)


def _fill_chunks(
    chunks: Iterable[np.ndarray], numbers: tuple[np.ndarray, np.ndarray], largest: int, triangles: Setup,
    region: Region, depth_range: DepthRange, buffers: FillBuffers, bounds: TileBounds, stencil: np.ndarray,
) -> None:  # fmt: skip
    """Fill triangles, a chunk of their numbers after the other, and apply what is pending after the last."""
    depth, pending = buffers.depth, PendingUpdates.none(region)
    room, passed = apart((3, COLUMNS), depth.dtype), apart(ROWS * COLUMNS, np.uint8)
    lefts, rights = row_columns(region.end_row)
    pitch = min(depth.shape[1], stencil.shape[1])
    for chunk in chunks:
        fill_in_tiles(
            *numbers, largest, triangles.corners, triangles.depth, triangles.front, chunk, region, depth_range, *bounds,
            pitch, buffers.columns, depth, stencil, pending, room, passed, lefts, rights,
        )  # fmt: skip
    apply_pending_updates(*numbers, pending, region, stencil)


# changes stencil values only: of the arrays that come after them, it needs only the types
fill_small = small_fill_for(True, False, only_updates=True)


@wide_kernel
def fill_in_tiles(
    ops, byte_ops, largest, corners, planes, faces, numbers, region, depth_range, lows, highs, width, pitch,
    columns, depth, stencil, pending, room, passed, lefts, rights,
):  # fmt: skip
    """Fill triangles under a state that is `order_independent`; small ones bypass the tiles.

    `ops` are the numbers of both facings, `lows`, `highs` and `width` the tile bounds, `pitch` the columns that both
    buffers have; `pending` receives updates that are not made at once, the arrays behind it are scratch.
    """
    op, most = common_op(ops), byte_ops[0, LARGEST]
    counts_rows = can_count(op, numbers.shape[0])
    func, depth_test = ops[0, DEPTH_FUNC], depth_test_of(ops, np.uint64(0))
    last_start = pitch - CHUNK
    first_tile_row = region.first_row >> ROWS_LOG2
    n = 0
    while n < numbers.shape[0]:
        if is_small(corners, np.uint64(numbers[n]), region, pitch):
            n = fill_small(
                0, ops, byte_ops, largest, corners, planes, faces, numbers, n, region, depth_range, pitch, depth,
                stencil, pending.whole, passed, passed, lefts,
            )  # fmt: skip
        if n == numbers.shape[0]:
            break
        t = np.uint64(numbers[n])
        n += 1
        first, end = bounds(corners, t)
        first, end = max(first, region.first_row), min(end, region.end_row)
        box_left, box_right = columns_of(corners, t)
        box_left, box_right = max(box_left, region.left), min(box_right, region.right)
        if first >= end or box_left >= box_right:
            continue
        f = np.uint64(faces[t])
        zfail, zpass = ops[f, ZFAIL_OP], ops[f, ZPASS_OP]
        failing, passing = stencil_update_of(byte_ops, f, ZFAIL), stencil_update_of(byte_ops, f, ZPASS)
        z0, dz, dz_row, offset = planes[t, 0], planes[t, 1], planes[t, 2], planes[t, 3]
        row_spans(corners, t, first, end, region.downwards, region.left, region.right, lefts, rights)
        for tile_row in range(first >> ROWS_LOG2, ((end - 1) >> ROWS_LOG2) + 1):
            top, bottom = rows_of(tile_row, region)
            first_here, end_here = max(first, top), min(end, bottom)
            outer_left, outer_right, inner_left, inner_right, widest = extent_of_rows(
                first_here, end_here, box_left, box_right, lefts, rights
            )
            if outer_left >= outer_right:
                continue
            has_all_rows = first_here == top and end_here == bottom
            for tile in range(outer_left >> COLUMNS_LOG2, ((outer_right - 1) >> COLUMNS_LOG2) + 1):
                tile_left, tile_right = columns_of_tile(tile, region)
                left, right = max(outer_left, tile_left), min(outer_right, tile_right)
                if func != ALWAYS and np.isnan(lows[tile_row, tile]):
                    write_tile_bounds(depth, tile_row, tile, lows, highs, width, room)
                what = outcome(
                    func, zfail, zpass, depth_range, largest, z0, dz, dz_row, offset, columns[left],
                    columns[right - 1], columns[first_here], columns[end_here - 1], lows[tile_row, tile],
                    highs[tile_row, tile],
                )  # fmt: skip
                if what == NOTHING:
                    continue
                if what != MIXED:
                    here = tile_row - first_tile_row, tile
                    once = -1 if (zpass if what == PASS else zfail) == DECR_WRAP else 1
                    if has_all_rows and inner_left <= tile_left and inner_right >= tile_right:
                        pending.whole[here] += once
                        continue
                    pending.parts[here] += counts_rows
                    if pending.parts[here] >= FEW:
                        count_rows(
                            once, pending.parts[here], first_here, end_here, tile_row, tile, tile_left, tile_right,
                            lefts, rights, pending.differences[here],
                        )  # fmt: skip
                        continue
                elif widest <= WIDEST:
                    fill_narrow(
                        op, first_here, end_here, tile_left, tile_right, pitch, lefts, rights, passing, failing, most,
                        depth_test, z0, dz, dz_row, offset, depth_range, largest, depth, stencil,
                    )  # fmt: skip
                    continue
                # the chunks of a row: one from `left` on if that covers the tile's part of every row, else all of them
                first_chunk, end_chunk = left >> CHUNK_LOG2 << CHUNK_LOG2, right
                if right - left <= CHUNK:
                    first_chunk = min(left, last_start)
                    end_chunk = first_chunk + 1
                if what == MIXED:
                    # for all rows: bytes read right after they were written in other portions would have to wait
                    for row in range(first_here, end_here):
                        j, row_at = np.uint64(row), np.float32(np.int32(row))
                        for at in range(first_chunk, end_chunk, CHUNK):
                            if lefts[j] >= at + CHUNK or rights[j] <= at:
                                continue
                            place = np.uint64(((row - first_here) << COLUMNS_LOG2) + at - first_chunk)
                            start_at = np.float32(np.int32(at))
                            if func == LESS:  # what nearly all shadow volumes use, in two thirds of the time
                                for k in range(CHUNK):
                                    i, column = np.uint64(at) + np.uint64(k), start_at + np.float32(np.int32(k))
                                    z = depth_of(z0, dz, dz_row, offset, column, row_at, depth_range, largest)
                                    passed[place + np.uint64(k)] = ALL if z < depth[j, i] else NONE
                                continue
                            for k in range(CHUNK):
                                i, column = np.uint64(at) + np.uint64(k), start_at + np.float32(np.int32(k))
                                z = depth_of(z0, dz, dz_row, offset, column, row_at, depth_range, largest)
                                passed[place + np.uint64(k)] = np.uint8(depth_passes(depth_test, z, depth[j, i]))
                    for row in range(first_here, end_here):
                        j = np.uint64(row)
                        row_left, row_right = max(lefts[j], tile_left), min(rights[j], tile_right)
                        for at in range(first_chunk, end_chunk, CHUNK):
                            if row_left >= at + CHUNK or row_right <= at:
                                continue
                            place = np.uint64(((row - first_here) << COLUMNS_LOG2) + at - first_chunk)
                            begin = min(max(row_left - at, 0), CHUNK)
                            count = np.uint8(min(max(row_right - at, begin), CHUNK) - begin)
                            if op == INCR_WRAP:
                                for k in range(CHUNK):
                                    i, hit = np.uint64(at) + np.uint64(k), passed[place + np.uint64(k)]
                                    step = passing.step if hit else failing.step
                                    # left of the first column, the difference wraps round to large numbers
                                    step = step if np.uint8(np.uint8(k) - np.uint8(begin)) < count else NONE
                                    stencil[j, i] = np.uint8(np.uint8(stencil[j, i] + step) & most)
                            else:
                                for k in range(CHUNK):
                                    i, hit = np.uint64(at) + np.uint64(k), passed[place + np.uint64(k)]
                                    inside = ALL if np.uint8(np.uint8(k) - np.uint8(begin)) < count else NONE
                                    s = stencil[j, i]
                                    after, other = updated(passing, s, most), updated(failing, s, most)
                                    after = after if hit else other
                                    stencil[j, i] = np.uint8(s ^ np.uint8(np.uint8(s ^ after) & inside))
                    continue
                update = passing if what == PASS else failing
                for row in range(first_here, end_here):
                    j = np.uint64(row)
                    row_left, row_right = max(lefts[j], tile_left), min(rights[j], tile_right)
                    for at in range(first_chunk, end_chunk, CHUNK):
                        if row_left >= at + CHUNK or row_right <= at:
                            continue
                        begin = min(max(row_left - at, 0), CHUNK)
                        count = np.uint8(min(max(row_right - at, begin), CHUNK) - begin)
                        for k in range(CHUNK):
                            i = np.uint64(at) + np.uint64(k)
                            inside = ALL if np.uint8(np.uint8(k) - np.uint8(begin)) < count else NONE
                            s = stencil[j, i]
                            stencil[j, i] = np.uint8(s ^ np.uint8(np.uint8(s ^ updated(update, s, most)) & inside))
