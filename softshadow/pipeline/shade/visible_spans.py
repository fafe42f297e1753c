"""Spans: fragments of one triangle, side by side in a row. Shading and writing take a run at a time.

What belongs to the triangle and to the row is looked up once per run, and along a long one loops are vectorised.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from softshadow.jit import kernel
from softshadow.pipeline.memory.scratch import scratch
from softshadow.pipeline.memory.threads import parts_of, share
from softshadow.pipeline.raster.ordered import Fragments

STRIDE = 16  # pixels of a long run that are looked at together
ROWS = 128  # of a part that a thread takes


class Spans(NamedTuple):
    """Spans of fragments, one after the other:

    Row and first column (R,) int32 of the stored planes; triangle (R,) int32, a row of `Setup`; start (R + 1,) int64,
    the number of each run's first fragment, and last how many fragments there are.
    """

    row: np.ndarray
    left: np.ndarray
    triangle: np.ndarray
    start: np.ndarray

    @property
    def fragments(self) -> int:
        """How many fragments there are."""
        return int(self.start[-1])

    def part(self, first: int, end: int) -> Spans:
        """Return the spans from `first` to `end`, their fragments numbered from 0."""
        start = self.start[first : end + 1] - self.start[first]
        return Spans(self.row[first:end], self.left[first:end], self.triangle[first:end], start)

    def chunks(self, size: int) -> np.ndarray:
        """Return where to cut (B + 1,), so that each part has about `size` fragments."""
        cuts = np.searchsorted(self.start, np.arange(0, self.fragments, size))
        return np.unique(np.append(cuts, len(self.row)))


def _empty(count: int) -> Spans:
    row, left, triangle = scratch((3, count), np.int32)
    start = scratch(count + 1, np.int64)
    start[0] = 0
    return Spans(row, left, triangle, start)


def visible_spans(ids: np.ndarray, first_row: int) -> Spans:
    """Return the spans of the fragments that are left per pixel.

    Parameters
    ----------
    ids : (rows, pitch) int32, the triangle of each pixel or -1
    first_row : of the stored planes, which row 0 of `ids` is
    """
    parts = parts_of(len(ids), ROWS)
    counts = share(lambda n: count_visible(ids[slice(*parts[n])]), len(parts))
    places = np.cumsum([(0, 0), *counts], axis=0)  # the first run and the first fragment of each part
    made = _empty(places[-1, 0])

    def collect(n: int) -> None:
        (first, end), (run, at) = parts[n], places[n]
        own = slice(run, places[n + 1, 0])
        collect_visible(ids[first:end], first_row + first, at, *(array[own] for array in made))

    share(collect, len(parts))
    made.start[-1] = places[-1, 1]
    return made


def spans_of(fragments: Fragments) -> Spans:
    """Return the spans that fragments make up in their order."""
    if not len(fragments.row):
        return _empty(0)
    goes_on = np.diff(fragments.column) == 1
    for same in (fragments.row, fragments.triangle):
        goes_on &= same[1:] == same[:-1]
    first = np.flatnonzero(np.append(True, ~goes_on))
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
    """Return how many spans there are, pixels with a triangle that the pixel left of them does not have, and pixels."""
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
    """Write row, first column, triangle and first fragment of all spans; `at` is the number of the first one's."""
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
