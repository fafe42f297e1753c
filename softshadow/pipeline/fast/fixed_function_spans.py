"""The fixed function on visible spans; equals `shade.shading.shade_and_write`, see fast/test_span_shading.py."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from softshadow.framebuffer import Framebuffer
from softshadow.kernel_cache import KernelGroup
from softshadow.pipeline.fast.fragment_block import block_memory
from softshadow.pipeline.fast.segment_rows import draw_segments
from softshadow.pipeline.fast.segment_tables import (
    IN_ORDER,
    NO_DEPTH,
    NO_STENCIL,
    OF_SPANS,
    covered_state,
    padded_textures,
    tables_of,
    texels_of_units,
)
from softshadow.pipeline.fast.span_tests import NO_OPS
from softshadow.pipeline.fast.special_fragments import NO_SPECIAL
from softshadow.pipeline.records import Geometry, Spans
from softshadow.pipeline.shade.interpolate import AttributePlanes
from softshadow.pipeline.shade.shading import LOOKED_UP, shade_in_parts
from softshadow.state import State

NO_RANGE, NO_ORDER, NO_COLUMNS = np.zeros((1, 2), np.float32), np.empty(0, np.int32), np.empty((2, 0), np.int32)
NO_COUNT = np.zeros(1, np.int64)  # spans have passed the tests before

# so many fragments, in draws that cover most of a small window, pay for compiling them
SPAN_KERNELS = KernelGroup("spans", pays_after=250_000)


def fixed_function_shader(state: State, target: Framebuffer, geometry: Geometry) -> Callable[[Spans], None] | None:
    """Return the function that shades and writes spans of a draw without overlaps; None where it is not covered."""
    units = geometry.program.units
    numbers = covered_state(state, target, geometry, units)
    if numbers is None:
        return None
    triangles, pixels = geometry.triangles, target.colors[0].cells.view(np.int32)[..., 0]
    tables, textures = tables_of(NO_OPS, NO_OPS, *numbers, NO_SPECIAL), padded_textures(texels_of_units(units))
    flats = np.array([geometry.flat])

    def shade_part(spans: Spans, planes: AttributePlanes) -> None:
        segment = np.array([[0, 0, OF_SPANS, len(spans.row), 0, 0, 0, 0, *IN_ORDER]], np.int32)
        draw_segments(
            segment, NO_RANGE, NO_ORDER, 0, 0, 0, triangles.corners, triangles.depth, triangles.front, planes.values,
            planes.place, flats, *tables, textures, pixels, NO_DEPTH, NO_STENCIL, NO_COUNT, *spans,
            *NO_COLUMNS, *block_memory.arrays,
        )  # fmt: skip

    return lambda spans: shade_in_parts(geometry, spans, shade_part, LOOKED_UP if geometry.program.units else 1)
