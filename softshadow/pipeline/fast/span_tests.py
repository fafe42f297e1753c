"""Depth, stencil and alpha test of spans; equals `raster.ordered.process_fragments`, see fast/test_forward.py.

The tests are numbers (`fragment_numbers`), so that a few loops without branches serve all states. Only with alpha test,
which needs colours, fragments are processed one by one.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from softshadow.jit import inlined, kernel
from softshadow.pipeline.constants import ONE, ZERO
from softshadow.pipeline.fast.fragment_block import (
    DEPTH,
    MASK,
    NEXT,
    SIZE,
    SPAN_LEFT,
    SPAN_ROW,
    SPAN_START,
)
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
    numbers_of,
    stencil_passes,
    stencil_test_of,
    stencil_update_of,
    updated,
)
from softshadow.pipeline.raster.coverage import bounds, row_spans
from softshadow.pipeline.raster.depth import depth_at, depth_units
from softshadow.pipeline.raster.fragment_ops import FragmentOps, process_fragment
from softshadow.pipeline.records import PASSED, DepthRange

LARGEST_BYTE = np.float32(255)
N_OPS = len(FragmentOps._fields)


class SpanTests(NamedTuple):
    """The tests of a draw's fragments as numbers.

    depth, stencil: which tests there are, none of them where the alpha test comes first, which needs colours; numbers,
    byte_numbers: see `fragment_numbers.numbers_of`; depth_largest: the integer that z = 1 becomes.
    """

    depth: int
    stencil: int
    numbers: np.ndarray
    byte_numbers: np.ndarray
    depth_largest: int


def span_tests(front: FragmentOps, back: FragmentOps) -> SpanTests:
    """Return the tests of the spans of both facings, which differ in stencil operations only."""
    tested = not front.alpha_test
    return SpanTests(
        front.depth_test * tested, front.stencil_test * tested, *numbers_of(front, back), front.depth_largest
    )


@inlined
def ops_of(numbers):
    """Return the per-fragment operations from their numbers (N_OPS,)."""
    return FragmentOps(
        numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5], numbers[6], numbers[7], numbers[8],
        numbers[9], numbers[10], numbers[11], numbers[12], numbers[13], numbers[14], numbers[15],
    )  # fmt: skip


@kernel
def collect_passing_spans(
    order, m, row, region_left, region_right, first_row, end_row, downwards, corners, planes, faces_front,
    tests_depth, tests_stencil, numbers, byte_numbers, largest, low, high, depth, stencil, rows, lefts, triangles,
    starts, room, whole, first_columns, end_columns,
):  # fmt: skip
    """Test the fragments of triangles in drawing order, and write the spans of those that pass.

    Parameters
    ----------
    order : (n,) int32, numbers of triangles, of which ``order[m]`` is the first, from `row` on
    tests_depth, ..., largest : the fields of `SpanTests`
    rows, lefts, triangles, starts : receive the spans, see `records.Spans`
    room, whole : of a block; first_columns, end_columns : (end_row,) int32, scratch

    Returns
    -------
    m, row, n_spans : where to go on, since the arrays were full, and how many spans there are
    """
    depth_range, n_spans, fragments = DepthRange(low, high), 0, np.int64(0)
    starts[0] = 0
    while m < order.shape[0]:
        t = np.uint64(order[m])
        first, end = bounds(corners, t)
        row, end, f = max(row, max(first, first_row)), min(end, end_row), np.uint64(faces_front[t])
        row_spans(corners, t, row, end, downwards, region_left, region_right, first_columns, end_columns)
        while row < end:
            j = np.uint64(row)
            # always of one type, so that `test_span` is compiled once
            left, right = int(np.int64(first_columns[j])), int(np.int64(end_columns[j]))
            if left < right and n_spans + ((right - left) >> 1) + 2 + (right - left) // SIZE > rows.shape[0]:
                return m, row, n_spans
            if left < right and not (tests_depth or tests_stencil):
                s, fragments = np.uint64(n_spans), fragments + right - left
                rows[s], lefts[s], triangles[s], starts[s + NEXT] = row, left, t, fragments
                n_spans += 1
                left = right
            while left < right:
                length = np.uint64(min(right - left, SIZE))
                every, some = test_span(
                    tests_depth, tests_stencil, numbers, byte_numbers, largest, f, planes, t, depth_range, j, left,
                    length, depth, stencil, room, whole,
                )  # fmt: skip
                n = np.uint64(0)
                while some and n < length:
                    while n < length and not whole[MASK + n]:
                        n += NEXT
                    begin = n
                    n = length if every else n
                    while n < length and whole[MASK + n]:
                        n += NEXT
                    if n > begin:
                        s, fragments = np.uint64(n_spans), fragments + np.int64(n - begin)
                        rows[s], lefts[s], triangles[s], starts[s + NEXT] = row, left + np.int64(begin), t, fragments
                        n_spans += 1
                left += SIZE
            row += 1
        m, row = m + 1, first_row
    return m, row, n_spans


@kernel
def test_span(
    tests_depth, tests_stencil, numbers, byte_numbers, largest, f, planes, t, depth_range, j, left, length, depth,
    stencil, room, whole,
):  # fmt: skip
    """Test up to SIZE fragments of row `j` of triangle `t`; return whether all and whether some of them pass.

    `f` is the facing. MASK receives which fragments pass.
    """
    first, row_at, shift = np.uint64(left), np.float32(np.int32(j)), np.int32(left)
    if tests_depth:
        z0, dz, dz_row, offset = planes[t, 0], planes[t, 1], planes[t, 2], planes[t, 3]
        for n in range(length):
            column = np.int32(np.int32(n) + shift)
            room[DEPTH + n] = depth_of(z0, dz, dz_row, offset, column, row_at, depth_range, largest)
        depth_test = depth_test_of(numbers, f)
        for n in range(length):
            whole[MASK + n] = depth_passes(depth_test, room[DEPTH + n], depth[j, first + n])
    else:
        for n in range(length):
            whole[MASK + n] = -1
    if tests_stencil:
        update_stencil(byte_numbers, f, j, first, length, stencil, whole)
    every, some = np.int32(-1), np.int32(0)
    for n in range(length):
        every &= whole[MASK + n]
        some |= whole[MASK + n]
    if numbers[f, DEPTH_WRITE] and some:
        for n in range(length):
            depth[j, first + n] = room[DEPTH + n] if whole[MASK + n] else depth[j, first + n]
    return every != 0, some != 0


@kernel
def update_stencil(numbers, f, j, first, length, stencil, whole):
    """Test and update stencil values from column `first` on; MASK, where the depth test passes, becomes where both do.

    `numbers` are the bytes of `fragment_numbers.numbers_of`.
    """
    test, ref, read = stencil_test_of(numbers, f), numbers[f, REF], numbers[f, READ]
    write, most = numbers[f, WRITE], numbers[f, LARGEST]
    sfail, zfail = stencil_update_of(numbers, f, SFAIL), stencil_update_of(numbers, f, ZFAIL)
    zpass = stencil_update_of(numbers, f, ZPASS)
    for n in range(length):
        hit, s = whole[MASK + n], stencil[j, first + n]
        allowed = stencil_passes(test, ref, np.uint8(s & read))
        passing, failing, denied = updated(zpass, s, most), updated(zfail, s, most), updated(sfail, s, most)
        after = passing if hit else failing
        after = after if allowed else denied
        stencil[j, first + n] = np.uint8(s ^ np.uint8(np.uint8(s ^ after) & write))
        whole[MASK + n] = hit if allowed else 0


@kernel
def test_alpha_of_block(
    ops, spans, n_spans, triangles, planes, faces_front, low, high, depth, stencil, alpha, room, whole
):
    """Test the shaded fragments of a block one by one, with alpha test; MASK receives which ones pass.

    `ops` (2, N_OPS) of front and back; `triangles` (SIZE,) of the spans; `alpha` is the row of the alphas.
    """
    front, back, depth_range = ops_of(ops[0]), ops_of(ops[1]), DepthRange(low, high)
    for s in range(np.uint64(n_spans)):
        row, left = np.uint64(spans[SPAN_ROW, s]), np.uint64(spans[SPAN_LEFT, s])
        first, end = np.uint64(spans[SPAN_START, s]), np.uint64(spans[SPAN_START, s + NEXT])
        t, j = np.uint64(triangles[s]), np.float32(spans[SPAN_ROW, s])
        own = front if faces_front[t] else back
        for n in range(end - first):
            i, m = left + n, first + n
            z = depth_at(planes[t, 0], planes[t, 1], planes[t, 2], planes[t, 3], np.float32(np.int32(i)), j)
            z = depth_units(z, depth_range, own.depth_largest)
            stored = depth[row, i] if own.depth_test else ZERO
            before = stencil[row, i] if own.stencil_test else np.uint8(0)
            compared = np.int64(compared_byte(room[alpha + m]))
            verdict, after, stored_z = process_fragment(own, True, compared, z, stored, before)
            if own.stencil_test:
                stencil[row, i] = after
            if own.depth_write:
                depth[row, i] = stored_z
            whole[MASK + m] = -1 if verdict == PASSED else 0


@inlined
def compared_byte(alpha):
    """Return the byte that the alpha test compares, as `blend.compared_alpha`; NaN is compared as 1."""
    value = alpha if alpha < ONE else ONE
    return np.int32(np.rint((value if value > ZERO else ZERO) * LARGEST_BYTE))
