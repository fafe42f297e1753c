"""glReadPixels: shapes, orientation, and the part outside the window."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softshadow import gl

WIDTH, HEIGHT = 7, 5


@pytest.fixture(autouse=True)
def context():
    with gl.create_context(WIDTH, HEIGHT) as context:
        rows = context.storage.window.color.view
        rows[:] = np.arange(HEIGHT * WIDTH * 4).reshape(HEIGHT, WIDTH, 4)[::-1]
        yield context


def read(x, y, width, height, array=None, format=gl.GL_RGBA):
    return gl.glReadPixels(x, y, width, height, format, gl.GL_UNSIGNED_BYTE, array)


WINDOW = np.arange(HEIGHT * WIDTH * 4, dtype=np.uint8).reshape(HEIGHT, WIDTH, 4)


def test_row_0_is_the_bottom_row_of_the_window():
    assert (read(0, 0, WIDTH, HEIGHT) == WINDOW).all()


@pytest.mark.parametrize(
    ("format", "shape"), [(gl.GL_RGBA, (2, 3, 4)), (gl.GL_BGR, (2, 3, 3)), (gl.GL_RG, (2, 3, 2)), (gl.GL_RED, (2, 3))]
)
def test_one_component_needs_no_axis(format, shape):
    assert read(0, 0, 3, 2, format=format).shape == shape


@given(st.integers(-9, 9), st.integers(-9, 9), st.integers(0, 12), st.integers(0, 12))
def test_pixels_outside_the_window_keep_the_arrays_values(x, y, width, height):
    array, fresh = (np.full((height, width, 4), value, np.uint8) for value in (211, 0))
    expected = array.copy()
    for j in range(height):
        for i in range(width):
            if 0 <= x + i < WIDTH and 0 <= y + j < HEIGHT:
                expected[j, i] = fresh[j, i] = WINDOW[y + j, x + i]
    assert read(x, y, width, height, array) is array
    assert (array == expected).all()
    assert (read(x, y, width, height) == fresh).all()


def test_rows_are_padded_to_the_alignment_in_a_larger_array():
    array = np.full((2, 8), 7, np.uint8)
    gl.glPixelStorei(gl.GL_PACK_ALIGNMENT, 8)
    read(0, 0, 3, 2, array, gl.GL_RED)
    assert array.tolist() == [[*WINDOW[row, :3, 0], *[7] * 5] for row in (0, 1)]


def test_a_rectangle_is_written_into_a_larger_image():
    array = np.zeros((6, 10, 4), np.uint8)
    gl.glPixelStorei(gl.GL_PACK_ROW_LENGTH, 10)
    gl.glPixelStorei(gl.GL_PACK_SKIP_ROWS, 1)
    gl.glPixelStorei(gl.GL_PACK_SKIP_PIXELS, 2)
    read(0, 0, 4, 3, array)
    expected = np.zeros_like(array)
    expected[1:4, 2:6] = WINDOW[:3, :4]
    assert (array == expected).all()


def test_reading_is_no_command(context):
    before = len(context.frame.commands)
    read(0, 0, 1, 1)
    assert len(context.frame.commands) == before


@pytest.mark.parametrize("size", [(2, 1 << 31), ((1 << 31) + 1, 2), (-1, 2)])
def test_sizes_beyond_32_bits_are_negative_as_in_c(size):
    with pytest.raises(gl.GLError, match="GL_INVALID_VALUE"):
        gl.glReadPixels(0, 0, *size, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)
