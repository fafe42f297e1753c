"""Planar shadows, shadow volumes and mirrors with the stencil buffer."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from softshadow.bench.corpus.program import DrawNumberedFrame, program
from softshadow.bench.corpus.shapes import Surface, knot, torus
from softshadow.bench.corpus.views import box, clear, draw, floor, light, look, shine

LAMP = (2.0, 5.0, 1.5)


def planar_shadow(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A knot flattened onto the floor by a matrix; the stencil buffer darkens each pixel once."""
    mesh = knot(240, 16)
    x, y, z = LAMP
    # column by column: the projection from the lamp onto the plane y = 0
    flatten = [y, 0.0, 0.0, 0.0, -x, 0.0, -z, -1.0, 0.0, 0.0, y, 0.0, 0.0, 0.0, 0.0, y]

    def knot_above(number: int) -> None:
        gl.glTranslatef(0.0, 1.6, 0.0)
        gl.glRotatef(4.0 * number, 0.0, 1.0, 0.2)
        draw(gl, mesh)

    def frame(number: int) -> None:
        look(gl, size, (4.0, 4.0, 6.0), (0.0, 0.8, 0.0))
        clear(gl, more=gl.GL_STENCIL_BUFFER_BIT)
        light(gl, (*LAMP, 1.0))
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glStencilFunc(gl.GL_ALWAYS, 1, 255)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
        gl.glColor3f(0.6, 0.6, 0.55)
        floor(gl)
        gl.glStencilFunc(gl.GL_EQUAL, 1, 255)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_INCR)
        gl.glDisable(gl.GL_LIGHTING)
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
        gl.glColor4f(0.0, 0.0, 0.0, 0.6)
        gl.glPushMatrix()
        gl.glTranslatef(0.0, 0.01, 0.0)
        gl.glMultMatrixf(flatten)
        knot_above(number)
        gl.glPopMatrix()
        gl.glDisable(gl.GL_BLEND)
        gl.glDisable(gl.GL_STENCIL_TEST)
        gl.glEnable(gl.GL_LIGHTING)
        gl.glColor3f(0.9, 0.5, 0.3)
        knot_above(number)

    return frame


def boxes_at(number: int) -> list[tuple[tuple[float, float, float], float]]:
    """Return the middle and half the edge of each box."""
    return [
        ((1.8 * math.cos(i + 0.02 * number), 0.8 + 0.15 * i, 1.8 * math.sin(1.3 * i + 0.02 * number)), 0.2 + 0.03 * i)
        for i in range(7)
    ]


def box_volume(gl: Any, center: tuple[float, float, float], half: float) -> None:
    """Draw the sides of a box's shadow volume: the edges between lit and unlit faces, far from the lamp."""
    corners = [tuple(center[k] + half * (1 if i >> k & 1 else -1) for k in range(3)) for i in range(8)]
    far = [tuple(LAMP[k] + 12.0 * (corner[k] - LAMP[k]) for k in range(3)) for corner in corners]
    for axis in range(3):
        one, two = 1 << (axis + 1) % 3, 1 << (axis + 2) % 3
        for side in (0, 1):
            lit = (LAMP[axis] - center[axis]) * (1 if side else -1) > half
            if not lit:
                continue
            loop = [side << axis, side << axis | one, side << axis | one | two, side << axis | two]
            for a, b in zip(loop, [*loop[1:], loop[0]], strict=True):
                if not side:
                    a, b = b, a
                edge_axis = (a ^ b).bit_length() - 1
                neighbour = 3 - axis - edge_axis
                outward = 1 if a >> neighbour & 1 else -1
                if (LAMP[neighbour] - center[neighbour]) * outward > half:
                    continue  # both faces at this edge are lit
                for corner in (corners[b], corners[a], far[a], far[b]):
                    gl.glVertex3f(*corner)


def zpass_boxes(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """Shadow volumes of boxes by z-pass: ambient, two counting passes, light where the count is 0."""

    def scene(number: int) -> None:
        gl.glColor3f(0.7, 0.7, 0.75)
        floor(gl, 5.0)
        for i, (center, half) in enumerate(boxes_at(number)):
            gl.glPushMatrix()
            gl.glTranslatef(*center)
            gl.glScalef(half, half, half)
            gl.glColor3f(0.9, 0.2 + 0.1 * i, 0.3)
            box(gl)
            gl.glPopMatrix()

    def frame(number: int) -> None:
        look(gl, size, (5.0, 4.0, 5.0), far=60.0)
        gl.glDepthMask(True)
        gl.glDepthFunc(gl.GL_LESS)
        clear(gl, more=gl.GL_STENCIL_BUFFER_BIT)
        light(gl, (*LAMP, 1.0))
        gl.glDisable(gl.GL_LIGHT0)
        scene(number)
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glStencilFunc(gl.GL_ALWAYS, 0, 255)
        gl.glColorMask(False, False, False, False)
        gl.glDepthMask(False)
        gl.glEnable(gl.GL_CULL_FACE)
        gl.glDisable(gl.GL_LIGHTING)
        for face, operation in ((gl.GL_BACK, gl.GL_INCR), (gl.GL_FRONT, gl.GL_DECR)):
            gl.glCullFace(face)
            gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, operation)
            gl.glBegin(gl.GL_QUADS)
            for center, half in boxes_at(number):
                box_volume(gl, center, half)
            gl.glEnd()
        gl.glDisable(gl.GL_CULL_FACE)
        gl.glColorMask(True, True, True, True)
        gl.glDepthFunc(gl.GL_LEQUAL)
        gl.glStencilFunc(gl.GL_EQUAL, 0, 255)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)
        light(gl, (*LAMP, 1.0))
        scene(number)
        gl.glDisable(gl.GL_STENCIL_TEST)

    return frame


def closed_volume(mesh: Surface, lamp: np.ndarray, length: float = 20.0) -> np.ndarray:
    """Return the shadow volume of a mesh as a triangle soup (n, 3): every face that faces the lamp becomes a prism.

    Prisms of neighbours share their sides, once from the front and once from the back, so they cancel in the count.
    """
    corners = mesh.positions.astype(np.float64)[mesh.triangles]
    facing = np.einsum(
        "ij,ij->i", np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), lamp - corners[:, 0]
    )
    near = corners[facing > 0]
    away = near - lamp
    far = near + away * (length / np.linalg.norm(away, axis=-1, keepdims=True))
    parts = [near, far[:, ::-1]]
    for i, j in ((0, 1), (1, 2), (2, 0)):
        parts.append(np.stack([near[:, j], near[:, i], far[:, i]], 1))
        parts.append(np.stack([near[:, j], far[:, i], far[:, j]], 1))
    return np.ascontiguousarray(np.concatenate(parts).reshape(-1, 3), np.float32)


def zfail_torus(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """The shadow volume of a torus by z-fail with two-sided stencil; a prism below each face."""
    mesh = torus(1.0, 0.4, 40, 20)
    mesh = mesh._replace(positions=mesh.positions + np.array((0.0, 1.6, 0.0), np.float32))
    volume = closed_volume(mesh, np.array(LAMP))

    def scene() -> None:
        gl.glColor3f(0.6, 0.65, 0.6)
        floor(gl, 5.0)
        gl.glColor3f(0.4, 0.6, 0.9)
        draw(gl, mesh)

    def frame(number: int) -> None:
        angle = 0.04 * number
        look(gl, size, (6.0 * math.sin(angle), 3.5, 6.0 * math.cos(angle)), (0.0, 1.0, 0.0), far=80.0)
        gl.glDepthMask(True)
        gl.glDepthFunc(gl.GL_LESS)
        clear(gl, more=gl.GL_STENCIL_BUFFER_BIT)
        light(gl, (*LAMP, 1.0))
        gl.glDisable(gl.GL_LIGHT0)
        scene()
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glStencilFunc(gl.GL_ALWAYS, 0, 255)
        gl.glStencilOpSeparate(gl.GL_FRONT, gl.GL_KEEP, gl.GL_DECR_WRAP, gl.GL_KEEP)
        gl.glStencilOpSeparate(gl.GL_BACK, gl.GL_KEEP, gl.GL_INCR_WRAP, gl.GL_KEEP)
        gl.glColorMask(False, False, False, False)
        gl.glDepthMask(False)
        gl.glDisable(gl.GL_LIGHTING)
        gl.glDisableClientState(gl.GL_NORMAL_ARRAY)
        gl.glVertexPointer(3, gl.GL_FLOAT, 0, volume)
        gl.glDrawArrays(gl.GL_TRIANGLES, 0, len(volume))
        gl.glColorMask(True, True, True, True)
        gl.glDepthFunc(gl.GL_EQUAL)
        gl.glStencilFunc(gl.GL_EQUAL, 0, 255)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)
        light(gl, (*LAMP, 1.0))
        scene()
        gl.glDisable(gl.GL_STENCIL_TEST)

    return frame


def mirrored_floor(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A shiny floor: the scene upside down inside the stencil mask, clipped at the floor, under a blended floor."""
    ring = torus(0.8, 0.3, 60, 30)

    def things(number: int) -> None:
        gl.glPushMatrix()
        gl.glTranslatef(0.0, 1.3, 0.0)
        gl.glRotatef(5.0 * number, 0.0, 1.0, 0.0)
        gl.glColor3f(0.9, 0.7, 0.2)
        draw(gl, ring)
        gl.glTranslatef(1.6, 0.4 * math.sin(0.2 * number) - 0.7, 0.0)
        gl.glScalef(0.3, 0.8, 0.3)
        gl.glColor3f(0.3, 0.8, 0.5)
        box(gl)
        gl.glPopMatrix()

    def frame(number: int) -> None:
        look(gl, size, (3.5, 2.5, 4.5), (0.0, 0.6, 0.0))
        clear(gl, more=gl.GL_STENCIL_BUFFER_BIT)
        light(gl)
        shine(gl)
        gl.glDisable(gl.GL_DEPTH_TEST)
        gl.glColorMask(False, False, False, False)
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glStencilFunc(gl.GL_ALWAYS, 1, 1)
        gl.glStencilOp(gl.GL_REPLACE, gl.GL_REPLACE, gl.GL_REPLACE)
        floor(gl, 2.5)
        gl.glColorMask(True, True, True, True)
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glStencilFunc(gl.GL_EQUAL, 1, 1)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)
        gl.glPushMatrix()
        gl.glScalef(1.0, -1.0, 1.0)
        gl.glClipPlane(gl.GL_CLIP_PLANE0, [0.0, 1.0, 0.0, 0.0])
        gl.glEnable(gl.GL_CLIP_PLANE0)
        gl.glLightfv(gl.GL_LIGHT0, gl.GL_POSITION, [2.0, 5.0, 3.0, 1.0])
        things(number)
        gl.glDisable(gl.GL_CLIP_PLANE0)
        gl.glPopMatrix()
        gl.glDisable(gl.GL_STENCIL_TEST)
        gl.glLightfv(gl.GL_LIGHT0, gl.GL_POSITION, [2.0, 5.0, 3.0, 1.0])
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
        gl.glColor4f(0.5, 0.55, 0.7, 0.6)
        floor(gl, 2.5)
        gl.glDisable(gl.GL_BLEND)
        things(number)

    return frame


PROGRAMS = tuple(map(program, (planar_shadow, zpass_boxes, zfail_torus, mirrored_floor)))
