"""Triangles that have an area only after snapping to 1/256 pixel: their plane equations are NaN."""

import numpy as np
import pytest

from softshadow.testing import compare, run_here

pytestmark = pytest.mark.mesa

SIZE = (64, 48)
# found by the fuzzer: on one line before they are snapped
CORNERS = [(0.8029, -2.5195, -0.9672), (-1.1705, 0.31025, -0.83005), (-7.0907, 8.7995, -0.4186)]
FORMATS = ["GL_DEPTH_COMPONENT24", "GL_DEPTH_COMPONENT32F"]


def target(gl, kind):
    images = (
        ("GL_COLOR_ATTACHMENT0", "GL_RGBA8", "GL_RGBA", "GL_UNSIGNED_BYTE"),
        ("GL_DEPTH_ATTACHMENT", kind, "GL_DEPTH_COMPONENT", "GL_FLOAT"),
    )
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
    for attachment, internal, pixel_format, pixel_type in images:
        name = gl.glGenTextures(1)
        kinds = (getattr(gl, pixel_format), getattr(gl, pixel_type))
        gl.glBindTexture(gl.GL_TEXTURE_2D, name)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, getattr(gl, internal), *SIZE, 0, *kinds, None)
        gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, getattr(gl, attachment), gl.GL_TEXTURE_2D, name, 0)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)


@pytest.mark.parametrize("kind", FORMATS)
@pytest.mark.parametrize("colored", [False, True])
@pytest.mark.parametrize("function", ["GL_ALWAYS", "GL_EQUAL"])
@pytest.mark.parametrize("clamped", [False, True])
def test_a_depth_that_is_not_a_number_is_the_largest_one(kind, colored, function, clamped):
    def program(gl):
        target(gl, kind)
        if clamped:
            gl.glEnable(gl.GL_DEPTH_CLAMP)
            gl.glDepthRange(0.25, 0.5)
        gl.glFrustum(-1.4828, 1.2737252, -1.4828, 1.4828, 1.4828, 49.5565)
        gl.glTranslatef(0.6847, -0.6486, -3.7179)
        gl.glRotatef(90, 0, 0, 1)
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glDepthFunc(getattr(gl, function))
        gl.glBegin(gl.GL_TRIANGLES)
        if colored:
            gl.glColor4f(0.1, 0.7, 0.3, 0.9)
        for corner in CORNERS:
            gl.glVertex3f(*corner)
        gl.glEnd()
        color = gl.glReadPixels(0, 0, *SIZE, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)
        return [color, gl.glReadPixels(0, 0, *SIZE, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT)]

    comparison = compare(program, SIZE)
    assert comparison, str(comparison)
    color, depth = run_here(program, SIZE).returned
    assert np.isfinite(depth).all()
    if not colored and not clamped:
        assert color.any()  # the one pixel that it covers
