"""Spans, fragments of one triangle side by side in a row: found in the ids that a fill leaves.

Shading and writing go span by span: values of the triangle and of the row are looked up once per span, and loops along
a long span are vectorised.
"""

import numpy as np

from softshadow.jit import kernel
from softshadow.pipeline.memory.scratch import scratch
from softshadow.pipeline.memory.threads import parts_of, share
from softshadow.pipeline.records import Fragments, Region, Spans

STRIDE = 16  # pixels of a long span that are compared together
PIXELS_PER_PART = 1 << 17
WORTH_SHARING = 1 << 20  # pixels from which several threads count their spans
WORTH_COLLECTING = 20_000  # spans; one takes as long as 32 pixels


def _empty_spans(n: int) -> Spans:
    row, left, triangle = scratch((3, n), np.int32)
    start = scratch(n + 1, np.int64)
    start[0] = 0
    return Spans(row, left, triangle, start)


def visible_spans(ids: np.ndarray, region: Region) -> Spans:
    """Return the spans of visible fragments.

    Parameters
    ----------
    ids : (rows of the region, pitch) int32, the triangle of each pixel or -1; other columns are not read
    """
    left, right, first_row = region.left, region.right, region.first_row
    parts, n_pixels = parts_of(len(ids), PIXELS_PER_PART // ids.shape[1]), len(ids) * (right - left)
    counted = share(lambda n: count_visible(ids[slice(*parts[n])], left, right), len(parts), n_pixels >= WORTH_SHARING)
    starts = [(0, 0)]  # the first span and the first fragment of each part
    for n_spans, n_fragments in counted:
        starts.append((starts[-1][0] + n_spans, starts[-1][1] + n_fragments))
    spans = _empty_spans(starts[-1][0])

    def collect(n: int) -> None:
        (first, end), (first_span, first_fragment) = parts[n], starts[n]
        rows = slice(first_span, starts[n + 1][0])
        collected = (array[rows] for array in spans)
        collect_visible(ids[first:end], left, right, first_row + first, first_fragment, *collected)

    share(collect, len(parts), starts[-1][0] + n_pixels // 32 >= WORTH_COLLECTING)
    spans.start[-1] = starts[-1][1]
    return spans


def spans_of(fragments: Fragments) -> Spans:
    """Return the spans of listed fragments, in their order."""
    if not len(fragments.row):
        return _empty_spans(0)
    continues = np.diff(fragments.column) == 1
    for same in (fragments.row, fragments.triangle):
        continues &= same[1:] == same[:-1]
    first = np.flatnonzero(np.append(True, ~continues))
    row, column, triangle = (part[first] for part in fragments)
    return Spans(row, column, triangle, np.append(first, len(fragments.row)))


def fragments_of(spans: Spans) -> Fragments:
    """Return the fragments of spans one by one."""
    lengths = np.diff(spans.start)
    row, triangle = np.repeat(spans.row, lengths), np.repeat(spans.triangle, lengths)
    column = np.arange(spans.fragments) + np.repeat(spans.left - spans.start[:-1], lengths)
    return Fragments(row, column.astype(np.int32), triangle)


@kernel
def count_visible(ids, left, right):
    """Return the numbers of spans (pixels whose triangle is not that of the left neighbour) and of pixels in them."""
    spans = pixels = np.int64(0)
    for row in range(ids.shape[0]):
        row_ids = ids[row, left:right]
        row_spans = row_pixels = np.int32(right > left and row_ids[0] >= 0)
        for column in range(1, row_ids.shape[0]):
            row_spans += np.int32((row_ids[column] >= 0) & (row_ids[column] != row_ids[column - 1]))
            row_pixels += np.int32(row_ids[column] >= 0)
        spans, pixels = spans + row_spans, pixels + row_pixels
    return spans, pixels


@kernel
def collect_visible(ids, first_column, end_column, first_row, fragment, rows, lefts, triangles, starts):
    """Write row, first column, triangle and first fragment of all spans; `fragment` is the number of the first one."""
    n = 0
    for row in range(ids.shape[0]):
        row_ids, column = ids[row, first_column:end_column], 0
        while column < row_ids.shape[0]:
            triangle, left = row_ids[column], column
            differs = np.int32(0)
            while column + STRIDE <= row_ids.shape[0] and differs == 0:
                for i in range(STRIDE):  # without a branch: one or two vectors
                    differs |= row_ids[np.uint64(column + i)] ^ triangle
                column += STRIDE if differs == 0 else 0
            while column < row_ids.shape[0] and row_ids[np.uint64(column)] == triangle:
                column += 1
            if triangle >= 0:
                rows[n], lefts[n], triangles[n], starts[n] = row + first_row, left + first_column, triangle, fragment
                n, fragment = n + 1, fragment + column - left
