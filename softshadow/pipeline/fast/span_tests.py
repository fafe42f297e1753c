"""Depth, stencil and alpha test of a span; equals `raster.ordered.process_fragments`, see fast/test_forward.py.

Without stencil test, a comparison of depths is a set of results that pass (less, equal, greater): one loop for all
comparisons. With it, fragments are processed one by one.
"""

import numpy as np

from softshadow.jit import kernel
from softshadow.pipeline.constants import ONE, ZERO
from softshadow.pipeline.fast.fragment_block import DEPTH, MASK, NEXT, SPAN_LEFT, SPAN_PLACE, SPAN_ROW, SPAN_START
from softshadow.pipeline.fast.span_colors import ALPHA_ROW
from softshadow.pipeline.fast.span_textures import EQUAL, GREATER, LESS, UNORDERED
from softshadow.pipeline.raster.depth import depth_at, depth_units
from softshadow.pipeline.raster.fragment_ops import NO_ALPHA, FragmentOps, process_fragment
from softshadow.pipeline.records import PASSED, DepthRange

LARGEST_BYTE = np.float32(255)
FIELDS = len(FragmentOps._fields)
WANTED, N_OPS = (
    FIELDS,
    FIELDS + 1,
)  # in the numbers of a facing: behind the fields, the results of the depth test that pass


@kernel
def ops_of(numbers):
    """Return the per-fragment operations from their numbers (N_OPS,)."""
    return FragmentOps(
        numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5], numbers[6], numbers[7], numbers[8],
        numbers[9], numbers[10], numbers[11], numbers[12], numbers[13], numbers[14], numbers[15],
    )  # fmt: skip


@kernel
def test_span(numbers, plane, low, high, row, left, length, start, depth, stencil, room, whole):
    """Test the fragments of a span without alpha test; return the first and the end of those that pass.

    `numbers` are those of the facing, `plane` is (z at pixel (0, 0), dz/di, dz/dj, offset), `start` the place of the
    first fragment in the block, `depth` and `stencil` the rows of the buffers. MASK receives which ones pass.
    """
    ops = ops_of(numbers)
    first, end, n_fragments = np.uint64(left), np.uint64(start), np.uint64(length)
    mask = MASK + end
    if not ops.depth_test and not ops.stencil_test:
        for n in range(n_fragments):
            whole[mask + n] = -1
        return 0, length
    z0, dz, dz_row, offset, j = plane[0], plane[1], plane[2], plane[3], np.float32(np.int32(row))
    own = DEPTH + end
    scale, shift = np.float32(ops.depth_largest), np.int32(left)
    for n in range(n_fragments):
        z = depth_at(z0, dz, dz_row, offset, np.float32(np.int32(np.int32(n) + shift)), j)
        z = z if z < high else high
        room[own + n] = z if z > low else low
    if ops.depth_largest:
        for n in range(n_fragments):
            room[own + n] = np.rint(room[own + n] * scale)
    if ops.stencil_test:
        for n in range(n_fragments):
            i = first + n
            stored = depth[i] if ops.depth_test else ZERO
            verdict, s, stored_z = process_fragment(ops, True, NO_ALPHA, room[own + n], stored, stencil[i])
            stencil[i] = s
            if ops.depth_write:
                depth[i] = stored_z
            whole[mask + n] = -1 if verdict == PASSED else 0
    else:
        wanted = np.int32(numbers[WANTED])
        for n in range(n_fragments):
            z, stored = room[own + n], depth[first + n]
            result = LESS if z < stored else EQUAL if z == stored else GREATER if z > stored else UNORDERED
            whole[mask + n] = -1 if result & wanted else 0
        if ops.depth_write:
            for n in range(n_fragments):
                depth[first + n] = room[own + n] if whole[mask + n] else depth[first + n]
    begin, stop = 0, length
    while begin < stop and not whole[mask + np.uint64(begin)]:
        begin += 1
    while begin < stop and not whole[mask + np.uint64(stop - 1)]:
        stop -= 1
    if begin > 0:
        for n in range(np.uint64(stop - begin)):
            whole[mask + n] = whole[mask + n + np.uint64(begin)]
    return begin, stop


@kernel
def test_block(numbers, spans, n_spans, triangles, planes, faces_front, low, high, depth, stencil, room, whole):
    """Test the shaded fragments of a block one by one, with alpha test; MASK receives which ones pass.

    `numbers` (2, N_OPS) of front and back; `triangles` (P,) are the triangles whose planes have the places of `spans`.
    """
    front, back, depth_range = ops_of(numbers[0]), ops_of(numbers[1]), DepthRange(low, high)
    for s in range(np.uint64(n_spans)):
        row, left = np.uint64(spans[SPAN_ROW, s]), np.uint64(spans[SPAN_LEFT, s])
        first, end = np.uint64(spans[SPAN_START, s]), np.uint64(spans[SPAN_START, s + NEXT])
        t = np.uint64(triangles[np.uint64(spans[SPAN_PLACE, s])])
        ops, j = front if faces_front[t] else back, np.float32(spans[SPAN_ROW, s])
        for n in range(end - first):
            i, m = left + n, first + n
            z = depth_at(planes[t, 0], planes[t, 1], planes[t, 2], planes[t, 3], np.float32(np.int32(i)), j)
            z = depth_units(z, depth_range, ops.depth_largest)
            stored = depth[row, i] if ops.depth_test else ZERO
            before = stencil[row, i] if ops.stencil_test else np.uint8(0)
            alpha = np.int64(compared_byte(room[ALPHA_ROW + m]))
            verdict, after, stored_z = process_fragment(ops, True, alpha, z, stored, before)
            if ops.stencil_test:
                stencil[row, i] = after
            if ops.depth_write:
                depth[row, i] = stored_z
            whole[MASK + m] = -1 if verdict == PASSED else 0


@kernel
def compared_byte(alpha):
    """Return the byte that the alpha test compares, as `blend.compared_alpha`; NaN is compared as 1."""
    value = ONE if not alpha < ONE else alpha
    return np.int32(np.rint((value if value > ZERO else ZERO) * LARGEST_BYTE))
