"""Spans, fragments of one triangle side by side in a row: found in the ids that a fill leaves.

Shading and writing go span by span: values of the triangle and of the row are looked up once per span, and loops along
a long span are vectorised.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from operator import itemgetter
from typing import NamedTuple

import numpy as np

from softshadow.jit import kernel
from softshadow.pipeline.memory.scratch import scratch
from softshadow.pipeline.memory.threads import parts_of, share
from softshadow.pipeline.records import NO_TRIANGLE, Fragments, Region, Spans

STRIDE, NEXT = np.uint64(16), np.uint64(1)  # pixels that are compared together: in a long span, they are equal
PIXELS_PER_PART = 1 << 16
WORTH_SHARING = 1 << 20  # pixels from which several threads count their spans
WORTH_COLLECTING = 20_000  # spans; one takes as long as 32 pixels


def _empty_spans(n: int) -> Spans:
    row, left, triangle = scratch((3, n), np.int32)
    start = scratch(n + 1, np.int64)
    start[0] = 0
    return Spans(row, left, triangle, start)


class CountedRows(NamedTuple):
    """The rows [first, end) of ids, and how many spans and fragments they have."""

    first: int
    end: int
    spans: int
    fragments: int


class BandsOfIds:
    """The ids of a fill in bands of rows: `clear` is called before a band is filled, and `finish` after it.

    Attributes
    ----------
    ids : (rows of the region, pitch) int32, the triangle of each pixel or -1, in the columns of the region
    shade : called with the spans of each band, by the thread that has filled it; None if they are shaded later
    """

    def __init__(self, region: Region, pitch: int, shade: Callable[[Spans], None] | None = None) -> None:
        self._region, self._counted, self._shaded = region, list[CountedRows](), list[tuple[int, Spans]]()
        self.ids = scratch((region.end_row - region.first_row, pitch), np.int32)
        self.shade = shade

    def clear(self, first_row: int, end_row: int) -> None:
        """Set the ids of a band to those of pixels without a triangle."""
        region = self._region
        rows = slice(first_row - region.first_row, end_row - region.first_row)
        self.ids[rows, region.left : region.right] = NO_TRIANGLE

    def finish(self, first_row: int, end_row: int) -> None:
        """Count the spans and the fragments of a band; shade them, if they are shaded by bands."""
        first, end = first_row - self._region.first_row, end_row - self._region.first_row
        counted = _counted(self.ids, self._region, first, end)
        if self.shade is None:
            self._counted.append(counted)
            return
        spans = _collected(self.ids, self._region, [counted])
        self.shade(spans)
        self._shaded.append((first, spans))

    def spans(self) -> VisibleSpans:
        """Return the spans of visible fragments of all bands."""
        if self.shade is None:
            return VisibleSpans([_collected(self.ids, self._region, sorted(self._counted))], are_shaded=False)
        return VisibleSpans([spans for _, spans in sorted(self._shaded, key=itemgetter(0))], are_shaded=True)


class VisibleSpans:
    """The spans of visible fragments in one list or several, which follow each other.

    Attributes
    ----------
    are_shaded : whether the draw that they were found for has shaded them already
    """

    def __init__(self, parts: list[Spans], *, are_shaded: bool) -> None:
        self._parts, self.are_shaded = parts, are_shaded

    @property
    def joined(self) -> Spans:
        """All spans in one list."""
        if len(self._parts) > 1:
            self._parts = [joined_spans(self._parts)]
        return self._parts[0]


def joined_spans(parts: Sequence[Spans]) -> Spans:
    """Return the spans of several lists in one."""
    if len(parts) == 1:
        return parts[0]
    starts, first = [np.zeros(1, np.int64)], 0
    for part in parts:
        starts.append(part.start[1:] + first)
        first += part.fragments
    row, left, triangle = (np.concatenate(arrays) for arrays in list(zip(*parts, strict=True))[:3])
    return Spans(row, left, triangle, np.concatenate(starts))


def visible_spans(ids: np.ndarray, region: Region) -> Spans:
    """Return the spans of visible fragments.

    Parameters
    ----------
    ids : (rows of the region, pitch) int32, the triangle of each pixel or -1; other columns are not read
    """
    parts = parts_of(len(ids), PIXELS_PER_PART // ids.shape[1])
    pays = len(ids) * (region.right - region.left) >= WORTH_SHARING
    return _collected(ids, region, share(lambda n: _counted(ids, region, *parts[n]), len(parts), pays))


def _counted(ids: np.ndarray, region: Region, first: int, end: int) -> CountedRows:
    return CountedRows(first, end, *count_visible(ids[first:end], region.left, region.right))


def _collected(ids: np.ndarray, region: Region, parts: Sequence[CountedRows]) -> Spans:
    """Return the spans of all rows, in parts without gaps."""
    left, right, first_row = region.left, region.right, region.first_row
    starts = [(0, 0)]  # the first span and the first fragment of each part
    for part in parts:
        starts.append((starts[-1][0] + part.spans, starts[-1][1] + part.fragments))
    spans = _empty_spans(starts[-1][0])

    def collect(n: int) -> None:
        (first, end, *_), (first_span, first_fragment) = parts[n], starts[n]
        rows = slice(first_span, starts[n + 1][0])
        collected = (array[rows] for array in spans)
        collect_visible(ids[first:end], left, right, first_row + first, first_fragment, *collected)

    share(collect, len(parts), starts[-1][0] + len(ids) * (right - left) // 32 >= WORTH_COLLECTING)
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
    n = np.uint64(0)
    for row in range(ids.shape[0]):
        j, column, end, last = np.uint64(row), np.uint64(first_column), np.uint64(end_column), np.int32(NO_TRIANGLE)
        while column < end:
            stop = min(column + STRIDE, end)
            if column + STRIDE <= end and ids[j, stop - NEXT] == last:
                differs = np.int32(0)
                for k in range(STRIDE):  # without a branch: one or two vectors
                    differs |= ids[j, column + k] ^ last
                if differs == 0:
                    fragment += np.int64(STRIDE) if last >= 0 else 0
                    column = stop
                    continue
            while column < stop:
                triangle = ids[j, column]
                if triangle != last:
                    last = triangle
                    if triangle >= 0:
                        rows[n], lefts[n], triangles[n], starts[n] = row + first_row, column, triangle, fragment
                        n += NEXT
                fragment += 1 if triangle >= 0 else 0
                column += NEXT
