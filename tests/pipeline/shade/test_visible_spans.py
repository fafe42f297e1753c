"""Spans of fragments: found in ids, cut into chunks, interpolated and written."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softshadow import tokens as gl
from softshadow.image import FORMATS, Image
from softshadow.pipeline import set_threads, threads
from softshadow.pipeline.records import NO_TRIANGLE, Region, Setup, Spans
from softshadow.pipeline.shade import interpolate as interpolation
from softshadow.pipeline.shade import visible_spans as visible_spans_module
from softshadow.pipeline.shade.color_writes import color_writer
from softshadow.pipeline.shade.interpolate import LONG_SPAN, interpolate, planes_of
from softshadow.pipeline.shade.visible_spans import BandsOfIds, fragments_of, spans_of, visible_spans
from softshadow.state import Blend, State

pytestmark = pytest.mark.interpreted
SIZE = 24


def random_ids(seed):
    """Return ids of triangles 0 to 2, and -1 for none, in pieces of a few pixels."""
    rng = np.random.default_rng(seed)
    return np.repeat(rng.integers(-1, 3, (5, SIZE // 2), dtype=np.int32), rng.integers(1, 4, SIZE // 2), axis=1)


def spans_in(ids, first_row=0):
    """Return the spans in all columns of ids."""
    return visible_spans(ids, Region(0, ids.shape[1], first_row, first_row + len(ids), 0))


def span_or_pixels(long):
    """Return one long span of a triangle, or the same pixels as spans of one pixel each."""
    n = LONG_SPAN + 5
    if long:
        row, left, start = np.array([3]), np.array([2]), np.array([0, n])
    else:
        row, left, start = np.full(n, 3), np.arange(2, 2 + n), np.arange(n + 1)
    return Spans(row.astype(np.int32), left.astype(np.int32), np.zeros(len(row), np.int32), start)


@given(st.integers(0, 2**32 - 1))
def test_spans_are_the_visible_pixels(seed):
    ids = random_ids(seed)
    spans = spans_in(ids, 7)
    row, column, triangle = fragments_of(spans)
    assert np.array_equal(np.stack([row - 7, column]), np.nonzero(ids >= 0))
    assert np.array_equal(triangle, ids[row - 7, column])
    spans_again = spans_of(fragments_of(spans))
    assert all(np.array_equal(a, b) for a, b in zip(spans, spans_again, strict=True))


@given(st.integers(0, 2**32 - 1), st.integers(0, SIZE // 2), st.integers(0, SIZE // 2))
def test_spans_outside_of_the_columns_of_the_region_are_left_out(seed, left, right):
    ids = random_ids(seed)
    cut = ids.copy()
    cut[:, :left] = cut[:, max(left, right) :] = -1
    spans = visible_spans(ids, Region(left, max(left, right), 7, 7 + len(ids), 0))
    assert all(np.array_equal(a, b) for a, b in zip(spans, spans_in(cut, 7), strict=True))


def on_threads(n, function, *arguments):
    before = threads()
    set_threads(n)
    try:
        return function(*arguments)
    finally:
        set_threads(before)


@pytest.mark.parametrize("rows", [1, 3, SIZE])
def test_parts_of_the_rows_have_the_same_spans_as_all_rows(monkeypatch, rows):
    monkeypatch.setattr(visible_spans_module, "PIXELS_PER_PART", rows * SIZE)
    for name in ("WORTH_SHARING", "WORTH_COLLECTING"):
        monkeypatch.setattr(visible_spans_module, name, 0)
    for seed in range(20):
        at_once, in_parts = (on_threads(n, spans_in, random_ids(seed), 7) for n in (1, 3))
        assert all(np.array_equal(a, b) for a, b in zip(in_parts, at_once, strict=True))


@pytest.mark.parametrize("at_a_time", [1, 2])
def test_planes_are_the_same_when_computed_in_parts(monkeypatch, at_a_time):
    monkeypatch.setattr(interpolation, "TRIANGLES_PER_TASK", at_a_time)
    rng, triangles = np.random.default_rng(1), 3
    window, values = rng.normal(size=(9, 4)).astype(np.float32), rng.normal(size=(9, 5)).astype(np.float32)
    vertices, flat = rng.permutation(9).reshape(triangles, 3).astype(np.int32), np.arange(5) == 2
    setup = Setup(
        np.zeros((triangles, 6), np.int32),
        vertices,
        np.zeros((triangles, 4), np.float32),
        np.array([1, 0, 1], np.uint8),
        np.array([2, 0, 1], np.int32),
    )
    provoking, spans = np.array([4, 8, 1], np.int32), spans_in(random_ids(5))
    arguments = spans, setup, window, values, -values, flat, provoking
    at_once, in_parts = (on_threads(n, planes_of, *arguments) for n in (1, 3))
    assert len(at_once.values) == triangles
    assert all(np.array_equal(a, b) for a, b in zip(in_parts, at_once, strict=True))


@given(st.integers(0, 2**32 - 1), st.integers(1, 30))
def test_the_parts_of_all_chunks_make_up_the_spans(seed, size):
    spans = spans_in(random_ids(seed))
    parts = [spans.part(first, end) for first, end in pairwise(spans.chunks(size))]
    together = [np.concatenate(fields) for fields in zip(*map(fragments_of, parts), strict=True)] if parts else []
    assert all(np.array_equal(a, b) for a, b in zip(together, fragments_of(spans), strict=bool(parts)))
    assert sum(part.fragments for part in parts) == spans.fragments
    assert all(part.fragments <= size + 3 * SIZE for part in parts)


@given(st.integers(0, 2**32 - 1), st.randoms(), st.booleans())
def test_ids_that_are_found_in_bands_have_the_spans_of_all_rows(seed, random, in_bands):
    ids, first_row = random_ids(seed), 11
    region, shaded = Region(0, ids.shape[1], first_row, first_row + len(ids), 0), []
    bands = BandsOfIds(region, ids.shape[1], shaded.append if in_bands else None)
    cuts = sorted({0, len(ids), *(random.randint(0, len(ids)) for _ in range(3))})
    rows = [(first + first_row, end + first_row) for first, end in pairwise(cuts)]
    random.shuffle(rows)  # threads take bands in any order
    for first, end in rows:
        bands.clear(first, end)
        within = slice(first - first_row, end - first_row)
        assert (bands.ids[within] == NO_TRIANGLE).all()
        bands.ids[within] = ids[within]
        bands.finish(first, end)
    expected, spans = spans_in(ids, first_row), bands.spans()
    assert spans.are_shaded == in_bands
    assert all(np.array_equal(a, b) for a, b in zip(spans.joined, expected, strict=True))
    assert [each.row.min() for each in shaded if len(each.row)] == [
        expected.row[(expected.row >= first) & (expected.row < end)][0] for first, end in rows
        if in_bands and ((expected.row >= first) & (expected.row < end)).any()
    ]  # fmt: skip


@given(st.integers(0, 2**32 - 1), st.integers(1, 9), st.integers(0, 20))
def test_equal_parts_make_up_the_spans_and_differ_by_a_span_at_most(seed, n_parts, beginning):
    spans = spans_in(random_ids(seed))
    parts = spans.equal_parts(n_parts, beginning)
    assert [span for first, end in parts for span in range(first, end)] == list(range(len(spans.row)))
    assert len(parts) <= n_parts
    work = np.diff(spans.start) + beginning
    most = work.sum() / n_parts + 2 * work.max(initial=0)  # a span lies in one part, whose ends are cut between spans
    assert all(first < end and work[first:end].sum() <= most + 1 for first, end in parts)


def test_no_fragments_have_no_spans():
    spans = spans_in(np.full((2, 3), -1, np.int32))
    assert spans.fragments == 0
    assert len(spans.chunks(10)) == 1
    assert spans.equal_parts(3, 16) == []
    assert spans_of(fragments_of(spans)).fragments == 0


@pytest.mark.parametrize("real", [np.float32, np.float64])
def test_a_long_span_is_interpolated_like_its_pixels(real):
    rng = np.random.default_rng(1)
    planes, flat = rng.normal(size=(1, 3, 5)).astype(real), np.array([False, True, False, False])
    values = []
    for long in (True, False):
        out = np.zeros((5, LONG_SPAN + 5), real)
        columns = np.arange(64, dtype=real)
        interpolate(planes, np.zeros(1, np.int32), *span_or_pixels(long), columns, flat, out)
        values.append(out[:4])
    assert np.array_equal(*values)
    assert (values[0][1] == planes[0, 0, 1]).all()
    assert len(np.unique(values[0][0])) == LONG_SPAN + 5


@pytest.mark.parametrize("internal", [gl.GL_RGBA8, gl.GL_RGB8, gl.GL_RGBA32F])
@pytest.mark.parametrize("adding", [False, True])
@pytest.mark.parametrize("mask", [(True,) * 4, (True, False, True, False), (False,) * 4])
def test_a_span_is_written_under_the_color_mask(mask, adding, internal):
    rng = np.random.default_rng(2)
    image = Image.new(FORMATS[internal], 32, 4, internal)
    image.cells[..., :3] = rng.integers(0, 256, image.cells[..., :3].shape)
    before, spans = image.cells.copy(), span_or_pixels(long=True)
    ones = Blend(adding, gl.GL_ONE, gl.GL_ONE, gl.GL_ONE, gl.GL_ONE)
    state = replace(State(), blend=ones, color=replace(State().color, mask=mask))
    colors = rng.uniform(-1, 2, (spans.fragments, 4)).astype(np.float32)
    color_writer(state, image)(spans, colors)
    source = colors
    if image.format.kind == "unorm8":
        source = np.rint(colors.clip(0, 1) * np.float32(255))
    expected, pixels = before.copy(), np.s_[3, 2 : 2 + spans.fragments]
    blended = source + before[pixels] if adding else source
    if image.format.kind == "unorm8":
        blended = blended.clip(0, 255)
    written_channels = np.array(mask) & np.array(image.format.written)
    expected[pixels] = np.where(written_channels, blended, before[pixels])
    assert np.array_equal(image.cells, expected)
    assert np.array_equal(before, expected) != any(mask)
