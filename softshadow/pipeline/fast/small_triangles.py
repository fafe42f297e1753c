"""Fill small triangles by bounding box; equals `raster.fill.fill_rows`, see fast/test_any_state.py.

For a triangle of a few pixels, the divisions that find the ends of a row cost more than the pixels. So three edge
functions are evaluated at every pixel of the box; a pixel outside is masked out: no branch decides,
and its stored values are written back.

A row is always the same number of pixels, so that each operation is one vector instruction. Measured on a million
triangles of 4 pixels: a loop over the box's own columns takes 47 ms, rows of 16 pixels 22 to 30.
"""

from functools import cache
from typing import Any

import numpy as np

from softshadow.jit import copied_kernel, kernel
from softshadow.pipeline.fast.fragment_numbers import (
    DEPTH_WRITE,
    LARGEST,
    READ,
    REF,
    SFAIL,
    WRITE,
    ZFAIL,
    ZPASS,
    depth_of,
    depth_passes,
    depth_test_of,
    stencil_passes,
    stencil_test_of,
    stencil_update_of,
    updated,
)  # fmt: skip
from softshadow.pipeline.raster.coverage import bounds
from softshadow.pipeline.raster.spans import ONLY
from softshadow.pipeline.records import NO_TRIANGLE, SEVERAL_TRIANGLES

WIDEST = 16  # columns; measured, boxes are the faster up to some 12 to 24
HALF = WIDEST // 2
WIDEST_OF_STRIPS = 3 * WIDEST  # columns of boxes that are filled strip by strip: in half the time that rows take
TALLEST = 64  # rows; up to these, edge functions over a row of a box stay below 2^30 in 1/256 pixel squared


@kernel
def columns_of(corners, t):
    """Return first and end column of the samples in a triangle's bounding box (end exclusive)."""
    x0, x1, x2 = int(corners[t, 0]), int(corners[t, 2]), int(corners[t, 4])
    return (min(x0, min(x1, x2)) + 255) >> 8, (max(x0, max(x1, x2)) >> 8) + 1


@kernel
def is_small(corners, t, region, pitch):
    """Return whether boxes can take triangle `t`: few columns and rows, no column cut off by the region.

    All strips of a box must lie within the buffers, whose rows have `pitch` columns.
    """
    first, end = bounds(corners, t)
    left, right = columns_of(corners, t)
    narrow = right - left <= WIDEST
    fits = narrow or (right - left <= WIDEST_OF_STRIPS and left + WIDEST_OF_STRIPS <= pitch)
    return fits and end - first <= TALLEST and left >= region.left and right <= region.right


@cache
def small_fill_for(tests_stencil: bool, writes_ids: bool, *, only_updates: bool = False) -> Any:
    """Return the kernel `fill_small` for fills that test stencil values or not, and write ids or not.

    With `only_updates`, it is for states under which all stencil values pass and are updated, and nothing else is. Then
    it is not copied into its caller, whose loop over large triangles would take a fifth longer.
    """

    @(kernel if only_updates else copied_kernel)
    def fill_small(
        which_ids, ops, byte_ops, largest, corners, planes, faces, numbers, n, region, depth_range, pitch, depth,
        stencil, ids, passed, covered, ties,
    ):  # fmt: skip
        """Fill small triangles by bounding box, from ``numbers[n]`` on; the arguments: see `any_state.compiled_for`.

        Return the index of the first triangle that is not small. The caller's loop over large triangles is separate so
        that the registers of one loop need not hold the values of the other: in one loop, it takes twice as long.
        `passed` and `covered` (16,) uint8 are scratch. Columns and rows as floats are those of `FillBuffers.columns`:
        reading that array would make the compiler test for every triangle whether it overlaps the buffers.
        """
        flip = 0 if region.downwards else -1
        while n < numbers.shape[0]:
            t = np.uint64(numbers[n])  # unsigned: no wrap-around of negative indices is compiled in
            if not is_small(corners, t, region, pitch):
                break
            n += 1
            first, end = bounds(corners, t)
            first, end = max(first, region.first_row), min(end, region.end_row)
            left, right = columns_of(corners, t)
            if first >= end or left >= right:
                continue  # between the samples
            z0, dz, dz_row, offset = planes[t, 0], planes[t, 1], planes[t, 2], planes[t, 3]
            x0, y0, x1, y1 = corners[t, 0], corners[t, 1], corners[t, 2], corners[t, 3]
            x2, y2 = corners[t, 4], corners[t, 5]
            f = np.uint64(faces[t])
            depth_test, writes_depth = depth_test_of(ops, f), np.int32(-1 if ops[f, DEPTH_WRITE] else 0)
            if tests_stencil:
                stencil_test, ref, read = stencil_test_of(byte_ops, f), byte_ops[f, REF], byte_ops[f, READ]
                write, most = byte_ops[f, WRITE], byte_ops[f, LARGEST]
                sfail, zfail = stencil_update_of(byte_ops, f, SFAIL), stencil_update_of(byte_ops, f, ZFAIL)
                zpass = stencil_update_of(byte_ops, f, ZPASS)
            if writes_ids:
                triangle = np.int32(t)
                repeated = SEVERAL_TRIANGLES if which_ids == ONLY else triangle
            # of depths and ids, rows of half the columns take less time; a number that varies would slow bytes down
            n_columns = np.int32(WIDEST)
            if not tests_stencil and right - left <= HALF:
                n_columns = np.int32(HALF)
            while left < right:
                start = np.int32(min(left, pitch - n_columns))
                x, y, start_at = np.int32(start << 8), np.int32(first << 8), np.float32(start)
                at0, across0, along0 = edge_from(x0, y0, x1, y1, x, y, flip)
                at1, across1, along1 = edge_from(x1, y1, x2, y2, x, y, flip)
                at2, across2, along2 = edge_from(x2, y2, x0, y0, x, y, flip)
                for row in range(first, end):
                    j, row_at = np.uint64(row), np.float32(np.int32(row))
                    if only_updates:
                        for k in range(WIDEST):
                            i, column = np.uint64(start) + np.uint64(k), start_at + np.float32(np.int32(k))
                            z = depth_of(z0, dz, dz_row, offset, column, row_at, depth_range, largest)
                            outside = outside_edges(at0, at1, at2, across0, across1, across2, np.int32(k))
                            s, hit = stencil[j, i], depth_passes(depth_test, z, depth[j, i]) != 0
                            passing, failing = updated(zpass, s, most), updated(zfail, s, most)
                            after = passing if hit else failing
                            stencil[j, i] = s if outside else after
                    elif tests_stencil:
                        for k in range(WIDEST):
                            i, column = np.uint64(start) + np.uint64(k), start_at + np.float32(np.int32(k))
                            z = depth_of(z0, dz, dz_row, offset, column, row_at, depth_range, largest)
                            outside = outside_edges(at0, at1, at2, across0, across1, across2, np.int32(k))
                            passed[np.uint64(k)] = np.uint8(depth_passes(depth_test, z, depth[j, i]))
                            covered[np.uint64(k)] = np.uint8(~outside)
                        for k in range(WIDEST):
                            i, hit, inside = (
                                np.uint64(start) + np.uint64(k),
                                passed[np.uint64(k)],
                                covered[np.uint64(k)],
                            )
                            s = stencil[j, i]
                            allowed = stencil_passes(stencil_test, ref, np.uint8(s & read))
                            passing, failing = updated(zpass, s, most), updated(zfail, s, most)
                            after, denied = passing if hit else failing, updated(sfail, s, most)
                            after = after if allowed else denied
                            stencil[j, i] = np.uint8(s ^ np.uint8(np.uint8(s ^ after) & np.uint8(write & inside)))
                            passed[np.uint64(k)] = np.uint8(np.uint8(hit & inside) & allowed)
                    if writes_ids:
                        id_j = np.uint64(row - region.first_row)
                        for k in range(WIDEST if tests_stencil else n_columns):
                            i, column = np.uint64(start) + np.uint64(k), start_at + np.float32(np.int32(k))
                            z = depth_of(z0, dz, dz_row, offset, column, row_at, depth_range, largest)
                            stored, before = depth[j, i], ids[id_j, i]
                            if tests_stencil:
                                hit = np.int32(-1 if passed[np.uint64(k)] else 0)
                                ties[np.uint64(k)] = hit  # see `any_state`
                            else:
                                outside = outside_edges(at0, at1, at2, across0, across1, across2, np.int32(k))
                                hit = np.int32(depth_passes(depth_test, z, stored) & ~outside)
                                tied = np.int32((1 if z == stored else 0) & ~outside)
                                ties[np.uint64(k)] = max(ties[np.uint64(k)], tied)  # see `any_state`
                            number = triangle if before == NO_TRIANGLE else repeated
                            depth[j, i] = z if np.int32(hit & writes_depth) else stored
                            ids[id_j, i] = number if hit else before
                    elif writes_depth and not only_updates:
                        for k in range(n_columns):
                            i, column = np.uint64(start) + np.uint64(k), start_at + np.float32(np.int32(k))
                            z = depth_of(z0, dz, dz_row, offset, column, row_at, depth_range, largest)
                            stored = depth[j, i]
                            if tests_stencil:
                                hit = np.int32(-1 if passed[np.uint64(k)] else 0)
                            else:
                                outside = outside_edges(at0, at1, at2, across0, across1, across2, np.int32(k))
                                hit = np.int32(depth_passes(depth_test, z, stored) & ~outside)
                            ties[np.uint64(k)] = hit  # see `any_state`
                            depth[j, i] = z if hit else stored
                    at0, at1, at2 = np.int32(at0 + along0), np.int32(at1 + along1), np.int32(at2 + along2)
                left += WIDEST
        return n

    return fill_small


@kernel
def outside_edges(at0, at1, at2, across0, across1, across2, n):
    """Return -1 for a sample outside an edge, `n` columns on, else 0: the sign of an or tells if one is negative."""
    inside0, inside1 = np.int32(at0 - np.int32(across0 * n)), np.int32(at1 - np.int32(across1 * n))
    inside2 = np.int32(at2 - np.int32(across2 * n))
    return np.int32(np.int32(inside0 | inside1 | inside2) >> 31)


@kernel
def edge_from(x0, y0, x1, y1, x, y, flip):
    """Return the edge function of `coverage.edge` at a sample, and its steps: a column subtracts, a row adds.

    For corners near the sample: truncated to 32 bits after every operation, so that the compiler uses 32-bit ones.
    `flip` is 0 where rows grow downwards, else -1.
    """
    across, along = np.int32(y0 - y1), np.int32(x0 - x1)
    # negative where the edge is inclusive: by the sign of `across` and, where that is 0, of `along`;
    # without a branch, which would be mispredicted for every second or third edge
    order = (np.int64(across) << 33) + (np.int64(along) ^ flip)
    at = np.int32(np.int32(across * np.int32(x0 - x)) - np.int32(along * np.int32(y0 - y)))
    return np.int32(at + np.int32(~(order >> 63))), np.int32(across << 8), np.int32(along << 8)
