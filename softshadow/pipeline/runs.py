"""Runs: fragments of one triangle, side by side in a row. Shading and writing take a run at a time.

What belongs to the triangle and to the row is looked up once per run, and along a long one loops are vectorised.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from softshadow.jit import kernel
from softshadow.pipeline.bands import parts_of, share
from softshadow.pipeline.fragments import Fragments
from softshadow.pipeline.lent import lent

STRIDE = 16  # pixels of a long run that are looked at together
ROWS = 128  # of a part that a thread takes


class Runs(NamedTuple):
    """Runs of fragments, one after the other:

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

    def part(self, first: int, end: int) -> Runs:
        """Return the runs from `first` to `end`, their fragments numbered from 0."""
        start = self.start[first : end + 1] - self.start[first]
        return Runs(self.row[first:end], self.left[first:end], self.triangle[first:end], start)

    def batches(self, size: int) -> np.ndarray:
        """Return where to cut (B + 1,), so that each part has about `size` fragments."""
        cuts = np.searchsorted(self.start, np.arange(0, self.fragments, size))
        return np.unique(np.append(cuts, len(self.row)))


def _empty(count: int) -> Runs:
    row, left, triangle = lent((3, count), np.int32)
    start = lent(count + 1, np.int64)
    start[0] = 0
    return Runs(row, left, triangle, start)


def visible_runs(ids: np.ndarray, first_row: int) -> Runs:
    """Return the runs of the fragments that are left per pixel.

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


def runs_of(fragments: Fragments) -> Runs:
    """Return the runs that fragments make up in their order."""
    if not len(fragments.row):
        return _empty(0)
    goes_on = np.diff(fragments.column) == 1
    for same in (fragments.row, fragments.triangle):
        goes_on &= same[1:] == same[:-1]
    first = np.flatnonzero(np.append(True, ~goes_on))
    row, column, triangle = (part[first] for part in fragments)
    return Runs(row, column, triangle, np.append(first, len(fragments.row)))


def fragments_of(runs: Runs) -> Fragments:
    """Return the fragments of runs one by one."""
    lengths = np.diff(runs.start)
    row, triangle = np.repeat(runs.row, lengths), np.repeat(runs.triangle, lengths)
    column = np.arange(runs.fragments) + np.repeat(runs.left - runs.start[:-1], lengths)
    return Fragments(row, column.astype(np.int32), triangle)


@kernel
def count_visible(ids):
    """Return how many runs there are, pixels with a triangle that the pixel left of them does not have, and pixels."""
    runs = pixels = np.int64(0)
    for row in range(ids.shape[0]):
        line = ids[row]
        begun = seen = np.int32(line[0] >= 0)
        for column in range(1, line.shape[0]):
            begun += np.int32((line[column] >= 0) & (line[column] != line[column - 1]))
            seen += np.int32(line[column] >= 0)
        runs, pixels = runs + begun, pixels + seen
    return runs, pixels


@kernel
def collect_visible(ids, first_row, at, rows, lefts, triangles, starts):
    """Write row, first column, triangle and first fragment of all runs; `at` is the number of the first one's."""
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
