"""Textures in all internal formats of GL 2.1 that are not compressed are stored, read and sampled as by Mesa."""

from typing import Any

import numpy as np
import pytest

from mesa.random_formats import FORMATS, OF_FEW_BITS, SIZE, SRGB, copies, lookups, mipmaps, transfers, uploads
from softshadow import gl
from softshadow.testing import compare

pytestmark = pytest.mark.mesa
DRAWN_SRGB = [name for name in SRGB if "LUMINANCE" not in name]


def check(program: Any, size: tuple[int, int] = (4, 4)) -> None:
    compared = compare(program, size)
    assert compared, str(compared)


@pytest.mark.parametrize("seed", range(4))
def test_uploads_in_all_formats_store_and_give_back_the_same_numbers(seed: int) -> None:
    check(uploads(seed, FORMATS))


@pytest.mark.parametrize("seed", range(6))
def test_lookups_in_all_formats_give_the_same_colors(seed: int) -> None:
    check(lookups(seed, FORMATS), SIZE)


def test_transferred_pixels_store_the_same_texels() -> None:
    check(transfers(1, FORMATS))


def test_copies_of_framebuffers_store_the_same_texels() -> None:
    check(copies(1, FORMATS), SIZE)


def test_computed_mipmaps_store_the_same_texels() -> None:
    check(mipmaps(1, [name for name in FORMATS if name not in DRAWN_SRGB]))


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(100, 160))
def test_many_textures_in_all_formats_are_those_of_mesa(seed: int) -> None:
    check(uploads(seed, FORMATS))
    check(lookups(seed, FORMATS), SIZE)
    check(lookups(seed, OF_FEW_BITS), SIZE)
    check(transfers(seed, FORMATS))
    check(copies(seed, FORMATS), SIZE)
    check(mipmaps(seed, [name for name in FORMATS if name not in DRAWN_SRGB]))


# llvmpipe encodes sRGB with the processor's approximate reciprocal square roots, which differ from maker to maker
LARGEST_DIFFERENCE, LARGEST_SHARE = 1.01 / 255, 0.02


def test_computed_mipmaps_of_srgb_differ_in_few_texels_by_one() -> None:
    compared = compare(mipmaps(2, DRAWN_SRGB * 4), (4, 4))
    differences = np.concatenate(
        [np.ravel(ours - theirs) for ours, theirs in zip(compared.ours.returned, compared.theirs.returned, strict=True)]
    )
    assert np.abs(differences).max() <= LARGEST_DIFFERENCE
    assert (differences != 0).mean() <= LARGEST_SHARE


def test_srgb_is_decoded_to_a_rising_curve_whose_bytes_come_back() -> None:
    texels = np.arange(256, dtype=np.uint8).reshape(16, 16)[..., np.newaxis].repeat(3, axis=2)
    with gl.create_context(4, 4):
        gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_SRGB8, 16, 16, 0, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, texels)
        assert np.array_equal(gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RGB, gl.GL_UNSIGNED_BYTE), texels)


def test_framebuffers_and_renderbuffers_of_these_formats_are_refused() -> None:
    with gl.create_context(4, 4):
        gl.glBindTexture(gl.GL_TEXTURE_2D, texture := gl.glGenTextures(1))
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA16, 4, 4, 0, gl.GL_RGBA, gl.GL_FLOAT, None)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
        gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, texture, 0)
        status = gl.glCheckFramebufferStatus(gl.GL_FRAMEBUFFER)
        assert status == gl.GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT
        gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, gl.glGenRenderbuffers(1))
        with pytest.raises(gl.GLError, match="GL_INVALID_ENUM"):
            gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, gl.GL_RGBA4, 4, 4)
