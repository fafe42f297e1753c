"""Textures: mipmaps, two units, environment maps, alpha test, text."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from softshadow.bench.corpus.program import DrawNumberedFrame, program
from softshadow.bench.corpus.shapes import checkers, leaf, letters, noise, sphere, spot, torus, turned
from softshadow.bench.corpus.views import BOX, clear, draw, flat_view, floor, light, look, upload


def textured_crates(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """Lit crates with a mipmapped texture on a tiled floor, vertex by vertex."""
    wood = upload(gl, noise(128), gl.GL_LINEAR_MIPMAP_LINEAR, gl.GL_REPEAT)
    tiles = upload(gl, checkers(256), gl.GL_LINEAR_MIPMAP_LINEAR, gl.GL_REPEAT)

    def frame(number: int) -> None:
        look(gl, size, (4.0, 2.5, 6.0))
        clear(gl)
        light(gl)
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_MODULATE)
        gl.glColor3f(1.0, 1.0, 1.0)
        gl.glBindTexture(gl.GL_TEXTURE_2D, tiles)
        floor(gl, 6.0, -1.0)
        gl.glBindTexture(gl.GL_TEXTURE_2D, wood)
        for i in range(9):
            gl.glPushMatrix()
            gl.glTranslatef(2.0 * (i % 3) - 2.0, -0.4, 2.0 * (i // 3) - 2.0)
            gl.glRotatef(20.0 * i + 2.0 * number, 0.0, 1.0, 0.0)
            gl.glScalef(0.6, 0.6, 0.6)
            gl.glBegin(gl.GL_QUADS)
            for normal, corners in BOX:
                gl.glNormal3f(*normal)
                for corner, (s, t) in zip(corners, ((0, 0), (1, 0), (1, 1), (0, 1)), strict=True):
                    gl.glTexCoord2f(s, t)
                    gl.glVertex3f(*corner)
            gl.glEnd()
            gl.glPopMatrix()

    return frame


def painted_vase(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A turned vase of 20,000 triangles, lit and textured with mipmaps, from arrays."""
    mesh = turned(lambda v: 0.5 + 0.35 * np.sin(2.0 + 5.5 * v) * (1 - 0.3 * v), 2.4, 100, 100)
    upload(gl, checkers(256, 16), gl.GL_LINEAR_MIPMAP_LINEAR, gl.GL_REPEAT)

    def frame(number: int) -> None:
        look(gl, size, (2.0, 2.4, 3.0), (0.0, 1.1, 0.0))
        clear(gl)
        light(gl)
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glRotatef(4.0 * number, 0.0, 1.0, 0.0)
        gl.glColor3f(0.95, 0.9, 0.8)
        draw(gl, mesh, texture=True)

    return frame


def lightmapped_room(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """The inside of a room with two texture units: bricks times a light map."""
    gl.glActiveTexture(gl.GL_TEXTURE0)
    upload(gl, checkers(128, 8), gl.GL_LINEAR_MIPMAP_NEAREST, gl.GL_REPEAT)
    gl.glEnable(gl.GL_TEXTURE_2D)
    gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_REPLACE)
    gl.glActiveTexture(gl.GL_TEXTURE1)
    lamp = spot(64)
    lamp[..., :3] = np.maximum(lamp[..., 3:], 40)
    upload(gl, lamp, gl.GL_LINEAR, gl.GL_CLAMP_TO_EDGE)
    gl.glEnable(gl.GL_TEXTURE_2D)
    gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_MODULATE)

    def frame(number: int) -> None:
        angle = 0.05 * number
        look(gl, size, (0.0, 0.0, 0.5), (math.sin(angle), 0.1, -math.cos(angle)), 70.0, 0.1)
        clear(gl)
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glBegin(gl.GL_QUADS)
        for _, corners in BOX:
            for corner, (s, t) in zip(corners, ((0, 0), (1, 0), (1, 1), (0, 1)), strict=True):
                gl.glMultiTexCoord2f(gl.GL_TEXTURE0, 3.0 * s, 2.0 * t)
                gl.glMultiTexCoord2f(gl.GL_TEXTURE1, s, t)
                gl.glVertex3f(2.0 * corner[0], corner[1], 2.0 * corner[2])
        gl.glEnd()

    return frame


def cube_map_reflection(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A torus that reflects a cube map, with generated reflection vectors."""
    mesh = torus(1.0, 0.45, 100, 50)
    gl.glBindTexture(gl.GL_TEXTURE_CUBE_MAP, gl.glGenTextures(1))
    for parameter, value in (
        (gl.GL_TEXTURE_MIN_FILTER, gl.GL_LINEAR),
        (gl.GL_TEXTURE_MAG_FILTER, gl.GL_LINEAR),
        (gl.GL_TEXTURE_WRAP_S, gl.GL_CLAMP_TO_EDGE),
        (gl.GL_TEXTURE_WRAP_T, gl.GL_CLAMP_TO_EDGE),
    ):
        gl.glTexParameteri(gl.GL_TEXTURE_CUBE_MAP, parameter, value)
    for i in range(6):
        sky = checkers(64, 4, 60 + 20 * i, 255 - 15 * i)
        sky[..., i % 3] //= 2
        target = gl.GL_TEXTURE_CUBE_MAP_POSITIVE_X + i
        gl.glTexImage2D(target, 0, gl.GL_RGBA, 64, 64, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, sky)
    for name in "STR":
        gl.glTexGeni(getattr(gl, f"GL_{name}"), gl.GL_TEXTURE_GEN_MODE, gl.GL_REFLECTION_MAP)
        gl.glEnable(getattr(gl, f"GL_TEXTURE_GEN_{name}"))
    gl.glEnable(gl.GL_TEXTURE_CUBE_MAP)

    def frame(number: int) -> None:
        look(gl, size, (0.0, 1.5, 3.5))
        clear(gl)
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glRotatef(5.0 * number, 1.0, 1.0, 0.0)
        draw(gl, mesh)

    return frame


def sphere_map_chrome(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """Chrome balls by sphere mapping, added to their own light."""
    mesh = sphere(0.55, 48, 24)
    upload(gl, noise(128, 3), gl.GL_LINEAR, gl.GL_REPEAT)
    for name in "ST":
        gl.glTexGeni(getattr(gl, f"GL_{name}"), gl.GL_TEXTURE_GEN_MODE, gl.GL_SPHERE_MAP)
        gl.glEnable(getattr(gl, f"GL_TEXTURE_GEN_{name}"))
    gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_ADD)

    def frame(number: int) -> None:
        look(gl, size, (0.0, 2.0, 5.0))
        clear(gl)
        light(gl)
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glColor3f(0.3, 0.3, 0.35)
        for i in range(10):
            gl.glPushMatrix()
            gl.glRotatef(36.0 * i + 2.0 * number, 0.0, 1.0, 0.0)
            gl.glTranslatef(1.8, 0.4 * math.sin(i + 0.1 * number), 0.0)
            draw(gl, mesh)
            gl.glPopMatrix()

    return frame


def alpha_tested_leaves(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A bush of 400 leaves cut out by the alpha test, with a quad each."""
    random = np.random.default_rng(11)
    centers, turns = random.normal(0.0, 0.6, (400, 3)), random.uniform(0, 2 * np.pi, 400)
    across = 0.16 * np.stack([np.cos(turns), np.sin(3 * turns) * 0.5, np.sin(turns)], 1)
    along = 0.16 * np.stack([-np.sin(turns) * 0.3, np.ones(400), np.cos(turns) * 0.3], 1)
    corners = np.stack([centers + a * across + b * along for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))], 1)
    vertices = np.ascontiguousarray(corners.reshape(-1, 3), np.float32)
    texture = np.tile(np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32), (400, 1))
    upload(gl, leaf(64), gl.GL_LINEAR, gl.GL_CLAMP_TO_EDGE)

    def frame(number: int) -> None:
        look(gl, size, (0.0, 0.5, 3.5))
        clear(gl, (0.6, 0.75, 0.9, 1.0))
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glEnable(gl.GL_ALPHA_TEST)
        gl.glAlphaFunc(gl.GL_GREATER, 0.5)
        gl.glRotatef(3.0 * number, 0.0, 1.0, 0.0)
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        gl.glEnableClientState(gl.GL_TEXTURE_COORD_ARRAY)
        gl.glVertexPointer(3, gl.GL_FLOAT, 0, vertices)
        gl.glTexCoordPointer(2, gl.GL_FLOAT, 0, texture)
        gl.glDrawArrays(gl.GL_QUADS, 0, len(vertices))

    return frame


def page_of_text(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """Lines of characters over a picture: a blended quad with glBegin for each of 1,200."""
    upload(gl, letters(), gl.GL_NEAREST, gl.GL_CLAMP_TO_EDGE)
    text = np.random.default_rng(2).integers(0, 64, 1200).tolist()

    def frame(number: int) -> None:
        flat_view(gl, size, 60.0, 20.0)
        clear(gl, (0.95, 0.93, 0.88, 1.0))
        gl.glDisable(gl.GL_BLEND)
        gl.glDisable(gl.GL_TEXTURE_2D)
        gl.glColor3f(0.7, 0.8, 0.9)
        gl.glRectf(4.0, 2.0, 56.0, 18.0)
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glColor4f(0.1, 0.1, 0.3, 1.0)
        gl.glTranslatef(0.0, 0.05 * (number % 20), 0.0)
        gl.glBegin(gl.GL_QUADS)
        for i, letter in enumerate(text):
            x, y, s, t = i % 60, i // 60, letter % 8 / 8, letter // 8 / 8
            for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                gl.glTexCoord2f(s + a / 8, t + b / 8)
                gl.glVertex2f(x + 0.9 * a, y + 0.9 * b)
        gl.glEnd()

    return frame


PROGRAMS = tuple(
    map(
        program,
        (
            textured_crates,
            painted_vase,
            lightmapped_room,
            cube_map_reflection,
            sphere_map_chrome,
            alpha_tested_leaves,
            page_of_text,
        ),
    )
)
