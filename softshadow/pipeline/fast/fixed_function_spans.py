"""The fixed function on visible spans; equals `shade.shading.shade_and_write`, see fast/test_span_shading.py.

Step by step, a fragment takes a hundred bytes from kernel to kernel, and a chunk large enough to pay for the calls does
not fit into the cache. Here a block of fragments goes through all steps in the first-level cache.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from softshadow.framebuffer import Framebuffer
from softshadow.jit import kernel
from softshadow.kernel_cache import KernelGroup
from softshadow.pipeline.constants import ONE, ZERO
from softshadow.pipeline.fast.fragment_block import (
    MASK,
    NEXT,
    SIZE,
    SPAN_LEFT,
    SPAN_PLACE,
    SPAN_ROW,
    SPAN_START,
    block_memory,
)
from softshadow.pipeline.fast.span_colors import ALPHA_ROW, shade_block
from softshadow.pipeline.fast.span_state import SpanState, span_state
from softshadow.pipeline.fast.span_tests import (
    IS_TESTED,
    NO_OPS,
    alpha_tests,
    test_alpha_of_block,
    test_depths_of_block,
    test_runs_of_block,
)
from softshadow.pipeline.fast.span_writes import write_block
from softshadow.pipeline.fast.special_fragments import NO_SPECIAL, discard_from_block
from softshadow.pipeline.records import Geometry, Spans
from softshadow.pipeline.shade.interpolate import AttributePlanes
from softshadow.pipeline.shade.shading import shade_in_parts
from softshadow.state import State

NO_DEPTH, NO_STENCIL = np.zeros((1, 1), np.float32), np.zeros((1, 1), np.uint8)  # where there is no such buffer
NO_TESTS = alpha_tests(NO_OPS, NO_OPS)

# so many fragments, in draws that cover most of a small window, pay for compiling them
SPAN_KERNELS = KernelGroup("spans", pays_after=250_000)


def fixed_function_shader(state: State, target: Framebuffer, geometry: Geometry) -> Callable[[Spans], None] | None:
    """Return the function that shades and writes spans of a draw without overlaps; None where it is not covered."""
    numbers = covered_state(state, target, geometry)
    if numbers is None:
        return None
    triangles, pixels = geometry.triangles, target.colors[0].cells.view(np.int32)[..., 0]

    def shade_part(spans: Spans, planes: AttributePlanes) -> None:
        shade_spans(
            planes.values, planes.place, *spans, len(spans.row), False, geometry.flat, numbers.switches,
            numbers.numbers, *numbers.texels, NO_SPECIAL, pixels, triangles.depth, triangles.front, *NO_TESTS, ZERO,
            ONE, NO_DEPTH, NO_STENCIL, *block_memory.arrays,
        )  # fmt: skip

    return lambda spans: shade_in_parts(geometry, spans, shade_part)


def covered_state(state: State, target: Framebuffer, geometry: Geometry) -> SpanState | None:
    """Return the numbers of a draw's fragment state, or None where the textbook has to shade.

    The kernels take the fixed function in float32 and one colour buffer of four bytes, which no unit samples.
    """
    units, colors = geometry.program.units, target.colors
    if units is None or geometry.window.dtype != np.float32 or len(colors) != 1:
        return None
    if any(image is attached.image for unit in units for image in unit.texture.images.values()
           for attached in target.attachments.values()):  # fmt: skip
        return None
    return span_state(state, units, colors[0].format, len(geometry.flat))


@kernel
def shade_spans(
    planes, place, rows, lefts, triangles, starts, n_all, may_overlap, flat, switches, numbers, texels0, texels1,
    special, pixels, depth_planes, faces_front, alpha_test, tests_depth, tests_stencil, test_numbers, test_bytes,
    largest, low, high, depth, stencil, room, whole, spans, own_triangles,
):  # fmt: skip
    """Shade `n_all` spans, as many at a time as fit into a block, and write them to `pixels` (H, pitch) int32.

    Spans that may overlap are blended in their order. With alpha test, or where `special` (`special_numbers`) leaves
    fragments out, they are tested before they are written; the arguments from `depth_planes` to `stencil` are read for
    that only. The last ones are those of `fragment_block.block_memory`.
    """
    whole[MASK : MASK + np.uint64(SIZE)] = -1
    r, done = 0, np.int64(0)  # the next span, and how many of its fragments are done
    while r < n_all:
        n_spans, n = 0, np.int64(0)
        while r < n_all and n < SIZE:  # the last span may go on in the next block
            length, s = min(starts[r + 1] - starts[r] - done, SIZE - n), np.uint64(n_spans)
            own_triangles[s] = triangles[r]
            spans[SPAN_ROW, s], spans[SPAN_LEFT, s], spans[SPAN_PLACE, s] = (
                rows[r],
                lefts[r] + done,
                place[triangles[r]],
            )
            done, n, n_spans = done + length, n + length, n_spans + 1
            spans[SPAN_START, s + NEXT] = n
            if done == starts[r + 1] - starts[r]:
                r, done = r + 1, np.int64(0)
        shade_block(planes, spans, n_spans, n, flat, switches, numbers, texels0, texels1, special, room, whole)
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
        write_block(spans, n_spans, may_overlap, switches, alpha_test[IS_TESTED] != 0, whole, pixels)
