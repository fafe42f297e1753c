"""Colour textures of every internal format are written from and read to every client format and type as on Mesa."""

import numpy as np
import pytest

from mesa.random_images import PIXEL_FORMATS, PIXEL_TYPES, client_pixels
from mesa.random_writer import Writer
from softshadow.testing import compare

pytestmark = pytest.mark.mesa

WIDTH, HEIGHT = 32, 8
RENDERABLE = ["GL_RGBA8", "GL_RGB8", "GL_RG8", "GL_R8", "GL_RGBA32F", "GL_RGB32F", "GL_RG32F", "GL_R32F"]
INTERNAL_FORMATS = [*RENDERABLE, "GL_LUMINANCE8", "GL_LUMINANCE8_ALPHA8", "GL_ALPHA8", "GL_INTENSITY8"]
KINDS = [(pixel_format, kind) for pixel_format in PIXEL_FORMATS for kind in PIXEL_TYPES]


def pixels(pixel_format: str, kind: str) -> np.ndarray:
    made = client_pixels(Writer(np.random.default_rng(3)), WIDTH, HEIGHT, PIXEL_FORMATS[pixel_format], kind)
    if kind == "GL_FLOAT":
        made[0, :4], made[0, 4:8] = 1, 0  # where products of integers overflow
    return made


def define(gl, internal: str, pixel_format: str, kind: str, image: np.ndarray) -> None:
    names = (getattr(gl, pixel_format), getattr(gl, kind))
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, getattr(gl, internal), WIDTH, HEIGHT, 0, *names, image)


@pytest.mark.parametrize("internal", INTERNAL_FORMATS)
def test_uploads_of_all_formats_and_types_store_the_same_texels(internal):
    images = [(names, pixels(*names)) for names in KINDS]

    def program(gl):
        answers = []
        for names, image in images:
            define(gl, internal, *names, image)
            answers.append(gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, gl.GL_FLOAT))
        return answers

    comparison = compare(program, (8, 8))
    assert comparison, str(comparison)


@pytest.mark.parametrize("internal", INTERNAL_FORMATS)
def test_textures_are_read_alike_in_all_formats_and_types(internal):
    image = pixels("GL_RGBA", "GL_FLOAT")

    def program(gl):
        define(gl, internal, "GL_RGBA", "GL_FLOAT", image)
        return [gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, getattr(gl, f), getattr(gl, t)) for f, t in KINDS]

    comparison = compare(program, (8, 8))
    assert comparison, str(comparison)


@pytest.mark.parametrize("internal", RENDERABLE)
def test_framebuffers_are_read_alike_in_all_formats_and_types(internal):
    image = pixels("GL_RGBA", "GL_FLOAT")

    def program(gl):
        gl.glBindTexture(gl.GL_TEXTURE_2D, texture := gl.glGenTextures(1))
        define(gl, internal, "GL_RGBA", "GL_FLOAT", image)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
        gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, texture, 0)
        return [gl.glReadPixels(0, 0, WIDTH, HEIGHT, getattr(gl, f), getattr(gl, t)) for f, t in KINDS]

    comparison = compare(program, (8, 8))
    assert comparison, str(comparison)


def test_a_copy_of_the_same_size_and_format_leaves_texels_outside_the_window():
    image = pixels("GL_RGBA", "GL_UNSIGNED_BYTE")

    def program(gl):
        define(gl, "GL_RGBA8", "GL_RGBA", "GL_UNSIGNED_BYTE", image)
        gl.glCopyTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, 4, 4, WIDTH, HEIGHT, 0)
        return [gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)]

    comparison = compare(program, (8, 8))
    assert comparison, str(comparison)
    assert (comparison.ours.returned[0][5:, 5:] == image[5:, 5:]).all()
