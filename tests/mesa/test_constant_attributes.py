"""Attributes that are not given per vertex are constant, and Mesa interpolates only some of these."""

import numpy as np
import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa

TEXELS = 8
TIES = (0.1, 0.3, 0.7, 0.9)  # each is k + 1/2 steps of 8 bits


def texture(gl, rng, texture_filter):
    gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
    texels = rng.integers(0, 256, (TEXELS, TEXELS, 4), dtype=np.uint8)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, TEXELS, TEXELS, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, texture_filter)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MAG_FILTER, texture_filter)
    gl.glEnable(gl.GL_TEXTURE_2D)


def change_texture_matrix(gl, rng):
    gl.glMatrixMode(gl.GL_TEXTURE)
    if rng.random() < 0.5:
        gl.glScalef(0.75, 1.25, 1)
    else:
        gl.glLoadIdentity()
    gl.glMatrixMode(gl.GL_MODELVIEW)


def triangles(gl, rng):
    """Draw with coordinates on the borders of texels, where the last bit of an interpolation decides."""
    gl.glTexCoord4f(*rng.integers(0, TEXELS, 2) / TEXELS, 0, rng.choice([1.0, 3.0, 0.7]))
    gl.glColor4f(*rng.choice(TIES, 4))
    if rng.random() < 0.3:
        change_texture_matrix(gl, rng)
    if rng.random() < 0.3:
        switch = gl.glEnable if rng.random() < 0.5 else gl.glDisable
        switch(gl.GL_TEXTURE_GEN_S)
    if rng.random() < 0.5:
        gl.glFlush()
    positions = 2 * rng.random((4, 3)) - 1
    if rng.random() < 0.5:
        gl.glBegin(gl.GL_QUADS)
        for position in positions:
            gl.glVertex3f(*position)
        gl.glEnd()
    else:
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        gl.glVertexPointer(3, gl.GL_FLOAT, 0, positions.astype(np.float32))
        gl.glDrawArrays(gl.GL_TRIANGLES, 0, 3)
        gl.glDisableClientState(gl.GL_VERTEX_ARRAY)


@pytest.mark.parametrize("seed", range(24))
def test_a_coordinate_that_vertices_do_not_carry_is_not_interpolated(seed):
    def program(gl):
        rng = np.random.default_rng(seed)
        gl.glMatrixMode(gl.GL_PROJECTION)
        gl.glFrustum(-0.1, 0.1, -0.08, 0.08, 0.1, 10)
        gl.glMatrixMode(gl.GL_MODELVIEW)
        gl.glTranslatef(0, 0, -2)
        texture(gl, rng, (gl.GL_NEAREST, gl.GL_LINEAR)[seed % 2])
        if seed % 4 > 1:
            gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_REPLACE)
        for _ in range(6):
            triangles(gl, rng)

    comparison = compare(program, (64, 60))
    assert comparison, str(comparison)


@pytest.mark.parametrize("source", ["GL_PRIMARY_COLOR", "GL_PREVIOUS"])
def test_a_constant_colour_is_interpolated_only_as_primary_color_of_a_combiner(source):
    def program(gl):
        rng = np.random.default_rng(7)
        gl.glMatrixMode(gl.GL_PROJECTION)
        gl.glFrustum(-0.1, 0.1, -0.08, 0.08, 0.1, 10)
        gl.glMatrixMode(gl.GL_MODELVIEW)
        gl.glTranslatef(0, 0, -2)
        for mode in ("GL_MODULATE", "GL_DOT3_RGB", "GL_INTERPOLATE"):
            texture(gl, rng, gl.GL_NEAREST)
            gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_COMBINE)
            gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_COMBINE_RGB, getattr(gl, mode))
            gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_SOURCE0_RGB, gl.GL_TEXTURE)
            gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_SOURCE1_RGB, getattr(gl, source))
            gl.glColor4f(*rng.choice(TIES, 4))
            gl.glShadeModel(rng.choice([gl.GL_FLAT, gl.GL_SMOOTH]))
            gl.glBegin(gl.GL_QUADS)
            for position in 2 * rng.random((8, 3)) - 1:
                gl.glTexCoord2f(*rng.random(2))
                gl.glVertex3f(*position)
            gl.glEnd()

    comparison = compare(program, (64, 60))
    assert comparison, str(comparison)
