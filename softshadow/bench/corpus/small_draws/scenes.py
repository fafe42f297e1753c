"""Scenes of many small draws: leaves, several views, cubes in fog, snowmen."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from softshadow.bench.corpus.program import DrawNumberedFrame
from softshadow.bench.corpus.shapes import CORNERS
from softshadow.bench.corpus.views import box, clear, light, look


def leaves(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A tree of 400 leaves, lit on both sides in materials of their own, cut by a clip plane."""
    places = np.random.default_rng(4).uniform((-3, -2, -3, 0), (3, 2, 3, 360), (400, 4)).tolist()

    def frame(number: int) -> None:
        look(gl, size, (0.0, 2.0, 7.0))
        clear(gl)
        light(gl)
        gl.glDisable(gl.GL_COLOR_MATERIAL)
        gl.glLightModeli(gl.GL_LIGHT_MODEL_TWO_SIDE, 1)
        gl.glClipPlane(gl.GL_CLIP_PLANE0, (1.0, 0.0, 0.0, 2.0))
        gl.glEnable(gl.GL_CLIP_PLANE0)
        for i, (x, y, z, angle) in enumerate(places):
            gl.glMaterialfv(gl.GL_FRONT, gl.GL_DIFFUSE, (0.1, i / 400, 0.2, 1.0))
            gl.glMaterialfv(gl.GL_BACK, gl.GL_DIFFUSE, (i / 400, 0.3, 0.1, 1.0))
            gl.glPushMatrix()
            gl.glTranslatef(x, y, z)
            gl.glRotatef(angle + 2 * number, 0.3, 1.0, 0.1)
            gl.glBegin(gl.GL_TRIANGLE_FAN)
            gl.glNormal3f(0.0, 0.0, 1.0)
            for vertex in ((0.0, 0.0, 0.0), (0.2, -0.1, 0.0), (0.4, 0.0, 0.05), (0.2, 0.1, 0.0)):
                gl.glVertex3f(*vertex)
            gl.glEnd()
            gl.glPopMatrix()

    return frame


def stars(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A sky of 100 groups of 40 smooth points, smaller in the distance, added to each other."""
    groups = np.random.default_rng(1).uniform(-3, 3, (100, 40, 3)).astype(np.float32)

    def frame(number: int) -> None:
        look(gl, size, (0.0, 2.0, 7.0))
        clear(gl, (0.0, 0.0, 0.05, 1.0))
        gl.glRotatef(number, 0.0, 1.0, 0.0)
        gl.glEnable(gl.GL_POINT_SMOOTH)
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE)
        gl.glPointParameterfv(gl.GL_POINT_DISTANCE_ATTENUATION, np.array([0.0, 0.1, 0.0], np.float32))
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        for i, points in enumerate(groups):
            gl.glPointSize(2 + i % 5)
            gl.glColor4f(1.0, i / 100, 0.5, 0.6)
            gl.glVertexPointer(3, gl.GL_FLOAT, 0, points)
            gl.glDrawArrays(gl.GL_POINTS, 0, len(points))

    return frame


def four_views(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A turned solid in four viewports: filled with polygon offset, then its edges, from one display list."""
    radius = [0.6 + 0.3 * math.sin(3 * (i / 8 - 1)) for i in range(17)]
    gl.glNewList(1, gl.GL_COMPILE)
    for i in range(16):
        gl.glBegin(gl.GL_QUAD_STRIP)
        for j in range(25):
            x, z = math.cos(math.pi * j / 12), math.sin(math.pi * j / 12)
            for k in (i, i + 1):
                gl.glNormal3f(x, 0.0, z)
                gl.glVertex3f(radius[k] * x, k / 8 - 1, radius[k] * z)
        gl.glEnd()
    gl.glEndList()

    def frame(number: int) -> None:
        width, height = size[0] // 2, size[1] // 2
        gl.glDisable(gl.GL_SCISSOR_TEST)
        clear(gl)
        gl.glEnable(gl.GL_SCISSOR_TEST)
        gl.glPolygonOffset(1.0, 1.0)
        for view in range(4):
            x, y = view % 2 * width, view // 2 * height
            look(gl, (width, height), ((4, 0, 0), (0, 4, 0.01), (0, 0, 4), (2, 2, 3))[view])
            gl.glViewport(x, y, width, height)
            gl.glScissor(x, y, width, height)
            light(gl)
            gl.glRotatef(2.0 * number, 0.0, 1.0, 0.0)
            gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
            gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_FILL)
            gl.glColor3f(0.7, 0.7, 0.8)
            gl.glCallList(1)
            gl.glDisable(gl.GL_POLYGON_OFFSET_FILL)
            gl.glDisable(gl.GL_LIGHTING)
            gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_LINE)
            gl.glColor3f(0.0, 0.0, 0.1)
            gl.glCallList(1)
        gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_FILL)

    return frame


def depth_of_field(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """Five spheres from a display list, seen from eight places through the accumulation buffer."""
    gl.glNewList(1, gl.GL_COMPILE)
    gl.gluSphere(gl.gluNewQuadric(), 0.6, 20, 16)
    gl.glEndList()

    def frame(number: int) -> None:
        for k in range(8):
            x, y = 0.1 * math.cos(0.785 * k), 0.1 * math.sin(0.785 * k)
            look(gl, size, (x, y, 6.0))
            clear(gl)
            light(gl)
            gl.glRotatef(number, 0.0, 1.0, 0.0)
            for i in range(5):
                gl.glPushMatrix()
                gl.glTranslatef(1.5 * i - 3, 0.0, 2.0 * i - 4)
                gl.glColor3f(i / 5, 0.5, 1 - i / 5)
                gl.glCallList(1)
                gl.glPopMatrix()
            gl.glAccum(gl.GL_ACCUM if k else gl.GL_LOAD, 1 / 8)
        gl.glAccum(gl.GL_RETURN, 1.0)

    return frame


def surface_plot(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A plot of a function as 900 flat polygons with their outlines, each by a glBegin of its own."""

    def frame(number: int) -> None:
        look(gl, size, (4.0, 3.0, 4.0))
        clear(gl, (1.0, 1.0, 1.0, 1.0))
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glShadeModel(gl.GL_FLAT)
        gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
        gl.glPolygonOffset(1.0, 1.0)
        heights = [[0.5 * math.sin(0.3 * i + 0.1 * number) * math.cos(0.3 * j) for j in range(31)] for i in range(31)]
        for mode in (gl.GL_FILL, gl.GL_LINE):
            gl.glPolygonMode(gl.GL_FRONT_AND_BACK, mode)
            for i in range(30):
                for j in range(30):
                    level = 0.5 + heights[i][j] if mode == gl.GL_FILL else 0.0
                    gl.glColor3f(level, 0.5 * level, 0.5 - 0.5 * level)
                    gl.glBegin(gl.GL_POLYGON)
                    for a, b in CORNERS:
                        gl.glVertex3f((i + a - 15) * 0.15, heights[i + a][j + b], (j + b - 15) * 0.15)
                    gl.glEnd()
        gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_FILL)

    return frame


def watched_cubes(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A field of 300 cubes in fog; the camera is set anew before each of them."""

    def frame(number: int) -> None:
        look(gl, size)
        clear(gl)
        light(gl)
        gl.glEnable(gl.GL_FOG)
        gl.glFogf(gl.GL_FOG_DENSITY, 0.05)
        for i in range(300):
            gl.glLoadIdentity()
            gl.gluLookAt(0.0, 8.0, 14.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0)
            gl.glTranslatef(i % 20 - 10, math.sin(0.1 * number + i), i // 20 - 8)
            gl.glScalef(0.3, 0.3, 0.3)
            gl.glRotatef(number + i, 1.0, 1.0, 0.0)
            gl.glColor3f(i / 300, 0.5, 1 - i / 300)
            box(gl)

    return frame


def snowmen(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """Snowmen of GLU's spheres and cones, each of a size of its own, lit; their eyes shrink and grow."""
    quadric = gl.gluNewQuadric()

    def snowman(height: float, eye: float) -> None:
        gl.glPushMatrix()
        for radius in (0.5, 0.35, 0.2):
            gl.glTranslatef(0.0, 1.3 * radius * height, 0.0)
            gl.glColor3f(1.0, 1.0, 1.0)
            gl.gluSphere(quadric, radius * height, 16, 12)
        gl.glColor3f(0.0, 0.0, 0.0)
        for side in (-0.07, 0.07):
            gl.glPushMatrix()
            gl.glTranslatef(side * height, 0.05 * height, 0.18 * height)
            gl.gluSphere(quadric, eye * height, 8, 6)
            gl.glPopMatrix()
        gl.glColor3f(1.0, 0.5, 0.1)
        gl.gluCylinder(quadric, 0.05 * height, 0.0, 0.4 * height, 10, 2)
        gl.glPopMatrix()

    def frame(number: int) -> None:
        look(gl, size, (0.0, 3.0, 9.0))
        clear(gl)
        light(gl)
        gl.glRotatef(2.0 * number, 0.0, 1.0, 0.0)
        for i in range(16):
            gl.glPushMatrix()
            gl.glTranslatef(1.6 * (i % 4) - 2.4, -0.8, 1.6 * (i // 4) - 2.4)
            snowman(0.7 + 0.03 * i, 0.03 + 0.01 * math.sin(0.3 * number))
            gl.glPopMatrix()

    return frame
