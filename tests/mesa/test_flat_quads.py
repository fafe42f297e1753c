"""Quads whose fragments take a flat colour are cut along the other diagonal, as on Mesa; a concave quad shows it."""

import itertools

import numpy as np
import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa

SIDE = 8
DART = ((0, 0), (SIDE, 0), (0, SIDE), (2, 2))
FORMATS = ["GL_RGBA", "GL_RGB", "GL_LUMINANCE", "GL_ALPHA", "GL_INTENSITY", "GL_LUMINANCE_ALPHA"]
PAIR = list(itertools.product(["GL_RGBA", "GL_RGB", "GL_ALPHA"], ["GL_REPLACE", "GL_MODULATE", "GL_COMBINE"]))


def texture(gl, unit, internal, mode):
    gl.glActiveTexture(gl.GL_TEXTURE0 + unit)
    gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
    texels = np.full((2, 2, 4), 255, np.uint8)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, getattr(gl, internal), 2, 2, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)
    for parameter in (gl.GL_TEXTURE_MIN_FILTER, gl.GL_TEXTURE_MAG_FILTER):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, parameter, gl.GL_NEAREST)
    gl.glEnable(gl.GL_TEXTURE_2D)
    gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, getattr(gl, mode))
    if mode == "GL_COMBINE":
        source = gl.GL_PRIMARY_COLOR if internal == "GL_RGB" else gl.GL_TEXTURE
        for parameter, value in ((gl.GL_COMBINE_RGB, gl.GL_REPLACE), (gl.GL_COMBINE_ALPHA, gl.GL_REPLACE)):
            gl.glTexEnvi(gl.GL_TEXTURE_ENV, parameter, value)
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_SOURCE0_RGB, source)


def dart(gl, colored=True):
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.glOrtho(0, SIDE, 0, SIDE, -1, 1)
    gl.glShadeModel(gl.GL_FLAT)
    gl.glBegin(gl.GL_QUADS)
    for corner, (x, y) in enumerate(DART):
        if colored:
            gl.glColor3f(1, 1, 1 - corner / 8)
        gl.glVertex2f(x, y)
    gl.glEnd()


def check(program):
    comparison = compare(program, (SIDE, SIDE))
    assert comparison, str(comparison)


@pytest.mark.parametrize("colored", [False, True])
@pytest.mark.parametrize("mode", ["GL_MODULATE", "GL_REPLACE", "GL_DECAL", "GL_BLEND", "GL_ADD"])
def test_a_texture_that_replaces_the_colour_is_not_flat(mode, colored):
    for internal in FORMATS:
        check(lambda gl, internal=internal: (texture(gl, 0, internal, mode), dart(gl, colored)))


@pytest.mark.parametrize("first", PAIR)
def test_the_colour_may_be_replaced_by_either_unit(first):
    for second in PAIR:
        check(lambda gl, second=second: (texture(gl, 1, *second), texture(gl, 0, *first), dart(gl)))


@pytest.mark.parametrize("colored", [False, True])
def test_colours_of_lighting_are_flat(colored):
    def program(gl):
        gl.glEnable(gl.GL_LIGHTING)
        gl.glMaterialfv(gl.GL_FRONT_AND_BACK, gl.GL_EMISSION, [1, 1, 1, 1])
        dart(gl, colored)

    check(program)


@pytest.mark.parametrize("tests_alpha", [False, True])
def test_without_a_colour_buffer_only_the_alpha_test_takes_colours(tests_alpha):
    def program(gl):
        gl.glDrawBuffer(gl.GL_NONE)
        gl.glEnable(gl.GL_DEPTH_TEST)
        if tests_alpha:
            gl.glEnable(gl.GL_ALPHA_TEST)
            gl.glAlphaFunc(gl.GL_GREATER, 0.5)
        dart(gl)

    check(program)
