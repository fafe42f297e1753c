"""Blending: particles, sorted billboards, slices of a volume, panes of glass."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from softshadow.bench.corpus.program import DrawNumberedFrame, program
from softshadow.bench.corpus.shapes import leaf, spot
from softshadow.bench.corpus.views import clear, floor, light, look, upload

QUAD = ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0))


def fountain(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """Particles of a fountain, 500 quads added to the picture, whose places NumPy computes for each frame."""
    random = np.random.default_rng(3)
    count = 500
    start, speed = random.uniform(0, 2, count), random.normal((0.0, 3.2, 0.0), 0.5, (count, 3))
    corners = 0.08 * np.array([(*corner, 0.0) for corner in QUAD])
    texture = np.tile(np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32), (count, 1))
    upload(gl, spot(32), gl.GL_LINEAR, gl.GL_CLAMP_TO_EDGE)

    def frame(number: int) -> None:
        age = (start + 0.04 * number) % 2.0
        places = speed * age[:, None] - np.array([0.0, 1.8, 0.0]) * age[:, None] ** 2
        vertices = np.ascontiguousarray((places[:, None] + corners).reshape(-1, 3), np.float32)
        shades = np.repeat(np.stack([1 - age / 4, 0.7 - age / 4, 0.3 + age / 4, 1 - age / 2], 1), 4, axis=0)
        look(gl, size, (0.0, 1.5, 5.0), (0.0, 1.0, 0.0))
        gl.glDepthMask(True)
        clear(gl, (0.02, 0.02, 0.08, 1.0))
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glDisable(gl.GL_BLEND)
        gl.glDisable(gl.GL_TEXTURE_2D)
        gl.glColor3f(0.2, 0.25, 0.3)
        floor(gl, 3.0, -0.2)
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE)
        gl.glDepthMask(False)
        for array in (gl.GL_VERTEX_ARRAY, gl.GL_COLOR_ARRAY, gl.GL_TEXTURE_COORD_ARRAY):
            gl.glEnableClientState(array)
        gl.glVertexPointer(3, gl.GL_FLOAT, 0, vertices)
        gl.glColorPointer(4, gl.GL_FLOAT, 0, np.ascontiguousarray(shades, np.float32))
        gl.glTexCoordPointer(2, gl.GL_FLOAT, 0, texture)
        gl.glDrawArrays(gl.GL_QUADS, 0, len(vertices))
        gl.glDisableClientState(gl.GL_COLOR_ARRAY)

    return frame


def sorted_trees(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A wood of 150 billboards that turn to the eye, sorted from back to front for blending."""
    random = np.random.default_rng(4)
    trees = random.uniform(-5, 5, (150, 2)).tolist()
    upload(gl, leaf(128), gl.GL_LINEAR_MIPMAP_LINEAR, gl.GL_CLAMP_TO_EDGE)

    def frame(number: int) -> None:
        angle = 0.03 * number
        eye = (7.0 * math.sin(angle), 1.6, 7.0 * math.cos(angle))
        right = (math.cos(angle), -math.sin(angle))
        look(gl, size, eye)
        clear(gl, (0.6, 0.75, 0.95, 1.0))
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glDisable(gl.GL_TEXTURE_2D)
        gl.glDisable(gl.GL_BLEND)
        gl.glColor3f(0.35, 0.5, 0.25)
        floor(gl, 6.0, -0.5)
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
        gl.glColor4f(1.0, 1.0, 1.0, 0.9)
        for x, z in sorted(trees, key=lambda tree: tree[0] * eye[0] + tree[1] * eye[2]):
            gl.glBegin(gl.GL_QUADS)
            for a, b in QUAD:
                gl.glTexCoord2f(0.5 + 0.5 * a, 0.5 + 0.5 * b)
                gl.glVertex3f(x + 0.5 * a * right[0], 0.5 * b + 0.4, z + 0.5 * a * right[1])
            gl.glEnd()

    return frame


def volume_slices(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A cloud as 48 textured slices, blended from back to front."""
    slices, side = 48, 64
    z, y, x = np.mgrid[-1 : 1 : slices * 1j, -1 : 1 : side * 1j, -1 : 1 : side * 1j]
    cloud = np.clip(1.2 - np.sqrt(x**2 + y**2 + z**2) + 0.3 * np.sin(7 * x) * np.cos(6 * y) * np.sin(5 * z), 0, 1)
    images = np.empty((slices, side, side, 4), np.uint8)
    images[..., 0], images[..., 1], images[..., 2] = 255, 255 * cloud, 255 * cloud**2
    images[..., 3] = 60 * cloud
    names = [upload(gl, np.ascontiguousarray(image), gl.GL_LINEAR, gl.GL_CLAMP_TO_EDGE) for image in images]

    def frame(number: int) -> None:
        look(gl, size, (0.4, 0.5, 4.0))
        clear(gl, (0.0, 0.0, 0.1, 1.0))
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
        gl.glRotatef(20.0 * math.sin(0.1 * number), 0.0, 1.0, 0.0)
        for i, name in enumerate(names):
            gl.glBindTexture(gl.GL_TEXTURE_2D, name)
            gl.glBegin(gl.GL_QUADS)
            for a, b in QUAD:
                gl.glTexCoord2f(0.5 + 0.5 * a, 0.5 + 0.5 * b)
                gl.glVertex3f(a, b, 2.0 * i / (slices - 1) - 1.0)
            gl.glEnd()

    return frame


def panes_of_glass(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """Six large coloured panes, one behind the other, multiplied with the picture behind them."""

    def frame(number: int) -> None:
        look(gl, size, (0.0, 1.0, 5.0))
        gl.glDepthMask(True)
        clear(gl, (0.9, 0.9, 0.9, 1.0))
        gl.glDisable(gl.GL_BLEND)
        light(gl)
        gl.glColor3f(0.8, 0.8, 0.8)
        floor(gl, 4.0, -1.2)
        gl.glDisable(gl.GL_LIGHTING)
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_DST_COLOR, gl.GL_ZERO)
        gl.glDepthMask(False)
        for i in range(6):
            gl.glColor4f(1.0 - 0.1 * i, 0.6 + 0.06 * i, 0.7, 1.0)
            gl.glPushMatrix()
            gl.glTranslatef(0.5 * math.sin(i + 0.1 * number), 0.2, 0.5 * i - 2.0)
            gl.glRotatef(10.0 * i + number, 0.0, 0.0, 1.0)
            gl.glRectf(-1.2, -0.9, 1.2, 0.9)
            gl.glPopMatrix()

    return frame


PROGRAMS = tuple(map(program, (fountain, sorted_trees, volume_slices, panes_of_glass)))
