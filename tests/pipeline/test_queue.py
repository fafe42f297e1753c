"""Draws that wait: which of them form a batch, and what is kept of a state for the draws that follow."""

import gc
import weakref
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from softshadow import context, gl
from softshadow.pipeline import draw_kinds, queue, use_short_cuts
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.fast.batch.geometry import Batch, Setting
from softshadow.pipeline.fast.batch.run import Run
from softshadow.pipeline.fast.batch.segments import Part

SIZE = 32


@pytest.fixture
def planned(monkeypatch):
    """Return a list that grows by 1 for each draw that is planned."""
    planned, plan_draw = [], draw_kinds.plan_draw
    monkeypatch.setattr(draw_kinds, "plan_draw", lambda *arguments: planned.append(1) or plan_draw(*arguments))
    return planned


@pytest.fixture
def batches(monkeypatch):
    """Return a list that gets the number of draws of each batch that is set up."""
    batches: list[int] = []
    geometry_of = queue.geometry_of

    def note_batch(run: Run, setting: Setting, draws: list[Draw], *rest: Any) -> Batch:
        batches.append(len(draws))
        return geometry_of(run, setting, draws, *rest)

    monkeypatch.setattr(queue, "geometry_of", note_batch)
    return batches


@pytest.mark.parametrize("polygon_mode", [gl.GL_FILL, gl.GL_LINE, gl.GL_POINT])
def test_many_small_draws_are_one_run(batches, polygon_mode):
    gl.create_context(SIZE, SIZE)
    gl.glPolygonMode(gl.GL_FRONT_AND_BACK, polygon_mode)
    gl.glEnable(gl.GL_LIGHTING)
    gl.glEnable(gl.GL_COLOR_MATERIAL)
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, np.eye(3, dtype=np.float32))
    for n in range(50):
        gl.glColor3f(n / 50, 0, 0)
        gl.glRotatef(n, 0, 1, 0)
        gl.glDrawArrays(gl.GL_TRIANGLES, 0, 3)
    assert not batches
    gl.glReadPixels(0, 0, 1, 1, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)
    assert batches == [50]


def test_small_draws_between_changes_of_tests_are_one_batch(batches, monkeypatch):
    segments, draw_segment = [], queue.DrawQueue._draw_segment

    def note_segment(waiting: queue.DrawQueue, segment: queue.Segment, part: Part, group: Any) -> Any:
        segments.append(part.end - part.first)
        return draw_segment(waiting, segment, part, group)

    monkeypatch.setattr(queue.DrawQueue, "_draw_segment", note_segment)
    gl.create_context(SIZE, SIZE)
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, np.eye(3, dtype=np.float32))
    for n in range(12):
        if n % 3 == 0:
            gl.glScissor(n, 0, SIZE, SIZE)
        gl.glDrawArrays(gl.GL_LINES if n % 3 == 2 else gl.GL_TRIANGLES, 0, 2 if n % 3 == 2 else 3)
    gl.glFinish()
    assert batches == [8, 4]  # of triangles and of lines
    assert segments == [2, 2] * 4  # two triangles; two of a line


def draw_triangle(y: float = -1) -> None:
    """Draw the lower left half of the window, above y."""
    gl.glBegin(gl.GL_TRIANGLES)
    for corner in ((-1, y), (1, y), (-1, 1)):
        gl.glVertex2f(*corner)
    gl.glEnd()


@pytest.mark.parametrize("plane", [gl.GL_DEPTH_BUFFER_BIT, gl.GL_STENCIL_BUFFER_BIT, gl.GL_COLOR_BUFFER_BIT])
def test_a_clear_between_small_draws_does_not_divide_their_batch(batches, plane):
    gl.create_context(SIZE, SIZE)
    gl.glEnable(gl.GL_SCISSOR_TEST)
    for n in range(5):
        gl.glScissor(n, 0, SIZE, SIZE)
        gl.glColor3ub(50 * n, 0, 0)
        gl.glClearColor(0, n / 5, 0, 1)
        gl.glClear(plane)
        draw_triangle(0)
    assert not batches
    pixels = gl.glReadPixels(0, 0, SIZE, SIZE, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)
    assert batches == [5]
    assert pixels[SIZE // 2 + 1, :6, 0].tolist() == [0, 50, 100, 150, 200, 200]
    is_cleared = plane == gl.GL_COLOR_BUFFER_BIT
    assert pixels[0, :6, 1].tolist() == ([0, 51, 102, 153, 204, 204] if is_cleared else [0] * 6)


def test_a_clear_of_the_window_carries_out_the_picture_before_it(batches):
    gl.create_context(SIZE, SIZE)
    draw_triangle()
    gl.glClear(gl.GL_COLOR_BUFFER_BIT)
    assert batches == [1]
    assert not gl.glReadPixels(0, 0, SIZE, SIZE, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)[..., 0].any()


def test_clears_do_not_wait_without_end(batches, monkeypatch):
    monkeypatch.setattr(queue, "MOST_DRAWS", 10)
    gl.create_context(SIZE, SIZE)
    draw_triangle()
    for _ in range(9):
        assert not batches
        gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
    assert batches == [1]


def load_texture(name: int, gray: int) -> None:
    """Load a texture of one gray."""
    gl.glBindTexture(gl.GL_TEXTURE_2D, name)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
    image = np.full((2, 2, 3), gray, np.uint8)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGB, 2, 2, 0, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, image)


def test_textures_loaded_between_draws_do_not_divide_their_batch(batches):
    gl.create_context(SIZE, SIZE)
    gl.glEnable(gl.GL_TEXTURE_2D)
    gl.glEnable(gl.GL_SCISSOR_TEST)
    for n in range(5):
        gl.glScissor(n, 0, SIZE, SIZE)
        load_texture(n + 1, 50 * n)
        draw_triangle()
    assert not batches
    pixels = gl.glReadPixels(0, 0, SIZE, SIZE, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)
    assert batches == [5]
    assert pixels[0, :6, 0].tolist() == [0, 50, 100, 150, 200, 200]


def test_a_texture_in_use_gets_an_image_after_the_draws_that_wait(batches):
    gl.create_context(SIZE, SIZE)
    gl.glEnable(gl.GL_TEXTURE_2D)
    gl.glBindTexture(gl.GL_TEXTURE_2D, 1)
    draw_triangle()  # white: the texture has no image yet
    load_texture(1, 50)
    assert batches == [1]
    assert gl.glReadPixels(0, 0, 1, 1, gl.GL_RGB, gl.GL_UNSIGNED_BYTE)[0, 0, 0] == 255


@pytest.mark.parametrize("side", [2, 256])
@pytest.mark.parametrize("is_whole", [True, False])
def test_new_texels_of_a_texture_in_use_wait(batches, side, is_whole):
    gl.create_context(SIZE, SIZE)
    gl.glEnable(gl.GL_TEXTURE_2D)
    gl.glEnable(gl.GL_SCISSOR_TEST)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
    form = gl.GL_RGBA, gl.GL_UNSIGNED_BYTE
    for n in range(20):  # more versions of the texture than one call of the kernels takes
        image = np.full((side, side, 4), 10 * n, np.uint8)
        if is_whole or n == 0:
            gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, side, side, 0, *form, image)
        else:
            gl.glTexSubImage2D(gl.GL_TEXTURE_2D, 0, 0, 0, side, side, *form, image)
        gl.glScissor(n, 0, SIZE, SIZE)
        draw_triangle()
    assert not batches
    pixels = gl.glReadPixels(0, 0, SIZE, SIZE, *form)
    assert batches == [20]
    assert pixels[0, :20, 0].tolist() == [10 * n for n in range(20)]
    assert (gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, *form) == 190).all()


def test_texels_that_wait_are_bounded(batches, monkeypatch):
    monkeypatch.setattr(queue, "MOST_BYTES", 50)
    gl.create_context(SIZE, SIZE)
    gl.glEnable(gl.GL_TEXTURE_2D)
    for n in range(7):  # 16 bytes each
        load_texture(1, n)
        draw_triangle()
    assert batches == [4]
    assert gl.glReadPixels(0, 0, 1, 1, gl.GL_RGB, gl.GL_UNSIGNED_BYTE)[0, 0, 0] == 6


def test_draws_keep_the_filter_that_their_texture_had(planned, batches):
    gl.create_context(SIZE, SIZE)
    gl.glEnable(gl.GL_TEXTURE_2D)
    gl.glEnable(gl.GL_SCISSOR_TEST)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
    image = np.array([[0, 200]], np.uint8)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_LUMINANCE, 2, 1, 0, gl.GL_LUMINANCE, gl.GL_UNSIGNED_BYTE, image)
    gl.glTexCoord2f(0.5, 0.5)
    for frame in range(3):
        for n, filter in enumerate([gl.GL_NEAREST, gl.GL_LINEAR] * 4):
            gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MAG_FILTER, filter)
            gl.glScissor(n, 0, SIZE, SIZE)
            draw_triangle()
        assert batches == [8] * frame
        row = gl.glReadPixels(0, 0, 8, 1, gl.GL_RGB, gl.GL_UNSIGNED_BYTE)[0, :, 0]
        assert row.tolist() == [200, 100] * 4
    assert len(planned) == 2, "the kinds of both filters are found again"


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


@pytest.mark.parametrize("target", [gl.GL_TEXTURE_1D, gl.GL_TEXTURE_2D])
def test_the_default_texture_is_one_of_each_target(batches, target):
    gl.create_context(SIZE, SIZE)
    gl.glEnable(target)
    gl.glTexParameteri(target, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
    size = (2,) if target == gl.GL_TEXTURE_1D else (2, 2)
    load = gl.glTexImage1D if target == gl.GL_TEXTURE_1D else gl.glTexImage2D
    for gray in (40, 80):
        image = np.full((*size, 3), gray, np.uint8)
        load(target, 0, gl.GL_RGB, *size, 0, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, image)
        draw_triangle()
    load(target, 0, gl.GL_RGBA, *size, 0, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, image)
    assert batches == [2], "an image of another format comes after draws that read the texture"
    assert gl.glReadPixels(0, 0, 1, 1, gl.GL_RGB, gl.GL_UNSIGNED_BYTE)[0, 0, 0] == 80


def test_new_texels_of_a_texture_that_waiting_draws_write_to_come_after_them(batches):
    gl.create_context(SIZE, SIZE)
    load_texture(1, 0)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
    gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, 1, 0)
    draw_triangle()
    image = np.full((1, 1, 3), 70, np.uint8)
    gl.glTexSubImage2D(gl.GL_TEXTURE_2D, 0, 0, 0, 1, 1, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, image)
    draw_triangle(0.5)  # of no pixel
    assert not batches
    assert gl.glReadPixels(0, 0, 1, 1, gl.GL_RGB, gl.GL_UNSIGNED_BYTE)[0, 0, 0] == 70
    assert batches == [2]


def test_a_result_carries_out_only_draws_that_the_query_counts(batches):
    gl.create_context(SIZE, SIZE)
    queries = gl.glGenQueries(2).tolist()
    for query in queries:
        gl.glBeginQuery(gl.GL_SAMPLES_PASSED, query)
        draw_triangle()
        gl.glEndQuery(gl.GL_SAMPLES_PASSED)
    counts = [gl.glGetQueryObjectuiv(queries[0], gl.GL_QUERY_RESULT)]
    assert batches == [2]
    draw_triangle()
    counts += [gl.glGetQueryObjectuiv(query, gl.GL_QUERY_RESULT) for query in queries]
    assert batches == [2], "the last draw is not counted, and waits"
    assert len(set(counts)) == 1
    assert counts[0] > 0
    gl.glBeginQuery(gl.GL_SAMPLES_PASSED, queries[0])
    draw_triangle()
    gl.glEndQuery(gl.GL_SAMPLES_PASSED)
    assert gl.glGetQueryObjectuiv(queries[0], gl.GL_QUERY_RESULT) == counts[0]
    assert batches == [2, 2]


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
    def drawn() -> list[bytes]:
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
        gl.glFinish()
        return [each.image.view.tobytes() for each in context.storage.window.attachments.values()]

    with use_short_cuts(False):
        expected = drawn()
    assert drawn() == expected
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


def test_large_draws_of_one_kind_are_set_up_together(batches):
    gl.create_context(SIZE, SIZE)
    gl.glEnable(gl.GL_LIGHTING)
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, np.zeros((queue.WORTH_COMPARING, 3), np.float32))
    for n in range(5):
        gl.glMaterialfv(gl.GL_FRONT, gl.GL_DIFFUSE, [n / 5, 0, 0, 1])
        gl.glDrawArrays(gl.GL_TRIANGLES, 0, queue.WORTH_COMPARING)
    gl.glFinish()
    assert batches == [5]


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


def test_a_program_is_told_once_that_it_waits_for_its_kernels(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    for folder, said in ((tmp_path, "only the first time"), (None, "no cache folder is writable")):
        monkeypatch.setattr(queue.BATCH_KERNELS, "_known", False)  # as if nothing were on disk
        monkeypatch.setattr("softshadow.kernel_cache.cache_folder", lambda value=folder: value)
        caplog.clear()
        with gl.create_context(SIZE, SIZE):
            for _ in range(2):
                gl.glRectf(0, 0, 1, 1)
                gl.glFinish()
        (record,) = caplog.records
        assert record.name == "softshadow"
        assert said in record.getMessage()
        assert ("softshadow warmup" in record.getMessage()) == (folder is not None)  # else it would cache nothing


def test_clip_planes_that_change_need_no_plan_and_cut_their_own_draws(planned, batches):
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
    assert sorted(batches) == [1] * 6 + [6], "draws without a plane are of one kind, whatever its equation is"


def test_contexts_that_share_textures_see_each_others_changes():
    first, second = gl.create_context(SIZE, SIZE), gl.create_context(SIZE, SIZE)
    second.objects.textures = first.objects.textures
    form = gl.GL_LUMINANCE, gl.GL_UNSIGNED_BYTE
    textures = (gl.GL_LINEAR, [0, 200]), (gl.GL_LINEAR, [0, 160, 40, 160]), (gl.GL_NEAREST, [0, 120])
    for n, (filter, row) in enumerate(textures):
        context.make_current(second)
        gl.glBindTexture(gl.GL_TEXTURE_2D, 1)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MAG_FILTER, filter)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_LUMINANCE, len(row), 1, 0, *form, np.array([row], np.uint8))
        context.make_current(first)
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glEnable(gl.GL_SCISSOR_TEST)
        gl.glScissor(n, 0, SIZE, SIZE)
        gl.glBindTexture(gl.GL_TEXTURE_2D, 1)
        gl.glTexCoord2f(0.5, 0.5)
        draw_triangle()
    read = gl.glReadPixels(0, 0, 3, 1, gl.GL_RGB, gl.GL_UNSIGNED_BYTE)[0, :, 0].tolist()
    assert read == [100, 100, 120]


def test_the_image_of_a_deleted_texture_is_freed_at_once():
    with gl.create_context(SIZE, SIZE) as current:
        gl.glEnable(gl.GL_TEXTURE_2D)
        load_texture(1, 50)
        for filter in (gl.GL_LINEAR, gl.GL_NEAREST):
            gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MAG_FILTER, filter)
            draw_triangle()
        image = weakref.ref(current.objects.textures[1].images[0, 0])
        gc.disable()
        try:
            gl.glDeleteTextures([1])
            assert image() is None
        finally:
            gc.enable()
