"""Vertices and coordinates at the limits of float32: NaN, infinity, 1/w too small to be normal."""

import itertools

import numpy as np
import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa

WRAPS = ["GL_REPEAT", "GL_MIRRORED_REPEAT", "GL_CLAMP_TO_EDGE", "GL_CLAMP_TO_BORDER", "GL_CLAMP"]
COORDINATES = [(0.0, 0.0, 0.0, 0.0), (1.0, -1.0, 0.0, 0.0), (1e30, -1e20, 0.0, 1.0)]  # NaN, infinite, huge


@pytest.mark.parametrize("place", range(4))
@pytest.mark.parametrize("number", [np.nan, 3e38, 1e20, -1e30, 1e-30])
def test_triangles_with_unusual_vertices_cover_the_same_pixels(number, place):
    rng = np.random.default_rng(place)
    vertices = np.concatenate([rng.uniform(-1.2, 1.2, (60, 3)).round(3), np.ones((60, 1))], axis=1)
    vertices[::4, place] = number

    def program(gl):
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glDepthFunc(gl.GL_ALWAYS)
        gl.glBegin(gl.GL_TRIANGLES)
        for index, vertex in enumerate(vertices.tolist()):
            gl.glColor3f(index / 60, 1 - index / 60, 0.2)
            gl.glVertex4f(*vertex)
        gl.glEnd()

    comparison = compare(program, (33, 20))
    assert comparison, str(comparison)


@pytest.mark.parametrize("filtering", ["GL_NEAREST", "GL_LINEAR"])
@pytest.mark.parametrize("size", [(3, 8), (4, 5)])
def test_coordinates_that_are_no_numbers_find_the_same_texels(size, filtering):
    texels = np.random.default_rng(1).integers(0, 256, (size[1], size[0], 4), dtype=np.uint8)

    def program(gl):
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, *size, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)
        for parameter in (gl.GL_TEXTURE_MIN_FILTER, gl.GL_TEXTURE_MAG_FILTER):
            gl.glTexParameteri(gl.GL_TEXTURE_2D, parameter, getattr(gl, filtering))
        gl.glEnable(gl.GL_TEXTURE_2D)
        answers = []
        for s, t in itertools.product(WRAPS, repeat=2):
            gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_WRAP_S, getattr(gl, s))
            gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_WRAP_T, getattr(gl, t))
            for coordinates in COORDINATES:
                gl.glTexCoord4f(*coordinates)
                gl.glRectf(-1, -1, 1, 1)
                answers.append(gl.glReadPixels(1, 1, 1, 1, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE))
        return answers

    comparison = compare(program, (4, 4))
    assert comparison, str(comparison)


@pytest.mark.parametrize("function", ["GL_LESS", "GL_LEQUAL", "GL_EQUAL", "GL_NOTEQUAL", "GL_GEQUAL", "GL_GREATER"])
def test_an_alpha_that_is_no_number_is_compared_as_one(function):
    texels = np.full((4, 4, 4), 200, np.uint8)

    def program(gl):
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, 4, 4, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_LINEAR)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_WRAP_S, gl.GL_MIRRORED_REPEAT)
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glEnable(gl.GL_ALPHA_TEST)
        gl.glAlphaFunc(getattr(gl, function), 0.5)
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_INCR)
        gl.glTexCoord4f(0.0, 0.0, 0.0, 0.0)
        gl.glRectf(-1, -1, 1, 1)

    comparison = compare(program, (4, 4))
    assert comparison, str(comparison)
