"""Client memory: where glPixelStore finds the rows of an image."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softshadow import tokens as gl
from softshadow.pixel_store import COMPONENTS, TYPES, PixelStore, client_image, image_view, output_array

TIGHT = PixelStore(alignment=1)


def pixel_by_pixel(memory: bytes, store: PixelStore, width: int, height: int, pixel: int) -> list[bytes]:
    """The bytes of every pixel, addressed as the specification does (GL 2.1, sec. 3.6.4, eq. 3.13)."""
    row = (store.row_length or width) * pixel
    step = -(-row // store.alignment) * store.alignment
    return [
        memory[start : start + pixel]
        for y in range(height)
        for x in range(width)
        for start in [(store.skip_rows + y) * step + (store.skip_pixels + x) * pixel]
    ]


@given(
    st.sampled_from([1, 2, 4, 8]),
    st.integers(0, 9),
    st.integers(0, 3),
    st.integers(0, 3),
    st.integers(1, 6),
    st.integers(1, 4),
    st.sampled_from([gl.GL_RED, gl.GL_RGB, gl.GL_RGBA]),
    st.sampled_from([gl.GL_UNSIGNED_BYTE, gl.GL_UNSIGNED_SHORT]),
)
def test_rows_lie_where_the_specification_says(align, length, rows, pixels, width, height, format, type):
    store = PixelStore(align, length, rows, pixels)
    pixel = len(COMPONENTS[format]) * np.dtype(TYPES[type]).itemsize
    memory = np.random.default_rng(width).integers(0, 256, 4000, dtype=np.uint8)
    image = image_view(memory, store, width, height, format, type, "glTexImage2D")
    pixels_read = [np.ascontiguousarray(image[y, x]).tobytes() for y in range(height) for x in range(width)]
    assert pixels_read == pixel_by_pixel(memory.tobytes(), store, width, height, pixel)


def test_an_array_needs_no_padding_at_the_initial_alignment():
    image = np.arange(2 * 3 * 3, dtype=np.uint8).reshape(2, 3, 3)
    converted = client_image(image, PixelStore(), 3, 2, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, "glTexImage2D")
    assert (converted == image).all()


def test_padded_memory_is_read_at_its_alignment():
    rows = np.arange(2 * 4, dtype=np.uint8).reshape(2, 4)
    converted = client_image(rows.tobytes(), PixelStore(), 3, 2, gl.GL_RED, gl.GL_UNSIGNED_BYTE, "glTexImage2D")
    assert (converted[..., 0] == rows[:, :3]).all()


def test_lists_and_other_number_types_are_converted():
    converted = client_image([[1, 2], [3, 4]], TIGHT, 2, 2, gl.GL_RED, gl.GL_FLOAT, "glTexImage2D")
    assert converted.dtype == np.float32
    assert converted.ravel().tolist() == [1, 2, 3, 4]


def test_too_few_pixels_are_named():
    with pytest.raises(ValueError, match=r"glTexImage2D: the image has 4 bytes; 2 x 2 pixels of 3 uint8 need 12"):
        client_image(bytes(4), TIGHT, 2, 2, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, "glTexImage2D")


@pytest.mark.parametrize("pixels", [np.full((2, 2), 0.5), np.array([["a"]])])
def test_pixels_that_would_be_cut_are_refused(pixels):
    with pytest.raises(TypeError, match=r"type=GL_UNSIGNED_BYTE takes uint8 numbers or bytes"):
        client_image(pixels, TIGHT, 2, 2, gl.GL_RED, gl.GL_UNSIGNED_BYTE, "glTexImage2D")


def test_a_read_out_is_a_new_array_of_its_own_shape():
    answer, view = output_array(None, PixelStore(), 3, 2, gl.GL_RGB, gl.GL_FLOAT, "glReadPixels")
    view[...] = 7
    assert answer.shape == (2, 3, 3)
    assert (answer == 7).all()
    assert output_array(None, TIGHT, 3, 2, gl.GL_RED, gl.GL_FLOAT, "glReadPixels")[0].shape == (2, 3)


def test_a_users_array_is_written_in_place():
    array = np.zeros((4, 8), np.uint8)
    answer, view = output_array(array, PixelStore(1, 8, 1, 2), 3, 2, gl.GL_RED, gl.GL_UNSIGNED_BYTE, "glReadPixels")
    view[...] = 9
    expected = np.zeros((4, 8), np.uint8)
    expected[1:3, 2:5] = 9
    assert answer is array
    assert (array == expected).all()


@pytest.mark.parametrize(
    ("array", "error", "message"),
    [
        (np.zeros((2, 2), np.float64), TypeError, "expected an array of float32, got float64"),
        ([0, 0, 0, 0], TypeError, "expected an array of float32"),
        (np.zeros((2, 4), np.float32)[:, ::2], ValueError, "C-contiguous and writeable"),
        (np.zeros((1, 2), np.float32), ValueError, "has 8 bytes; 2 x 2 pixels of 1 float32 need 16"),
    ],
)
def test_an_array_that_cannot_be_filled_is_refused(array, error, message):
    with pytest.raises(error, match=message):
        output_array(array, TIGHT, 2, 2, gl.GL_RED, gl.GL_FLOAT, "glReadPixels")
