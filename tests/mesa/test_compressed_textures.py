"""Compressed textures are stored, read and sampled as by Mesa, and wrong calls end in its errors."""

import ctypes
from typing import Any

import numpy as np
import pytest

from mesa.random_compressed import COMPRESSED, FROM_PIXELS, CompressedTextures, from_pixels, lookups, uploads
from mesa.random_formats import SIZE
from softshadow import gl
from softshadow.testing import compare

pytestmark = pytest.mark.mesa
DXT1, DXT5 = "GL_COMPRESSED_RGB_S3TC_DXT1_EXT", "GL_COMPRESSED_RGBA_S3TC_DXT5_EXT"
BLOCKS = np.arange(256, dtype=np.uint8)


def check(program: Any, size: tuple[int, int] = (4, 4)) -> None:
    compared = compare(program, size)
    assert compared, str(compared)


@pytest.mark.parametrize("seed", range(3))
def test_blocks_come_back_and_are_read_as_the_same_pixels(seed: int) -> None:
    check(uploads(seed, COMPRESSED))


@pytest.mark.parametrize("seed", range(4))
def test_lookups_in_all_compressed_formats_give_the_same_colors(seed: int) -> None:
    check(lookups(seed, COMPRESSED), SIZE)


@pytest.mark.parametrize("seed", range(3))
def test_pixels_are_compressed_to_the_blocks_of_mesa(seed: int) -> None:
    check(from_pixels(seed, FROM_PIXELS))


def with_mipmaps(gl: Any) -> list[np.ndarray]:
    """Compute mipmaps of compressed textures, and return the levels that consist of whole blocks."""
    make, told = CompressedTextures(gl, 7), []
    for name in FROM_PIXELS:
        target = make.new()
        if len(told) % 2:
            gl.glTexParameteri(target, gl.GL_GENERATE_MIPMAP, 1)
        gl.glTexImage2D(target, 0, make.named(name), 32, 16, 0, *make.smooth(32, 16))
        if not len(told) % 2:
            gl.glGenerateMipmap(target)
        told += [make.read(level=level) for level in (1, 2)]
        told.append(np.array([int(gl.glGetTexLevelParameteriv(target, 5, gl.GL_TEXTURE_INTERNAL_FORMAT))]))
    return told


def test_mipmaps_are_means_that_are_compressed_again() -> None:
    check(with_mipmaps)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(100, 200))
def test_many_compressed_textures_are_those_of_mesa(seed: int) -> None:
    check(uploads(seed, COMPRESSED, n=4))
    check(from_pixels(seed, FROM_PIXELS, n=4))
    check(lookups(seed, COMPRESSED), SIZE)


def wrong_calls(gl: Any) -> list[int]:
    """Return the errors of calls, 0 for those without."""
    make = CompressedTextures(gl, 1)
    texture, cube, volume = gl.GL_TEXTURE_2D, gl.GL_TEXTURE_CUBE_MAP_POSITIVE_X, gl.GL_TEXTURE_3D
    dxt1, dxt5, generic = gl.GL_COMPRESSED_RGB_S3TC_DXT1_EXT, make.named(DXT5), gl.GL_COMPRESSED_RGB
    told: list[int] = []

    def call(name: str, *arguments: Any) -> None:
        try:
            getattr(gl, name)(*arguments)
            told.append(0)
        except gl.GLError as error:
            told.append(int(error.err))

    make.new()
    define, update = "glCompressedTexImage2D", "glCompressedTexSubImage2D"
    call("glGetCompressedTexImage", texture, 0)
    call(update, texture, 0, 0, 0, 4, 4, dxt1, 8, BLOCKS)
    for target, level, internal, width, height, border, n_bytes in (
        (texture, 0, dxt1, 8, 8, 0, 31), (texture, 0, dxt1, 8, 8, 0, 32), (texture, 0, dxt1, 8, 8, 1, 32),
        (texture, -1, dxt1, 8, 8, 0, 32), (texture, 40, dxt1, 8, 8, 0, 32), (texture, 0, gl.GL_RGBA8, 8, 8, 0, 32),
        (texture, 0, generic, 8, 8, 0, 32), (texture, 0, 77, 8, 8, 0, 32), (texture, 0, dxt5, 7, 5, 0, 64),
        (cube, 0, dxt1, 8, 8, 0, 32), (cube, 0, dxt1, 8, 4, 0, 16), (gl.GL_TEXTURE_1D, 0, dxt1, 8, 8, 0, 32),
        (gl.GL_TEXTURE_RECTANGLE, 0, dxt1, 8, 8, 0, 32), (gl.GL_PROXY_TEXTURE_2D, 0, dxt1, 8, 8, 0, 32),
        (gl.GL_TEXTURE_CUBE_MAP, 0, dxt1, 8, 8, 0, 32), (texture, 0, dxt1, 8, -8, 0, 32),
        (texture, 0, dxt1, 0, 0, 0, 0), (texture, 0, dxt1, 8, 12, 0, 48),
    ):  # fmt: skip
        call(define, target, level, internal, width, height, border, n_bytes, BLOCKS)
    for level, x, y, width, height, internal, n_bytes in (
        (0, 0, 0, 4, 4, dxt1, 8), (0, 2, 0, 4, 4, dxt1, 8), (0, 0, 0, 3, 4, dxt1, 8), (0, 4, 8, 4, 4, dxt1, 8),
        (0, 4, 8, 4, 8, dxt1, 16), (0, 0, 0, 4, 4, dxt5, 16), (0, 0, 0, 4, 4, dxt1, 9), (1, 0, 0, 4, 4, dxt1, 8),
        (-1, 0, 0, 4, 4, dxt1, 8), (0, 0, 0, 4, 4, generic, 8), (0, 0, 0, 4, 4, 77, 8), (0, 0, 0, 0, 4, dxt1, 0),
        (0, 0, 0, -4, 4, dxt1, 8),
    ):  # fmt: skip
        call(update, texture, level, x, y, width, height, internal, n_bytes, BLOCKS)
    color = (gl.GL_RGB, gl.GL_UNSIGNED_BYTE, None)
    for name, target, sides in (
        ("glTexImage1D", gl.GL_TEXTURE_1D, (4,)), ("glTexImage2D", texture, (4, 4)), ("glTexImage2D", cube, (4, 4)),
        ("glTexImage3D", volume, (4, 4, 1)), ("glTexImage2D", gl.GL_TEXTURE_RECTANGLE, (4, 4)),
    ):  # fmt: skip
        for border in (0, 1):
            call(name, target, 0, dxt1, *sides, border, *color)
    call("glTexImage1D", gl.GL_TEXTURE_1D, 0, generic, 4, 0, *color)
    gl.glTexImage2D(texture, 0, dxt1, 8, 8, 0, *color)
    pixels = gl.GL_RGB, gl.GL_UNSIGNED_BYTE, BLOCKS
    for x, y, width, height in ((4, 4, 4, 4), (2, 0, 4, 4), (0, 0, 3, 4), (4, 4, 4, 8), (0, 0, 0, 0)):
        call("glTexSubImage2D", texture, 0, x, y, width, height, *pixels)
    call("glCompressedTexImage1D", gl.GL_TEXTURE_1D, 0, dxt1, 4, 0, 8, BLOCKS)
    call("glCompressedTexImage3D", volume, 0, dxt1, 4, 4, 1, 0, 8, BLOCKS)
    call("glCompressedTexSubImage1D", gl.GL_TEXTURE_1D, 0, 0, 4, dxt1, 8, BLOCKS)
    call("glCompressedTexSubImage3D", volume, 0, 0, 0, 0, 4, 4, 1, dxt1, 8, BLOCKS)
    for pname in (gl.GL_TEXTURE_COMPRESSED_IMAGE_SIZE, gl.GL_TEXTURE_COMPRESSED, gl.GL_TEXTURE_INTERNAL_FORMAT):
        for target in (gl.GL_PROXY_TEXTURE_2D, texture):
            call("glGetTexLevelParameteriv", target, 0, pname)
    call("glGetCompressedTexImage", texture, 0)
    call("glGetCompressedTexImage", texture, 50)
    gl.glTexImage2D(texture, 0, gl.GL_RGBA, 1, 1, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, BLOCKS[:4])
    call("glGetCompressedTexImage", texture, 0)
    call("glGetTexLevelParameteriv", texture, 0, gl.GL_TEXTURE_COMPRESSED_IMAGE_SIZE)
    gl.glBindBuffer(gl.GL_PIXEL_UNPACK_BUFFER, gl.glGenBuffers(1))
    gl.glBufferData(gl.GL_PIXEL_UNPACK_BUFFER, BLOCKS[:40], gl.GL_STATIC_DRAW)
    call(define, texture, 0, dxt1, 8, 8, 0, 32, ctypes.c_void_p(9))
    return told


def test_wrong_calls_end_in_the_errors_of_mesa() -> None:
    compared = compare(lambda gl: np.array(wrong_calls(gl)), (4, 4))
    assert compared, f"{compared}\n{compared.ours.returned}\n{compared.theirs.returned}"


def in_lists_and_buffers(gl: Any) -> list[np.ndarray]:
    """Define textures from a list, whose memory changes afterwards, and from a buffer; read into a buffer."""
    make, told = CompressedTextures(gl, 3), []
    target, blocks = make.new(), make.blocks(DXT5, 8, 12)
    gl.glNewList(1, gl.GL_COMPILE)
    gl.glCompressedTexImage2D(target, 0, make.named(DXT5), 8, 12, 0, blocks)
    gl.glCompressedTexSubImage2D(target, 0, 4, 4, 4, 8, make.named(DXT5), blocks[:32])
    gl.glEndList()
    blocks[:] = 0
    gl.glCallList(1)
    told.append(make.read())
    gl.glBindBuffer(gl.GL_PIXEL_UNPACK_BUFFER, gl.glGenBuffers(1))
    gl.glBufferData(gl.GL_PIXEL_UNPACK_BUFFER, make.blocks(DXT1, 16, 16), gl.GL_STATIC_DRAW)
    gl.glCompressedTexImage2D(target, 0, make.named(DXT1), 8, 8, 0, 32, ctypes.c_void_p(24))
    gl.glBindBuffer(gl.GL_PIXEL_UNPACK_BUFFER, 0)
    told.append(make.read())
    gl.glBindBuffer(gl.GL_PIXEL_PACK_BUFFER, gl.glGenBuffers(1))
    gl.glBufferData(gl.GL_PIXEL_PACK_BUFFER, np.zeros(64, np.uint8), gl.GL_STATIC_DRAW)
    gl.glGetCompressedTexImage(target, 0, 16)
    told.append(gl.glGetBufferSubData(gl.GL_PIXEL_PACK_BUFFER, 0, 64))
    return told


def test_lists_keep_blocks_and_buffers_hold_them() -> None:
    check(in_lists_and_buffers)


def test_textures_of_other_blocks_or_without_data_are_told() -> None:
    with gl.create_context(4, 4):
        gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
        with pytest.raises(gl.GLError, match="expected one of GL_COMPRESSED_RGB_S3TC_DXT1_EXT"):
            gl.glCompressedTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_COMPRESSED_RGB_FXT1_3DFX, 8, 4, 0, BLOCKS[:16])
        with pytest.raises(ValueError, match="has 16 bytes, 32 are needed"):
            gl.glCompressedTexImage2D(gl.GL_TEXTURE_2D, 0, getattr(gl, DXT1), 8, 8, 0, 32, BLOCKS[:16])
        gl.glCompressedTexImage2D(gl.GL_TEXTURE_2D, 0, getattr(gl, DXT1), 8, 8, 0, 32, None)
        assert not gl.glGetCompressedTexImage(gl.GL_TEXTURE_2D, 0).any()
        for call, *arguments in (
            (gl.glCopyTexSubImage2D, 0, 0, 0, 0, 0, 4, 4),
            (gl.glCopyTexImage2D, 0, gl.GL_COMPRESSED_RGB, 0, 0, 4, 4, 0),
            (gl.glTexImage2D, 0, gl.GL_COMPRESSED_SIGNED_RED_RGTC1, 4, 4, 0, gl.GL_RED, gl.GL_FLOAT, None),
        ):  # fmt: skip
            with pytest.raises(gl.GLError, match="this package does not compress"):
                call(gl.GL_TEXTURE_2D, *arguments)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
        gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, 1, 0)
        status = gl.glCheckFramebufferStatus(gl.GL_FRAMEBUFFER)
        assert status == gl.GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT
