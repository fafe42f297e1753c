"""Mesa draws quads together or apart, depending on the call between them: where one is clipped, pixels tell which.

In a draw with a vertex that is clipped, all quads are cut along the other diagonal.
"""

import numpy as np
import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa

CALLS = {
    "glBitmap of nothing": lambda gl: gl.glBitmap(0, 0, 0, 0, 1, 1, None),
    "glBitmap outside": lambda gl: gl.glBitmap(8, 1, 50, 0, 0, 0, bytes([255, 0, 0, 0])),
    "glBitmap without bits": lambda gl: gl.glBitmap(8, 1, 0, 0, 0, 0, bytes(4)),
    "glDrawPixels": lambda gl: gl.glDrawPixels(1, 1, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, bytes(4)),
    "glDrawPixels of nothing": lambda gl: gl.glDrawPixels(0, 0, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, bytes(4)),
    "glDrawPixels of depths": lambda gl: gl.glDrawPixels(1, 1, gl.GL_DEPTH_COMPONENT, gl.GL_UNSIGNED_BYTE, bytes(4)),
    "glCopyPixels": lambda gl: gl.glCopyPixels(0, 0, 1, 1, gl.GL_COLOR),
    "glCopyPixels of nothing": lambda gl: gl.glCopyPixels(0, 0, 0, 0, gl.GL_COLOR),
    "glCopyPixels outside": lambda gl: gl.glCopyPixels(100, 100, 1, 1, gl.GL_COLOR),
    "glPixelZoom": lambda gl: gl.glPixelZoom(2, 2),
    "glPixelZoom, unchanged": lambda gl: gl.glPixelZoom(1, 1),
    "glPixelTransfer": lambda gl: gl.glPixelTransferf(gl.GL_RED_BIAS, 0.1),
    "glPixelTransfer, unchanged": lambda gl: gl.glPixelTransferf(gl.GL_RED_BIAS, 0.0),
    "glPixelTransfer of a switch": lambda gl: gl.glPixelTransferi(gl.GL_MAP_COLOR, 1),
    "glPixelMap": lambda gl: gl.glPixelMapfv(gl.GL_PIXEL_MAP_R_TO_R, 2, np.float32([0, 1])),
    "glPixelStore": lambda gl: gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1),
    "glRasterPos": lambda gl: gl.glRasterPos2f(0, 0),
    "glWindowPos": lambda gl: gl.glWindowPos2i(0, 0),
    "glAccum": lambda gl: gl.glAccum(gl.GL_MULT, 1.0),
    "glReadPixels": lambda gl: gl.glReadPixels(0, 0, 1, 1, gl.GL_RGB, gl.GL_UNSIGNED_BYTE),
    "glClear of nothing": lambda gl: gl.glClear(0),
    "glClearColor": lambda gl: gl.glClearColor(1, 0, 0, 1),
    "glFlush": lambda gl: gl.glFlush(),
    "glHint": lambda gl: gl.glHint(gl.GL_FOG_HINT, gl.GL_NICEST),
    "glGet": lambda gl: gl.glGetFloatv(gl.GL_MODELVIEW_MATRIX),
    "glLineWidth": lambda gl: gl.glLineWidth(3),
    "glLineWidth, unchanged": lambda gl: gl.glLineWidth(1),
    "glDrawBuffer": lambda gl: gl.glDrawBuffer(gl.GL_BACK),
    "glReadBuffer": lambda gl: gl.glReadBuffer(gl.GL_BACK),
    "glBindTexture": lambda gl: gl.glBindTexture(gl.GL_TEXTURE_2D, 3),
    "glTexImage2D": lambda gl: gl.glTexImage2D(
        gl.GL_TEXTURE_2D, 0, gl.GL_RGB, 1, 1, 0, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, bytes(4)
    ),
    "glNewList": lambda gl: (gl.glNewList(5, gl.GL_COMPILE), gl.glEndList()),
    "glCallList of no list": lambda gl: gl.glCallList(77),
    "glCallLists of no list": lambda gl: gl.glCallLists(2, gl.GL_UNSIGNED_BYTE, bytes([60, 61])),
    "glCallList of an empty list": lambda gl: (gl.glNewList(5, gl.GL_COMPILE), gl.glEndList(), gl.glCallList(5)),
    "glListBase": lambda gl: gl.glListBase(50),
    "glPushName": lambda gl: gl.glPushName(1),
    "glPassThrough": lambda gl: gl.glPassThrough(1.0),
    "glRectf of nothing": lambda gl: gl.glRectf(0, 0, 0, 0),
    "glDrawArrays of nothing": lambda gl: gl.glDrawArrays(gl.GL_TRIANGLES, 0, 0),
    "glEdgeFlag": lambda gl: gl.glEdgeFlag(True),
    "glMaterial": lambda gl: gl.glMaterialf(gl.GL_FRONT, gl.GL_SHININESS, 4.0),
}


def draw_quad(gl, x, z):
    """Draw a quad of four colours, of which one corner is at the depth z."""
    gl.glBegin(gl.GL_QUADS)
    corners = (
        (-0.4, -0.8, 0, (1, 0, 0)),
        (0.3, -0.7, 0, (0, 1, 0)),
        (0.4, 0.8, z, (0, 0, 1)),
        (-0.3, 0.6, 0, (1, 1, 0)),
    )
    for across, up, depth, color in corners:
        gl.glColor3f(*color)
        gl.glVertex3f(across + x, up, depth)
    gl.glEnd()


@pytest.mark.parametrize("clipped_first", [False, True])
@pytest.mark.parametrize("name", CALLS)
def test_quads_around_a_call_are_cut_as_those_of_mesa(name, clipped_first):
    def program(gl):
        gl.glRasterPos2f(-1, -1)
        gl.glEnable(gl.GL_DEPTH_TEST)
        quads = [(0.5, 0.6), (-0.5, 1.7)]
        first, second = quads[::-1] if clipped_first else quads
        draw_quad(gl, *first)
        CALLS[name](gl)
        draw_quad(gl, *second)

    comparison = compare(program, (64, 48))
    assert comparison, str(comparison)
