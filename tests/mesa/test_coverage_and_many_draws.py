"""glMultiDrawElements draws what Mesa draws; the state of glSampleCoverage is set, pushed and returned as in Mesa."""

import ctypes
from typing import Any

import numpy as np
import pytest

from softshadow import gl
from softshadow.testing import compare

pytestmark = pytest.mark.mesa
SIZE = (32, 24)
VERTICES = np.array(
    [[-0.9, -0.7, 0.2], [-0.8, 0.8, -0.4], [-0.1, -0.9, 0.9], [0.1, 0.6, 0.1], [0.8, -0.5, -0.8], [0.9, 0.95, 0.6]],
    np.float32,
)
INDICES = [np.array(indices, np.uint16) for indices in ([0, 1, 2], [2, 1, 3], [5, 4, 3, 2])]
SWITCHES = ("GL_SAMPLE_COVERAGE", "GL_SAMPLE_ALPHA_TO_ONE", "GL_SAMPLE_ALPHA_TO_COVERAGE")


def many_draws(gl: Any) -> np.ndarray:
    """Draws from arrays, from offsets and in a display list, and the errors of wrong arguments."""
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, VERTICES)
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    short, triangles = gl.GL_UNSIGNED_SHORT, gl.GL_TRIANGLES
    gl.glColor3f(1, 0.5, 0.2)
    gl.glMultiDrawElements(triangles, [3, 0, 3], short, INDICES, 3)
    gl.glColor3f(0, 0.5, 0.9)
    gl.glNewList(1, gl.GL_COMPILE)
    gl.glMultiDrawElements(gl.GL_LINE_STRIP, np.array([3, 3, 4], np.int32), short, INDICES, 3)
    gl.glEndList()
    gl.glCallList(1)
    gl.glMultiDrawElements(gl.GL_QUADS, [3, 4], short, [None, INDICES[2]], 2)  # None: nothing is drawn
    gl.glBindBuffer(gl.GL_ELEMENT_ARRAY_BUFFER, gl.glGenBuffers(1))
    gl.glBufferData(gl.GL_ELEMENT_ARRAY_BUFFER, np.concatenate(INDICES), gl.GL_STATIC_DRAW)
    gl.glColor3f(0, 0.9, 0.1)
    offsets = [ctypes.c_void_p(12), ctypes.c_void_p(0)]
    gl.glMultiDrawElements(gl.GL_TRIANGLE_STRIP, [4, 3], short, offsets, 2)
    errors = []
    for mode, counts, kind, n in (
        (triangles, [3, -3], short, 2), (99, [3, -3], short, 2), (triangles, [3, -3], gl.GL_FLOAT, 2),
        (triangles, [3, 3], short, -1),
    ):  # fmt: skip
        try:
            gl.glMultiDrawElements(mode, counts, kind, offsets, n)
        except gl.GLError as error:
            errors.append(int(error.err))
    return np.array(errors)


def test_many_draws_are_those_of_mesa() -> None:
    compared = compare(many_draws, SIZE)
    assert compared, str(compared)
    value, enum = gl.GL_INVALID_VALUE, gl.GL_INVALID_ENUM
    assert compared.ours.returned.tolist() == [value, enum, enum, value]


def coverage(gl: Any) -> np.ndarray:
    """Return the state of multisampling, set, pushed and restored."""
    told: list[float] = []

    def ask() -> None:
        for read, pname in (
            (gl.glGetFloatv, gl.GL_SAMPLE_COVERAGE_VALUE), (gl.glGetIntegerv, gl.GL_SAMPLE_COVERAGE_VALUE),
            (gl.glGetBooleanv, gl.GL_SAMPLE_COVERAGE_INVERT),
        ):  # fmt: skip
            told.append(float(np.ravel(read(pname))[0]))
        told.extend(float(gl.glIsEnabled(getattr(gl, name))) for name in SWITCHES)

    ask()
    for bit in (gl.GL_MULTISAMPLE_BIT, gl.GL_ENABLE_BIT):
        gl.glPushAttrib(bit)
        for name in SWITCHES:
            gl.glEnable(getattr(gl, name))
        for value, inverted in ((0.3, True), (7, False), (-2.5, True)):
            gl.glSampleCoverageARB(value, inverted)
            ask()
        gl.glNewList(1, gl.GL_COMPILE)
        gl.glSampleCoverage(0.75, False)
        gl.glEndList()
        ask()
        gl.glCallList(1)
        ask()
        gl.glPopAttrib()
        ask()
    gl.glRectf(-1, -1, 0.5, 0.5)
    return np.array(told)


def test_state_of_sample_coverage_is_that_of_mesa() -> None:
    compared = compare(coverage, SIZE)
    assert compared, str(compared)
