"""PyOpenGL's image calls that end in a type, and its glRasterPos."""

from typing import Any

import numpy as np
import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa
SIZE = (64, 48)
IMAGE = np.indices((16, 16)).sum(0)[..., None] * np.array([3, 5, 7])


def numbers(image: Any) -> np.ndarray:
    return np.frombuffer(image, np.uint8) if isinstance(image, bytes) else np.ravel(image)


def test_image_calls_that_end_in_a_type_are_those_of_pyopengl() -> None:
    def program(gl: Any) -> list[np.ndarray]:
        image = IMAGE.astype(np.uint8)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
        gl.glTexImage2Dub(gl.GL_TEXTURE_2D, 0, gl.GL_RGB, 0, gl.GL_RGB, image)
        gl.glTexSubImage2Df(gl.GL_TEXTURE_2D, 0, 3, 4, gl.GL_RGB, np.full((2, 8, 3), 0.5, np.float32))
        gl.glRasterPos(-0.9, -0.9)
        gl.glDrawPixelsub(gl.GL_RGB, image[:8].copy())
        gl.glRasterPos((0.1, 0.2, 0.3))
        gl.glDrawPixelsf(gl.GL_RGB, (image / 255).astype(np.float32))
        texture = gl.glGetTexImageub(gl.GL_TEXTURE_2D, 0, gl.GL_RGB)
        return [numbers(texture), numbers(gl.glReadPixelsf(0, 0, *SIZE, gl.GL_RED))]

    compared = compare(program, SIZE)
    assert compared, str(compared)
    assert compared.ours.color.any()


def test_sizes_that_tutorials_print_are_those_of_mesa() -> None:
    def program(gl: Any) -> list[np.ndarray]:
        names = ("GL_MAX_ELEMENTS_VERTICES", "GL_MAX_ELEMENTS_INDICES", "GL_AUX_BUFFERS")
        names += ("GL_SMOOTH_LINE_WIDTH_RANGE", "GL_SMOOTH_POINT_SIZE_RANGE")
        return [np.ravel(gl.glGetFloatv(getattr(gl, name))) for name in names]

    compared = compare(program, SIZE)
    assert compared, str(compared)
