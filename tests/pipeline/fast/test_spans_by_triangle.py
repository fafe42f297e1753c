"""Spans of small triangles are shaded triangle by triangle: the same spans, in another order."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softshadow.pipeline.fast.fixed_function_spans import LONG_SPAN, spans_by_triangle
from softshadow.pipeline.records import Region, Spans
from softshadow.pipeline.shade.interpolate import AttributePlanes, number_triangles
from softshadow.pipeline.shade.visible_spans import fragments_of, visible_spans

SIDE = 24


def planes_for(spans: Spans, n_triangles: int) -> AttributePlanes:
    """Return planes of no values for the triangles of spans."""
    place, needed = np.empty((2, n_triangles), np.int32)
    n_needed = number_triangles(spans.triangle, place, needed)
    return AttributePlanes(np.zeros((n_needed, 3, 1), np.float32), place)


def listed(spans: Spans) -> set[tuple[int, int, int]]:
    """Return row, column and triangle of all fragments."""
    fragments = fragments_of(spans)
    return set(zip(fragments.row.tolist(), fragments.column.tolist(), fragments.triangle.tolist(), strict=True))


def spans_of_grid(rng: np.random.Generator, n_triangles: int, width: int) -> Spans:
    """Return the visible spans of squares of random triangles, `width` pixels wide."""
    squares = rng.integers(-1, n_triangles, (SIDE // 3, SIDE), dtype=np.int32)
    ids = np.repeat(np.repeat(squares, 3, axis=0), width, axis=1)
    return visible_spans(ids, Region(0, ids.shape[1], 0, len(ids), 0))


@given(st.integers(0, 2**32 - 1), st.integers(1, 40))
def test_the_same_spans_are_sorted_by_triangle(seed, n_triangles):
    spans = spans_of_grid(np.random.default_rng(seed), n_triangles, 2)
    planes = planes_for(spans, n_triangles)
    by_triangle = spans_by_triangle(spans, planes)
    assert listed(by_triangle) == listed(spans)
    assert by_triangle.fragments == spans.fragments
    order = np.argsort(planes.place[spans.triangle], kind="stable")
    for array, expected in zip(by_triangle[:3], spans[:3], strict=True):
        assert np.array_equal(array, expected[order] if len(spans.row) >= 2 * len(planes.values) else expected)


@pytest.mark.parametrize(("width", "is_sorted"), [(1, True), (LONG_SPAN // 2, True), (LONG_SPAN, False)])
def test_long_spans_keep_their_order(width, is_sorted):
    spans = spans_of_grid(np.random.default_rng(1), 5, width)
    by_triangle = spans_by_triangle(spans, planes_for(spans, 5))
    assert (by_triangle is not spans) == is_sorted
    if is_sorted:
        assert (np.diff(by_triangle.triangle) != 0).sum() == 4


def test_triangles_of_one_span_each_keep_their_order():
    row, left, triangle = np.array([[0, 1, 2], [0, 0, 0], [2, 1, 0]], np.int32)
    spans = Spans(row, left, triangle, np.array([0, 1, 2, 3]))
    assert spans_by_triangle(spans, planes_for(spans, 3)) is spans
