"""gluScaleImage and gluBuild*DMipmaps give the bytes of libGLU, gluUnProject4 its numbers."""

import ctypes
import ctypes.util
from typing import Any

import numpy as np
import pytest

from softshadow import gl
from softshadow.testing import compare

pytestmark = pytest.mark.mesa
SIZE = (4, 4)
TYPES = {
    "GL_UNSIGNED_BYTE": np.uint8, "GL_BYTE": np.int8, "GL_UNSIGNED_SHORT": np.uint16, "GL_SHORT": np.int16,
    "GL_UNSIGNED_INT": np.uint32, "GL_INT": np.int32, "GL_FLOAT": np.float32,
}  # fmt: skip
FORMATS = {"GL_RGB": 3, "GL_RGBA": 4, "GL_LUMINANCE": 1}
LEVELS = 5


def image(rng: np.random.Generator, kind: str, width: int, height: int, components: int, signed: bool) -> np.ndarray:
    dtype = TYPES[kind]
    if kind == "GL_FLOAT":
        return rng.random((height, width, components)).astype(np.float32)
    limits = np.iinfo(dtype)
    lowest = limits.min if signed else 0
    return rng.integers(lowest, limits.max, (height, width, components), endpoint=True).astype(dtype)


def textures(seeds: range) -> Any:
    """Return a program that scales images and builds mipmaps, and reads all of them back."""

    def program(gl: Any) -> list[np.ndarray]:
        told: list[np.ndarray] = []
        gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1)
        gl.glPixelStorei(gl.GL_PACK_ALIGNMENT, 1)
        for seed in seeds:
            rng = np.random.default_rng(seed)
            kind, into = (str(rng.choice(list(TYPES))) for _ in range(2))
            name = str(rng.choice(list(FORMATS)))
            width, height, other_width, other_height = map(int, rng.integers(1, 14, 4))
            if seed % 3 == 0:
                width, height = 2 * other_width, 2 * other_height
            pixels = image(rng, kind, width, height, FORMATS[name], False)
            scaled = np.zeros((other_height, other_width, FORMATS[name]), TYPES[into])
            shape = (width, height, getattr(gl, kind), pixels, other_width, other_height, getattr(gl, into), scaled)
            told.append(np.array([gl.gluScaleImage(getattr(gl, name), *shape)]))
            told.append(scaled.astype(np.float64).ravel())
            pixels = image(rng, kind, width, height, FORMATS[name], seed % 2 == 0)
            gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
            described = (gl.GL_RGBA32F, width, height, getattr(gl, name), getattr(gl, kind), pixels)
            told.append(np.array([gl.gluBuild2DMipmaps(gl.GL_TEXTURE_2D, *described)]))
            for level in range(LEVELS):
                sides = [
                    int(gl.glGetTexLevelParameteriv(gl.GL_TEXTURE_2D, level, side))
                    for side in (gl.GL_TEXTURE_WIDTH, gl.GL_TEXTURE_HEIGHT)
                ]
                told.append(np.array(sides))
                if sides[0]:
                    told.append(np.ravel(gl.glGetTexImage(gl.GL_TEXTURE_2D, level, gl.GL_RGBA, gl.GL_FLOAT)))
        return told

    return program


def test_scaled_images_and_mipmaps_are_those_of_libglu() -> None:
    compared = compare(textures(range(12)), SIZE)
    assert compared, str(compared)


@pytest.mark.slow
def test_many_scaled_images_and_mipmaps_are_those_of_libglu() -> None:
    compared = compare(textures(range(100, 400)), SIZE)
    assert compared, str(compared)


def rows_and_boxes(seeds: range) -> Any:
    """Return a program that builds mipmaps of 1-D and 3-D textures, and reads all of them back.

    Boxes are at least as high as wide: with lower ones libGLU reads memory that is not the image's, and with signed
    numbers below 0 it ends the program.
    """

    def program(gl: Any) -> list[np.ndarray]:
        told: list[np.ndarray] = []
        gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1)
        gl.glPixelStorei(gl.GL_PACK_ALIGNMENT, 1)
        for seed in seeds:
            rng = np.random.default_rng(seed)
            kind, name = str(rng.choice(list(TYPES))), str(rng.choice(list(FORMATS)))
            width, height, depth = map(int, rng.integers(1, 12, 3))
            height = max(width, height)
            row = image(rng, kind, width, 1, FORMATS[name], False)
            box = image(rng, kind, width, height * depth, FORMATS[name], False)
            described = getattr(gl, name), getattr(gl, kind)
            sizes = "GL_TEXTURE_WIDTH", "GL_TEXTURE_HEIGHT", "GL_TEXTURE_DEPTH"
            for target in (gl.GL_TEXTURE_1D, gl.GL_TEXTURE_3D):
                gl.glBindTexture(target, gl.glGenTextures(1))
                if target == gl.GL_TEXTURE_1D:
                    code = gl.gluBuild1DMipmaps(target, gl.GL_RGBA32F, width, *described, row)
                else:
                    code = gl.gluBuild3DMipmaps(target, gl.GL_RGBA32F, width, height, depth, *described, box)
                told.append(np.array([code]))
                for level in range(LEVELS):
                    read = (gl.glGetTexLevelParameteriv(target, level, getattr(gl, size)) for size in sizes)
                    sides = np.array([int(side) for side in read])
                    told.append(sides)
                    if sides[0]:
                        told.append(np.ravel(gl.glGetTexImage(target, level, gl.GL_RGBA, gl.GL_FLOAT)))
        return told

    return program


def test_mipmaps_of_rows_and_boxes_are_those_of_libglu() -> None:
    compared = compare(rows_and_boxes(range(12)), SIZE)
    assert compared, str(compared)


@pytest.mark.slow
def test_many_mipmaps_of_rows_and_boxes_are_those_of_libglu() -> None:
    compared = compare(rows_and_boxes(range(100, 300)), SIZE)
    assert compared, str(compared)


def some_levels(gl: Any) -> list[np.ndarray]:
    """Return the sizes of the levels that gluBuild2DMipmapLevels has defined, and its answers to wrong arguments."""
    pixels = np.arange(8 * 4 * 3, dtype=np.uint8).reshape(4, 8, 3)
    gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
    gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1)

    def build(width: int, height: int, levels: tuple[int, int, int], format: int, type: int) -> int:
        return int(gl.gluBuild2DMipmapLevels(gl.GL_TEXTURE_2D, 3, width, height, format, type, *levels, pixels))

    plain = (gl.GL_RGB, gl.GL_UNSIGNED_BYTE)
    answers = [
        build(8, 4, (1, 2, 3), *plain), build(8, 4, (2, 1, 3), *plain), build(8, 4, (0, 0, 9), *plain),
        build(5, 4, (0, 0, 1), *plain), build(8, 4, (0, 0, 1), gl.GL_TEXTURE_2D, gl.GL_UNSIGNED_BYTE),
        build(8, 4, (0, 0, 1), gl.GL_RGB, gl.GL_RGB),
        int(gl.gluBuild2DMipmaps(gl.GL_TEXTURE_2D, 3, 0, 4, *plain, pixels)),
        int(gl.gluScaleImage(gl.GL_RGB, -1, 4, gl.GL_UNSIGNED_BYTE, pixels, 2, 2, gl.GL_UNSIGNED_BYTE, pixels.copy())),
        int(gl.gluScaleImage(gl.GL_RGB, 0, 4, gl.GL_UNSIGNED_BYTE, pixels, 2, 2, gl.GL_UNSIGNED_BYTE, pixels.copy())),
    ]  # fmt: skip
    row, box = (gl.GL_TEXTURE_1D, 3, 8), (gl.GL_TEXTURE_3D, 3, 4, 4, 2)
    for levels in ((1, 2, 3), (2, 1, 3), (0, 0, 9)):
        answers.append(int(gl.gluBuild1DMipmapLevels(*row, *plain, *levels, pixels)))
        answers.append(int(gl.gluBuild3DMipmapLevels(*box, *plain, *levels, pixels)))
    answers += [
        int(gl.gluBuild1DMipmapLevels(gl.GL_TEXTURE_1D, 3, 5, *plain, 0, 0, 1, pixels)),
        int(gl.gluBuild1DMipmaps(gl.GL_TEXTURE_1D, 3, 0, *plain, pixels)),
        int(gl.gluBuild1DMipmaps(*row, gl.GL_TEXTURE_2D, gl.GL_UNSIGNED_BYTE, pixels)),
        int(gl.gluBuild3DMipmaps(gl.GL_TEXTURE_3D, 3, 4, -1, 2, *plain, pixels)),
    ]
    widths = [
        int(gl.glGetTexLevelParameteriv(target, level, gl.GL_TEXTURE_WIDTH))
        for target in (gl.GL_TEXTURE_2D, gl.GL_TEXTURE_1D, gl.GL_TEXTURE_3D)
        for level in range(5)
    ]
    return [np.array(answers), np.array(widths)]


def test_some_levels_are_built_and_wrong_arguments_are_answered_as_by_libglu() -> None:
    compared = compare(some_levels, SIZE)
    assert compared, str(compared)


def test_gluunproject4_gives_the_numbers_of_libglu() -> None:
    found = ctypes.util.find_library("GLU")
    if found is None:
        pytest.skip("libGLU is not installed")
    call = ctypes.CDLL(found).gluUnProject4  # PyOpenGL's own call lacks its results
    number, pointer = ctypes.c_double, ctypes.c_void_p
    call.argtypes = [*[number] * 4, *[pointer] * 3, *[number] * 2, *[pointer] * 4]
    rng = np.random.default_rng(4)
    with gl.create_context(*SIZE):
        for _ in range(100):
            model, projection, place = rng.normal(size=16), rng.normal(size=16), rng.normal(size=4)
            viewport, (near, far), theirs = np.array([1, 2, 30, 40], np.int32), rng.random(2), np.zeros(4)
            arrays = [array.ctypes.data for array in (model, projection, viewport)]
            assert call(*place, *arrays, near, far, *[theirs[i:].ctypes.data for i in range(4)])
            assert gl.gluUnProject4(*place, model, projection, viewport, near, far) == tuple(theirs)
        with pytest.raises(ValueError, match="no inverse"):
            gl.gluUnProject4(0, 0, 0, 1, np.zeros(16), np.eye(4), (0, 0, 4, 4))
