"""Flat pictures: text from bitmaps, sprites, panels, images and smooth curves."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from softshadow.bench.corpus.program import DrawNumberedFrame, program
from softshadow.bench.corpus.views import clear, flat_view, upload

GLYPHS = 64


def console_text(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A console of 30 lines of 60 characters, bitmaps in display lists called by glCallLists."""
    random = np.random.default_rng(4)
    strokes = random.integers(0, 256, (GLYPHS, 13), np.uint8) & 0b01111100
    strokes[:, (0, 4, 8, 12)] = 0b00111000
    base = gl.glGenLists(GLYPHS)
    gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1)
    for glyph, rows in enumerate(strokes):
        gl.glNewList(base + glyph, gl.GL_COMPILE)
        gl.glBitmap(8, 13, 0.0, 2.0, 10.0, 0.0, rows.tobytes())
        gl.glEndList()
    lines = random.integers(0, GLYPHS, (30, 60), np.uint8)

    def frame(number: int) -> None:
        flat_view(gl, size, *map(float, size))
        clear(gl, (0.0, 0.0, 0.0, 1.0))
        gl.glColor3f(0.2, 1.0, 0.3)
        gl.glListBase(base)
        for row in range(30):
            gl.glRasterPos2i(10, 10 + 15 * row)
            gl.glCallLists(60, gl.GL_UNSIGNED_BYTE, lines[(row + number) % 30].copy())

    return frame


def sprite_game(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """Turning sprites of a game: 200 quads, each with one of twelve textures and a matrix, with the alpha test."""
    random = np.random.default_rng(5)
    images = random.integers(0, 256, (12, 16, 16, 4), np.uint8)
    textures = [upload(gl, image, gl.GL_NEAREST, gl.GL_REPEAT) for image in images]
    places = random.uniform(0, 1, (200, 2)).tolist()

    def frame(number: int) -> None:
        flat_view(gl, size, 640.0, 480.0)
        clear(gl)
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glEnable(gl.GL_ALPHA_TEST)
        gl.glAlphaFunc(gl.GL_GREATER, 0.3)
        gl.glColor3f(1.0, 1.0, 1.0)
        for i, (x, y) in enumerate(places):
            gl.glBindTexture(gl.GL_TEXTURE_2D, textures[i % 12])
            gl.glPushMatrix()
            gl.glTranslatef(640.0 * x, 480.0 * y, 0.0)
            gl.glRotatef(2.0 * number + i, 0.0, 0.0, 1.0)
            gl.glBegin(gl.GL_QUADS)
            for s, t in ((0, 0), (1, 0), (1, 1), (0, 1)):
                gl.glTexCoord2f(s, t)
                gl.glVertex2f(40 * s - 20, 40 * t - 20)
            gl.glEnd()
            gl.glPopMatrix()

    return frame


def panels(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """The panels of a user interface: 60 blended rectangles with a frame of lines, each in a scissor box of its own."""

    def corners(x: float, y: float, inset: float) -> None:
        right, top = x + 80 - inset, y + 60 - inset
        for corner in ((x + inset, y + inset), (right, y + inset), (right, top), (x + inset, top)):
            gl.glVertex2f(*corner)

    def frame(number: int) -> None:
        flat_view(gl, size, *map(float, size))
        clear(gl, (0.9, 0.9, 0.92, 1.0))
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
        gl.glEnable(gl.GL_SCISSOR_TEST)
        for i in range(60):
            x, y = (37 * i + number) % 560, 53 * i % 420
            gl.glScissor(x, y, 80, 60)
            gl.glColor4f(i / 60, 0.3, 0.6, 0.7)
            gl.glBegin(gl.GL_QUADS)
            corners(x, y, 0.0)
            gl.glEnd()
            gl.glColor4f(1.0, 1.0, 1.0, 1.0)
            gl.glBegin(gl.GL_LINE_LOOP)
            corners(x, y, 2.5)
            gl.glEnd()
        gl.glDisable(gl.GL_SCISSOR_TEST)

    return frame


def image_viewer(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """An image by glDrawPixels, enlarged by one and a half, and its copy by glCopyPixels."""
    image = np.random.default_rng(6).integers(0, 256, (256, 256, 4), np.uint8)
    image[..., 0] = np.arange(256)

    def frame(number: int) -> None:
        flat_view(gl, size, *map(float, size))
        clear(gl)
        gl.glRasterPos2f(5.0, 5.0)
        gl.glPixelZoom(1.5, 1.5)
        shifted = np.ascontiguousarray(np.roll(image, 3 * number, axis=1))
        gl.glDrawPixels(256, 256, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, shifted)
        gl.glPixelZoom(1.0, 1.0)
        gl.glRasterPos2f(size[0] / 2, 0.0)
        gl.glCopyPixels(0, 0, size[0] // 2, size[1], gl.GL_COLOR)

    return frame


def smooth_curves(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """Six curves of 1,500 points as smooth lines, with 300 smooth points on them."""
    x = np.linspace(0, 640, 1500)

    def frame(number: int) -> None:
        flat_view(gl, size, 640.0, 480.0)
        clear(gl, (1.0, 1.0, 1.0, 1.0))
        for capability in (gl.GL_LINE_SMOOTH, gl.GL_POINT_SMOOTH, gl.GL_BLEND):
            gl.glEnable(capability)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
        gl.glLineWidth(1.5)
        gl.glPointSize(7.0)
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        for i in range(6):
            y = 160 + 30 * i + 60 * np.sin(0.015 * (i + 1) * x + 0.2 * number)
            points = np.ascontiguousarray(np.stack([x, y], 1), np.float32)
            gl.glColor4f(i / 6, 0.2, 1 - i / 6, 0.9)
            gl.glVertexPointer(2, gl.GL_FLOAT, 0, points)
            gl.glDrawArrays(gl.GL_LINE_STRIP, 0, len(points))
            marks = np.ascontiguousarray(points[::30])
            gl.glVertexPointer(2, gl.GL_FLOAT, 0, marks)
            gl.glDrawArrays(gl.GL_POINTS, 0, len(marks))

    return frame


def stippled_grid(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A map with a stippled grid, a stippled area, and a rubber band drawn with exclusive or."""
    pattern = np.tile(np.array([0xAA, 0x55], np.uint8).repeat(4), 16)

    def frame(number: int) -> None:
        flat_view(gl, size, 640.0, 480.0)
        clear(gl, (0.95, 0.95, 0.9, 1.0))
        gl.glEnable(gl.GL_LINE_STIPPLE)
        gl.glLineStipple(2, 0x0F0F)
        gl.glColor3f(0.5, 0.5, 0.5)
        gl.glBegin(gl.GL_LINES)
        for i in range(0, 640, 20):
            gl.glVertex2f(i + number % 20, 0.0)
            gl.glVertex2f(i + number % 20, 480.0)
            gl.glVertex2f(0.0, 0.75 * i)
            gl.glVertex2f(640.0, 0.75 * i)
        gl.glEnd()
        gl.glDisable(gl.GL_LINE_STIPPLE)
        gl.glEnable(gl.GL_POLYGON_STIPPLE)
        gl.glPolygonStipple(pattern)
        gl.glColor3f(0.2, 0.5, 0.2)
        gl.glBegin(gl.GL_POLYGON)
        for i in range(30):
            angle = i * math.tau / 30
            gl.glVertex2f(320 + 200 * math.cos(angle), 240 + 200 * math.sin(angle))
        gl.glEnd()
        gl.glDisable(gl.GL_POLYGON_STIPPLE)
        gl.glEnable(gl.GL_COLOR_LOGIC_OP)
        gl.glLogicOp(gl.GL_XOR)
        gl.glRectf(100.0 + number, 100.0, 300.0 + number, 300.0)
        gl.glDisable(gl.GL_COLOR_LOGIC_OP)

    return frame


PROGRAMS = tuple(map(program, (console_text, sprite_game, panels, image_viewer, smooth_curves, stippled_grid)))
