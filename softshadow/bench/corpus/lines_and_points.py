"""Lines and points: plots, wire frames, outlines, clouds of points."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from softshadow.bench.corpus.program import DrawNumberedFrame, program
from softshadow.bench.corpus.shapes import sphere, torus
from softshadow.bench.corpus.views import box, clear, draw, flat_view, look


def plotted_curves(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A diagram with a grid and 24 curves of 400 points each, as line strips from arrays."""
    x = np.linspace(0, 10, 400)

    def frame(number: int) -> None:
        flat_view(gl, size, 10.0, 6.0)
        clear(gl, (1.0, 1.0, 1.0, 1.0))
        gl.glColor3f(0.8, 0.8, 0.8)
        gl.glBegin(gl.GL_LINES)
        for i in range(41):
            gl.glVertex2f(0.25 * i, 0.0)
            gl.glVertex2f(0.25 * i, 6.0)
            gl.glVertex2f(0.0, 0.15 * i)
            gl.glVertex2f(10.0, 0.15 * i)
        gl.glEnd()
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        for i in range(24):
            y = 3.0 + 0.1 * i * np.sin((0.5 + 0.1 * i) * x + 0.05 * number)
            points = np.ascontiguousarray(np.stack([x, y], 1), np.float32)
            gl.glColor3f(i / 24, 0.4, 1 - i / 24)
            gl.glVertexPointer(2, gl.GL_FLOAT, 0, points)
            gl.glDrawArrays(gl.GL_LINE_STRIP, 0, len(points))

    return frame


def wire_torus(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A torus in wire frame by glPolygonMode."""
    mesh = torus(1.0, 0.45, 48, 24)

    def frame(number: int) -> None:
        look(gl, size)
        clear(gl, (0.0, 0.0, 0.0, 1.0))
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_LINE)
        gl.glRotatef(3.0 * number, 1.0, 1.0, 0.0)
        gl.glColor3f(0.3, 1.0, 0.4)
        draw(gl, mesh)

    return frame


def outlined_solids(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """Hidden lines removed: filled faces with polygon offset, then their edges."""
    ball = sphere(1.0, 20, 10)

    def solids(number: int) -> None:
        for i in range(4):
            gl.glPushMatrix()
            gl.glRotatef(90.0 * i + 3.0 * number, 0.0, 1.0, 0.0)
            gl.glTranslatef(1.8, 0.0, 0.0)
            gl.glRotatef(40.0 * i, 1.0, 0.0, 0.5)
            gl.glScalef(0.8, 0.8, 0.8)
            if i % 2:
                box(gl)
            else:
                draw(gl, ball)
            gl.glPopMatrix()

    def frame(number: int) -> None:
        look(gl, size, (3.5, 3.0, 4.5))
        clear(gl, (1.0, 1.0, 1.0, 1.0))
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_FILL)
        gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
        gl.glPolygonOffset(1.0, 1.0)
        gl.glColor3f(0.85, 0.9, 1.0)
        solids(number)
        gl.glDisable(gl.GL_POLYGON_OFFSET_FILL)
        gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_LINE)
        gl.glLineWidth(2.0)
        gl.glColor3f(0.1, 0.1, 0.2)
        solids(number)
        gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_FILL)

    return frame


def scanned_points(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A cloud of 60,000 coloured points of two pixels, as from a scanner."""
    random = np.random.default_rng(9)
    direction = random.normal(size=(60_000, 3))
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    bumps = 1 + 0.1 * np.sin(6 * direction[:, :1]) * np.cos(5 * direction[:, 1:2])
    points = np.ascontiguousarray(direction * bumps, np.float32)
    colors = np.ascontiguousarray(127 + 127 * direction, np.uint8)

    def frame(number: int) -> None:
        look(gl, size, (0.0, 1.0, 3.0))
        clear(gl, (0.0, 0.0, 0.0, 1.0))
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glPointSize(2.0)
        gl.glRotatef(3.0 * number, 0.0, 1.0, 0.0)
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        gl.glEnableClientState(gl.GL_COLOR_ARRAY)
        gl.glVertexPointer(3, gl.GL_FLOAT, 0, points)
        gl.glColorPointer(3, gl.GL_UNSIGNED_BYTE, 0, colors)
        gl.glDrawArrays(gl.GL_POINTS, 0, len(points))

    return frame


def vector_field(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A field of 900 arrows with glBegin, each with its own matrix."""

    def frame(number: int) -> None:
        flat_view(gl, size, 30.0, 30.0)
        clear(gl, (0.05, 0.05, 0.1, 1.0))
        for i in range(900):
            x, y = i % 30 + 0.5, i // 30 + 0.5
            angle = math.degrees(math.sin(0.3 * x + 0.1 * number) + math.cos(0.25 * y))
            gl.glPushMatrix()
            gl.glTranslatef(x, y, 0.0)
            gl.glRotatef(angle, 0.0, 0.0, 1.0)
            gl.glColor3f(0.5 + angle / 250, 0.8, 0.5 - angle / 250)
            gl.glBegin(gl.GL_LINE_STRIP)
            gl.glVertex2f(-0.4, 0.0)
            gl.glVertex2f(0.4, 0.0)
            gl.glVertex2f(0.2, 0.15)
            gl.glEnd()
            gl.glPopMatrix()

    return frame


PROGRAMS = tuple(map(program, (plotted_curves, wire_torus, outlined_solids, scanned_points, vector_field)))
