"""Small draws of several states, drawn by one call, leave the bits of draws carried out one by one."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from draws import same_window
from softshadow import gl
from softshadow.context import Context
from softshadow.pipeline import choose, set_threads, threads, use_short_cuts
from softshadow.pipeline.fast import forward, segment_groups
from softshadow.pipeline.fast.batch import segments

SIZE = 72
seeds = st.integers(0, 2**32 - 1)


@pytest.fixture(autouse=True)
def groups(monkeypatch):
    """How many segments and triangles each group has that is drawn."""
    monkeypatch.setattr(choose.SPAN_KERNELS, "pays_after", 0)
    drawn, draw = [], segment_groups.Group.draw

    def note(group: segment_groups.Group) -> None:
        drawn.append((len(group._rows), group._n_triangles))
        draw(group)

    monkeypatch.setattr(segment_groups.Group, "draw", note)
    return drawn


def numbers(rng, count, low=-1, high=1):
    return rng.uniform(low, high, count).tolist()


def one_of(rng, *values):
    return int(rng.choice(values))


def switch(rng, cap, p=0.5):
    (gl.glEnable if rng.random() < p else gl.glDisable)(cap)


def make_textures(rng, count):
    for texture in range(1, count + 1):
        gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, one_of(rng, gl.GL_NEAREST, gl.GL_LINEAR))
        image = rng.integers(0, 256, (4, 8, 4), np.uint8)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, 8, 4, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, image)


def make_target(size):
    """Make framebuffer object 1 with a colour texture and a depth buffer."""
    gl.glGenFramebuffers(1)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, 99)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, size, size, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, None)
    gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, 99, 0)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)


def change_something(rng, textures):
    kind = int(rng.integers(10))
    if kind == 0:
        switch(rng, gl.GL_SCISSOR_TEST)
        gl.glScissor(*rng.integers(0, SIZE, 4).tolist())
    elif kind == 1:
        switch(rng, gl.GL_BLEND)
        gl.glBlendFunc(one_of(rng, gl.GL_ONE, gl.GL_SRC_ALPHA), one_of(rng, gl.GL_ONE, gl.GL_ONE_MINUS_SRC_ALPHA))
    elif kind == 2:
        switch(rng, gl.GL_STENCIL_TEST)
        gl.glStencilFunc(one_of(rng, gl.GL_NOTEQUAL, gl.GL_LEQUAL), one_of(rng, 0, 1, 2), 255)
        gl.glStencilOp(gl.GL_KEEP, one_of(rng, gl.GL_KEEP, gl.GL_INVERT), one_of(rng, gl.GL_INCR, gl.GL_DECR_WRAP))
    elif kind == 3:
        gl.glDepthMask(bool(rng.integers(2)))
        gl.glDepthFunc(one_of(rng, gl.GL_LESS, gl.GL_LEQUAL, gl.GL_GREATER, gl.GL_ALWAYS))
    elif kind == 4:
        gl.glColorMask(*(rng.random(4) < 0.7).tolist())
    elif kind == 5:
        switch(rng, gl.GL_ALPHA_TEST)
        gl.glAlphaFunc(gl.GL_GREATER, float(rng.random()))
    elif kind == 6:
        switch(rng, gl.GL_TEXTURE_2D, 0.8)
    elif kind == 7:
        switch(rng, gl.GL_DEPTH_CLAMP, 0.3)
        switch(rng, gl.GL_POLYGON_STIPPLE, 0.2)
    elif kind == 8:
        gl.glViewport(*rng.integers(-4, SIZE, 2).tolist(), *rng.integers(1, SIZE, 2).tolist())
        gl.glDepthRange(*rng.random(2).tolist())
    else:
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, one_of(rng, 0, 0, 0, 1))
    gl.glBindTexture(gl.GL_TEXTURE_2D, one_of(rng, *range(1, textures + 1)))


def small_draws(seed, count=40, textures=20, size=SIZE):
    """Return a context after many small draws, with a change of the state before each; queries count some of them."""
    rng = np.random.default_rng(seed)
    context = gl.create_context(size, size, depth_format=str(rng.choice(["d24", "d32f"])))
    make_textures(rng, textures)
    make_target(size)
    gl.glPolygonStipple(rng.integers(0, 256, 128, np.uint8))
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
    gl.glEnable(gl.GL_DEPTH_TEST)
    for _ in range(count):
        change_something(rng, textures)
        gl.glColor4f(*numbers(rng, 4, 0))
        mode, corners = [(gl.GL_QUADS, 4), (gl.GL_TRIANGLES, 6), (gl.GL_LINE_LOOP, 3), (gl.GL_POINTS, 5)][
            int(rng.choice(4, p=(0.5, 0.3, 0.1, 0.1)))
        ]
        is_counted = rng.random() < 0.4
        if is_counted:
            gl.glBeginQuery(gl.GL_SAMPLES_PASSED, int(rng.integers(1, 20)))
        gl.glBegin(mode)
        for _ in range(corners):
            gl.glTexCoord2f(*numbers(rng, 2, -1, 2))
            gl.glVertex3f(*numbers(rng, 3, -1.1, 1.1))
        gl.glEnd()
        if is_counted:
            gl.glEndQuery(gl.GL_SAMPLES_PASSED)
    gl.glFinish()
    return context


def assert_same_windows(seed, **options):
    with use_short_cuts(False):
        expected = small_draws(seed, **options)
    window = small_draws(seed, **options)
    assert same_window(window, expected), seed
    assert window.storage.queries == expected.storage.queries, seed
    images = [each.storage.framebuffers[1].attachments for each in (window, expected)]
    assert all(images[0][key].image.same_as(images[1][key].image) for key in images[0]), seed


@given(seeds)
def test_groups_of_draws_leave_the_bits_of_single_draws(seed):
    assert_same_windows(seed)


def test_most_of_these_draws_are_in_groups(groups):
    small_draws(7)
    assert sum(count for count, _ in groups if count > 1) > 20


def polygons_lines_and_points():
    """Return a window after a rectangle, a line, a rectangle and a point, all of which overlap."""
    context = gl.create_context(SIZE, SIZE)
    for n, (mode, count) in enumerate([(gl.GL_QUADS, 4), (gl.GL_LINES, 2), (gl.GL_QUADS, 4), (gl.GL_POINTS, 1)]):
        gl.glColor3f(n / 3, 1 - n / 3, 0.5)
        gl.glPointSize(5)
        gl.glBegin(mode)
        for x, y in [(0, 0), (0.9, 0.2), (0.8, 0.9), (-0.5, 0.6)][:count]:
            gl.glVertex2f(x - n / 4, y)
        gl.glEnd()
    gl.glFinish()
    return context


def test_a_line_and_a_point_are_in_one_group_with_polygons(groups):
    with use_short_cuts(False):
        expected = polygons_lines_and_points()
    assert same_window(polygons_lines_and_points(), expected)
    assert groups == [(4, 8)]


def test_batches_that_may_join_others_are_counted():
    assert segments.COUNTED == choose.MANY_TRIANGLES


def test_draws_of_several_queries_are_in_one_group(groups):
    with gl.create_context(SIZE, SIZE) as context:
        for query in range(1, 6):
            gl.glBeginQuery(gl.GL_SAMPLES_PASSED, query)
            gl.glRecti(-1, -1, 1, 1)
            gl.glEndQuery(gl.GL_SAMPLES_PASSED)
            gl.glRecti(0, 0, 1, 1)
        gl.glFinish()
    assert [count for count, _ in groups] == [10]
    assert context.storage.queries == dict.fromkeys(range(1, 6), SIZE * SIZE)


def large_draws(blended: bool) -> Context:
    """Return a window after three rectangles with scissor boxes of their own."""
    context = gl.create_context(SIZE, SIZE)
    (gl.glEnable if blended else gl.glDisable)(gl.GL_BLEND)
    gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
    gl.glEnable(gl.GL_SCISSOR_TEST)
    for n in range(3):
        gl.glScissor(n, 0, SIZE - 3 * n, SIZE)
        gl.glColor4f(n / 3, 0.5, 1 - n / 4, 0.4)
        gl.glRectf(-1, -1 + n / 5, 1, 1)
    gl.glFinish()
    return context


def test_large_draws_in_order_are_in_one_group_but_opaque_ones_are_not(monkeypatch, groups):
    monkeypatch.setattr(choose, "FEW_FRAGMENTS", SIZE)
    for blended in (True, False):
        with use_short_cuts(False):
            expected = large_draws(blended)
        assert same_window(large_draws(blended), expected)
    assert groups == [(3, 6)]


def test_groups_with_large_draws_leave_the_bits_of_single_draws(monkeypatch, groups):
    monkeypatch.setattr(choose, "FEW_FRAGMENTS", 300)
    for seed in range(20):
        assert_same_windows(seed)
    assert max(count for count, _ in groups) > 3


@pytest.mark.parametrize(("limit", "most"), [("SEGMENTS", 3), ("TEXTURES", 3), ("TRIANGLES", 6)])
def test_a_group_ends_where_its_tables_are_full(monkeypatch, groups, limit, most):
    monkeypatch.setattr(segment_groups, limit, most)
    for seed in range(12):
        assert_same_windows(seed)
    counts, n_triangles = zip(*groups, strict=True)
    assert limit != "SEGMENTS" or max(counts) == most
    assert limit != "TRIANGLES" or sum(n > most for n in n_triangles) == sum(
        count == 1 and n > most for count, n in groups
    )


@example(0)
@given(seeds)
def test_threads_share_bands_of_rows_of_a_group(seed):
    before, worth = threads(), forward.WORTH_BANDS
    try:
        set_threads(2)
        forward.WORTH_BANDS = 0
        assert_same_windows(seed, count=25)
    finally:
        set_threads(before)
        forward.WORTH_BANDS = worth


def lit_again(func) -> Context:
    """Return a window after a surface, small draws over it, the first under `func`, and the surface once more."""
    context = gl.create_context(SIZE, SIZE)
    surface = np.random.default_rng(1).uniform(-1, 1, (400, 3)).astype(np.float32).repeat(3, axis=0)
    surface += np.tile(np.array([[0, 0, 0], [0.3, 0, 0.1], [0, 0.3, -0.1]], np.float32), (400, 1))
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, surface)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glColor4f(0.2, 0.3, 0.4, 1)
    gl.glDrawArrays(gl.GL_TRIANGLES, 0, len(surface))
    gl.glFinish()
    for n in range(3):
        gl.glDepthFunc(gl.GL_LESS if n else func)
        gl.glScissor(0, 0, SIZE - n, SIZE)
        gl.glColor4f(n / 3, 1, 0, 1)
        gl.glRectf(-0.5 + 0.3 * n, -0.5, 0.2 + 0.3 * n, 0.5)
    gl.glDepthFunc(gl.GL_LEQUAL)
    gl.glDepthMask(False)
    gl.glEnable(gl.GL_BLEND)
    gl.glBlendFunc(gl.GL_ONE, gl.GL_ONE)
    gl.glDrawArrays(gl.GL_TRIANGLES, 0, len(surface))
    gl.glFinish()
    return context


@pytest.mark.parametrize("func", [gl.GL_LESS, gl.GL_ALWAYS, gl.GL_GREATER])
def test_a_surface_below_small_draws_is_known_only_if_they_make_no_depth_larger(func):
    with use_short_cuts(False):
        expected = lit_again(func)
    assert same_window(lit_again(func), expected)


@pytest.mark.interpreted
@pytest.mark.parametrize("seed", range(3))
def test_the_interpreted_kernels_leave_the_bits_of_single_draws(seed):
    assert_same_windows(seed, count=8, size=16)
