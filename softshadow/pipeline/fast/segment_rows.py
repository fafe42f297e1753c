"""Segments in drawing order; equals `raster.ordered.process_fragments`, see fast/test_segments.py.

The triangles of each segment are tested row by row, one after the other; the spans that pass are shaded and written in
the same order. A segment can also be visible spans, which were tested before and do not overlap.
"""

from __future__ import annotations

import numpy as np

from softshadow.jit import wide_kernel
from softshadow.pipeline.fast.segment_tables import (
    DEPTH_AFTER,
    DEPTH_BEFORE,
    DEPTH_LARGEST,
    END,
    END_ROW,
    FIRST,
    FIRST_ROW,
    FLATS,
    LEFT,
    OF_SPANS,
    OWN_TEXTURES,
    RIGHT,
    STATE,
    STENCIL_AFTER,
    STENCIL_BEFORE,
)
from softshadow.pipeline.fast.shade_spans import shade_spans
from softshadow.pipeline.fast.span_state import WRITABLE
from softshadow.pipeline.fast.span_tests import IS_TESTED, collect_passing_spans


@wide_kernel
def draw_segments(
    segments, ranges, order, first_row, end_row, downwards, corners, depth_planes, faces_front, planes, place, flats,
    tests, before, before_bytes, after, after_bytes, alphas, switches, numbers, specials, textures, pixels, depth,
    stencil, passed, rows, lefts, triangles, starts, first_columns, end_columns, room, whole, spans, own_triangles,
):  # fmt: skip
    """Draw the segments into the rows [first_row, end_row); count the fragments that pass the tests before shading.

    Fragments are shaded where a colour is written, or decides.

    Parameters
    ----------
    segments (S, 12) int32 : columns as in `segment_tables`; of spans, there is only one, and `order` is empty
    ranges (S, 2) float32 : what depths are clamped to
    order (n,) int32 : numbers of triangles, of which a segment's begin at its FIRST and end at its END
    planes (T, 3, k + 1), place (T,) : see `interpolate.AttributePlanes`
    flats (g, k) bool : which columns are not interpolated
    tests, ..., specials : of `segment_tables.state_tables`
    textures : of `segment_tables.padded_textures`
    passed (S,) int64 : the fragments of each segment that pass are added
    rows, ..., starts : spans, or scratch for them (`records.Spans`)
    first_columns, end_columns (end_row,) int32 : scratch, as are the last four (`fragment_block.block_memory`)
    """
    for n in range(segments.shape[0]):
        k, flat = segments[n, STATE], flats[segments[n, FLATS]]
        own_textures = segments[n, OWN_TEXTURES:]
        low, high, left, right = ranges[n, 0], ranges[n, 1], segments[n, LEFT], segments[n, RIGHT]
        first, end = max(first_row, np.int64(segments[n, FIRST_ROW])), min(end_row, np.int64(segments[n, END_ROW]))
        is_spans = segments[n, FIRST] == OF_SPANS
        m, row, own = np.int64(max(segments[n, FIRST], 0)), first, order[: segments[n, END]]
        n_spans = np.int64(segments[n, END])
        while is_spans or (first < end and m < len(own)):
            if not is_spans:
                m, row, n_spans = collect_passing_spans(
                    own, m, row, left, right, first, end, downwards, corners, depth_planes, faces_front,
                    tests[k, DEPTH_BEFORE], tests[k, STENCIL_BEFORE], before[k], before_bytes[k],
                    tests[k, DEPTH_LARGEST], low, high, depth, stencil, rows, lefts, triangles, starts, room, whole,
                    first_columns, end_columns,
                )  # fmt: skip
                passed[n] += starts[n_spans]
                if switches[k, WRITABLE] == 0 and not alphas[k, IS_TESTED]:
                    continue
            shade_spans(
                planes, place, rows, lefts, triangles, starts, n_spans, not is_spans, flat, switches[k], numbers[k],
                textures, own_textures, specials[k], pixels, depth_planes, faces_front, alphas[k],
                tests[k, DEPTH_AFTER], tests[k, STENCIL_AFTER], after[k], after_bytes[k], tests[k, DEPTH_LARGEST], low,
                high, depth, stencil, room, whole, spans, own_triangles,
            )  # fmt: skip
            is_spans = False
