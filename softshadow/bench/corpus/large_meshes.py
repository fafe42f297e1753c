"""Many vertices: landscapes, cloth, knots in buffer objects; and many small draws."""

from __future__ import annotations

import ctypes
import math
from typing import Any

import numpy as np

from softshadow.bench.corpus.program import DrawNumberedFrame, program
from softshadow.bench.corpus.shapes import box_faces, knot, noise, terrain, torus
from softshadow.bench.corpus.views import arrays, clear, draw, light, look, shine, upload


def foggy_hills(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A flight over hills in fog: a triangle strip with glDrawElements for each of 120 rows."""
    cells = 120
    mesh = terrain(cells, 16.0)
    column = np.arange(cells + 1, dtype=np.uint32)
    strips = [
        np.ascontiguousarray(np.stack([row * (cells + 1) + column + cells + 1, row * (cells + 1) + column], 1)).ravel()
        for row in range(cells)
    ]
    upload(gl, noise(256), gl.GL_LINEAR_MIPMAP_LINEAR, gl.GL_REPEAT)

    def frame(number: int) -> None:
        angle = 0.02 * number
        look(gl, size, (5.0 * math.sin(angle), 1.6, 5.0 * math.cos(angle)), (0.0, 0.3, 0.0), 60.0, 0.1)
        clear(gl, (0.7, 0.75, 0.8, 1.0))
        light(gl)
        gl.glEnable(gl.GL_FOG)
        gl.glFogi(gl.GL_FOG_MODE, gl.GL_LINEAR)
        gl.glFogf(gl.GL_FOG_START, 2.0)
        gl.glFogf(gl.GL_FOG_END, 11.0)
        gl.glFogfv(gl.GL_FOG_COLOR, [0.7, 0.75, 0.8, 1.0])
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glColor3f(0.9, 0.95, 0.9)
        arrays(gl, mesh, texture=True)
        for strip in strips:
            gl.glDrawElements(gl.GL_TRIANGLE_STRIP, len(strip), gl.GL_UNSIGNED_INT, strip)

    return frame


def hills_in_ranges(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """Hills in buffer objects, drawn with glDrawRangeElements in blocks, coloured by their heights, exponential fog."""
    cells, block = 160, 20
    mesh = terrain(cells, 14.0, 1.6)
    height = (mesh.positions[:, 1] - mesh.positions[:, 1].min()) / np.ptp(mesh.positions[:, 1])
    colors = np.stack([0.3 + 0.6 * height, 0.5 + 0.3 * height, 0.2 + 0.7 * height**2], 1).astype(np.float32)
    data = np.ascontiguousarray(np.hstack([mesh.positions, mesh.normals, colors]))
    vertices, indices = gl.glGenBuffers(1), gl.glGenBuffers(1)
    gl.glBindBuffer(gl.GL_ARRAY_BUFFER, vertices)
    gl.glBufferData(gl.GL_ARRAY_BUFFER, data.nbytes, data, gl.GL_STATIC_DRAW)
    gl.glBindBuffer(gl.GL_ELEMENT_ARRAY_BUFFER, indices)
    quads = mesh.triangles.reshape(2, cells, cells, 3)
    blocks = [np.ascontiguousarray(quads[:, row : row + block]).ravel() for row in range(0, cells, block)]
    gl.glBufferData(gl.GL_ELEMENT_ARRAY_BUFFER, mesh.triangles.nbytes, np.concatenate(blocks), gl.GL_STATIC_DRAW)

    def frame(number: int) -> None:
        look(gl, size, (0.0, 4.0, 8.0 - 0.02 * number), (0.0, 0.0, 0.0))
        clear(gl, (0.8, 0.85, 0.9, 1.0))
        light(gl)
        gl.glEnable(gl.GL_FOG)
        gl.glFogi(gl.GL_FOG_MODE, gl.GL_EXP2)
        gl.glFogf(gl.GL_FOG_DENSITY, 0.08)
        gl.glFogfv(gl.GL_FOG_COLOR, [0.8, 0.85, 0.9, 1.0])
        for array in (gl.GL_VERTEX_ARRAY, gl.GL_NORMAL_ARRAY, gl.GL_COLOR_ARRAY):
            gl.glEnableClientState(array)
        gl.glVertexPointer(3, gl.GL_FLOAT, 36, ctypes.c_void_p(0))
        gl.glNormalPointer(gl.GL_FLOAT, 36, ctypes.c_void_p(12))
        gl.glColorPointer(3, gl.GL_FLOAT, 36, ctypes.c_void_p(24))
        first = 0
        for part in blocks:
            at = ctypes.c_void_p(4 * first)
            gl.glDrawRangeElements(gl.GL_TRIANGLES, int(part.min()), int(part.max()), len(part), gl.GL_UNSIGNED_INT, at)
            first += len(part)

    return frame


def waving_flag(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A cloth whose arrays NumPy computes anew for each frame; lit on both sides."""
    cells = 80
    v, u = np.meshgrid(np.linspace(-1, 1, cells + 1), np.linspace(0, 3, cells + 1), indexing="ij")
    corner = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    quads = np.ascontiguousarray(np.stack([corner, corner + 1, corner + cells + 2, corner + cells + 1], 1), np.uint16)

    def frame(number: int) -> None:
        phase = 3.0 * u - 0.2 * number
        depth, slope = 0.1 * u * np.sin(phase + v), 0.1 * np.sin(phase + v) + 0.3 * u * np.cos(phase + v)
        positions = np.ascontiguousarray(np.stack([u - 1.5, v, depth], -1).reshape(-1, 3), np.float32)
        normals = np.stack([-slope, -0.1 * u * np.cos(phase + v), np.ones_like(u)], -1)
        look(gl, size, (1.0, 0.8, 4.0))
        clear(gl)
        light(gl)
        gl.glLightModeli(gl.GL_LIGHT_MODEL_TWO_SIDE, 1)
        gl.glColor3f(0.85, 0.2, 0.2)
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        gl.glEnableClientState(gl.GL_NORMAL_ARRAY)
        gl.glVertexPointer(3, gl.GL_FLOAT, 0, positions)
        gl.glNormalPointer(gl.GL_FLOAT, 0, np.ascontiguousarray(normals.reshape(-1, 3), np.float32))
        gl.glDrawElements(gl.GL_QUADS, quads.size, gl.GL_UNSIGNED_SHORT, quads)

    return frame


def knot_in_buffers(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A knot of 48,000 triangles in buffer objects, with a highlight."""
    mesh = knot()
    buffers = []
    for target, data in (
        (gl.GL_ARRAY_BUFFER, mesh.positions),
        (gl.GL_ARRAY_BUFFER, mesh.normals),
        (gl.GL_ELEMENT_ARRAY_BUFFER, mesh.triangles),
    ):
        buffers.append(gl.glGenBuffers(1))
        gl.glBindBuffer(target, buffers[-1])
        gl.glBufferData(target, data.nbytes, data, gl.GL_STATIC_DRAW)

    def frame(number: int) -> None:
        look(gl, size, (0.0, 0.0, 4.0))
        clear(gl)
        light(gl)
        shine(gl)
        gl.glRotatef(4.0 * number, 0.3, 1.0, 0.0)
        gl.glColor3f(0.4, 0.7, 0.5)
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        gl.glEnableClientState(gl.GL_NORMAL_ARRAY)
        gl.glBindBuffer(gl.GL_ARRAY_BUFFER, buffers[0])
        gl.glVertexPointer(3, gl.GL_FLOAT, 0, None)
        gl.glBindBuffer(gl.GL_ARRAY_BUFFER, buffers[1])
        gl.glNormalPointer(gl.GL_FLOAT, 0, None)
        gl.glDrawElements(gl.GL_TRIANGLES, mesh.triangles.size, gl.GL_UNSIGNED_INT, None)

    return frame


def three_lights(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A torus of 36,000 triangles under a spotlight, a directional and a local light, culled, from client arrays."""
    mesh = torus(1.1, 0.5, 180, 100)

    def frame(number: int) -> None:
        look(gl, size, (0.0, 2.0, 4.0))
        clear(gl, (0.0, 0.0, 0.0, 1.0))
        light(gl, (1.0, 1.0, 0.5, 0.0))
        shine(gl, 60.0)
        gl.glEnable(gl.GL_CULL_FACE)
        for index, (place, color) in enumerate(
            (((2.0, 2.0, 2.0, 1.0), (0.2, 0.2, 1.0)), ((-2.0, 3.0, 1.0, 1.0), (1.0, 0.3, 0.1))), 1
        ):
            lamp = gl.GL_LIGHT0 + index
            gl.glEnable(lamp)
            gl.glLightfv(lamp, gl.GL_POSITION, place)
            gl.glLightfv(lamp, gl.GL_DIFFUSE, [*color, 1.0])
            gl.glLightfv(lamp, gl.GL_SPECULAR, [*color, 1.0])
            gl.glLightf(lamp, gl.GL_LINEAR_ATTENUATION, 0.1)
        gl.glLightf(gl.GL_LIGHT2, gl.GL_SPOT_CUTOFF, 25.0)
        gl.glLightf(gl.GL_LIGHT2, gl.GL_SPOT_EXPONENT, 4.0)
        gl.glLightfv(gl.GL_LIGHT2, gl.GL_SPOT_DIRECTION, [2.0, -3.0, -1.0])
        gl.glRotatef(3.0 * number, 1.0, 0.4, 0.0)
        gl.glColor3f(0.7, 0.7, 0.7)
        draw(gl, mesh)

    return frame


def city_of_boxes(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A city of 400 houses: a matrix, a colour and a draw of twelve triangles each."""
    faces = box_faces()
    corners = np.array([corner for _, four in faces for corner in four], np.float32)
    normals = np.array([normal for normal, _ in faces for _ in range(4)], np.float32)
    quads = np.arange(24, dtype=np.uint8)
    random = np.random.default_rng(6)
    heights, shades = random.uniform(0.2, 1.4, (20, 20)).tolist(), random.uniform(0.3, 1.0, (20, 20)).tolist()

    def frame(number: int) -> None:
        angle = 0.02 * number
        look(gl, size, (9.0 * math.sin(angle), 5.0, 9.0 * math.cos(angle)))
        clear(gl, (0.7, 0.8, 0.9, 1.0))
        light(gl)
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        gl.glEnableClientState(gl.GL_NORMAL_ARRAY)
        gl.glVertexPointer(3, gl.GL_FLOAT, 0, corners)
        gl.glNormalPointer(gl.GL_FLOAT, 0, normals)
        for row in range(20):
            for column in range(20):
                gl.glPushMatrix()
                gl.glTranslatef(0.5 * column - 4.75, heights[row][column], 0.5 * row - 4.75)
                gl.glScalef(0.18, heights[row][column], 0.18)
                gl.glColor3f(shades[row][column], 0.6, 0.5)
                gl.glDrawElements(gl.GL_QUADS, 24, gl.GL_UNSIGNED_BYTE, quads)
                gl.glPopMatrix()

    return frame


PROGRAMS = tuple(
    map(program, (foggy_hills, hills_in_ranges, waving_flag, knot_in_buffers, three_lights, city_of_boxes))
)
