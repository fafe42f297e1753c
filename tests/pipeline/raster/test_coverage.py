"""Coverage in integers: the fill rule, shared edges, invariances."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from softshadow.pipeline.fast.small_triangles import columns_of, edge_from
from softshadow.pipeline.geometry.triangle_setup import MAX_SLOPE, Offset, set_up
from softshadow.pipeline.raster.coverage import (
    FARTHEST,
    bounds,
    edge,
    narrow,
    narrow_rows,
    row_span,
    row_spans,
    triangles_at,
)  # fmt: skip
from softshadow.pipeline.raster.ordered import list_fragments
from softshadow.pipeline.records import Region, Setup
from softshadow.state import Cull
from strategies import window_fans

pytestmark = pytest.mark.interpreted

SIZE = 24
NO_OFFSET = Offset(MAX_SLOPE, np.float32(0), np.float32(0), 1)


def set_up_in_window(positions: np.ndarray, triangles: np.ndarray, flipped: bool = True) -> Setup:
    window = np.ones((len(positions), 4), np.float32)
    window[:, :2] = positions
    return set_up(window, np.asarray(triangles, np.int32), Cull(), NO_OFFSET, flipped)


def coverage(positions: np.ndarray, triangles: np.ndarray, flipped: bool = True, size: int = SIZE) -> np.ndarray:
    """Return how many triangles cover each pixel, (size, size)."""
    setup = set_up_in_window(positions, triangles, flipped)
    fragments = list_fragments(setup, Region(0, size, 0, size, int(flipped)))
    counts = np.zeros((size, size), int)
    np.add.at(counts, (fragments.row, fragments.column), 1)
    return counts


def oracle(corners: np.ndarray, flipped: bool) -> np.ndarray:
    """Return the coverage of one triangle, by the fill rule and its edges in GL's orientation (y upwards)."""
    points = np.rint((corners.astype(np.float64) - 0.5) * 256).astype(int)
    if flipped:
        points[:, 1] *= -1
    twice = np.linalg.det(np.stack([points[1] - points[0], points[2] - points[0]]))
    if abs(twice) < 0.5:
        return np.zeros((SIZE, SIZE), int)
    if twice < 0:
        points = points[::-1]
    inside = np.ones((SIZE, SIZE), bool)
    for row in range(SIZE):
        for column in range(SIZE):
            sample = np.array([256 * column, -256 * row if flipped else 256 * row])
            for i in range(3):
                edge, to = points[(i + 1) % 3] - points[i], sample - points[i]
                side = edge[0] * to[1] - edge[1] * to[0]
                left = edge[1] < 0  # counter-clockwise and downwards: the inside is to the right
                bottom = edge[1] == 0 and edge[0] > 0
                inside[row, column] &= side > 0 or (side == 0 and (left or bottom))
    return inside.astype(int)


@given(window_fans(SIZE), st.booleans())
def test_every_sample_of_a_fan_is_covered_once(fan, flipped):
    positions, triangles = fan
    counts = coverage(positions, triangles, flipped)
    assert counts.max() <= 1
    middle = np.rint((positions[0] - 0.5) * 256).astype(int)
    if (middle % 256 == 0).all():
        assert counts[middle[1] // 256, middle[0] // 256] == 1  # all spokes meet in this sample


@given(window_fans(SIZE), st.booleans(), st.integers(0, 8))
def test_coverage_follows_the_fill_rule(fan, flipped, which):
    positions, triangles = fan
    triangle = triangles[which % len(triangles)]
    np.testing.assert_array_equal(coverage(positions, triangle[None], flipped), oracle(positions[triangle], flipped))


@given(window_fans(SIZE), st.booleans())
def test_coverage_does_not_depend_on_the_first_vertex_or_the_winding(fan, flipped):
    positions, triangles = fan
    here = coverage(positions, triangles, flipped)
    np.testing.assert_array_equal(here, coverage(positions, np.roll(triangles, 1, axis=1), flipped))
    np.testing.assert_array_equal(here, coverage(positions, triangles[:, ::-1], flipped))


@given(window_fans(SIZE), st.integers(-5, 5), st.integers(-5, 5))
def test_coverage_moves_with_whole_pixels(fan, dx, dy):
    positions, triangles = fan
    size = SIZE + 16
    here = coverage(positions + np.float32(8), triangles, size=size)
    there = coverage(positions + np.float32((8 + dx, 8 + dy)), triangles, size=size)
    np.testing.assert_array_equal(np.roll(here, (dy, dx), axis=(0, 1)), there)


@given(st.integers(0, 2**32 - 1))
def test_every_sample_of_a_triangulated_grid_is_covered_once(seed):
    rng = np.random.default_rng(seed)
    n = 6
    lattice = np.stack(np.meshgrid(np.arange(n), np.arange(n)), axis=-1).reshape(-1, 2).astype(np.float32) * 4
    inner = ((lattice > 0) & (lattice < 4 * (n - 1))).all(axis=1)
    lattice[inner] += rng.integers(-8, 9, (inner.sum(), 2)) / np.float32(8)
    quads = [
        (r * n + c, r * n + c + 1, (r + 1) * n + c + 1, (r + 1) * n + c) for r in range(n - 1) for c in range(n - 1)
    ]
    triangles = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    counts = coverage(lattice + np.float32(0.5), np.array(triangles, np.int32))
    covered = np.zeros_like(counts)
    covered[1 : 4 * (n - 1) + 1, : 4 * (n - 1)] = 1  # left and bottom edges (rows grow downwards) belong to the grid
    np.testing.assert_array_equal(counts, covered)


@given(window_fans(SIZE), st.integers(0, SIZE - 1), st.integers(0, SIZE - 1))
def test_triangles_at_a_pixel_are_those_that_cover_it(fan, column, row):
    setup = set_up_in_window(*fan)
    fragments = list_fragments(setup, Region(0, SIZE, 0, SIZE, 1))
    numbers = np.empty(len(setup.ids), np.int64)
    n = triangles_at(setup.corners, column, row, 1, numbers)
    here = (fragments.row == row) & (fragments.column == column)
    assert numbers[:n].tolist() == fragments.triangle[here].tolist()


@given(window_fans(SIZE), st.booleans())
def test_edge_functions_agree_with_row_spans(fan, downwards):
    corners = set_up_in_window(*fan).corners
    for t, (x0, y0, x1, y1, x2, y2) in enumerate(corners.tolist()):
        first_column, end_column = columns_of(corners, t)
        first_row, end_row = bounds(corners, t)
        edges = [edge(*ends, downwards) for ends in ((x0, y0, x1, y1), (x1, y1, x2, y2), (x2, y2, x0, y0))]
        for row in range(first_row, end_row):
            inside = [
                column
                for column in range(first_column, end_column)
                if all(at + along * (row << 8) - across * (column << 8) >= 0 for across, along, at in edges)
            ]
            assert inside == list(range(*row_span(corners, t, row, int(downwards))))


@given(window_fans(SIZE), st.booleans(), st.integers(0, 8), st.integers(8, 16))
@example(np.array([[50048, 2304, 44160, 2560, 50048, 2560]], np.int32), False, 0, 65)  # its top edge lies in a row
def test_spans_stay_within_the_columns_of_the_region(fan, downwards, left, right):
    corners = fan if isinstance(fan, np.ndarray) else set_up_in_window(*fan).corners
    for t in range(len(corners)):
        first, end = bounds(corners, t)
        lefts, rights = np.zeros((2, max(end, 0)), np.int32)
        first = max(first, 0)
        row_spans(corners, t, first, end, int(downwards), left, right, lefts, rights)
        assert (lefts[first:end] >= left).all()
        assert (rights[first:end] <= right).all()


@given(st.integers(-(2**22), 2**22), st.integers(1, 2**24), st.integers(-3, 3), st.booleans(), st.booleans())
@example(2**20 - 1, 2**22 - 1, 0, False, False)  # the largest numbers for which floats are used
@example(3608213, 4875587, 0, False, False)  # too large for them
def test_edges_through_a_sample_in_every_row_are_exact(column, height, slope, is_left, downwards):
    """There a quotient is a whole number, or the largest that is less: nothing is closer to the next one."""
    x0, y0, across = 256 * column, 256 * 5, -height if is_left else height
    ends = x0, y0, x0 - slope * across, y0 - across
    low, high = sorted((y0 >> 8, (y0 - across) >> 8))
    first = max(low, -20)
    end = min(high, first + 40) + 1
    lefts, rights = np.empty((2, 64), np.int32)
    lefts[:], rights[:] = -FARTHEST, FARTHEST
    moved = (ends[0], ends[1] - 256 * first, ends[2], ends[3] - 256 * first)  # rows as indices, from 0 on
    narrow_rows(*moved, 0, end - first, int(downwards), lefts, rights)
    for row in range(end - first):
        expected = narrow(*moved, row, int(downwards), -FARTHEST, FARTHEST)
        within = (min(moved[1], moved[3]) + 255) >> 8 <= row <= max(moved[1], moved[3]) >> 8
        assert (lefts[row], rights[row]) == (expected if within else (-FARTHEST, FARTHEST))


@given(window_fans(SIZE), st.booleans(), st.integers(0, 2**16 - 1), st.integers(0, 2**16 - 1))
def test_edge_functions_in_32_bits_agree_with_those_in_64_bits(fan, downwards, column, row):
    corners = set_up_in_window(*fan).corners + np.tile([column << 8, row << 8], 3).astype(np.int32)
    for x0, y0, x1, y1, *_ in corners:
        across, along, at = edge(x0, y0, x1, y1, downwards)
        expected = at + along * (row << 8) - across * (column << 8), across << 8, along << 8
        first = np.int32(column << 8), np.int32(row << 8)
        assert tuple(map(int, edge_from(x0, y0, x1, y1, *first, 0 if downwards else -1))) == expected


def test_a_triangle_without_snapped_area_covers_nothing():
    line = np.array([[1.5, 1.5], [5.5, 5.5], [9.5, 9.5]], np.float32)
    assert len(set_up_in_window(line, np.array([[0, 1, 2]])).ids) == 0


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_a_triangle_with_a_coordinate_that_is_not_finite_covers_nothing(bad):
    positions = np.array([[1, 1], [9, 1], [bad, 9]], np.float32)
    assert len(set_up_in_window(positions, np.array([[0, 1, 2]])).ids) == 0
