"""Arrays that are enabled, but have no pointer: GL leaves open what is read; on Mesa, their numbers are 0."""

import numpy as np
import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa

CORNERS = np.array([[-0.5, -0.5], [0.5, -0.5], [0.1, 0.5], [-0.3, 0.3]], np.float32)
INDICES = np.array([0, 1, 3], np.uint32)


def prepare(gl, array):
    """Set what the values of an array decide about."""
    if array == "GL_NORMAL_ARRAY":
        gl.glEnable(gl.GL_LIGHTING)
        gl.glEnable(gl.GL_LIGHT0)
    elif array == "GL_TEXTURE_COORD_ARRAY":
        texels = np.arange(16, dtype=np.uint8) * 13
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, 2, 2, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glTexCoord2f(0.9, 0.9)
    elif array == "GL_FOG_COORD_ARRAY":
        gl.glEnable(gl.GL_FOG)
        gl.glFogi(gl.GL_FOG_COORD_SRC, gl.GL_FOG_COORD)
        gl.glFogi(gl.GL_FOG_MODE, gl.GL_LINEAR)
        gl.glFogf(gl.GL_FOG_START, -1.0)
        gl.glFogCoordf(1.0)
    elif array == "GL_SECONDARY_COLOR_ARRAY":
        gl.glEnable(gl.GL_COLOR_SUM)
        gl.glColor3f(0.2, 0.2, 0.2)
        gl.glSecondaryColor3f(0.4, 0.1, 0.1)


def compare_draws(array, set_pointer=lambda gl: None):
    def program(gl):
        prepare(gl, array)
        gl.glEnableClientState(getattr(gl, array))
        set_pointer(gl)
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        gl.glVertexPointer(2, gl.GL_FLOAT, 0, CORNERS)
        gl.glDrawArrays(gl.GL_TRIANGLES, 1, 3)
        gl.glDrawElements(gl.GL_TRIANGLES, 3, gl.GL_UNSIGNED_INT, INDICES)

    comparison = compare(program, (40, 30))
    assert comparison, str(comparison)


@pytest.mark.parametrize(
    "array",
    ["GL_COLOR_ARRAY", "GL_NORMAL_ARRAY", "GL_TEXTURE_COORD_ARRAY", "GL_FOG_COORD_ARRAY", "GL_SECONDARY_COLOR_ARRAY"],
)
def test_an_array_that_was_never_given_is_zeros(array):
    compare_draws(array)


def test_the_size_of_the_last_pointer_call_says_which_components_are_missing():
    compare_draws("GL_COLOR_ARRAY", lambda gl: gl.glColorPointer(3, gl.GL_FLOAT, 0, None))


def test_an_array_that_is_given_later_is_read():
    def program(gl):
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        gl.glVertexPointer(2, gl.GL_FLOAT, 0, CORNERS)
        gl.glEnableClientState(gl.GL_COLOR_ARRAY)
        gl.glDrawArrays(gl.GL_TRIANGLES, 0, 3)
        gl.glColorPointer(3, gl.GL_FLOAT, 0, np.full((4, 3), 0.5, np.float32))
        gl.glDrawArrays(gl.GL_TRIANGLES, 1, 3)

    comparison = compare(program, (40, 30))
    assert comparison, str(comparison)
