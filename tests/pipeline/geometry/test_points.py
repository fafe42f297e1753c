"""Points: squares of whole pixels; those with their centre outside the view are not drawn."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softshadow import gl

pytestmark = pytest.mark.interpreted

SIZE = 24
coordinates = st.floats(8, 16)


def covered_pixels(x: float, y: float, size: float) -> np.ndarray:
    """Return the pixels (SIZE, SIZE) that a point at window position x, y covers, row 0 at the bottom."""
    with gl.create_context(SIZE, SIZE):
        gl.glPointSize(size)
        gl.glBegin(gl.GL_POINTS)
        gl.glVertex2f(x / SIZE * 2 - 1, y / SIZE * 2 - 1)
        gl.glEnd()
        return gl.glReadPixels(0, 0, SIZE, SIZE, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)[:, :, 0] > 0


@given(coordinates, coordinates, st.integers(1, 7))
def test_a_point_of_size_n_is_a_square_of_n_pixels_around_its_position(x, y, size):
    covered = covered_pixels(x, y, size)
    rows, columns = np.flatnonzero(covered.any(axis=1)), np.flatnonzero(covered.any(axis=0))
    assert covered.sum() == size * size
    assert len(rows) == len(columns) == size
    # within half a pixel of the position, rounded to 1/256 pixel
    assert abs(columns.mean() + 0.5 - x) <= 0.5 + 1 / 256
    assert abs(rows.mean() + 0.5 - y) <= 0.5 + 1 / 256


@pytest.mark.parametrize(("size", "pixels"), [(0.3, 1), (1.5, 1), (1.6, 4), (2.5, 4), (3.4, 9)])
def test_the_size_is_rounded_to_whole_pixels_with_a_half_rounded_down(size, pixels):
    assert covered_pixels(12.3, 12.3, size).sum() == pixels


def test_a_point_whose_center_is_outside_the_view_is_not_drawn():
    assert covered_pixels(-0.5, 12, 5).sum() == 0
    assert covered_pixels(0.5, 12.5, 5).sum() == 15


def test_points_are_never_culled_and_use_the_front_stencil_state():
    with gl.create_context(SIZE, SIZE):
        gl.glEnable(gl.GL_CULL_FACE)
        gl.glCullFace(gl.GL_FRONT_AND_BACK)
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glStencilOpSeparate(gl.GL_FRONT, gl.GL_KEEP, gl.GL_KEEP, gl.GL_INCR)
        gl.glBegin(gl.GL_POINTS)
        gl.glVertex2f(0.1, 0.1)
        gl.glEnd()
        stencil = gl.glReadPixels(0, 0, SIZE, SIZE, gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE)
    assert stencil.sum() == 1


@pytest.mark.parametrize(("height", "row"), [(12 - 1 / 512, 11), (12 - 1 / 1024, 12), (12 + 1 / 512, 12)])
def test_a_position_halfway_between_subpixels_is_rounded_as_in_mesa(height, row):
    # stored rows grow downwards: half a subpixel below the border is rounded away from the top, into the lower row
    assert np.flatnonzero(covered_pixels(12.5, height, 1).any(axis=1)).tolist() == [row]
