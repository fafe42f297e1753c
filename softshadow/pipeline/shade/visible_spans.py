"""Spans: fragments of one triangle, side by side in a row, found in the buffer of triangle ids.

Shading and writing take a span at a time: values of the triangle and of the row are looked up once per span, and loops
along a long one are vectorised.
"""

import numpy as np

from softshadow.jit import kernel
from softshadow.pipeline.memory.scratch import scratch
from softshadow.pipeline.memory.threads import parts_of, share
from softshadow.pipeline.records import Fragments, Spans

STRIDE = 16  # pixels of a long span that are compared together
ROWS = 128  # of a part that a thread takes


def _empty(count: int) -> Spans:
    row, left, triangle = scratch((3, count), np.int32)
    start = scratch(count + 1, np.int64)
    start[0] = 0
    return Spans(row, left, triangle, start)


def visible_spans(ids: np.ndarray, first_row: int) -> Spans:
    """Return the spans of visible fragments.

    Parameters
    ----------
    ids : (rows, pitch) int32, the triangle of each pixel or -1
    first_row : of the stored planes, which row 0 of `ids` is
    """
    parts = parts_of(len(ids), ROWS)
    counts = share(lambda n: count_visible(ids[slice(*parts[n])]), len(parts))
    places = np.cumsum([(0, 0), *counts], axis=0)  # the first span and the first fragment of each part
    spans = _empty(places[-1, 0])

    def collect(n: int) -> None:
        (first, end), (span, at) = parts[n], places[n]
        own = slice(span, places[n + 1, 0])
        collect_visible(ids[first:end], first_row + first, at, *(array[own] for array in spans))

    share(collect, len(parts))
    spans.start[-1] = places[-1, 1]
    return spans


def spans_of(fragments: Fragments) -> Spans:
    """Return the spans of listed fragments, in their order."""
    if not len(fragments.row):
        return _empty(0)
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
def count_visible(ids):
    """Return the number of spans (pixels whose triangle is not that of the left neighbour) and of their pixels."""
    spans = pixels = np.int64(0)
    for row in range(ids.shape[0]):
        line = ids[row]
        begun = seen = np.int32(line[0] >= 0)
        for column in range(1, line.shape[0]):
            begun += np.int32((line[column] >= 0) & (line[column] != line[column - 1]))
            seen += np.int32(line[column] >= 0)
        spans, pixels = spans + begun, pixels + seen
    return spans, pixels


@kernel
def collect_visible(ids, first_row, at, rows, lefts, triangles, starts):
    """Write row, first column, triangle and first fragment of all spans; `at` numbers the first fragment."""
    count = 0
    for row in range(ids.shape[0]):
        line, column = ids[row], 0
        while column < line.shape[0]:
            triangle, left = line[column], column
            others = np.int32(0)
            while column + STRIDE <= line.shape[0] and others == 0:
                for i in range(STRIDE):  # no branches between them: a vector or two
                    others |= line[np.uint64(column + i)] ^ triangle
                column += STRIDE if others == 0 else 0
            while column < line.shape[0] and line[np.uint64(column)] == triangle:
                column += 1
            if triangle >= 0:
                rows[count], lefts[count], triangles[count], starts[count] = row + first_row, left, triangle, at
                count, at = count + 1, at + column - left
