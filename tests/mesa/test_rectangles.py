"""Three triangles of which the last is level: llvmpipe draws none of them, and neither does softshadow."""

import numpy as np
import pytest

from combinations import sampled
from softshadow.testing import compare, run_here

pytestmark = pytest.mark.mesa

SIZE = (40, 30)
PLAIN = [(-0.8, -0.5), (0.5, -0.5), (0.0, 0.8)]
LEVEL = [(-0.5, 0.25), (0.5, 0.25), (0.1, 0.25)]
UPRIGHT = [(0.25, -0.5), (0.25, 0.5), (0.25, 0.1)]
RECTANGLE = [(-0.5, 0.5), (-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (0.5, -0.5), (-0.5, 0.5)]
SHAPES = {
    "the last is level": PLAIN + PLAIN + LEVEL,
    "the last is upright": PLAIN + PLAIN + UPRIGHT,
    "the second is level": PLAIN + LEVEL + PLAIN,
    "two of them": PLAIN + LEVEL,
    "four of them": PLAIN + PLAIN + PLAIN + LEVEL,
    "a rectangle": RECTANGLE + LEVEL,
    "a rectangle turned round": [RECTANGLE[i] for i in (1, 0, 3, 2, 3, 1)] + LEVEL,
    "more vertices than make triangles": PLAIN + PLAIN + LEVEL + PLAIN[:2],
    "one of them is clipped": [*PLAIN, (-0.8, -0.5), (0.5, -0.5), (0.0, 1.8), *LEVEL],
    "many before": (PLAIN * 5000)[:4095] + PLAIN + PLAIN + LEVEL,
}
SHADING = {"smooth": (False, False), "one colour": (True, False), "flat": (True, True)}


def check(program):
    comparison = compare(program, SIZE)
    assert comparison, str(comparison)


@pytest.mark.parametrize(("by", "shape", "shading"), sampled([3, 9, 10000, "arrays", "elements"], SHAPES, SHADING))
def test_three_triangles_are_left_out_as_on_mesa(shape, by, shading):
    corners = SHAPES[shape]
    is_flat, colored = SHADING[shading]

    def program(gl):
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glShadeModel(gl.GL_FLAT if is_flat else gl.GL_SMOOTH)
        if isinstance(by, str):
            gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
            gl.glVertexPointer(2, gl.GL_FLOAT, 0, np.array(corners, np.float32))
            if by == "arrays":
                gl.glDrawArrays(gl.GL_TRIANGLES, 0, len(corners))
            else:
                gl.glDrawElements(gl.GL_TRIANGLES, len(corners), gl.GL_UNSIGNED_INT, np.arange(len(corners)))
            return
        for start in range(0, len(corners), by):
            gl.glBegin(gl.GL_TRIANGLES if by > 3 or len(corners) % 3 else gl.GL_TRIANGLE_FAN)
            for corner in corners[start : start + by]:
                if colored:
                    gl.glColor3f(1, 0.5, 0.25)
                gl.glVertex2f(*corner)
            gl.glEnd()

    check(program)


@pytest.mark.parametrize("between", ["glFlush", "a debug group", "glLoadIdentity", "a line"])
def test_calls_between_triangles_end_a_draw_as_on_mesa(between):
    def program(gl):
        for number in range(3):
            gl.glBegin(gl.GL_TRIANGLES)
            for corner in LEVEL if number == 2 else PLAIN:
                gl.glVertex2f(*corner)
            gl.glEnd()
            if between == "a debug group":
                gl.glPushDebugGroup(gl.GL_DEBUG_SOURCE_APPLICATION, 0, -1, str(number))
            elif between == "a line":
                gl.glBegin(gl.GL_LINES)
                gl.glEnd()
            else:
                getattr(gl, between)()

    check(program)
    assert run_here(program, SIZE).color.any() == (between != "a debug group")
