"""Programs that read back, copy or accumulate what they have drawn."""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow.bench.corpus.program import DrawNumberedFrame, program
from softshadow.bench.corpus.shapes import knot, sphere, torus
from softshadow.bench.corpus.views import box, clear, draw, flat_view, floor, light, look, shine


def motion_blur(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A turning knot, six exposures averaged in the accumulation buffer."""
    mesh, exposures = knot(200, 16), 6

    def frame(number: int) -> None:
        for i in range(exposures):
            look(gl, size, (0.0, 0.5, 4.0))
            clear(gl)
            light(gl)
            gl.glRotatef(8.0 * number + 1.5 * i, 0.0, 1.0, 0.0)
            gl.glColor3f(0.9, 0.6, 0.2)
            draw(gl, mesh)
            gl.glAccum(gl.GL_ACCUM if i else gl.GL_LOAD, 1.0 / exposures)
        gl.glAccum(gl.GL_RETURN, 1.0)

    return frame


def picked_by_color(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """Picking: 64 cubes each in a colour of its own, the pixel under the pointer read, then the cubes as shown."""

    def cubes(number: int, color_of: Any) -> None:
        look(gl, size, (4.0, 3.0, 6.0))
        clear(gl, (0.0, 0.0, 0.0, 1.0))
        gl.glRotatef(4.0 * number, 0.0, 1.0, 0.0)
        for i in range(64):
            gl.glPushMatrix()
            gl.glTranslatef(1.2 * (i % 4) - 1.8, 1.2 * (i // 4 % 4) - 1.8, 1.2 * (i // 16) - 1.8)
            gl.glScalef(0.35, 0.35, 0.35)
            color_of(i)
            box(gl)
            gl.glPopMatrix()

    def frame(number: int) -> None:
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glDisable(gl.GL_LIGHTING)
        cubes(number, lambda i: gl.glColor3ub(4 * i + 3, 0, 0))
        x, y = size[0] * (7 * number % 20 + 2) // 24, size[1] * (5 * number % 20 + 2) // 24
        pixel = np.zeros((1, 1, 4), np.uint8)
        gl.glReadPixels(x, y, 1, 1, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, pixel)
        chosen = int(pixel[0, 0, 0]) // 4 if pixel[0, 0, 0] else -1
        light(gl)
        cubes(number, lambda i: gl.glColor3f(1.0 if i == chosen else 0.3, 0.5, 0.2 + 0.01 * i))

    return frame


def video_frames(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """Frames of a film: a shiny ball on a floor; all colours and all depths are read back."""
    ball = sphere(1.0, 60, 30)
    colors, depths = np.zeros((size[1], size[0], 3), np.uint8), np.zeros((size[1], size[0]), np.float32)

    def frame(number: int) -> None:
        look(gl, size)
        clear(gl)
        light(gl, (3.0, 4.0, 0.2 * number, 1.0))
        shine(gl)
        gl.glColor3f(0.8, 0.3, 0.3)
        draw(gl, ball)
        gl.glColor3f(0.5, 0.6, 0.5)
        floor(gl, 4.0, -1.0)
        gl.glPixelStorei(gl.GL_PACK_ALIGNMENT, 1)
        gl.glReadPixels(0, 0, *size, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, colors)
        gl.glReadPixels(0, 0, *size, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT, depths)

    return frame


def image_in_image(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A cube that wears the picture of a torus, which is drawn first and copied with glCopyTexImage2D."""
    ring, side = torus(1.0, 0.4, 60, 30), 1 << (min(size).bit_length() - 1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_LINEAR)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MAG_FILTER, gl.GL_LINEAR)

    def frame(number: int) -> None:
        gl.glDisable(gl.GL_TEXTURE_2D)
        look(gl, (side, side), (0.0, 1.0, 3.2))
        clear(gl, (0.4, 0.2, 0.1, 1.0))
        light(gl)
        gl.glColor3f(0.3, 0.6, 1.0)
        gl.glRotatef(6.0 * number, 1.0, 0.5, 0.0)
        draw(gl, ring)
        gl.glCopyTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGB, 0, 0, side, side, 0)
        gl.glEnable(gl.GL_TEXTURE_2D)
        look(gl, size, (2.0, 1.6, 3.0))
        clear(gl)
        light(gl)
        gl.glRotatef(2.0 * number, 0.0, 1.0, 0.0)
        gl.glTexGeni(gl.GL_S, gl.GL_TEXTURE_GEN_MODE, gl.GL_OBJECT_LINEAR)
        gl.glTexGeni(gl.GL_T, gl.GL_TEXTURE_GEN_MODE, gl.GL_OBJECT_LINEAR)
        gl.glTexGenfv(gl.GL_S, gl.GL_OBJECT_PLANE, [0.5, 0.0, 0.25, 0.5])
        gl.glTexGenfv(gl.GL_T, gl.GL_OBJECT_PLANE, [0.0, 0.5, 0.25, 0.5])
        gl.glEnable(gl.GL_TEXTURE_GEN_S)
        gl.glEnable(gl.GL_TEXTURE_GEN_T)
        gl.glColor3f(1.0, 1.0, 1.0)
        box(gl)

    return frame


def counted_layers(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """How many faces lie behind each pixel: counted in the stencil buffer, then shown in colours, count by count."""
    mesh = knot(240, 16)

    def frame(number: int) -> None:
        look(gl, size, (0.0, 0.0, 4.0))
        clear(gl, (0.0, 0.0, 0.0, 1.0), gl.GL_STENCIL_BUFFER_BIT)
        gl.glDisable(gl.GL_DEPTH_TEST)
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glStencilFunc(gl.GL_ALWAYS, 0, 255)
        gl.glStencilOp(gl.GL_INCR, gl.GL_INCR, gl.GL_INCR)
        gl.glColorMask(False, False, False, False)
        gl.glRotatef(5.0 * number, 0.2, 1.0, 0.0)
        draw(gl, mesh)
        gl.glColorMask(True, True, True, True)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)
        flat_view(gl, size, 1.0, 1.0)
        for count in range(1, 9):
            gl.glStencilFunc(gl.GL_EQUAL, count, 255)
            gl.glColor3f(count / 8, 0.5 * (count % 2), 1 - count / 8)
            gl.glRectf(0.0, 0.0, 1.0, 1.0)

    return frame


PROGRAMS = tuple(map(program, (motion_blur, picked_by_color, video_frames, image_in_image, counted_layers)))
