"""Points: squares of whole pixels, all or nothing at the edge of the view."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softshadow import gl

pytestmark = pytest.mark.interpreted

SIZE = 24
places = st.floats(8, 16)


def drawn(x: float, y: float, size: float) -> np.ndarray:
    """The pixels (SIZE, SIZE) that a point at window position x, y covers, row 0 at the bottom."""
    with gl.create_context(SIZE, SIZE):
        gl.glPointSize(size)
        gl.glBegin(gl.GL_POINTS)
        gl.glVertex2f(x / SIZE * 2 - 1, y / SIZE * 2 - 1)
        gl.glEnd()
        return gl.glReadPixels(0, 0, SIZE, SIZE, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)[:, :, 0] > 0


@given(places, places, st.integers(1, 7))
def test_a_point_of_size_n_is_a_square_of_n_pixels_around_its_place(x, y, size):
    covered = drawn(x, y, size)
    rows, columns = np.flatnonzero(covered.any(axis=1)), np.flatnonzero(covered.any(axis=0))
    assert covered.sum() == size * size
    assert len(rows) == len(columns) == size
    # within half a pixel of the place, and a rounding of it to 1/256 pixel
    assert abs(columns.mean() + 0.5 - x) <= 0.5 + 1 / 256
    assert abs(rows.mean() + 0.5 - y) <= 0.5 + 1 / 256


@pytest.mark.parametrize(("size", "pixels"), [(0.3, 1), (1.5, 1), (1.6, 4), (2.5, 4), (3.4, 9)])
def test_the_size_is_rounded_to_whole_pixels_and_a_half_down(size, pixels):
    assert drawn(12.3, 12.3, size).sum() == pixels


def test_a_point_whose_centre_is_outside_the_view_is_not_drawn_at_all():
    assert drawn(-0.5, 12, 5).sum() == 0
    assert drawn(0.5, 12.5, 5).sum() == 15


def test_nothing_culls_points_and_the_front_stencil_state_is_theirs():
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
def test_a_place_halfway_between_two_subpixels_goes_the_way_of_mesa(height, row):
    # stored rows run downwards: half a subpixel below an edge is rounded away from the top, the lower row keeps it
    assert np.flatnonzero(drawn(12.5, height, 1).any(axis=1)).tolist() == [row]
