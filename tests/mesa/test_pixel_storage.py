"""glPixelStore: swapped bytes, and bitmaps whose lowest bit is the left one, are those of Mesa."""

from typing import Any

import numpy as np
import pytest

from mesa.random_images import PACKED_KINDS, PIXEL_TYPES, client_pixels, packed_words
from mesa.random_writer import Writer
from softshadow.testing import compare

pytestmark = pytest.mark.mesa

SIZE = WIDTH, HEIGHT = 16, 9
KINDS = [*PIXEL_TYPES, *PACKED_KINDS]


def check(program: Any) -> None:
    """Compare the buffers and answers of a program with Mesa's."""
    comparison = compare(program, SIZE)
    assert comparison, str(comparison)


def pixels(kind: str) -> tuple[str, np.ndarray]:
    """A format for a type, and random pixels."""
    rng = np.random.default_rng(5)
    if kind in PACKED_KINDS:
        return PACKED_KINDS[kind][1][0], packed_words(rng, WIDTH, HEIGHT, kind)
    return "GL_RGBA", client_pixels(Writer(rng), WIDTH, HEIGHT, 4, kind)


@pytest.mark.parametrize("kind", KINDS)
def test_bytes_are_swapped_on_every_way(kind):
    pixel_format, image = pixels(kind)
    image = image.byteswap()

    def program(gl):
        gl.glPixelStorei(gl.GL_UNPACK_SWAP_BYTES, gl.GL_TRUE)
        names = (getattr(gl, pixel_format), getattr(gl, kind))
        gl.glWindowPos2i(0, 0)
        gl.glDrawPixels(WIDTH, HEIGHT, *names, image)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, WIDTH, HEIGHT, 0, *names, image)
        gl.glPixelStorei(gl.GL_PACK_SWAP_BYTES, 3)
        set_to = int(gl.glGetIntegerv(gl.GL_PACK_SWAP_BYTES))
        answers = [gl.glReadPixels(1, 2, 9, 5, *names), gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, *names)]
        gl.glPixelStorei(gl.GL_PACK_SWAP_BYTES, 0)
        return [answer.view(np.uint8) for answer in answers] + [np.array([set_to])]

    check(program)


@pytest.mark.parametrize("skip", range(10))
def test_bitmaps_whose_lowest_bit_is_left(skip):
    bits = np.random.default_rng(skip).integers(0, 256, 60, dtype=np.uint8).tobytes()

    def program(gl):
        gl.glPixelStorei(gl.GL_UNPACK_LSB_FIRST, gl.GL_TRUE)
        gl.glPixelStorei(gl.GL_UNPACK_SKIP_PIXELS, skip)
        gl.glPixelStorei(gl.GL_UNPACK_ROW_LENGTH, 24)
        gl.glWindowPos2i(1, 1)
        gl.glBitmap(13, 7, 0, 0, 0, 0, bits)
        return []

    check(program)


def test_parameters_of_three_dimensional_images_are_kept():
    def program(gl):
        answers = []
        for name in ("IMAGE_HEIGHT", "SKIP_IMAGES"):
            for direction in ("PACK", "UNPACK"):
                token = getattr(gl, f"GL_{direction}_{name}")
                gl.glPixelStorei(token, 5)
                answers.append(int(gl.glGetIntegerv(token)))
                try:
                    gl.glPixelStorei(token, -1)
                except gl.GLError as error:
                    answers.append(int(error.err))
                    gl.glGetError()
                gl.glPixelStorei(token, 0)
        return [np.array(answers)]

    check(program)
