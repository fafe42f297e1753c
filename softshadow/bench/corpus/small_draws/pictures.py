"""Flat pictures of many small draws: a sketch, widgets, plots, a game, a clock."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from softshadow.bench.corpus.program import DrawNumberedFrame
from softshadow.bench.corpus.shapes import CORNERS, noise
from softshadow.bench.corpus.views import clear, flat_view, upload


def pencil_sketch(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A sketch of 250 smooth line strips of six points, each in its colour."""
    strokes = np.random.default_rng(2).uniform(0, 1, (250, 6, 2)).tolist()

    def frame(number: int) -> None:
        flat_view(gl, size, 640.0, 480.0)
        clear(gl, (1.0, 1.0, 0.95, 1.0))
        gl.glEnable(gl.GL_LINE_SMOOTH)
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
        for i, stroke in enumerate(strokes):
            gl.glColor4f(0.2, i / 500, 0.3, 0.7)
            gl.glBegin(gl.GL_LINE_STRIP)
            for x, y in stroke:
                gl.glVertex2f(200 * x + 1.7 * i, 200 * y + i + number % 50)
            gl.glEnd()

    return frame


def dashed_boxes(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A plan of 300 dashed rectangles with different patterns."""

    def frame(number: int) -> None:
        flat_view(gl, size, 640.0, 480.0)
        clear(gl)
        gl.glEnable(gl.GL_LINE_STIPPLE)
        for i in range(300):
            x, y = i % 20 * 32 + 4, i // 20 * 32 + number % 8
            gl.glLineStipple(1 + i % 3, 0x0F0F if i % 2 else 0x00FF)
            gl.glColor3f(0.5 * (i % 3), 1.0, 0.5)
            gl.glBegin(gl.GL_LINE_LOOP)
            for a, b in CORNERS:
                gl.glVertex2f(x + 24 * a, y + 24 * b)
            gl.glEnd()

    return frame


def widgets(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A window of 200 widgets: a scissor box, a blended picture and two lines for each."""
    textures = [upload(gl, noise(32, seed), gl.GL_LINEAR, gl.GL_REPEAT) for seed in range(8)]

    def frame(number: int) -> None:
        flat_view(gl, size, 640.0, 480.0)
        gl.glDisable(gl.GL_SCISSOR_TEST)
        clear(gl)
        gl.glEnable(gl.GL_SCISSOR_TEST)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
        for i in range(200):
            x, y = i % 20 * 32, i // 20 * 44
            gl.glScissor(x * size[0] // 640, y * size[1] // 480, 30 * size[0] // 640, 40 * size[1] // 480)
            gl.glEnable(gl.GL_TEXTURE_2D)
            gl.glEnable(gl.GL_BLEND)
            gl.glBindTexture(gl.GL_TEXTURE_2D, textures[(i + number) % 8])
            gl.glColor4f(1.0, 1.0, 1.0, 0.7)
            gl.glBegin(gl.GL_QUADS)
            for a, b in CORNERS:
                gl.glTexCoord2f(a, b)
                gl.glVertex2f(x + 32 * a, y + 44 * b)
            gl.glEnd()
            gl.glDisable(gl.GL_TEXTURE_2D)
            gl.glDisable(gl.GL_BLEND)
            gl.glColor3f(0.0, 0.0, 0.0)
            gl.glBegin(gl.GL_LINES)
            for end, height in ((26, 10), (20, 20)):
                gl.glVertex2f(x + 4, y + height)
                gl.glVertex2f(x + end, y + height)
            gl.glEnd()

    return frame


def sized_points(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A chart of 600 smooth points, each in its size and colour, between lines of a grid, one by one."""
    points = np.random.default_rng(6).uniform(0, 1, (600, 3)).tolist()

    def frame(number: int) -> None:
        flat_view(gl, size, 1.0, 1.0)
        clear(gl)
        gl.glEnable(gl.GL_POINT_SMOOTH)
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
        gl.glColor3f(0.4, 0.4, 0.5)
        for i in range(1, 40):
            for a, b in ((i / 40, 0.0), (0.0, i / 40)):
                gl.glBegin(gl.GL_LINES)
                gl.glVertex2f(a, b)
                gl.glVertex2f(a or 1.0, b or 1.0)
                gl.glEnd()
        for x, y, weight in points:
            gl.glPointSize(1 + 8 * weight)
            gl.glColor4f(x, y, 1 - weight, 0.7)
            gl.glBegin(gl.GL_POINTS)
            gl.glVertex2f((x + 0.003 * number * weight) % 1, y)
            gl.glEnd()

    return frame


def wall_of_bricks(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A game: 240 bricks by glRectf, each in its colour, and boxes whose faces are drawn one by one, with outlines."""

    def frame(number: int) -> None:
        flat_view(gl, size, 640.0, 480.0)
        clear(gl)
        for i in range(240):
            if (i + number) % 7:
                gl.glColor3ub(i, 250 - i, 120)
                gl.glRectf(i % 16 * 40 + 2, 150 + i // 16 * 20, i % 16 * 40 + 38, 168 + i // 16 * 20)
        for i in range(20):
            gl.glPushMatrix()
            gl.glTranslatef(32 * i + 16, 60 + 40 * math.sin(0.1 * number + i), 0)
            for mode in (gl.GL_QUADS, gl.GL_LINE_LOOP):
                for face in range(4):
                    gl.glColor3f(0.25 * face, 0.5, 1.0 if mode == gl.GL_QUADS else 0.0)
                    gl.glBegin(mode)
                    for a, b in CORNERS:
                        gl.glVertex2f(12 * (a + face % 2) - 12, 12 * (b + face // 2) - 12)
                    gl.glEnd()
            gl.glPopMatrix()

    return frame


def curves(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """Twenty Bezier curves by glEvalCoord1f, with their control points."""

    def frame(number: int) -> None:
        flat_view(gl, size, 640.0, 480.0)
        clear(gl)
        gl.glEnable(gl.GL_MAP1_VERTEX_3)
        gl.glPointSize(5.0)
        for i in range(20):
            x, y = 20.0 * i, 50 * math.sin(0.1 * number + i)
            points = [[x, 100 + y, 0.0], [x + 60, 400.0, 0.0], [x + 130, 20.0, 0.0], [x + 200, 300.0 + i, 0.0]]
            gl.glMap1f(gl.GL_MAP1_VERTEX_3, 0.0, 1.0, np.array(points, np.float32))
            gl.glColor3f(1.0, i / 20, 0.0)
            gl.glBegin(gl.GL_LINE_STRIP)
            for step in range(31):
                gl.glEvalCoord1f(step / 30)
            gl.glEnd()
            gl.glColor3f(1.0, 1.0, 0.0)
            gl.glBegin(gl.GL_POINTS)
            for point in points:
                gl.glVertex3f(*point)
            gl.glEnd()

    return frame


def clock(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A clock: each line has a rotation and a width of its own."""

    def turned(angle: float, width: float, first: float, last: float) -> None:
        gl.glPushMatrix()
        gl.glRotatef(angle, 0.0, 0.0, 1.0)
        gl.glLineWidth(width)
        gl.glBegin(gl.GL_LINES)
        gl.glVertex2f(0.0, first)
        gl.glVertex2f(0.0, last)
        gl.glEnd()
        gl.glPopMatrix()

    def frame(number: int) -> None:
        flat_view(gl, size, 640.0, 480.0)
        clear(gl)
        gl.glTranslatef(320.0, 240.0, 0.0)
        gl.glColor3f(1.0, 1.0, 1.0)
        for minute in range(60):
            turned(6.0 * minute, 1.0 if minute % 5 else 3.0, 180.0, 195.0)
        for speed, width, length in ((1, 6.0, 100.0), (6, 4.0, 150.0), (30, 2.0, 170.0)):
            turned(-number * speed % 360, width, 0.0, length)

    return frame
