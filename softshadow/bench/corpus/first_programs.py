"""First programs: immediate mode, matrix stacks and display lists."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np

from softshadow.bench.corpus.program import DrawNumberedFrame, program
from softshadow.bench.corpus.shapes import Surface, sphere, turned
from softshadow.bench.corpus.views import box, clear, floor, light, look, shine


def turning_cubes(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A ring of lit cubes over a floor, vertex by vertex."""

    def frame(number: int) -> None:
        look(gl, size, (5.0, 4.0, 6.0))
        clear(gl)
        light(gl)
        gl.glColor3f(0.5, 0.55, 0.5)
        floor(gl, 4.0, -1.0)
        for i in range(8):
            gl.glPushMatrix()
            gl.glRotatef(45.0 * i + 2.0 * number, 0.0, 1.0, 0.0)
            gl.glTranslatef(2.5, 0.0, 0.0)
            gl.glRotatef(30.0 * i + 5.0 * number, 1.0, 0.0, 1.0)
            gl.glScalef(0.5, 0.5, 0.5)
            gl.glColor3f(0.2 + 0.1 * i, 0.9 - 0.1 * i, 0.4)
            box(gl)
            gl.glPopMatrix()

    return frame


def colored_cube(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """One cube with a colour at every corner, unlit, which fills the window."""

    def frame(number: int) -> None:
        look(gl, size, (2.0, 1.5, 2.6))
        clear(gl, (0.0, 0.0, 0.0, 1.0))
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glShadeModel(gl.GL_SMOOTH)
        gl.glRotatef(3.0 * number, 0.0, 1.0, 0.0)
        gl.glBegin(gl.GL_QUADS)
        for x in (-1.0, 1.0):
            for axis in range(3):
                for y, z in ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)):
                    corner = [y, z]
                    corner.insert(axis, x)
                    gl.glColor3f(*(0.5 + 0.5 * value for value in corner))
                    gl.glVertex3f(*corner)
        gl.glEnd()

    return frame


def ball(gl: Any, mesh: Surface) -> None:
    """Draw a mesh triangle by triangle with glBegin."""
    positions, normals = mesh.positions.tolist(), mesh.normals.tolist()
    gl.glBegin(gl.GL_TRIANGLES)
    for triangle in mesh.triangles.tolist():
        for corner in triangle:
            gl.glNormal3fv(normals[corner])
            gl.glVertex3fv(positions[corner])
    gl.glEnd()


def solar_system(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """Planets and moons with pushed matrices; the ball is a display list."""
    planet = gl.glGenLists(1)
    gl.glNewList(planet, gl.GL_COMPILE)
    ball(gl, sphere(1.0, 24, 12))
    gl.glEndList()

    def frame(number: int) -> None:
        look(gl, size, (0.0, 6.0, 9.0))
        clear(gl, (0.0, 0.0, 0.05, 1.0))
        light(gl, (0.0, 0.0, 0.0, 1.0))
        gl.glDisable(gl.GL_LIGHTING)
        gl.glColor3f(1.0, 0.9, 0.3)
        gl.glCallList(planet)
        gl.glEnable(gl.GL_LIGHTING)
        for i in range(7):
            gl.glPushMatrix()
            gl.glRotatef((9.0 - i) * number + 50.0 * i, 0.0, 1.0, 0.0)
            gl.glTranslatef(1.6 + 0.6 * i, 0.0, 0.0)
            gl.glPushMatrix()
            gl.glScalef(0.15 + 0.03 * i, 0.15 + 0.03 * i, 0.15 + 0.03 * i)
            gl.glColor3f(0.3 + 0.1 * i, 0.5, 1.0 - 0.1 * i)
            gl.glCallList(planet)
            gl.glPopMatrix()
            for moon in range(i % 3):
                gl.glPushMatrix()
                gl.glRotatef(15.0 * number + 180.0 * moon, 0.0, 1.0, 0.3)
                gl.glTranslatef(0.5, 0.0, 0.0)
                gl.glScalef(0.07, 0.07, 0.07)
                gl.glColor3f(0.7, 0.7, 0.7)
                gl.glCallList(planet)
                gl.glPopMatrix()
            gl.glPopMatrix()

    return frame


def wave_grid(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A function of two variables as quad strips, computed anew in Python for each frame."""
    cells = 40
    steps = [8.0 * i / cells - 4.0 for i in range(cells + 1)]

    def frame(number: int) -> None:
        look(gl, size, (4.0, 5.0, 6.0))
        clear(gl)
        light(gl)
        gl.glColor3f(0.3, 0.6, 0.9)
        phase = 0.15 * number
        for x, after in pairwise(steps):
            gl.glBegin(gl.GL_QUAD_STRIP)
            for z in steps:
                for column in (x, after):
                    distance = math.hypot(column, z) + 0.1
                    slope = -math.cos(3.0 * distance - phase) * 0.6 / distance
                    gl.glNormal3f(slope * column, 1.0, slope * z)
                    gl.glVertex3f(column, 0.2 * math.sin(3.0 * distance - phase), z)
            gl.glEnd()

    return frame


def robot_arm(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A hierarchy of scaled boxes with attributes pushed and popped, flat shaded."""

    def limb(length: float, width: float, color: tuple[float, float, float]) -> None:
        gl.glPushAttrib(gl.GL_CURRENT_BIT | gl.GL_LIGHTING_BIT)
        gl.glPushMatrix()
        gl.glTranslatef(0.0, length, 0.0)
        gl.glScalef(width, length, width)
        gl.glColor3f(*color)
        box(gl)
        gl.glPopMatrix()
        gl.glPopAttrib()

    def frame(number: int) -> None:
        look(gl, size, (5.0, 4.0, 7.0), (0.0, 2.0, 0.0))
        clear(gl, (0.8, 0.85, 0.9, 1.0))
        light(gl)
        gl.glShadeModel(gl.GL_FLAT)
        for arm in range(5):
            gl.glPushMatrix()
            gl.glTranslatef(1.2 * (arm - 2), 0.0, -0.8 * (arm % 2))
            for joint in range(4):
                limb(0.5 - 0.06 * joint, 0.2 - 0.03 * joint, (0.9, 0.3 + 0.15 * joint, 0.2 * arm))
                gl.glTranslatef(0.0, 1.0 - 0.12 * joint, 0.0)
                gl.glRotatef(30.0 * math.sin(0.1 * number + joint + arm), 0.3, 0.0, 1.0)
            for side in (-1.0, 1.0):
                gl.glPushMatrix()
                gl.glRotatef(25.0 * side, 0.0, 0.0, 1.0)
                limb(0.2, 0.06, (0.2, 0.2, 0.2))
                gl.glPopMatrix()
            gl.glPopMatrix()

    return frame


def chess_board(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """Turned chessmen in display lists on a board of 64 quads."""

    def pawn(v: np.ndarray) -> np.ndarray:
        return 0.1 + 0.28 * (1 - v) ** 2 + 0.12 * np.exp(-120 * (v - 0.85) ** 2) - 0.08 * v**6

    def queen(v: np.ndarray) -> np.ndarray:
        return 0.1 + 0.3 * (1 - v) ** 3 + 0.1 * v**8 + 0.05 * np.sin(20 * v) * (1 - v)

    men = gl.glGenLists(2)
    for i, (profile, height) in enumerate(((pawn, 0.9), (queen, 1.6))):
        gl.glNewList(men + i, gl.GL_COMPILE)
        ball(gl, turned(profile, height, 20, 16))
        gl.glEndList()

    def frame(number: int) -> None:
        look(gl, size, (7.0 * math.sin(0.03 * number), 6.0, 7.0 * math.cos(0.03 * number)))
        clear(gl, (0.3, 0.25, 0.2, 1.0))
        light(gl)
        shine(gl)
        gl.glBegin(gl.GL_QUADS)
        gl.glNormal3f(0.0, 1.0, 0.0)
        for row in range(8):
            for column in range(8):
                gray = 0.85 if (row + column) % 2 else 0.2
                gl.glColor3f(gray, gray, gray * 0.8)
                for x, z in ((0, 0), (0, 1), (1, 1), (1, 0)):
                    gl.glVertex3f(column + x - 4.0, 0.0, row + z - 4.0)
        gl.glEnd()
        for row, color in ((0, (0.9, 0.85, 0.7)), (1, (0.9, 0.85, 0.7)), (6, (0.25, 0.2, 0.2)), (7, (0.25, 0.2, 0.2))):
            gl.glColor3f(*color)
            for column in range(8):
                gl.glPushMatrix()
                gl.glTranslatef(column - 3.5, 0.0, row - 3.5)
                gl.glCallList(men + (row in (0, 7)))
                gl.glPopMatrix()

    return frame


PROGRAMS = tuple(map(program, (turning_cubes, colored_cube, solar_system, wave_grid, robot_arm, chess_board)))
