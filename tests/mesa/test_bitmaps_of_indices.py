"""Indices of one bit (GL_BITMAP) are drawn and stored as by Mesa, in the colours of glPixelMap."""

from typing import Any

import numpy as np
import pytest

from softshadow import gl
from softshadow.testing import compare

pytestmark = pytest.mark.mesa
SIZE = (24, 16)


def drawn_and_stored(gl: Any) -> list[np.ndarray]:
    """Draw a bitmap as colours, and return textures of it."""
    rng = np.random.default_rng(4)
    bits = rng.integers(0, 256, 64).astype(np.uint8)
    gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1)
    told = []
    for name, numbers in (("R", [0.25, 0.75]), ("G", [1, 0.1]), ("B", [0.4, 0.6]), ("A", [1, 0.5])):
        gl.glPixelMapfv(getattr(gl, f"GL_PIXEL_MAP_I_TO_{name}"), 2, np.array(numbers, np.float32))
    gl.glWindowPos2i(2, 3)
    gl.glDrawPixels(20, 8, gl.GL_COLOR_INDEX, gl.GL_BITMAP, bits)
    target = gl.GL_TEXTURE_2D
    gl.glBindTexture(target, gl.glGenTextures(1))
    for lsb_first in (0, 1):
        gl.glPixelStorei(gl.GL_UNPACK_LSB_FIRST, lsb_first)
        gl.glTexImage2D(target, 0, gl.GL_RGBA, 16, 8, 0, gl.GL_COLOR_INDEX, gl.GL_BITMAP, bits)
        gl.glTexSubImage2D(target, 0, 1, 2, 5, 3, gl.GL_COLOR_INDEX, gl.GL_BITMAP, bits[3:])
        told.append(np.ravel(gl.glGetTexImage(target, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)))
    return told


def test_bitmaps_of_indices_are_drawn_and_stored_as_by_mesa() -> None:
    compared = compare(drawn_and_stored, SIZE)
    assert compared, str(compared)


def test_stencil_values_of_one_bit_are_drawn() -> None:  # Mesa does not return from this call
    with gl.create_context(8, 2):
        gl.glWindowPos2i(0, 0)
        gl.glDrawPixels(8, 2, gl.GL_STENCIL_INDEX, gl.GL_BITMAP, bytes([0b10110001, 0, 0, 0, 0b01000000, 0, 0, 0]))
        values = gl.glReadPixels(0, 0, 8, 2, gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE)
        assert values.tolist() == [[1, 0, 1, 1, 0, 0, 0, 1], [0, 1, 0, 0, 0, 0, 0, 0]]


def test_colors_are_no_bitmaps_and_none_are_read() -> None:
    with gl.create_context(4, 4):
        with pytest.raises(gl.GLError, match=r"GL_INVALID_ENUM: glDrawPixels\(type="):
            gl.glDrawPixels(4, 4, gl.GL_RGB, gl.GL_BITMAP, bytes(64))
        with pytest.raises(gl.GLError, match="GL_INVALID"):
            gl.glReadPixels(0, 0, 4, 4, gl.GL_COLOR_INDEX, gl.GL_BITMAP)
