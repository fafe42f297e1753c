"""Where a line pattern ended is found only when a draw asks; the lines are those of patterns followed draw by draw."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from softshadow import gl
from softshadow.matrices import multiply
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.geometry.geometry import process_geometry
from softshadow.pipeline.geometry.stipple_places import begins_stipple_anew, stipple_place_after

SIZE = 24
MODES = (
    gl.GL_LINES, gl.GL_LINE_STRIP, gl.GL_LINE_LOOP, gl.GL_LINE_STRIP, gl.GL_POINTS, gl.GL_TRIANGLES, gl.GL_QUADS,
    gl.GL_QUAD_STRIP, gl.GL_POLYGON,
)  # fmt: skip


def draw_something(rng: np.random.Generator) -> None:
    """Draw a few lines, often from outside of the window or with too few vertices, or something else."""
    gl.glPolygonMode(gl.GL_FRONT_AND_BACK, int(rng.choice([gl.GL_LINE, gl.GL_FILL])))
    (gl.glDisable if rng.random() < 0.2 else gl.glEnable)(gl.GL_LINE_STIPPLE)
    (gl.glEnable if rng.random() < 0.2 else gl.glDisable)(gl.GL_CULL_FACE)
    gl.glBegin(int(rng.choice(MODES)))
    for x, y in rng.uniform(-1.6, 1.6, (int(rng.integers(0, 6)), 2)).tolist():
        gl.glVertex2f(x, y)
    gl.glEnd()


@given(st.integers(0, 2**32 - 1))
def test_patterns_go_on_where_the_draws_before_have_left_them(seed):
    rng = np.random.default_rng(seed)
    with gl.create_context(SIZE, SIZE) as context:
        gl.glLineStipple(int(rng.integers(1, 4)), int(rng.integers(1, 1 << 16)))
        for n in range(12):
            draw_something(rng)
            if n == 6:
                gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
        gl.glFinish()
        place, storage = 0, context.storage
        for command in context.stream.frame.commands:
            if isinstance(command, Draw):
                expected = command._replace(stipple_place=place)
                ours, theirs = (process_geometry(each, storage.window, storage) for each in (command, expected))
                np.testing.assert_array_equal(ours.triangles.corners, theirs.triangles.corners)
                place = stipple_place_after(expected, storage)


def test_a_strip_that_begins_inside_does_not_ask():
    with gl.create_context(SIZE, SIZE) as context:
        gl.glEnable(gl.GL_LINE_STIPPLE)
        gl.glLineStipple(1, 0x0F0F)
        for x in (0.0, 2.0):
            gl.glBegin(gl.GL_LINE_STRIP)
            for y in (0.0, 0.5, -0.5):
                gl.glVertex2f(x if y == 0 else 0.25, y)
            gl.glEnd()
        gl.glFinish()
        draws = [command for command in context.stream.frame.commands if isinstance(command, Draw)]
        products = [multiply(draw.projection, draw.modelview) for draw in draws]
        assert [*map(begins_stipple_anew, draws, products)] == [True, False]


def test_a_polygon_that_is_surely_drawn_does_not_ask():
    """Not one that may be culled, one with a corner outside, or one whose edges may be hidden."""
    with gl.create_context(SIZE, SIZE) as context:
        gl.glEnable(gl.GL_LINE_STIPPLE)
        gl.glLineStipple(1, 0x0F0F)
        gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_LINE)
        for x, cap in ((0.5, 0), (2.0, 0), (0.5, gl.GL_CULL_FACE)):
            if cap:
                gl.glEnable(cap)
            for mode in (gl.GL_QUADS, gl.GL_TRIANGLES):
                gl.glBegin(mode)
                gl.glVertex2f(-0.5, -0.5)
                gl.glVertex2f(x, -0.5)
                gl.glVertex2f(x, 0.5)
                gl.glVertex2f(-0.5, 0.5)
                gl.glEnd()
        gl.glDisable(gl.GL_CULL_FACE)
        gl.glEdgeFlag(False)
        gl.glRectf(-0.5, -0.5, 0.5, 0.5)
        gl.glFinish()
        draws = [command for command in context.stream.frame.commands if isinstance(command, Draw)]
        products = [multiply(draw.projection, draw.modelview) for draw in draws]
        assert [*map(begins_stipple_anew, draws, products)] == [True] * 2 + [False] * 5


def test_numbers_without_a_value_give_no_warning(recwarn):
    with gl.create_context(SIZE, SIZE):
        gl.glEnable(gl.GL_LINE_STIPPLE)
        gl.glLineStipple(1, 0x0F0F)
        gl.glEnable(gl.GL_CLIP_PLANE0)
        gl.glClipPlane(gl.GL_CLIP_PLANE0, [3e38, 3e38, 3e38, 3e38])
        gl.glMatrixMode(gl.GL_PROJECTION)
        gl.glLoadMatrixf(np.diag([1e-20, 1e-20, 1.0, 1.0]))
        for _ in range(2):
            gl.glBegin(gl.GL_LINE_STRIP)
            for x in (3e38, -3e38, 0.0):
                gl.glVertex2f(x, x)
            gl.glEnd()
        gl.glFinish()
    assert not recwarn.list
