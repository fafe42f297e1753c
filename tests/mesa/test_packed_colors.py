"""Packed pixel types, such as GL_UNSIGNED_SHORT_5_6_5, are written and read as on Mesa."""

from typing import Any

import numpy as np
import pytest

from mesa.random_images import PACKED_KINDS, packed_words
from softshadow.gl import GL_INVALID_ENUM, GL_INVALID_OPERATION
from softshadow.testing import compare

pytestmark = pytest.mark.mesa

WIDTH, HEIGHT = 16, 9
RENDERABLE = ["GL_RGBA8", "GL_RGB8", "GL_RG8", "GL_R8", "GL_RGBA32F", "GL_RGB32F", "GL_RGBA16F"]
INTERNAL_FORMATS = [*RENDERABLE, "GL_LUMINANCE8", "GL_LUMINANCE8_ALPHA8", "GL_ALPHA8", "GL_INTENSITY8"]
PAIRS = [(pixel_format, kind) for kind, (_, formats) in PACKED_KINDS.items() for pixel_format in formats]
FLOATS = np.random.default_rng(4).uniform(-0.2, 1.2, (HEIGHT, WIDTH, 4)).astype(np.float32)
FLOATS[0] = np.linspace(0, 1, WIDTH)[:, np.newaxis]


def words(kind: str, seed: int = 1) -> np.ndarray:
    """Random packed pixels, the smallest and the largest among them."""
    pixels = packed_words(np.random.default_rng(seed), WIDTH, HEIGHT, kind)
    pixels[0, 0], pixels[0, 1] = 0, np.iinfo(pixels.dtype).max
    return pixels


def define(gl: Any, internal: str, pixel_format: str, kind: str, pixels: np.ndarray) -> None:
    """Define the bound texture."""
    names = (getattr(gl, pixel_format), getattr(gl, kind))
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, getattr(gl, internal), WIDTH, HEIGHT, 0, *names, pixels)


def check(program: Any, size: tuple[int, int] = (WIDTH, HEIGHT)) -> None:
    """Compare the buffers and answers of a program with Mesa's."""
    comparison = compare(program, size)
    assert comparison, str(comparison)


@pytest.mark.parametrize("internal", INTERNAL_FORMATS)
def test_uploads_store_the_same_texels(internal):
    def program(gl):
        answers = []
        for pixel_format, kind in PAIRS:
            define(gl, internal, pixel_format, kind, words(kind))
            part = (2, 3, 4, 2, getattr(gl, pixel_format), getattr(gl, kind), words(kind, 2)[:2, :4].copy())
            gl.glTexSubImage2D(gl.GL_TEXTURE_2D, 0, *part)
            answers.append(gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, gl.GL_FLOAT))
        return answers

    check(program)


@pytest.mark.parametrize("internal", INTERNAL_FORMATS)
def test_textures_are_read_alike(internal):
    def program(gl):
        define(gl, internal, "GL_RGBA", "GL_FLOAT", FLOATS)
        return [gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, getattr(gl, f), getattr(gl, t)) for f, t in PAIRS]

    check(program)


@pytest.mark.parametrize("internal", RENDERABLE)
def test_framebuffers_are_read_alike(internal):
    def program(gl):
        gl.glBindTexture(gl.GL_TEXTURE_2D, texture := gl.glGenTextures(1))
        define(gl, internal, "GL_RGBA", "GL_FLOAT", FLOATS)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
        gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, texture, 0)
        return [gl.glReadPixels(0, 0, WIDTH, HEIGHT, getattr(gl, f), getattr(gl, t)) for f, t in PAIRS]

    check(program)


@pytest.mark.parametrize("internal", ["window", "GL_RGBA32F"])
@pytest.mark.parametrize("kind", sorted(PACKED_KINDS))
def test_rectangles_are_drawn_alike(kind, internal):
    def program(gl):
        if internal != "window":
            gl.glBindTexture(gl.GL_TEXTURE_2D, texture := gl.glGenTextures(1))
            define(gl, internal, "GL_RGBA", "GL_FLOAT", FLOATS)
            gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
            gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, texture, 0)
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
        answers = []
        for pixel_format in PACKED_KINDS[kind][1]:
            gl.glWindowPos2i(0, 0)
            gl.glDrawPixels(WIDTH, HEIGHT, getattr(gl, pixel_format), getattr(gl, kind), words(kind))
            answers.append(gl.glReadPixels(0, 0, WIDTH, HEIGHT, gl.GL_RGBA, gl.GL_FLOAT))
        return answers

    check(program)


def test_wrong_pairs_have_the_errors_of_mesa():
    formats = "RED ALPHA RG RGB BGR RGBA BGRA LUMINANCE LUMINANCE_ALPHA COLOR_INDEX DEPTH_COMPONENT DEPTH_STENCIL"
    kinds = [
        "GL_UNSIGNED_BYTE",
        "GL_DOUBLE",
        *PACKED_KINDS,
        "GL_UNSIGNED_INT_24_8",
        "GL_FLOAT_32_UNSIGNED_INT_24_8_REV",
    ]

    def program(gl):
        codes = []
        pixels = np.zeros(64, np.uint8)
        for pixel_format in formats.split():
            for kind in kinds:
                names = getattr(gl, f"GL_{pixel_format}"), getattr(gl, kind)
                try:
                    gl.glReadPixels(0, 0, 2, 2, *names)
                    codes.append(0)
                except gl.GLError as error:
                    codes.append(int(error.err))
                while gl.glGetError():
                    pass
        return [np.array(codes), pixels]

    check(program)
    answered = compare(program, (4, 4)).ours.returned[0]
    assert {GL_INVALID_ENUM, GL_INVALID_OPERATION, 0} == set(answered.tolist())
