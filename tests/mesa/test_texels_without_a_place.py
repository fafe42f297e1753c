"""Texels that are NaN, as all coordinates are divided by q = 0: where a texture function clamps, NaN becomes 0."""

import numpy as np
import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa

TEXELS = np.random.default_rng(1).integers(0, 255, (5, 4, 4), np.uint8)
COMBINES = (
    "GL_REPLACE", "GL_MODULATE", "GL_ADD", "GL_ADD_SIGNED", "GL_SUBTRACT", "GL_INTERPOLATE", "GL_DOT3_RGB",
    "GL_DOT3_RGBA",
)  # fmt: skip
SECONDS = (None, "GL_REPLACE", "GL_MODULATE", "GL_ADD", "GL_SUBTRACT")
FUNCTIONS = ("GL_ADD", "GL_MODULATE", "GL_BLEND", "GL_REPLACE", "GL_DECAL")  # the last is for RGB and RGBA only
TESTS = ("GL_ALWAYS", "GL_GREATER", "GL_LESS")


def texture(gl, format, texels, filter):
    gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
    height, width = texels.shape[:2]
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, format, width, height, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, filter)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_WRAP_T, gl.GL_CLAMP_TO_BORDER)
    gl.glEnable(gl.GL_TEXTURE_2D)


def combine(gl, mode, scale=1.0):
    gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_COMBINE)
    gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_COMBINE_RGB, getattr(gl, mode))
    if "DOT3" not in mode:
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_COMBINE_ALPHA, getattr(gl, mode))
    gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_RGB_SCALE, scale)
    gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_ALPHA_SCALE, scale)


def draw(gl, column, row, test):
    """Draw a triangle into a viewport of its own."""
    gl.glViewport(8 * column, 8 * row, 8, 8)
    gl.glEnable(gl.GL_ALPHA_TEST)
    gl.glAlphaFunc(getattr(gl, test), 0.57)
    gl.glMultiTexCoord4f(gl.GL_TEXTURE0, 0.0, 0.0, 1.0, 0.0)
    gl.glColor4f(0.3, 0.6, 0.2, 0.7)
    gl.glBegin(gl.GL_TRIANGLES)
    for corner in ((-0.7, -0.7), (0.7, -0.6), (0.1, 0.8)):
        gl.glVertex2f(*corner)
    gl.glEnd()


def grey(gl):
    gl.glClearColor(0.5, 0.5, 0.5, 0.5)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT)


@pytest.mark.parametrize("scale", [1.0, 2.0])
@pytest.mark.parametrize("mode", COMBINES)
def test_a_texel_that_is_nan_is_combined_as_in_mesa(mode, scale):
    def program(gl):
        grey(gl)
        texture(gl, gl.GL_RGBA8, TEXELS, gl.GL_LINEAR)
        combine(gl, mode, scale)
        for row, second in enumerate(SECONDS):
            if second:
                gl.glActiveTexture(gl.GL_TEXTURE1)
                texture(gl, gl.GL_RGBA8, np.array([[[40, 60, 80, 100]]], np.uint8), gl.GL_NEAREST)
                combine(gl, second)
            for column, test in enumerate(TESTS):
                draw(gl, column, row, test)

    comparison = compare(program, (8 * len(TESTS), 8 * len(SECONDS)))
    assert comparison, str(comparison)


@pytest.mark.parametrize("format", ["GL_RGBA8", "GL_INTENSITY8", "GL_ALPHA8", "GL_LUMINANCE8"])
def test_a_texel_that_is_nan_enters_the_texture_functions_as_in_mesa(format):
    modes = FUNCTIONS if format == "GL_RGBA8" else FUNCTIONS[:-1]

    def program(gl):
        grey(gl)
        for row, mode in enumerate(modes):
            for unit in (gl.GL_TEXTURE0, gl.GL_TEXTURE1):
                gl.glActiveTexture(unit)
                texture(gl, getattr(gl, format), TEXELS, gl.GL_LINEAR)
                gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, getattr(gl, mode))
            for column, test in enumerate(TESTS):
                draw(gl, column, row, test)

    comparison = compare(program, (8 * len(TESTS), 8 * len(modes)))
    assert comparison, str(comparison)
