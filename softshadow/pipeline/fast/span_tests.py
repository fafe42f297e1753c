"""Depth, stencil and alpha test of spans; equals `raster.ordered.process_fragments`, see fast/test_forward.py.

Without stencil test, a comparison of depths is a set of results that pass (less, equal, greater): one loop for all
comparisons. With it, fragments are processed one by one.
"""

import numpy as np

from softshadow.jit import inlined, kernel
from softshadow.pipeline.constants import ONE, ZERO
from softshadow.pipeline.fast.fragment_block import (
    DEPTH,
    FLOAT_ROWS,
    MASK,
    NEXT,
    SIZE,
    SPAN_LEFT,
    SPAN_ROW,
    SPAN_START,
    WHOLE_ROWS,
)
from softshadow.pipeline.fast.span_textures import EQUAL, GREATER, LESS, UNORDERED
from softshadow.pipeline.raster.coverage import bounds, row_span
from softshadow.pipeline.raster.depth import depth_at, depth_units
from softshadow.pipeline.raster.fragment_ops import NO_ALPHA, FragmentOps, process_fragment
from softshadow.pipeline.records import PASSED, DepthRange

LARGEST_BYTE = np.float32(255)
WANTED = len(FragmentOps._fields)  # in the numbers of a facing, behind the fields: which results of the depth test pass
N_OPS = WANTED + 1


@inlined
def ops_of(numbers):
    """Return the per-fragment operations from their numbers (N_OPS,)."""
    return FragmentOps(
        numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5], numbers[6], numbers[7], numbers[8],
        numbers[9], numbers[10], numbers[11], numbers[12], numbers[13], numbers[14], numbers[15],
    )  # fmt: skip


@kernel
def collect_passing_spans(
    order, m, row, region_left, region_right, first_row, end_row, downwards, corners, planes, faces_front, ops, low,
    high, depth, stencil, rows, lefts, triangles, starts,
):  # fmt: skip
    """Test the fragments of triangles in drawing order, and write the spans of those that pass.

    With alpha test, which needs colours, nothing is tested, and the spans are all fragments.

    Parameters
    ----------
    order : (n,) int32, numbers of triangles, of which ``order[m]`` is the first, from `row` on
    ops : (2, N_OPS) of front and back
    rows, lefts, triangles, starts : receive the spans, see `records.Spans`

    Returns
    -------
    m, row, n_spans : where to go on, since the arrays were full, and how many spans there are
    """
    room, whole = np.empty(FLOAT_ROWS * SIZE, np.float32), np.empty(WHOLE_ROWS * SIZE, np.int32)
    tests = ops[0, 0] == 0 and (ops[0, 2] | ops[0, 8] | ops[1, 2] | ops[1, 8]) != 0
    n_spans, fragments = 0, np.int64(0)
    no_depth, no_stencil = depth.shape[0] < end_row, stencil.shape[0] < end_row
    starts[0] = 0
    while m < order.shape[0]:
        t = np.uint64(order[m])
        first, end = bounds(corners, t)
        row, end, numbers, plane = (
            max(row, max(first, first_row)),
            min(end, end_row),
            ops[1 - faces_front[t]],
            planes[t],
        )
        while row < end:
            left, right = row_span(corners, t, row, downwards)
            left, right = max(left, region_left), min(right, region_right)
            if left < right and n_spans + ((right - left) >> 1) + 2 + (right - left) // SIZE > rows.shape[0]:
                return m, row, n_spans
            if left < right and not tests:
                s, fragments = np.uint64(n_spans), fragments + right - left
                rows[s], lefts[s], triangles[s], starts[s + NEXT] = row, left, t, fragments
                n_spans += 1
                left = right
            while left < right:
                length = np.uint64(min(right - left, SIZE))
                own_depth, own_stencil = depth[0 if no_depth else row], stencil[0 if no_stencil else row]
                every, some = test_span(
                    numbers, plane, low, high, row, left, length, own_depth, own_stencil, room, whole
                )
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


@inlined
def test_span(numbers, plane, low, high, row, left, length, depth, stencil, room, whole):
    """Test up to SIZE fragments of a span without alpha test; return whether all and whether some of them pass.

    `numbers` are those of the facing, `plane` is (z at pixel (0, 0), dz/di, dz/dj, offset), `depth` and `stencil` the
    rows of the buffers. MASK receives which fragments pass.
    """
    ops, first = ops_of(numbers), np.uint64(left)
    z0, dz, dz_row, offset, j = plane[0], plane[1], plane[2], plane[3], np.float32(np.int32(row))
    scale, shift = np.float32(ops.depth_largest), np.int32(left)
    for n in range(length):
        z = depth_at(z0, dz, dz_row, offset, np.float32(np.int32(np.int32(n) + shift)), j)
        z = z if z < high else high
        room[DEPTH + n] = z if z > low else low
    if ops.depth_largest:
        for n in range(length):
            room[DEPTH + n] = np.rint(room[DEPTH + n] * scale)
    every, some, wanted = np.int32(-1), np.int32(0), np.int32(numbers[WANTED])
    if ops.stencil_test:
        for n in range(length):
            i = first + n
            stored = depth[i] if ops.depth_test else ZERO
            verdict, s, stored_z = process_fragment(ops, True, NO_ALPHA, room[DEPTH + n], stored, stencil[i])
            stencil[i] = s
            if ops.depth_write:
                depth[i] = stored_z
            passed = np.int32(-1) if verdict == PASSED else np.int32(0)
            whole[MASK + n], every, some = passed, every & passed, some | passed
    elif ops.depth_test:
        for n in range(length):
            z, stored = room[DEPTH + n], depth[first + n]
            result = LESS if z < stored else EQUAL if z == stored else GREATER if z > stored else UNORDERED
            passed = np.int32(-1) if result & wanted else np.int32(0)
            whole[MASK + n] = passed
            every &= passed
            some |= passed
        if ops.depth_write and some:
            for n in range(length):
                depth[first + n] = room[DEPTH + n] if whole[MASK + n] else depth[first + n]
    else:
        for n in range(length):
            whole[MASK + n] = -1
        some = every
    return every != 0, some != 0


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
