"""Mesa collects the vertices of immediate mode in a buffer; a primitive that does not fit is drawn in parts.

Two effects are visible: a colour is constant only if no vertex carries one, and each part of consecutive quads is
clipped as a draw of its own.
"""

import numpy as np
import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa

MODES = [
    "GL_POINTS", "GL_LINES", "GL_LINE_STRIP", "GL_LINE_LOOP", "GL_TRIANGLES", "GL_TRIANGLE_STRIP", "GL_TRIANGLE_FAN",
    "GL_QUADS", "GL_QUAD_STRIP", "GL_POLYGON",
]  # fmt: skip
TIES = (0.1, 0.3, 0.7, 0.9)  # each is k + 1/2 steps of 8 bits
SIDE = 8
DART = ((0, 0), (SIDE, 0), (0, SIDE), (2, 2))


def perspective(gl):
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.glFrustum(-0.1, 0.1, -0.08, 0.08, 0.1, 10)
    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glTranslatef(0, 0, -2)


def give(gl, attribute, rng):
    if attribute == 0:
        gl.glColor3f(*rng.choice(TIES, 3))
    elif attribute == 1:
        gl.glColor4f(*rng.choice(TIES, 4))
    elif attribute == 2:
        gl.glNormal3f(*rng.random(3))
    else:
        gl.glTexCoord2f(*rng.random(2))


@pytest.mark.parametrize("mode", MODES)
def test_a_colour_is_one_for_all_vertices_until_they_carry_it(mode):
    def program(gl):
        rng = np.random.default_rng(MODES.index(mode))
        perspective(gl)
        gl.glColor4f(*TIES)
        for late in range(9):
            gl.glFlush()
            gl.glBegin(getattr(gl, mode))
            for number in range(9):
                if number == late:
                    give(gl, 0, rng)
                if number == late + 2:
                    give(gl, 3, rng)
                gl.glVertex3f(*(2 * rng.random(3) - 1))
            gl.glEnd()

    comparison = compare(program, (48, 40))
    assert comparison, str(comparison)


@pytest.mark.parametrize("seed", range(20))
def test_attributes_anywhere_in_a_primitive_leave_the_same_bits(seed):
    def program(gl):
        rng = np.random.default_rng(seed)
        perspective(gl)
        gl.glEnable(gl.GL_BLEND)  # what is drawn twice shows
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE)
        for _ in range(8):
            gl.glBegin(getattr(gl, MODES[rng.integers(len(MODES))]))
            for _ in range(rng.integers(0, 10)):
                for attribute in np.flatnonzero(rng.random(4) < 0.1):
                    give(gl, attribute, rng)
                gl.glVertex3f(*(2 * rng.random(3) - 1))
            gl.glEnd()
            if rng.random() < 0.3:
                gl.glFlush()
            if rng.random() < 0.3:
                give(gl, rng.integers(4), rng)

    comparison = compare(program, (48, 40))
    assert comparison, str(comparison)


@pytest.mark.parametrize("pairs", [1, 7])
@pytest.mark.parametrize("first", [0, 1, 2, 3])
def test_the_end_of_the_buffer_ends_a_draw_of_quads(pairs, first):
    """Vertices of 84 bytes fill the 512 KB after about 6,240 of them; llvmpipe draws 4,096 at a time."""
    quads = 5000

    def program(gl):
        columns = 64
        gl.glOrtho(0, SIDE * columns, 0, SIDE, -1, 1)
        gl.glEnable(gl.GL_LIGHTING)
        gl.glBegin(gl.GL_TRIANGLES)
        for _ in range(first):
            gl.glVertex2f(0, 0)
        gl.glEnd()
        for pair in range(pairs):
            gl.glBegin(gl.GL_QUADS)
            for number in range(pair * quads // pairs, (pair + 1) * quads // pairs):
                gl.glColor4f(1, 1, 1, 1)
                gl.glNormal3f(0, 0, 1)
                for unit in (gl.GL_TEXTURE0, gl.GL_TEXTURE1):
                    gl.glMultiTexCoord4f(unit, 0, 0, 0, 1)
                gl.glMaterialfv(gl.GL_FRONT, gl.GL_EMISSION, (number / quads, 1, 1, 1))
                clipped = number % 1900 == 1899
                for x, y in DART:
                    gl.glVertex2f(x + number * columns // quads * SIDE, y - clipped)
            gl.glEnd()

    comparison = compare(program, (512, SIDE))
    assert comparison, str(comparison)
