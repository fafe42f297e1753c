"""Draws that go triangle by triangle from coverage to pixels leave the bits of the ordered path."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from draws import MIXING, draw, random_triangles, same_window
from fixed_function_pictures import random_picture
from softshadow import gl
from softshadow.context import Context
from softshadow.pipeline import choose, explain_paths, set_threads, threads, use_short_cuts
from softshadow.pipeline.fast import forward, segment_groups


@pytest.fixture(autouse=True)
def _compiled(monkeypatch):
    monkeypatch.setattr(choose.SPAN_KERNELS, "pays_after", 0)


def assert_same(seed, **options):
    with explain_paths() as paths:
        window = random_picture(seed, **options)
    with use_short_cuts(False):
        assert same_window(window, random_picture(seed, **options)), seed
    return {path.fill for path in paths}


@given(st.integers(0, 2**32 - 1))
def test_blended_fragments_are_written_in_order(seed):
    assert_same(seed, ordered=True)


@given(st.integers(0, 2**32 - 1), st.booleans())
def test_the_alpha_test_decides_about_each_fragment(seed, ordered):
    assert_same(seed, ordered=ordered, tested=True)


@given(st.integers(0, 2**32 - 1))
def test_small_opaque_draws_leave_the_bits_of_the_fill(seed):
    assert_same(seed, size=(40, 30))


@given(st.integers(0, 2**32 - 1), st.booleans(), st.booleans(), st.sampled_from([1, 2]))
def test_fragments_that_pass_are_counted(seed, ordered, tested, thread_count):
    before, worth = threads(), forward.WORTH_BANDS
    try:
        set_threads(thread_count)
        forward.WORTH_BANDS = 0
        window = random_picture(seed, ordered=ordered, tested=tested, counted=True)
        with use_short_cuts(False):
            textbook = random_picture(seed, ordered=ordered, tested=tested, counted=True)
    finally:
        set_threads(before)
        forward.WORTH_BANDS = worth
    assert same_window(window, textbook), seed
    assert window.objects.queries == textbook.objects.queries, seed


def test_a_query_does_not_keep_draws_from_the_kernels():
    with explain_paths() as paths:
        counts = [random_picture(seed, counted=True, units=seed % 2).objects.queries for seed in range(12)]
    assert sum(path.fill == "span by span" for path in paths) > 6
    assert len({*map(str, counts)}) > 3


@example(675991)  # GL_ADD of texels and colours below 0
@given(st.integers(0, 2**32 - 1))
def test_bands_of_rows_keep_the_order(seed):
    before, worth = threads(), forward.WORTH_BANDS
    try:
        set_threads(2)
        forward.WORTH_BANDS = 0
        assert_same(seed, size=(30, 150), ordered=True)
    finally:
        set_threads(before)
        forward.WORTH_BANDS = worth


def work_of_rectangles(monkeypatch, width, height, n_rectangles=1, *caps):
    """Return the work of blended rectangles as it is estimated."""
    drawn, draw_rows = {}, forward.draw_rows

    def note(segments, *rest):
        drawn[id(segments)] = segments  # in bands of rows, the same ones several times
        return draw_rows(segments, *rest)

    monkeypatch.setattr(forward, "draw_rows", note)
    monkeypatch.setattr(segment_groups, "draw_rows", note)
    with gl.create_context(400, 400):
        gl.glEnable(gl.GL_BLEND)
        for cap in caps:
            gl.glEnable(cap)
        image = np.zeros((2, 2, 3), np.uint8)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGB, 2, 2, 0, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, image)
        for n in range(n_rectangles):
            gl.glRectf(-1, -1 + n / 200, -1 + width / 200, -1 + n / 200 + height / 200)
        gl.glFinish()
    return sum(segments.work for segments in drawn.values())


def test_work_grows_with_textures_rows_and_triangles_and_halves_with_a_stencil_test(monkeypatch):
    plain = work_of_rectangles(monkeypatch, 300, 300)
    assert 300 * 300 < plain < 1.2 * 300 * 300
    assert 3 * plain < work_of_rectangles(monkeypatch, 300, 300, 1, gl.GL_TEXTURE_2D) < 4 * plain
    assert work_of_rectangles(monkeypatch, 300, 300, 1, gl.GL_STENCIL_TEST) < 0.7 * plain
    assert work_of_rectangles(monkeypatch, 300, 3, 100) > 1.3 * plain  # as many fragments


def overlapping(seed):
    """Return a window after many blended triangles with depth test, most of them across each other."""
    rng = np.random.default_rng(seed)
    context = Context(200, 40, "d24")
    depth = replace(context.state.depth, enabled=True, func=gl.GL_LESS, write=bool(seed % 2))
    draw(context, replace(context.state, depth=depth, blend=MIXING), random_triangles(rng, 90))
    return context


@pytest.mark.parametrize("seed", range(4))
def test_triangles_and_spans_that_do_not_fit_at_once_go_on_afterwards(monkeypatch, seed):
    monkeypatch.setattr(forward, "TRIANGLES", 7)
    row, left, triangle = np.empty((3, 150), np.int32)
    spans = forward.Spans(row, left, triangle, np.empty(151, np.int64))
    monkeypatch.setattr(forward._lists, "spans", spans)
    window = overlapping(seed)
    with use_short_cuts(False):
        assert same_window(window, overlapping(seed))


def test_what_is_drawn_forward():
    fills = set()
    for seed in range(6):
        fills |= assert_same(seed, ordered=True)
    assert "span by span" in fills
    assert "span by span" not in assert_same(1, ordered=True, precision="exact")


def three_quads():
    """Return a window after the same quad in three frames, and the fill of each."""
    context = gl.create_context(64, 48)
    gl.glEnable(gl.GL_DEPTH_TEST)
    with explain_paths() as paths:
        for _ in range(3):
            gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
            gl.glRectf(-0.9, -0.8, 0.7, 0.9)
        gl.glFinish()
    return context, [path.fill for path in paths]


def test_a_large_quad_goes_forward_unless_it_was_drawn_before(monkeypatch):
    monkeypatch.setattr(choose, "FEW_FRAGMENTS", -1)
    window, fills = three_quads()
    assert fills[0] == "span by span"
    assert "span by span" not in fills[1:]
    with use_short_cuts(False):
        assert same_window(window, three_quads()[0])


def layers_of_rectangles(columns, rows, n_layers, textured):
    """Return a window that layers of rectangles cover, those behind last, and the fill of their only draw."""
    context = gl.create_context(64, 48)
    gl.glEnable(gl.GL_DEPTH_TEST)
    if textured:
        texels = np.arange(4 * 4 * 4, dtype=np.uint8).reshape(4, 4, 4) * 4
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, 4, 4, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
        gl.glEnable(gl.GL_TEXTURE_2D)
    with explain_paths() as paths:
        gl.glBegin(gl.GL_QUADS)
        for layer in range(n_layers):
            for j in range(rows):
                for i in range(columns):
                    gl.glColor3f(i / columns, j / rows, layer / n_layers)
                    for x, y in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                        gl.glTexCoord2f(x, y)
                        gl.glVertex3f(2 * x / columns - 1, 2 * y / rows - 1, 0.1 * layer + 0.3 * x / columns)
        gl.glEnd()
        gl.glFinish()
    (path,) = paths
    return context, path.fill


@pytest.mark.parametrize(
    ("rectangles", "goes_forward"),
    [
        ((4, 2, 1, False), True),
        ((4, 2, 2, False), False),  # neither large nor single
        ((2, 2, 2, False), True),
        ((2, 2, 4, False), False),  # too many layers
        ((20, 15, 1, False), False),  # too small
        ((2, 2, 1, True), True),
        ((2, 2, 2, True), False),  # a texture would be looked up for what is hidden
    ],
)
def test_large_triangles_that_hide_little_go_forward(monkeypatch, rectangles, goes_forward):
    monkeypatch.setattr(choose, "FEW_FRAGMENTS", -1)
    window, fill = layers_of_rectangles(*rectangles)
    assert (fill == "span by span") == goes_forward
    with use_short_cuts(False):
        assert same_window(window, layers_of_rectangles(*rectangles)[0])


@pytest.mark.interpreted
def test_the_interpreted_kernels_leave_the_bits_of_the_ordered_path():
    for seed in range(5):
        assert_same(seed, size=(12, 9), n_triangles=4, ordered=True)
        assert_same(seed, size=(12, 9), n_triangles=4, tested=True)
