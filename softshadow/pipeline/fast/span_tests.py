"""Depth, stencil and alpha test of spans; equals `raster.ordered.process_fragments`, see fast/test_forward.py.

The tests are numbers (`fragment_numbers`), so that a few loops without branches serve all states. The alpha test needs
colours: with it, fragments are tested after they have been shaded, but those that fail the depth test for good before.
So are those of draws in which stipple or smooth points leave out fragments.
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from softshadow.jit import inlined, kernel, read_only
from softshadow.pipeline.constants import ONE, ZERO
from softshadow.pipeline.fast.fragment_block import (
    DEPTH,
    MASK,
    NEXT,
    SIZE,
    SPAN_LEFT,
    SPAN_ROW,
    SPAN_START,
    whole_portions,
)
from softshadow.pipeline.fast.fragment_numbers import (
    DEPTH_WRITE,
    WRITE,
    depth_passes,
    depth_test_of,
    numbers_of,
)
from softshadow.pipeline.fast.span_row_tests import (
    test_depths,
    test_depths_and_update_stencil,
    test_span,
    test_stencil,
    write_depths,
    write_passing,
)
from softshadow.pipeline.raster.coverage import bounds, row_spans
from softshadow.pipeline.raster.fragment_ops import (
    ALWAYS,
    EQUAL,
    GEQUAL,
    GREATER,
    KEEP,
    LEQUAL,
    LESS,
    NEVER,
    FragmentOps,
    compare,
)
from softshadow.pipeline.records import DepthRange

LARGEST_BYTE, START = np.float32(255), np.uint64(0)
NO_OPS = FragmentOps(0, ALWAYS, 0, ALWAYS, KEEP, KEEP, KEEP, 0, 0, ALWAYS, 0, 0, 0, 0, 0, 0)
# depth tests that a fragment, once it has failed, fails for ever: what passes moves the stored depth away from it
LASTING = (NEVER, LESS, EQUAL, LEQUAL, GREATER, GEQUAL)
IS_TESTED, IF_LESS, IF_EQUAL, IF_GREATER, ALPHA_REF = range(5)  # of `AlphaTests.alpha`
UNROUNDED = 2  # in IS_TESTED: alphas are compared as floats, and ALPHA_REF has the bits of one


class SpanTests(NamedTuple):
    """The tests of a draw's fragments as numbers.

    depth, stencil: which tests there are; numbers, byte_numbers: see `fragment_numbers.numbers_of`; depth_largest: the
    integer that z = 1 becomes.
    """

    depth: int
    stencil: int
    numbers: np.ndarray
    byte_numbers: np.ndarray
    depth_largest: int


class AlphaTests(NamedTuple):
    """The tests of fragments that have been shaded: `alpha` (5,) int32 is the alpha test, the others follow it.

    Fragments that stipple and smoothing leave out (`special_fragments`) fail with those of the alpha test.
    """

    alpha: np.ndarray
    depth: int
    stencil: int
    numbers: np.ndarray
    byte_numbers: np.ndarray
    depth_largest: int


def span_tests(front: FragmentOps, back: FragmentOps) -> SpanTests:
    """Return the tests of spans before they are shaded; the facings differ in stencil operations only."""
    if front.alpha_test:
        if front.stencil_test or front.depth_func not in LASTING:
            front = back = NO_OPS
        else:
            front, back = front._replace(depth_write=0), back._replace(depth_write=0)
    return SpanTests(front.depth_test, front.stencil_test, *numbers_of(front, back), front.depth_largest)


def with_float_reference(ops: FragmentOps, reference: float) -> FragmentOps:
    """Return operations whose alpha test compares floats, as for buffers of floats (`blend.compared_alpha`)."""
    return ops._replace(alpha_test=UNROUNDED, alpha_ref=int(np.float32(reference).view(np.int32)))


@lru_cache(maxsize=256)
def alpha_tests(front: FragmentOps, back: FragmentOps) -> AlphaTests:
    """Return the tests of spans after they have been shaded; without alpha test, there are none."""
    if not front.alpha_test:
        front = back = NO_OPS
    says = getattr(compare, "py_func", compare)
    results = [-int(says(front.alpha_func, *pair)) for pair in ((0, 1), (1, 1), (1, 0))]
    alpha = read_only(np.array([front.alpha_test, *results, front.alpha_ref], np.int32))
    return AlphaTests(alpha, front.depth_test, front.stencil_test, *numbers_of(front, back), front.depth_largest)


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
    pitch = depth.shape[1] if tests_depth else stencil.shape[1]
    pitch = min(pitch, stencil.shape[1]) if tests_stencil else pitch
    starts[0] = 0
    while m < order.shape[0]:
        t = np.uint64(order[m])
        first, end = bounds(corners, t)
        row, end, f = max(row, max(first, first_row)), min(end, end_row), np.uint64(faces_front[t])
        if row >= end:  # in other bands of rows, or between the samples
            m, row = m + 1, first_row
            continue
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
                fits = left + np.int64(whole_portions(length)) <= pitch
                if fits and not tests_stencil:
                    every, some = test_depths(
                        numbers, largest, f, planes, t, depth_range, j, left, length, depth, START, False, whole
                    )
                elif fits and not byte_numbers[f, WRITE]:
                    every, some = test_stencil(byte_numbers, f, j, left, length, stencil, whole)
                    if tests_depth and some:
                        every, some = test_depths(
                            numbers, largest, f, planes, t, depth_range, j, left, length, depth, START, True, whole
                        )
                elif fits and tests_depth:
                    every, some = test_depths_and_update_stencil(
                        numbers, byte_numbers, largest, f, planes, t, depth_range, j, left, length, depth, stencil,
                        whole,
                    )  # fmt: skip
                else:
                    every, some = test_span(
                        tests_depth, tests_stencil, numbers, byte_numbers, largest, f, planes, t, depth_range, j, left,
                        length, depth, stencil, START, room, whole,
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
def test_alpha_of_block(alpha_test, n_fragments, alpha, room, whole):
    """Test the alphas of a block, which are in the row `alpha`; MASK receives which fragments pass."""
    ref = alpha_test[ALPHA_REF]
    if_less, if_equal, if_greater = alpha_test[IF_LESS], alpha_test[IF_EQUAL], alpha_test[IF_GREATER]
    if alpha_test[IS_TESTED] == UNROUNDED:
        reference = np.int32(ref).view(np.float32)
        for i in range(np.uint64(n_fragments)):
            value = room[alpha + i]
            result = if_equal if value == reference else if_less
            whole[MASK + i] = if_greater if value > reference else result
        return
    for i in range(np.uint64(n_fragments)):
        value = compared_byte(room[alpha + i])
        result = if_less if value < ref else if_equal
        whole[MASK + i] = if_greater if value > ref else result


@kernel
def test_depths_of_block(
    numbers, largest, low, high, depth, spans, n_spans, triangles, planes, faces_front, room, whole
):
    """Do what `test_runs_of_block` does where there is no stencil test: then spans need not be cut into runs."""
    depth_range = DepthRange(low, high)
    for s in range(np.uint64(n_spans)):
        t, j, left = np.uint64(triangles[s]), np.uint64(spans[SPAN_ROW, s]), int(spans[SPAN_LEFT, s])
        start, f = np.uint64(spans[SPAN_START, s]), np.uint64(faces_front[t])
        length, first = np.uint64(spans[SPAN_START, s + NEXT]) - start, np.uint64(left)
        if left + np.int64(whole_portions(length)) <= depth.shape[1]:
            test_depths(numbers, largest, f, planes, t, depth_range, j, left, length, depth, start, True, whole)
            continue
        mask, z = MASK + start, DEPTH + start
        write_depths(planes, t, depth_range, largest, j, left, length, z, room)
        depth_test = depth_test_of(numbers, f)
        for n in range(length):
            whole[mask + n] &= depth_passes(depth_test, room[z + n], depth[j, first + n])
        if numbers[f, DEPTH_WRITE]:
            write_passing(j, first, length, depth, start, room, whole)


@kernel
def test_runs_of_block(
    tests_depth, tests_stencil, numbers, byte_numbers, largest, low, high, depth, stencil, spans, n_spans, triangles,
    planes, faces_front, room, whole,
):  # fmt: skip
    """Test the fragments of a block where MASK is set, which receives the ones that pass.

    `tests_depth`, ..., `largest` are fields of `AlphaTests`; `triangles` (SIZE,) are those of the spans.
    """
    depth_range = DepthRange(low, high)
    for s in range(np.uint64(n_spans)):
        t, j = np.uint64(triangles[s]), np.uint64(spans[SPAN_ROW, s])
        n, end, f = np.uint64(spans[SPAN_START, s]), np.uint64(spans[SPAN_START, s + NEXT]), np.uint64(faces_front[t])
        shift = np.int64(spans[SPAN_LEFT, s]) - np.int64(n)
        while n < end:
            while n < end and not whole[MASK + n]:
                n += NEXT
            begin = n
            while n < end and whole[MASK + n]:
                n += NEXT
            if n > begin:
                left = int(np.int64(begin) + shift)
                test_span(
                    tests_depth, tests_stencil, numbers, byte_numbers, largest, f, planes, t, depth_range, j, left,
                    n - begin, depth, stencil, begin, room, whole,
                )  # fmt: skip


@inlined
def compared_byte(alpha):
    """Return the byte that the alpha test compares, as `blend.compared_alpha`; NaN is compared as 1."""
    value = alpha if alpha < ONE else ONE
    return np.int32(np.rint((value if value > ZERO else ZERO) * LARGEST_BYTE))
