"""The fixed function on spans; equals `shade.shading.shade_and_write`, see fast/test_span_shading.py.

Step by step, a fragment takes a hundred bytes from kernel to kernel, and a chunk large enough to pay for the calls does
not fit into the cache. Here a block of fragments goes through all steps in the first-level cache.
"""

from __future__ import annotations

import numpy as np

from softshadow.jit import kernel
from softshadow.pipeline.fast.fragment_block import (
    FRAGMENTS,
    MASK,
    NEXT,
    SIZE,
    SPAN_LEFT,
    SPAN_PLACE,
    SPAN_ROW,
    SPAN_START,
)
from softshadow.pipeline.fast.span_colors import ALPHA_ROW, shade_block
from softshadow.pipeline.fast.span_float_writes import write_float_block
from softshadow.pipeline.fast.span_state import AS_BYTES, STORED_AS
from softshadow.pipeline.fast.span_tests import (
    IS_TESTED,
    test_alpha_of_block,
    test_depths_of_block,
    test_runs_of_block,
)
from softshadow.pipeline.fast.span_writes import write_block
from softshadow.pipeline.fast.special_fragments import discard_from_block


@kernel
def shade_spans(
    planes, place, rows, lefts, triangles, starts, n_all, may_overlap, flat, switches, numbers, textures,
    own_textures, special, pixels, depth_planes, faces_front, alpha_test, tests_depth, tests_stencil, test_numbers,
    test_bytes, largest, low, high, depth, stencil, room, whole, spans, own_triangles,
):  # fmt: skip
    """Shade `n_all` spans, as many at a time as fit into a block, and write them to `pixels` (see `pixels_of`).

    Spans that may overlap are blended in their order. With alpha test, or where `special` (`special_numbers`) leaves
    fragments out, they are tested before they are written; the arguments from `depth_planes` to `stencil` are read for
    that only. The last ones are those of `fragment_block.block_memory`.
    """
    whole[MASK : MASK + np.uint64(SIZE)] = -1
    r, end, done = np.uint64(0), np.uint64(n_all), np.int64(0)  # the next span, and how many of its fragments are done
    while r < end:
        n_spans, n = 0, np.int64(0)
        while r < end and n < FRAGMENTS:  # the last span may go on in the next block
            t, s, rest = np.uint64(triangles[r]), np.uint64(n_spans), starts[r + NEXT] - starts[r] - done
            length = min(rest, FRAGMENTS - n)
            own_triangles[s], spans[SPAN_PLACE, s] = t, place[t]
            spans[SPAN_ROW, s], spans[SPAN_LEFT, s] = rows[r], lefts[r] + done
            done, n, n_spans = done + length, n + length, n_spans + 1
            spans[SPAN_START, s + NEXT] = n
            if length == rest:
                r, done = r + NEXT, np.int64(0)
        shade_block(planes, spans, n_spans, n, flat, switches, numbers, textures, own_textures, special, room, whole)
        if alpha_test[IS_TESTED]:
            test_alpha_of_block(alpha_test, n, ALPHA_ROW, room, whole)
            discard_from_block(special, spans, n_spans, n, room, whole)
            if tests_depth and not tests_stencil:
                test_depths_of_block(
                    test_numbers, largest, low, high, depth, spans, n_spans, own_triangles, depth_planes, faces_front,
                    room, whole,
                )  # fmt: skip
            elif tests_stencil:
                test_runs_of_block(
                    tests_depth, tests_stencil, test_numbers, test_bytes, largest, low, high, depth, stencil, spans,
                    n_spans, own_triangles, depth_planes, faces_front, room, whole,
                )  # fmt: skip
        is_masked = alpha_test[IS_TESTED] != 0
        if switches[STORED_AS] == AS_BYTES:
            write_block(spans, n_spans, may_overlap, switches, is_masked, whole, pixels)
        else:
            write_float_block(spans, n_spans, switches, numbers, is_masked, room, whole, pixels)
