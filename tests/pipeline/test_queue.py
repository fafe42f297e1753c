"""Draws that wait: which of them form a batch, and when they are carried out."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from draws import same_window
from pipeline.small_draws import SIZE, draw_triangle
from softshadow import gl
from softshadow.pipeline import execute_waiting, queue, use_short_cuts
from softshadow.pipeline.draw_kinds import Kinds
from softshadow.pipeline.fast.batch.admission import LONG_DRAW, WORTH_COMPARING
from softshadow.pipeline.fast.batch.segments import Part


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
    segments, draw_segment = [], execute_waiting._draw_segment

    def note_segment(segment: execute_waiting.Segment, part: Part, *rest: Any) -> Any:
        segments.append(part.end - part.first)
        return draw_segment(segment, part, *rest)

    monkeypatch.setattr(execute_waiting, "_draw_segment", note_segment)
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


@pytest.mark.parametrize(
    "switch", [None, gl.GL_DEPTH_TEST, gl.GL_STENCIL_TEST, gl.GL_BLEND, gl.GL_ALPHA_TEST, gl.GL_COLOR_LOGIC_OP]
)
def test_rectangles_wait_unless_their_texels_are_copied(batches, switch):
    gl.create_context(SIZE, SIZE)
    if switch:
        gl.glEnable(switch)
    gl.glAlphaFunc(gl.GL_GREATER, 0.5)
    gl.glLogicOp(gl.GL_XOR)
    gl.glDrawPixels(1, 1, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, bytes(3))
    assert not batches
    draw_triangle()
    gl.glFinish()
    assert batches == ([1, 1] if switch else [1])


def draw_three_triangles(height, shift=0.0):
    """Draw three triangles, of which the last one has a height in normalized coordinates."""
    corners = [(-0.9, -0.8), (0.7, -0.6), (0.5, 0.9), (-0.9, 0.1), (0.3, 0.2), (-0.4, 0.8), (-0.5, 0.3), (0.8, 0.3)]
    gl.glBegin(gl.GL_TRIANGLES)
    for x, y in (*corners, (0.1, 0.3 + height)):
        gl.glVertex2f(x + shift, y)
    gl.glEnd()


def draw_three_triangles_twice(height):
    """Return a window with two such draws, under matrices of their own."""
    context = gl.create_context(SIZE, SIZE)
    for shift in (0.0, 0.05):
        gl.glTranslatef(shift, 0, 0)
        draw_three_triangles(height)
    gl.glFinish()
    return context


@pytest.mark.parametrize(
    ("height", "waiting", "is_drawn"),
    [(0.6, [2], True), (-0.2, [2], True), (0.0, [], False), (1e-9, [], False), (1e-6, [], True)],
)
def test_three_triangles_wait_where_the_last_one_has_a_height(batches, height, waiting, is_drawn):
    """Mesa leaves out all three of a draw where it has none; else they are like those of any other draw."""
    context = draw_three_triangles_twice(height)
    assert batches == waiting
    assert gl.glReadPixels(0, 0, SIZE, SIZE, gl.GL_RED, gl.GL_UNSIGNED_BYTE).any() == is_drawn
    with use_short_cuts(False):
        assert same_window(context, draw_three_triangles_twice(height))


@pytest.mark.parametrize("in_list", [False, True])
@pytest.mark.parametrize("heights", [(0.6, 0.0, 0.6), (0.0, 0.6, 0.0), (0.6, 0.6, 0.0), (0.6, 1e-6, 0.0)])
def test_three_triangles_with_and_without_a_height_in_turns(heights, in_list):
    def draw():
        context = gl.create_context(SIZE, SIZE)
        if in_list:
            gl.glNewList(1, gl.GL_COMPILE)
        for number, height in enumerate(heights):
            draw_three_triangles(height, 0.1 * number)
            gl.glRectf(-0.9, -0.9, 0.9, -0.8)
        if in_list:
            gl.glEndList()
            gl.glCallList(1)
        gl.glFinish()
        return context

    context = draw()
    with use_short_cuts(False):
        assert same_window(context, draw())


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


def test_the_samples_of_an_accumulated_picture_wait_together(batches):
    gl.create_context(SIZE, SIZE)
    for n in range(4):
        gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
        gl.glColor3ub(60 * n, 0, 0)
        draw_triangle()
        gl.glAccum(gl.GL_ACCUM if n else gl.GL_LOAD, 0.25)
    gl.glAccum(gl.GL_RETURN, 1)
    assert not batches
    assert gl.glReadPixels(0, 0, 1, 1, gl.GL_RGB, gl.GL_UNSIGNED_BYTE).tolist() == [[[90, 0, 0]]]
    assert batches == [4]


def test_a_clear_of_the_window_carries_out_an_accumulated_picture(batches):
    gl.create_context(SIZE, SIZE)
    for operation in (gl.GL_LOAD, gl.GL_RETURN):
        draw_triangle()
        gl.glAccum(operation, 1)
    assert not batches
    gl.glClear(gl.GL_COLOR_BUFFER_BIT)
    assert batches == [2]


@pytest.mark.parametrize("copy", ["copied", "blitted"])
def test_pictures_that_are_copied_wait_together(batches, copy):
    gl.create_context(SIZE, SIZE)
    texture, framebuffer = int(gl.glGenTextures(1)), int(gl.glGenFramebuffers(1))
    gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGB, 4, 4, 0, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, None)
    gl.glBindFramebuffer(gl.GL_DRAW_FRAMEBUFFER, framebuffer)
    gl.glFramebufferTexture2D(gl.GL_DRAW_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, texture, 0)
    gl.glBindFramebuffer(gl.GL_DRAW_FRAMEBUFFER, 0)
    for n in range(3):
        gl.glClear(gl.GL_COLOR_BUFFER_BIT)
        gl.glColor3ub(60 * n + 60, 0, 0)
        draw_triangle()
        if copy == "copied":
            gl.glCopyTexSubImage2D(gl.GL_TEXTURE_2D, 0, n, 0, 0, 0, 1, 1)
        else:
            gl.glBindFramebuffer(gl.GL_DRAW_FRAMEBUFFER, framebuffer)
            gl.glBlitFramebuffer(0, 0, 1, 1, n, 0, n + 1, 1, gl.GL_COLOR_BUFFER_BIT, gl.GL_NEAREST)
            gl.glBindFramebuffer(gl.GL_DRAW_FRAMEBUFFER, 0)
    assert not batches
    texels = gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RGB, gl.GL_UNSIGNED_BYTE)
    assert batches == [3]
    assert texels[0, :, 0].tolist() == [60, 120, 180, 0]


@pytest.mark.parametrize("change", ["image", "buffer", "deletion"])
def test_what_a_copy_needs_changes_after_it(batches, change):
    gl.create_context(SIZE, SIZE)
    form = gl.GL_RGB, gl.GL_UNSIGNED_BYTE
    gl.glBindTexture(gl.GL_TEXTURE_2D, int(gl.glGenTextures(1)))
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGB, 2, 1, 0, *form, None)
    draw_triangle()
    gl.glCopyTexSubImage2D(gl.GL_TEXTURE_2D, 0, 0, 0, 0, 0, 1, 1)
    assert not batches
    if change == "image":
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGB, 4, 4, 0, *form, None)
    elif change == "buffer":
        gl.glReadBuffer(gl.GL_NONE)
    else:
        gl.glDeleteTextures([1])
    assert batches == [1]
    if change == "buffer":
        assert gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, *form).tolist() == [[[255] * 3, [0] * 3]]


def test_clears_do_not_wait_without_end(batches, monkeypatch):
    monkeypatch.setattr(queue, "MOST_DRAWS", 10)
    gl.create_context(SIZE, SIZE)
    draw_triangle()
    for _ in range(9):
        assert not batches
        gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
    assert batches == [1]


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


def test_draws_in_turns_ask_once_for_each_kind(batches, monkeypatch):
    asked, of = [], Kinds.of
    monkeypatch.setattr(Kinds, "of", lambda self, command: asked.append(command.mode) or of(self, command))
    gl.create_context(SIZE, SIZE)
    for n in range(20):
        gl.glTranslatef(n / 100, 0, 0)
        for mode in (gl.GL_POLYGON, gl.GL_LINE_LOOP):
            gl.glBegin(mode)
            for corner in ((-1, -1), (1, -1), (1, 1)):
                gl.glVertex2f(*corner)
            gl.glEnd()
    gl.glFinish()
    assert sorted(asked) == [gl.GL_LINE_LOOP, gl.GL_POLYGON]
    assert batches == [20, 20]


def test_large_draws_of_one_kind_are_set_up_together(batches):
    gl.create_context(SIZE, SIZE)
    gl.glEnable(gl.GL_LIGHTING)
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, np.zeros((WORTH_COMPARING, 3), np.float32))
    for n in range(5):
        gl.glMaterialfv(gl.GL_FRONT, gl.GL_DIFFUSE, [n / 5, 0, 0, 1])
        gl.glDrawArrays(gl.GL_TRIANGLES, 0, WORTH_COMPARING)
    gl.glFinish()
    assert batches == [5]


@pytest.mark.parametrize("between", [lambda: None, lambda: gl.glLightf(gl.GL_LIGHT0, gl.GL_SPOT_CUTOFF, 40)])
def test_a_long_draw_without_colors_goes_in_chunks_also_behind_a_short_one(batches, between):
    """Of a shadow map, for example: the ground comes before the mesh."""
    gl.create_context(SIZE, SIZE)
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glColorMask(False, False, False, False)
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, np.zeros((LONG_DRAW, 3), np.float32))
    for n_vertices in (3, LONG_DRAW, 3, LONG_DRAW - 1):
        gl.glDrawArrays(gl.GL_TRIANGLE_STRIP, 0, n_vertices)
        between()
    gl.glFinish()
    assert batches == [1, 2]


def test_long_lines_under_other_states_wait_together(batches):
    gl.create_context(SIZE, SIZE)
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, np.zeros((WORTH_COMPARING, 3), np.float32))
    for n in range(6):
        (gl.glEnable if n % 2 else gl.glDisable)(gl.GL_LINE_SMOOTH)
        gl.glDrawArrays(gl.GL_POINTS if n % 3 else gl.GL_LINE_STRIP, 0, WORTH_COMPARING)
    assert not batches
    gl.glFinish()
    assert sum(batches) == 6


def test_spheres_under_other_states_wait_together(batches):
    """Their strips are a draw of many vertices, but few programs draw the same sphere again in a pass of its own."""
    quadric = gl.gluNewQuadric()
    context = gl.create_context(SIZE, SIZE)
    for n in range(4):
        (gl.glEnable if n % 2 else gl.glDisable)(gl.GL_LIGHTING)
        gl.gluSphere(quadric, 0.5, 20, 16)
    context.flush()
    assert min(len(command.vertices.position) for command in context.frame.commands) > WORTH_COMPARING
    assert not batches
    gl.glFinish()
    assert sum(batches) == 4


def test_a_program_is_told_once_that_it_waits_for_its_kernels(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    for folder, said in ((tmp_path, "only the first time"), (None, "no cache folder is writable")):
        monkeypatch.setattr(execute_waiting.BATCH_KERNELS, "_known", False)  # as if nothing were on disk
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
