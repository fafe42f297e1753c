"""The same glBegin ... glEnd pairs of quads as on Mesa are joined to one draw, which decides how quads are cut.

A dart (a concave quad) is cut along its other diagonal if a vertex of the same draw is clipped, or if it is flat shaded
with a colour per vertex. Both show in its pixels.
"""

import numpy as np
import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa

SIDE = 8
DART = ((0, 0), (SIDE, 0), (0, SIDE), (2, 2))
# calls between two pairs: some end a draw, some do not
BETWEEN = {
    "nothing": lambda gl: None,
    "colour": lambda gl: gl.glColor3f(1, 0.5, 0),
    "colour and alpha": lambda gl: gl.glColor4f(1, 0.5, 0, 1),
    "normal": lambda gl: gl.glNormal3f(0, 0, 1),
    "texture coordinate": lambda gl: gl.glTexCoord2f(0, 0),
    "the same state": lambda gl: (gl.glDisable(gl.GL_BLEND), gl.glDepthFunc(gl.GL_LESS)),
    "a state that changes back": lambda gl: (gl.glEnable(gl.GL_STENCIL_TEST), gl.glDisable(gl.GL_STENCIL_TEST)),
    "clear values": lambda gl: (gl.glClearColor(1, 0, 1, 1), gl.glClearDepth(0.5), gl.glClearStencil(3)),
    "matrix stack": lambda gl: (gl.glPushMatrix(), gl.glPopMatrix()),
    "matrix mode": lambda gl: (gl.glMatrixMode(gl.GL_PROJECTION), gl.glMatrixMode(gl.GL_MODELVIEW)),
    "no matrix": lambda gl: gl.glLoadIdentity(),
    "identity": lambda gl: gl.glMultMatrixf(np.eye(4, dtype=np.float32)),
    "no way": lambda gl: gl.glTranslatef(0, 0, 0),
    "no turn": lambda gl: gl.glRotatef(0, 0, 0, 1),
    "flush": lambda gl: gl.glFlush(),
    "reading state": lambda gl: gl.glGetFloatv(gl.GL_CURRENT_COLOR),
    "reading pixels": lambda gl: gl.glReadPixels(0, 0, 1, 1, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE),
    "material": lambda gl: gl.glMaterialfv(gl.GL_FRONT, gl.GL_DIFFUSE, (0.8, 0.8, 0.8, 1)),
    "another primitive": lambda gl: (gl.glBegin(gl.GL_LINES), gl.glEnd()),
    "quads without vertices": lambda gl: (gl.glBegin(gl.GL_QUADS), gl.glEnd()),
    "debug group": lambda gl: gl.glPushDebugGroup(gl.GL_DEBUG_SOURCE_APPLICATION, 0, -1, "inner"),
    "attribute stack": lambda gl: (gl.glPushAttrib(gl.GL_ALL_ATTRIB_BITS), gl.glPopAttrib()),
    "a list": lambda gl: (gl.glNewList(1, gl.GL_COMPILE), gl.glEndList()),
    "active unit": lambda gl: (gl.glActiveTexture(gl.GL_TEXTURE1), gl.glActiveTexture(gl.GL_TEXTURE0)),
    "binding what is bound": lambda gl: gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0),
    "clearing nothing": lambda gl: gl.glClear(0),
    "new names": lambda gl: (gl.glGenTextures(1), gl.glIsTexture(1)),
}


def window(gl, columns):
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.glOrtho(0, SIDE * columns, 0, SIDE, -1, 1)
    gl.glMatrixMode(gl.GL_MODELVIEW)


def dart(gl, column, clipped, inside=lambda gl, corner: None):
    """Send the vertices of a dart, `inside` before each; the fourth vertex of a clipped one is beyond the far plane."""
    for corner, (x, y) in enumerate(DART):
        inside(gl, corner)
        gl.glVertex3f(x + SIDE * column, y, 5 if clipped and corner == 3 else 0)


def pair(gl, column, clipped):
    gl.glBegin(gl.GL_QUADS)
    dart(gl, column, clipped)
    gl.glEnd()


@pytest.mark.parametrize("between", BETWEEN)
def test_calls_between_two_pairs_end_a_draw_as_on_mesa(between):
    def program(gl):
        window(gl, 2)
        pair(gl, 0, clipped=True)
        BETWEEN[between](gl)
        pair(gl, 1, clipped=False)

    comparison = compare(program, (2 * SIDE, SIDE))
    assert comparison, str(comparison)


def random_calls(gl, rng):
    """Draw pairs of random darts, with random attributes in and between them and random calls in between."""
    columns = 6

    def attribute(gl, corner=None):
        value = float(np.float32(rng.random()))
        choice = rng.integers(0, 24 if corner is None else 16)
        if choice == 0:
            gl.glColor3f(value, 1, 0)
        elif choice == 1:
            gl.glColor4f(value, 0, 1, 1)
        elif choice == 2:
            gl.glNormal3f(0, 0, 1)
        elif choice == 3:
            gl.glTexCoord2f(value, 0)
        elif choice == 4:
            gl.glTexCoord4f(value, 0, 0, 1)

    window(gl, columns)
    for column in range(columns):
        mode = gl.GL_QUADS if rng.random() < 0.8 else rng.choice([gl.GL_QUAD_STRIP, gl.GL_TRIANGLES, gl.GL_POLYGON])
        gl.glShadeModel(gl.GL_FLAT if rng.random() < 0.3 else gl.GL_SMOOTH)
        gl.glBegin(int(mode))
        for _ in range(rng.integers(1, 4)):
            dart(gl, column, rng.random() < 0.3, attribute)
        if rng.random() < 0.1:
            gl.glVertex2f(0, 0)  # begins a quad that is never completed
        gl.glEnd()
        attribute(gl)
        if rng.random() < 0.3:
            BETWEEN[rng.choice(sorted(BETWEEN))](gl)


@pytest.mark.parametrize("seed", range(12))
def test_random_pairs_are_cut_as_on_mesa(seed):
    comparison = compare(lambda gl: random_calls(gl, np.random.default_rng(seed)), (6 * SIDE, SIDE))
    assert comparison, str(comparison)
