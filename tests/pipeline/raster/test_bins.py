"""Bins: a band has all triangles that meet it, in drawing order."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softshadow.pipeline import set_threads, threads
from softshadow.pipeline.raster.bins import (
    BAND_ROWS,
    BANDS_PER_THREAD,
    FEW_BANDS,
    FEW_VISITS,
    MUCH_WORK,
    bands_of,
    rows_of_band,
    rows_of_few_bands,
    sort_into_bands,
    triangles_in_bands,
)
from softshadow.pipeline.raster.coverage import bounds, extent
from softshadow.pipeline.records import Region

pytestmark = pytest.mark.interpreted


def random_corners(seed: int, n: int) -> np.ndarray:
    """Return corners of triangles of positive area, in and around 100 rows."""
    rng = np.random.default_rng(seed)
    corners = rng.integers(-5000, 30000, (n, 1, 2)) + rng.integers(-3000, 3000, (n, 3, 2))
    clockwise = np.linalg.det((corners[:, 1:] - corners[:, :1]).astype(float)) < 0
    corners[clockwise] = corners[clockwise][:, ::-1]
    return np.ascontiguousarray(corners.reshape(-1, 6), np.int32)


@given(st.integers(0, 2**32 - 1), st.integers(0, 40), st.integers(0, 50), st.integers(1, 90), st.integers(1, 3))
def test_a_band_has_the_triangles_that_meet_it_in_drawing_order(seed, n, first_row, rows, band_tiles):
    corners, band_rows = random_corners(seed, n), BAND_ROWS * band_tiles
    region = Region(0, 100, first_row, first_row + rows, 1)
    parts = [(n // 4, n // 3), (n // 2, n - n // 5)]
    bins = sort_into_bands(corners, parts, region, band_rows)
    assert bands_of(region, band_rows) == len(bins.starts) - 1
    for band in range(bands_of(region, band_rows)):
        low, high = rows_of_band(band, region, band_rows)
        # a multiple of the rows of a tile, whatever the first row of the region
        begin = first_row // BAND_ROWS * BAND_ROWS + band * band_rows
        assert (low, high) == (max(begin, first_row), min(begin + band_rows, region.end_row))
        spans = [(t, *bounds(corners, t)) for part in parts for t in range(*part)]
        assert bins.of(band).tolist() == [t for t, first, last in spans if max(first, low) < min(last, high)]


@pytest.mark.parametrize("band_rows", [BAND_ROWS, BAND_ROWS * 2])  # more than two bands, and two
@pytest.mark.parametrize("n", [300, FEW_VISITS])  # times several bands: not sorted, and sorted
def test_every_triangle_is_among_those_of_each_band_that_it_meets(n, band_rows):
    corners = random_corners(7, n)
    region = Region(0, 100, 5, 96, 1)
    parts = [(0, n // 3), (n // 2, n)]
    bands = triangles_in_bands(corners, parts, region, band_rows)
    assert [row for band in bands for row in range(band.first_row, band.end_row)] == list(range(5, 96))
    own = [t for part in parts for t in range(*part)]
    rows = np.array([bounds(corners, t) for t in own])
    for numbers, low, high in bands:
        meets = np.maximum(rows[:, 0], low) < np.minimum(rows[:, 1], high)
        assert (np.diff(numbers) > 0).all()
        assert set(numbers.tolist()) <= set(own)
        assert set(np.array(own)[meets].tolist()) <= set(numbers.tolist())
        assert len(numbers) == (len(own) if n == 300 or len(bands) == FEW_BANDS else meets.sum())


@pytest.mark.parametrize("work", [0, MUCH_WORK])
@pytest.mark.parametrize("n_threads", [2, 3, 8])
@pytest.mark.parametrize("rows", [(0, 480), (207, 301), (31, 33), (40, 41), (5, 1080)])
def test_each_thread_gets_a_few_bands_that_make_up_the_region(rows, n_threads, work):
    before, region = threads(), Region(0, 100, rows[0], rows[1], 1)
    set_threads(n_threads)
    try:
        band_rows = rows_of_few_bands(region, work)
    finally:
        set_threads(before)
    bands = [rows_of_band(band, region, band_rows) for band in range(bands_of(region, band_rows))]
    assert band_rows % BAND_ROWS == 0
    assert len(bands) <= n_threads * (BANDS_PER_THREAD if work else 1)
    assert [row for low, high in bands for row in range(low, high)] == list(range(*rows))


@given(st.integers(0, 2**32 - 1), st.integers(1, 40))
def test_extent_has_the_rows_the_columns_and_the_area_of_all_triangles(seed, n):
    corners = random_corners(seed, n)
    first, end, left, right, area = extent(corners, 0, n)
    turned = corners.reshape(-1, 3, 2)[..., ::-1].reshape(-1, 6)
    for limits, places in (((first, end), corners), ((left, right), turned)):
        spans = [bounds(places, t) for t in range(n)]
        assert limits == (min(a for a, _ in spans), max(b for _, b in spans))
    points = corners.reshape(-1, 3, 2) / 256
    exact = np.abs(np.linalg.det(points[:, 1:] - points[:, :1])).sum() / 2
    assert exact - n / 256 <= area / 256 <= exact + 1e-6  # each area is rounded down to 1/256


def test_the_extent_of_no_triangles_is_empty():
    first, end, left, right, area = extent(np.empty((0, 6), np.int32), 0, 0)
    assert first >= end
    assert left >= right
    assert area == 0
