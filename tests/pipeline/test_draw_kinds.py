"""Kinds of draws that wait: what is kept of a state for the draws that follow, and when it is forgotten."""

from collections.abc import Callable
from functools import partial

import numpy as np
import pytest

from pipeline.small_draws import SIZE, draw_triangle, load_texture
from softshadow import gl
from softshadow.context import Context
from softshadow.pipeline import draw_kinds, use_short_cuts


def has_bits_of_single_draws(drawn: Callable[[], Context]) -> bool:
    """Return whether a program leaves the same buffers as without short cuts."""

    def buffers() -> list[bytes]:
        context = drawn()
        gl.glFinish()
        return [each.image.view.tobytes() for each in context.storage.window.attachments.values()]

    with use_short_cuts(False):
        expected = buffers()
    return buffers() == expected


def test_buffers_and_attachments_of_one_shape_need_no_new_plan(planned):
    gl.create_context(SIZE, SIZE)
    load_texture(1, 10)
    load_texture(2, 20)
    framebuffer = gl.glGenFramebuffers(1)
    for _ in range(3):
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, framebuffer)
        for texture in (1, 2):
            gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, texture, 0)
            gl.glDrawBuffer(gl.GL_COLOR_ATTACHMENT0)
            draw_triangle()
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
        gl.glDrawBuffer(gl.GL_FRONT)
        gl.glReadBuffer(gl.GL_FRONT)
        draw_triangle()
    gl.glFinish()
    assert len(planned) == 2  # of the framebuffer, and of the window
    gl.glDrawBuffer(gl.GL_NONE)
    draw_triangle()
    gl.glFinish()
    assert len(planned) == 3


def test_kinds_are_forgotten_with_their_texture_or_framebuffer(planned):
    gl.create_context(SIZE, SIZE)
    framebuffer = gl.glGenFramebuffers(1)

    def draw_with_each() -> int:
        planned.clear()
        for name in (1, 2):
            gl.glEnable(gl.GL_TEXTURE_2D)
            gl.glBindTexture(gl.GL_TEXTURE_2D, name)
            draw_triangle()
        gl.glDisable(gl.GL_TEXTURE_2D)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, framebuffer)
        draw_triangle()
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
        gl.glFinish()
        return len(planned)

    for name in (1, 2, 3, 4):
        load_texture(name, 10)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, framebuffer)
    gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, 3, 0)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
    assert draw_with_each() == 3
    load_texture(4, 1)
    load_texture(1, 20)
    gl.glDeleteTextures([4])
    assert draw_with_each() == 0, "other textures, and other texels of the same size, change nothing"
    gl.glBindTexture(gl.GL_TEXTURE_2D, 1)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGB, 1, 1, 0, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, b"abc")
    assert draw_with_each() == 1
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, framebuffer)
    gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, 0, 0)
    gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, 3, 0)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
    assert draw_with_each() == 1
    load_texture(3, 0)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGB, 1, 1, 0, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, b"abc")
    assert draw_with_each() == 3, "draws to a texture depend on its size"


def test_draws_in_many_scissor_boxes_are_of_one_kind_and_fill_their_own_box(planned):
    gl.create_context(SIZE, SIZE)
    gl.glEnable(gl.GL_SCISSOR_TEST)
    expected = np.zeros((SIZE, SIZE, 4), np.uint8)
    for frame in range(2):
        for n in range(16):
            x, y = 8 * (n % 4) + frame, 8 * (n // 4)
            gl.glScissor(x, y, 6, 5)
            gl.glColor4ub(10 * n, frame, 7, 255)
            gl.glBegin(gl.GL_POLYGON)
            for corner in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                gl.glVertex2f(*corner)
            gl.glEnd()
            expected[y : y + 5, x : x + 6] = 10 * n, frame, 7, 255
        gl.glFinish()
    image = np.array(gl.glReadPixels(0, 0, SIZE, SIZE, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE))
    np.testing.assert_array_equal(image.reshape(SIZE, SIZE, 4), expected)
    assert len(planned) == 1


@pytest.mark.parametrize("mode", [gl.GL_QUADS, gl.GL_LINE_LOOP, gl.GL_POINTS])
def test_draws_in_many_viewports_are_of_one_kind_and_fill_their_own_one(planned, batches, mode):
    gl.create_context(SIZE, SIZE)
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glDepthFunc(gl.GL_ALWAYS)
    views = [(8 * (n % 4), 8 * (n // 4), n) for n in range(16)]
    for x, y, n in views:  # half of the viewports cut corners off: those get new vertices
        gl.glViewport(x, y, 8, 8)
        gl.glDepthRange(0, n / 16)
        gl.glColor4ub(10 * n, 0, 7, 255)
        far = 3 if n % 2 else 0.9
        gl.glBegin(mode)
        for corner in ((-far, -far), (far, -far), (far, far), (-far, far), (0, 0)):
            gl.glVertex3f(*corner, 1)
        gl.glEnd()
    gl.glFinish()
    depth = np.array(gl.glReadPixels(0, 0, SIZE, SIZE, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT)).reshape(SIZE, SIZE)
    image = np.array(gl.glReadPixels(0, 0, SIZE, SIZE, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)).reshape(SIZE, SIZE, 4)
    for x, y, n in views:
        own = depth[y : y + 8, x : x + 8]
        assert set(own.ravel()) - {1} == {np.float32(round(n / 16 * (2**24 - 1)) / (2**24 - 1))}
        assert set(image[y : y + 8, x : x + 8][own != 1, 0]) == {10 * n}
    assert len(planned) == 1
    assert batches == [16]


@pytest.mark.parametrize("cap", [None, gl.GL_POINT_SMOOTH, gl.GL_POINT_SPRITE])
@pytest.mark.parametrize("attenuation", [(1, 0, 0), (0.2, 0.1, 0)])
@pytest.mark.parametrize("limits", [(0, 60), (3, 5)])
def test_points_of_many_sizes_are_one_batch_with_the_bits_of_single_draws(planned, batches, cap, attenuation, limits):
    def drawn() -> Context:
        context = gl.create_context(SIZE, SIZE)
        if cap:
            gl.glEnable(cap)
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
        gl.glPointParameterfv(gl.GL_POINT_DISTANCE_ATTENUATION, attenuation)
        gl.glPointParameterf(gl.GL_POINT_SIZE_MIN, limits[0])
        gl.glPointParameterf(gl.GL_POINT_SIZE_MAX, limits[1])
        for n in range(12):
            gl.glPointSize(0.3 + 0.7 * n)
            gl.glColor4f(n / 12, 0.5, 1 - n / 12, 0.6)
            gl.glBegin(gl.GL_POINTS)
            for k in range(1 + n % 2):
                gl.glVertex3f(n % 4 / 2 - 0.7, n // 4 / 2 - 0.6, k / 2)
            gl.glEnd()
        return context

    assert has_bits_of_single_draws(drawn)
    assert batches == [12]
    assert len(planned) == 1


def test_what_a_run_depends_on_is_known_when_its_state_returns(planned):
    gl.create_context(SIZE, SIZE)
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, np.eye(3, dtype=np.float32))
    for n in range(2 * draw_kinds.KNOWN_KINDS):  # as many states, since the light moves, of two kinds
        (gl.glEnable if n % 2 else gl.glDisable)(gl.GL_DEPTH_TEST)
        gl.glLightfv(gl.GL_LIGHT0, gl.GL_POSITION, [n, 0, 1, 0])
        gl.glDrawArrays(gl.GL_TRIANGLES, 0, 3)
    gl.glFinish()
    assert len(planned) == 2


def test_what_a_run_depends_on_stays_known_when_only_pixels_change(planned):
    gl.create_context(SIZE, SIZE)
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, np.eye(3, dtype=np.float32))
    changes = (
        partial(gl.glAccum, gl.GL_LOAD, 1.0),
        partial(gl.glAccum, gl.GL_RETURN, 0.5),
        partial(gl.glBlitFramebuffer, 0, 0, 1, 1, 1, 1, 2, 2, gl.GL_COLOR_BUFFER_BIT, gl.GL_NEAREST),
        gl.glFinish,
    )
    for change in changes:
        gl.glDrawArrays(gl.GL_TRIANGLES, 0, 3)
        change()
    assert len(planned) == 1


def test_what_a_run_depends_on_stays_known_when_texels_change(planned):
    context = gl.create_context(SIZE, SIZE)
    corners = np.array([[-1, -1, 0], [3, -1, 0], [-1, 3, 0]], np.float32)
    texels = np.zeros((2, 2, 4), np.uint8)
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, corners)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, 2, 2, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)
    gl.glEnable(gl.GL_TEXTURE_2D)
    gl.glClearColor(0.5, 0.5, 0.5, 0.5)
    drawn = []
    for n in range(5):
        texels[:] = 60 * n + 10
        if n == 4:
            gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, 2, 2, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)
        elif n < 3:
            gl.glTexSubImage2D(gl.GL_TEXTURE_2D, 0, 0, 0, 2, 2, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)
        else:
            gl.glClear(gl.GL_COLOR_BUFFER_BIT)
            gl.glCopyTexSubImage2D(gl.GL_TEXTURE_2D, 0, 0, 0, 0, 0, 2, 2)
        gl.glDrawArrays(gl.GL_TRIANGLES, 0, 3)
        drawn.append(context.storage.window.color.view.copy())
    assert [np.unique(picture).tolist() for picture in drawn] == [[10], [70], [130], [128], [250]]
    assert len(planned) == 1
    for size in (4, 2):  # another size does end it
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, size, size, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, None)
        gl.glDrawArrays(gl.GL_TRIANGLES, 0, 3)
    gl.glFinish()
    assert len(planned) == 3


def test_draws_with_other_clip_planes_or_projections_are_one_batch_and_each_is_cut_by_its_own(planned, batches):
    def picture() -> bytes:
        gl.create_context(SIZE, SIZE)
        gl.glEnable(gl.GL_SCISSOR_TEST)
        for n in range(12):
            gl.glClipPlane(gl.GL_CLIP_PLANE0, (1, n % 4, 0, n / 12))
            if n >= 4:
                (gl.glDisable if n % 3 == 0 else gl.glEnable)(gl.GL_CLIP_PLANE0)
            if n == 8:
                gl.glMatrixMode(gl.GL_PROJECTION)
                gl.glScalef(0.5, 1, 1)
            gl.glScissor(0, n, SIZE, 4)
            gl.glColor3f(n / 12, 1, 0)
            draw_triangle()
        return np.array(gl.glReadPixels(0, 0, SIZE, SIZE, gl.GL_RGB, gl.GL_UNSIGNED_BYTE)).tobytes()

    with use_short_cuts(False):
        expected = picture()
    planned.clear()
    assert picture() == expected
    assert len(planned) == 1
    assert batches == [12]


def test_kinds_of_one_state_are_found_again_by_the_arrays_of_their_draws(monkeypatch):
    """One colour, then a colour at each vertex, then one again: the groups of the state are compared once for each."""
    gl.create_context(SIZE, SIZE)
    compared = []
    of_equal_state = draw_kinds.Kinds._of_equal_state
    monkeypatch.setattr(
        draw_kinds.Kinds, "_of_equal_state", lambda kinds, draw: compared.append(draw) or of_equal_state(kinds, draw)
    )
    for frame in range(4):
        for has_colors in (False, True):
            gl.glColor3f(0.25 * frame, 0.5, 0.0)
            gl.glBegin(gl.GL_TRIANGLE_STRIP)
            for x, y in ((-1, -1), (1, -1), (-1, 1), (1, 1)):
                if has_colors:
                    gl.glColor3f(0.5, 0.25 * frame, 0.5 * x + 0.5)
                gl.glVertex2f(x, y)
            gl.glEnd()
            gl.glFinish()
    assert [draw.vertices.color.strides[0] > 0 for draw in compared] == [False, True]


@pytest.mark.parametrize("caps", [(), (gl.GL_LINE_SMOOTH,), (gl.GL_LINE_STIPPLE,)])
def test_lines_of_many_widths_are_one_batch_with_the_bits_of_single_draws(planned, batches, caps):
    def drawn() -> Context:
        context = gl.create_context(SIZE, SIZE)
        for cap in (gl.GL_BLEND, *caps):
            gl.glEnable(cap)
        gl.glLineStipple(2, 0x3B5D)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
        for n in range(14):
            if n in (1, 13):  # the first line and the last one are drawn alone
                gl.glFinish()
            gl.glLineWidth(0.3 + 0.7 * n)
            gl.glColor4f(n / 14, 0.5, 1 - n / 14, 0.6)
            gl.glBegin((gl.GL_LINES, gl.GL_LINE_STRIP, gl.GL_LINE_LOOP)[n % 3])
            for k in range(4):  # some ends lie outside
                gl.glVertex3f(n % 4 / 2 - 0.7 + k % 2, n // 4 / 2 - 0.6 + k // 2 / 3, k / 2)
            gl.glEnd()
        return context

    assert has_bits_of_single_draws(drawn)
    assert batches == [1, 12, 1]
