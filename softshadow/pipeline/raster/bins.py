"""Bin triangles by row band, so that each thread visits only its own.

A counting sort: count per band, add up, write. Within a band the numbers stay in drawing order, so results are the same
for any number of threads.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from softshadow.jit import inlined, kernel
from softshadow.pipeline.memory.scratch import apart
from softshadow.pipeline.memory.threads import share, threads
from softshadow.pipeline.raster.coverage import bounds
from softshadow.pipeline.records import Region

BAND_ROWS = 32  # layers drawn over each other in a band stay in the cache
BANDS_PER_THREAD = 2  # more would balance the threads better, but a triangle is set up again in each band that it meets
MUCH_WORK = 500_000  # fragments; with fewer, a thread gets one band: to begin a second costs more than balance gains
# of triangles in bands: up to these, and in so few bands, a look at each triangle takes less time than sorting
FEW_VISITS, FEW_BANDS = 1 << 15, 2


class Band(NamedTuple):
    """The rows [first_row, end_row) of a band, and the numbers of the triangles to draw in them, in drawing order."""

    numbers: np.ndarray
    first_row: int
    end_row: int


class Bins(NamedTuple):
    """The numbers of the triangles in band b: ``numbers[starts[b] : starts[b + 1]]``."""

    starts: np.ndarray
    numbers: np.ndarray

    def of(self, band: int) -> np.ndarray:
        """Return the numbers of the triangles of one band, in drawing order."""
        return self.numbers[self.starts[band] : self.starts[band + 1]]


def rows_of_few_bands(region: Region, work: int) -> int:
    """Return how many rows a band has where each thread gets one band, or two if `work`, in fragments, is much."""
    n_bands = threads() * (BANDS_PER_THREAD if work >= MUCH_WORK else 1)
    return -(-(region.end_row - first_row_of_bands(region)) // (n_bands * BAND_ROWS)) * BAND_ROWS


def bands_of(region: Region, band_rows: int = BAND_ROWS) -> int:
    """Return the number of bands of a region."""
    return (region.end_row - 1 - first_row_of_bands(region)) // band_rows + 1


def rows_of_band(band: int, region: Region, band_rows: int) -> tuple[int, int]:
    """Return first and end row of a band, which has `band_rows`, a multiple of `BAND_ROWS`, or fewer at the ends."""
    first = first_row_of_bands(region) + band * band_rows
    return max(first, region.first_row), min(first + band_rows, region.end_row)


def first_row_of_bands(region: Region) -> int:
    """Return where the first band begins, maybe above the region: bands do not cut tiles (`fast/hierarchical_z.py`)."""
    return int(region.first_row) // BAND_ROWS * BAND_ROWS


def triangles_in_bands(
    corners: np.ndarray, parts: Sequence[tuple[int, int]], region: Region, band_rows: int
) -> list[Band]:
    """Return the bands of a region, each with the triangles in `parts` that meet it.

    Few triangles, and those of few bands, are not sorted: each band gets all; kernels skip those without rows in it.

    Parameters
    ----------
    corners : (T, 6) int32, of `Setup`
    parts : first and end numbers of triangles, in order
    """
    n_bands = bands_of(region, band_rows)
    if n_bands <= FEW_BANDS or sum(end - first for first, end in parts) * n_bands <= FEW_VISITS:
        numbers = np.concatenate([np.arange(first, end, dtype=np.int32) for first, end in parts])
        return [Band(numbers, *rows_of_band(band, region, band_rows)) for band in range(n_bands)]
    bins = sort_into_bands(corners, parts, region, band_rows)
    return [Band(bins.of(band), *rows_of_band(band, region, band_rows)) for band in range(n_bands)]


def sort_into_bands(
    corners: np.ndarray, parts: Sequence[tuple[int, int]], region: Region, band_rows: int = BAND_ROWS
) -> Bins:
    """Return the bins of the triangles in `parts`, their first and end numbers in order, for the bands of a region."""
    base, end, bands = parts[0][0], parts[-1][1], bands_of(region, band_rows)
    band_ranges, marks = np.empty((end - base, 2), np.uint16), [apart((2, bands + 1), np.int64) for _ in parts]
    rows = region, first_row_of_bands(region), band_rows
    share(lambda n: write_band_ranges(corners, *parts[n], *rows, base, band_ranges, marks[n]), len(parts))
    counts = np.cumsum([begun - ended for begun, ended in marks], axis=1)[:, :-1]
    # sums over bands, and in a band over parts: so a band keeps the drawing order
    end_places = np.cumsum(counts.T).reshape(counts.T.shape).T
    places = [apart(bands, np.int64) for _ in parts]
    for own, first_places in zip(places, end_places - counts, strict=True):
        own[:] = first_places
    starts = np.append(places[0], end_places[-1, -1])
    numbers = np.empty(starts[-1], np.int32)
    share(lambda n: write_numbers(*parts[n], base, band_ranges, places[n], numbers), len(parts))
    return Bins(starts, numbers)


@inlined
def band_range(corners, t, region, first_row, band_rows):
    """Return first and end band of a triangle (end exclusive); the range is empty where it meets none."""
    first, end = bounds(corners, t)
    first, end = max(first, region.first_row), min(end, region.end_row)
    if first >= end:
        return 0, 0
    return (first - first_row) // band_rows, (end - 1 - first_row) // band_rows + 1


@kernel
def write_band_ranges(corners, begin, end, region, first_row, band_rows, base, band_ranges, marks):
    """Write first and end band of each triangle to `band_ranges`, with `base` in row 0; count both in `marks`.

    marks (2, bands + 1): how many triangles begin with a band, and how many end before it. So no loop over the bands of
    a triangle is needed; most triangles meet one band.
    """
    marks[:] = 0
    for number in range(begin, end):
        t = np.uint64(number)  # unsigned: no wrap-around of negative indices is compiled in
        first_band, end_band = band_range(corners, t, region, first_row, band_rows)
        row = np.uint64(number - base)
        band_ranges[row, 0], band_ranges[row, 1] = first_band, end_band
        marks[0, np.uint64(first_band)] += 1
        marks[1, np.uint64(end_band)] += 1


@kernel
def write_numbers(begin, end, base, band_ranges, places, numbers):
    """Append the number of each triangle to its bands; `places` (bands,) is where each band continues."""
    for number in range(begin, end):
        row = np.uint64(number - base)
        for band in range(int(band_ranges[row, 0]), int(band_ranges[row, 1])):
            place = places[np.uint64(band)]
            numbers[np.uint64(place)] = number
            places[np.uint64(band)] = place + 1
