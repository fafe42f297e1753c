"""Scenes with calls of their own: quadrics, evaluators, glArrayElement, 3-D textures, combined textures."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from softshadow.bench.corpus.program import DrawNumberedFrame, program
from softshadow.bench.corpus.shapes import sphere
from softshadow.bench.corpus.views import arrays, clear, draw, light, look, shine, upload


def molecule(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A molecule of quadrics: 24 spheres in materials of their own, and the sticks between them."""
    quadric = gl.gluNewQuadric()

    def frame(number: int) -> None:
        look(gl, size, (0.0, 2.0, 6.0))
        clear(gl)
        light(gl)
        shine(gl)
        gl.glRotatef(3.0 * number, 0.0, 1.0, 0.0)
        for i in range(24):
            gl.glPushMatrix()
            gl.glRotatef(30.0 * i, 0.0, 1.0, 0.0)
            gl.glTranslatef(1.4, 0.12 * (i - 12), 0.0)
            gl.glColor3f(i / 24, 0.4, 1 - i / 24)
            gl.gluSphere(quadric, 0.25, 16, 12)
            gl.glRotatef(-90.0, 0.0, 1.0, 0.0)
            gl.glColor3f(0.7, 0.7, 0.7)
            gl.gluCylinder(quadric, 0.06, 0.06, 1.4, 10, 2)
            gl.glPopMatrix()

    return frame


def bezier_sheet(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A lit Bezier surface that waves, by glEvalMesh2 with normals of GL_AUTO_NORMAL."""
    points = np.zeros((4, 4, 3), np.float32)
    points[..., 0], points[..., 2] = np.meshgrid(np.linspace(-1.8, 1.8, 4), np.linspace(-1.8, 1.8, 4))

    def frame(number: int) -> None:
        look(gl, size)
        clear(gl)
        light(gl)
        gl.glLightModeli(gl.GL_LIGHT_MODEL_TWO_SIDE, 1)
        gl.glEnable(gl.GL_MAP2_VERTEX_3)
        gl.glEnable(gl.GL_AUTO_NORMAL)
        points[..., 1] = np.sin(np.arange(16).reshape(4, 4) + 0.1 * number)
        gl.glMap2f(gl.GL_MAP2_VERTEX_3, 0.0, 1.0, 0.0, 1.0, points)
        gl.glMapGrid2f(30, 0.0, 1.0, 30, 0.0, 1.0)
        gl.glColor3f(0.8, 0.7, 0.3)
        gl.glEvalMesh2(gl.GL_FILL, 0, 30, 0, 30)

    return frame


def ball_by_elements(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A ball of 600 triangles, vertex by vertex with glArrayElement."""
    ball = sphere(1.3, 20, 15)
    elements = ball.triangles.reshape(-1).tolist()

    def frame(number: int) -> None:
        look(gl, size)
        clear(gl)
        light(gl)
        gl.glRotatef(5.0 * number, 0.0, 1.0, 0.3)
        gl.glColor3f(0.5, 0.6, 0.9)
        arrays(gl, ball)
        gl.glBegin(gl.GL_TRIANGLES)
        for element in elements:
            gl.glArrayElement(element)
        gl.glEnd()

    return frame


def scanned_volume(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A volume of 32 x 32 x 32 texels: 32 blended slices of a 3-D texture, turned by the texture matrix."""
    n = 32
    places = np.mgrid[:n, :n, :n] / n - 0.5
    texels = np.zeros((n, n, n, 4), np.uint8)
    texels[..., :3] = 255 * (places.transpose(1, 2, 3, 0) + 0.5)
    texels[..., 3] = 30 * (np.sqrt((places**2).sum(0)) < 0.45)
    gl.glBindTexture(gl.GL_TEXTURE_3D, gl.glGenTextures(1))
    gl.glTexImage3D(gl.GL_TEXTURE_3D, 0, gl.GL_RGBA, n, n, n, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)
    gl.glTexParameteri(gl.GL_TEXTURE_3D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_LINEAR)

    def frame(number: int) -> None:
        look(gl, size, (0.0, 0.0, 3.0))
        clear(gl, (0.0, 0.0, 0.0, 1.0))
        gl.glEnable(gl.GL_TEXTURE_3D)
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
        gl.glColor3f(1.0, 1.0, 1.0)
        gl.glMatrixMode(gl.GL_TEXTURE)
        gl.glLoadIdentity()
        gl.glTranslatef(0.5, 0.5, 0.5)
        gl.glRotatef(4.0 * number, 0.0, 1.0, 0.0)
        gl.glTranslatef(-0.5, -0.5, -0.5)
        gl.glMatrixMode(gl.GL_MODELVIEW)
        gl.glBegin(gl.GL_QUADS)
        for i in range(n):
            for s, t in ((0, 0), (1, 0), (1, 1), (0, 1)):
                gl.glTexCoord3f(s, t, i / (n - 1))
                gl.glVertex3f(2 * s - 1, 2 * t - 1, 2 * i / (n - 1) - 1)
        gl.glEnd()
        gl.glMatrixMode(gl.GL_TEXTURE)
        gl.glLoadIdentity()
        gl.glMatrixMode(gl.GL_MODELVIEW)

    return frame


def mixed_textures(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A ball on which GL_COMBINE mixes two textures, by a constant that changes."""
    ball, random = sphere(1.4, 40, 30), np.random.default_rng(8)
    stripes = np.full((64, 64, 4), 255, np.uint8)
    stripes[::8, :, :2] = 40
    spots = random.integers(0, 256, (64, 64, 4), np.uint8)
    names = [upload(gl, image, gl.GL_LINEAR_MIPMAP_LINEAR, gl.GL_REPEAT) for image in (stripes, spots)]

    def frame(number: int) -> None:
        look(gl, size)
        clear(gl)
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glRotatef(3.0 * number, 0.0, 1.0, 0.0)
        gl.glColor3f(1.0, 1.0, 1.0)
        for unit, name in enumerate(names):
            gl.glActiveTexture(gl.GL_TEXTURE0 + unit)
            gl.glBindTexture(gl.GL_TEXTURE_2D, name)
            gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_COMBINE)
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_COMBINE_RGB, gl.GL_INTERPOLATE)
        gl.glTexEnvfv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_COLOR, [0.0, 0.0, 0.0, 0.5 + 0.5 * math.sin(0.1 * number)])
        gl.glClientActiveTexture(gl.GL_TEXTURE1)
        gl.glEnableClientState(gl.GL_TEXTURE_COORD_ARRAY)
        gl.glTexCoordPointer(2, gl.GL_FLOAT, 0, ball.texture)
        gl.glClientActiveTexture(gl.GL_TEXTURE0)
        draw(gl, ball, texture=True)
        gl.glDisable(gl.GL_TEXTURE_2D)
        gl.glActiveTexture(gl.GL_TEXTURE0)

    return frame


PROGRAMS = tuple(map(program, (molecule, bezier_sheet, ball_by_elements, scanned_volume, mixed_textures)))
