"""glBegin ... glEnd pairs that Mesa joins to one draw of its driver: the first triangle decides about their offset.

Whether a triangle has a polygon offset depends on its polygon mode, but llvmpipe looks at the first triangle of a draw
only. Consecutive pairs of one primitive mode are one draw, up to 64 pairs. If the first pair has no vertices, Mesa
draws none of them.
"""

import numpy as np
import pytest

from combinations import sampled, with_quick
from softshadow.testing import compare

pytestmark = pytest.mark.mesa

SIZE = (40, 30)
MODES = ("GL_TRIANGLES", "GL_QUADS", "GL_TRIANGLE_STRIP", "GL_TRIANGLE_FAN", "GL_QUAD_STRIP", "GL_POLYGON")
BETWEEN = {
    "nothing": lambda gl: None,
    "an empty pair": lambda gl: (gl.glBegin(gl.GL_TRIANGLE_STRIP), gl.glEnd()),
    "an empty pair of lines": lambda gl: (gl.glBegin(gl.GL_LINES), gl.glEnd()),
    "a colour": lambda gl: gl.glColor3f(1, 0.5, 0),
    "state": lambda gl: gl.glDepthFunc(gl.GL_LEQUAL),
    "the same state": lambda gl: gl.glDepthFunc(gl.GL_LESS),
    "a debug group": lambda gl: gl.glPushDebugGroup(gl.GL_DEBUG_SOURCE_APPLICATION, 0, -1, "inner"),
    "an array": lambda gl: array(gl),
    "reading": lambda gl: gl.glGetFloatv(gl.GL_CURRENT_COLOR),
}


def array(gl):
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    gl.glVertexPointer(2, gl.GL_FLOAT, 0, np.array([(-0.1, 0), (0.1, 0), (0.1, 0.1), (-0.1, 0.1)], np.float32))
    gl.glDrawArrays(gl.GL_TRIANGLE_STRIP, 0, 4)
    gl.glDisableClientState(gl.GL_VERTEX_ARRAY)


def outlined(gl):
    """Draw front faces as lines, which have an offset, and back faces filled, which have none."""
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glPolygonMode(gl.GL_FRONT, gl.GL_LINE)
    gl.glPolygonMode(gl.GL_BACK, gl.GL_FILL)
    gl.glEnable(gl.GL_POLYGON_OFFSET_LINE)
    gl.glPolygonOffset(3, 1000)


def pair(gl, mode, front, x=0.0, depth=0.2):
    """Draw a rectangle that is steep in depth; GL_TRIANGLES gets its first three corners only."""
    corners = [(-0.9, -0.9), (-0.4, -0.9), (-0.4, 0.8), (-0.9, 0.8)]
    if "STRIP" in mode:
        corners[2:] = corners[:1:-1]
    corners = corners[:3] if mode == "GL_TRIANGLES" else corners
    gl.glBegin(getattr(gl, mode))
    for cx, cy in corners if front else corners[::-1]:
        gl.glVertex3f(cx + x, cy, depth * (cx + cy))
    gl.glEnd()


def check(program, size=SIZE):
    comparison = compare(program, size)
    assert comparison, str(comparison)


@pytest.mark.parametrize(("between", "mode", "first"), sampled(BETWEEN, MODES, ["front", "back", "culled", "clipped"]))
def test_the_first_triangle_of_pairs_in_a_row_decides_about_their_offset(between, mode, first):
    def program(gl):
        outlined(gl)
        if first == "culled":
            gl.glEnable(gl.GL_CULL_FACE)
        pair(gl, mode, first in ("front", "clipped"), x=8 if first == "clipped" else 0)
        BETWEEN[between](gl)
        pair(gl, mode, first == "back", x=0.5)
        pair(gl, mode, first != "back", x=1)

    check(program)


def test_a_vertex_at_infinity_decides_nothing():
    def program(gl):
        outlined(gl)
        gl.glBegin(gl.GL_TRIANGLE_STRIP)
        gl.glVertex4f(0.5, -0.25, -0.5, 0)
        gl.glEnd()
        pair(gl, "GL_TRIANGLE_STRIP", front=True)
        pair(gl, "GL_TRIANGLE_STRIP", front=False, x=0.5)

    check(program)


KINDS = ("strips", "empty strips", "points", "lines", "lines and points", "half triangles")
LENGTHS = [(kind, before) for before in (63, 0, 61, 62, 64, 65) for kind in KINDS]


# the quick lane has all kinds with 63 pairs, and all numbers of pairs with strips
@pytest.mark.parametrize(("kind", "before"), with_quick(LENGTHS, [*range(6), *range(6, 36, 6)]))
def test_the_64th_pair_ends_what_is_drawn_together(kind, before):
    """A dart is cut along its other diagonal if a vertex of the same draw is clipped."""

    def dart(gl, column, depth):
        gl.glBegin(gl.GL_QUADS)
        for x, y, z in ((0, 0, 0), (8, 0, 0), (0, 8, 0), (2, 2, depth)):
            gl.glVertex3f(x + 8 * column, y, z)
        gl.glEnd()

    def program(gl):
        gl.glOrtho(0, 24, 0, 8, -1, 1)
        for number in range(before):
            mode = {"points": "GL_POINTS", "lines": "GL_LINE_STRIP", "half triangles": "GL_TRIANGLES"}.get(
                kind, "GL_TRIANGLE_STRIP"
            )
            if kind == "lines and points":
                mode = ("GL_LINE_STRIP", "GL_POINTS")[number % 2]
            gl.glBegin(getattr(gl, mode))
            for x in range({"empty strips": 0, "half triangles": 4}.get(kind, 2)):
                gl.glVertex2f(x, 1)
            gl.glEnd()
        dart(gl, 0, 0)
        dart(gl, 1, 5)
        dart(gl, 2, 0)

    check(program, (24, 8))


@pytest.mark.parametrize("pairs", [62, 63, 64, 65])
def test_the_64th_strip_ends_a_run(pairs):
    def program(gl):
        outlined(gl)
        for number in range(pairs):
            pair(gl, "GL_TRIANGLE_STRIP", number != 0, x=-0.1 + number / 50, depth=0.2 - number / 500)
        for number in range(3):
            pair(gl, "GL_TRIANGLE_STRIP", number != 1, x=number / 5, depth=-0.2)

    check(program)


EMPTY = (
    "",
    "STRIP",
    "STRIP STRIP",
    "FAN",
    "FAN FAN",
    "FAN STRIP",
    "STRIP FAN",
    "S",
    "S S",
    "S STRIP",
    "S FAN",
    "STRIP S",
)


@pytest.mark.parametrize(("empty", "mode", "before"), sampled(EMPTY, ["STRIP", "FAN"], range(5), strength=1))
def test_pairs_after_an_empty_one_of_their_mode_are_drawn_as_on_mesa(empty, mode, before):
    """An empty pair that follows vertices of another mode in the buffer makes Mesa draw nothing after it."""

    def program(gl):
        for name, count in ((mode, before), *((name, 0) for name in empty.split()), (mode, 4), (mode, 5)):
            gl.glBegin(getattr(gl, f"GL_TRIANGLE{name}" if name == "S" else f"GL_TRIANGLE_{name}"))
            for x, y in [(-0.9, -0.8), (0.8, -0.5), (-0.7, 0.6), (0.8, 0.9), (0.9, 0)][:count]:
                gl.glVertex2f(x, y)
            gl.glEnd()

    check(program)


@pytest.mark.parametrize("seed", with_quick([(seed,) for seed in range(30)], range(10)))
def test_random_pairs_have_the_offset_that_they_have_on_mesa(seed):
    def program(gl):
        rng = np.random.default_rng(seed)
        outlined(gl)
        modes = rng.choice(MODES, 2)
        for face in ("GL_FRONT", "GL_BACK"):
            gl.glPolygonMode(getattr(gl, face), getattr(gl, str(rng.choice(["GL_LINE", "GL_FILL", "GL_POINT"]))))
        if rng.random() < 0.5:
            gl.glEnable(gl.GL_CULL_FACE)
        for _ in range(int(rng.choice([8, 100]))):
            mode = str(modes[int(rng.random() < 0.15)])
            gl.glColor3f(*rng.random(3).tolist()) if rng.random() < 0.3 else None
            gl.glBegin(getattr(gl, mode))
            for x, y, z in rng.uniform(-1.2, 1.2, (int(rng.integers(0, 7)), 3)).tolist():
                gl.glVertex3f(x, y, z)
            gl.glEnd()
            if rng.random() < 0.1:
                BETWEEN[str(rng.choice(list(BETWEEN)))](gl)

    check(program)
