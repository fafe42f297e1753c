"""Many small draws, each under a state of its own: dashed or smooth lines, widgets, leaves, several views.

What a draw costs besides its pixels shows here. Where such draws cannot wait for each other (`pipeline.queue`), a
program takes ten times as long.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np

from softshadow.bench.corpus.program import DrawNumberedFrame, program
from softshadow.bench.corpus.shapes import noise
from softshadow.bench.corpus.views import box, clear, flat_view, light, look, upload

FAMILY = "small-draws"
CORNERS = ((0, 0), (1, 0), (1, 1), (0, 1))


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


PROGRAMS = tuple(
    replace(each, name=f"{FAMILY}/{each.name}")
    for each in map(
        program,
        (
            pencil_sketch, dashed_boxes, widgets, leaves, stars, four_views, depth_of_field, surface_plot,
            watched_cubes, sized_points, wall_of_bricks, curves, clock, snowmen,
        ),
    )
)  # fmt: skip
