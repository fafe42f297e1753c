"""The units of the polygon offset in a float depth buffer are those of Mesa."""

from typing import Any

import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa

SIZE = (31, 23)


@pytest.mark.parametrize("far", [0.0, 1e-30, 1e-9, 1.0])
@pytest.mark.parametrize("units", [1.0, 1e6])
def test_units_count_in_last_places_of_the_largest_depth_and_nothing_at_depth_zero(far: float, units: float) -> None:
    def program(gl: Any) -> list[Any]:
        gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
        depth = (gl.GL_DEPTH_COMPONENT32F, *SIZE, 0, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT, None)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, *depth)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
        gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_DEPTH_ATTACHMENT, gl.GL_TEXTURE_2D, 1, 0)
        gl.glDrawBuffer(gl.GL_NONE)
        gl.glReadBuffer(gl.GL_NONE)
        gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
        gl.glPolygonOffset(0, units)
        gl.glDepthRange(0, far)
        gl.glBegin(gl.GL_TRIANGLES)
        for corner in ((-0.9, -0.9, 0.3), (0.9, -0.8, -0.2), (0, 0.9, 0.4)):
            gl.glVertex3f(*corner)
        gl.glEnd()
        return [gl.glReadPixels(0, 0, *SIZE, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT)]

    compared = compare(program, SIZE)
    assert compared, str(compared)
