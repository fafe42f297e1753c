"""Numbers that are too large become infinite as in GL, without a warning, whether kernels are compiled or not."""

import numpy as np
import pytest

from softshadow import gl

pytestmark = pytest.mark.interpreted

LARGE = 3e38  # below the largest float32


@pytest.fixture(autouse=True)
def window():
    with gl.create_context(8, 8) as context:
        yield context


def test_an_infinite_raster_position_is_no_number():
    gl.glRasterPos3f(1e39, 0, 0)
    assert np.isnan(gl.glGetFloatv(gl.GL_CURRENT_RASTER_POSITION)).all()
    assert gl.glGetBooleanv(gl.GL_CURRENT_RASTER_POSITION_VALID)  # as in Mesa


def test_the_texture_coordinates_of_a_raster_position_become_infinite():
    gl.glMatrixMode(gl.GL_TEXTURE)
    gl.glScalef(10, 1, 1)
    gl.glTexCoord2f(LARGE, 0.5)
    gl.glRasterPos2f(0, 0)
    assert gl.glGetFloatv(gl.GL_CURRENT_RASTER_TEXTURE_COORDS).tolist() == [np.inf, 0.5, 0, 1]


def test_a_curve_between_large_control_points_becomes_infinite(window):
    points = np.array([[LARGE, 0, 0], [LARGE, 0, 0], [-LARGE, 0, 0], [LARGE, 1, 0]], np.float32)
    gl.glEnable(gl.GL_MAP1_VERTEX_3)
    gl.glMap1f(gl.GL_MAP1_VERTEX_3, 0, 1, points)
    gl.glBegin(gl.GL_POINTS)
    for u in (0, 0.5, 4):
        gl.glEvalCoord1f(u)
    gl.glEnd()
    x = window.frame.commands[-1].vertices.position[:, 0]
    assert x[0] == np.float32(LARGE)
    assert not np.isfinite(x[2])


def test_normals_of_a_large_surface_become_no_numbers_in_silence(window):
    points = np.zeros((2, 2, 3), np.float32)
    points[1, :, 0], points[:, 1, 1] = LARGE, LARGE
    gl.glEnable(gl.GL_MAP2_VERTEX_3)
    gl.glEnable(gl.GL_AUTO_NORMAL)
    gl.glMap2f(gl.GL_MAP2_VERTEX_3, 0, 1, 0, 1, points)
    gl.glBegin(gl.GL_POINTS)
    gl.glEvalCoord2f(0.5, 0.5)
    gl.glEnd()
    assert np.isnan(window.frame.commands[-1].vertices.normal).any()
