"""Shadow maps by framebuffer object and by copy, soft shadows by accumulation, a slide projector."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from softshadow.bench.corpus.program import DrawNumberedFrame, program
from softshadow.bench.corpus.shapes import Surface, checkers, knot, sphere, terrain, torus
from softshadow.bench.corpus.views import box, clear, draw, floor, light, look, upload


def depth_texture(gl: Any, side: int) -> int:
    """Return a depth texture that is compared with the third texture coordinate."""
    name: int = gl.glGenTextures(1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, name)
    for parameter, value in (
        (gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST),
        (gl.GL_TEXTURE_MAG_FILTER, gl.GL_NEAREST),
        (gl.GL_TEXTURE_WRAP_S, gl.GL_CLAMP_TO_EDGE),
        (gl.GL_TEXTURE_WRAP_T, gl.GL_CLAMP_TO_EDGE),
        (gl.GL_TEXTURE_COMPARE_MODE, gl.GL_COMPARE_R_TO_TEXTURE),
        (gl.GL_TEXTURE_COMPARE_FUNC, gl.GL_LEQUAL),
        (gl.GL_DEPTH_TEXTURE_MODE, gl.GL_LUMINANCE),
    ):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, parameter, value)
    gl.glTexImage2D(
        gl.GL_TEXTURE_2D, 0, gl.GL_DEPTH_COMPONENT, side, side, 0, gl.GL_DEPTH_COMPONENT, gl.GL_UNSIGNED_INT, None
    )
    return name


def look_from_lamp(gl: Any, lamp: Sequence[float], side: int) -> None:
    """Set the view of a depth pass, and slope-scaled offset."""
    look(gl, (side, side), lamp, field_of_view=60.0, near=1.5, far=15.0)
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glDisable(gl.GL_LIGHTING)
    gl.glDisable(gl.GL_TEXTURE_2D)
    gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
    gl.glPolygonOffset(2.0, 4.0)


def project_from(gl: Any, lamp: Sequence[float]) -> None:
    """Generate texture coordinates: the place in the map of a lamp; call it with the camera as modelview matrix."""
    gl.glMatrixMode(gl.GL_TEXTURE)
    gl.glLoadIdentity()
    gl.glTranslatef(0.5, 0.5, 0.5)
    gl.glScalef(0.5, 0.5, 0.5)
    gl.gluPerspective(60.0, 1.0, 1.5, 15.0)
    gl.gluLookAt(*lamp, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0)
    gl.glMatrixMode(gl.GL_MODELVIEW)
    for i, name in enumerate("STRQ"):
        gl.glTexGeni(getattr(gl, f"GL_{name}"), gl.GL_TEXTURE_GEN_MODE, gl.GL_EYE_LINEAR)
        gl.glTexGenfv(getattr(gl, f"GL_{name}"), gl.GL_EYE_PLANE, [float(i == k) for k in range(4)])
        gl.glEnable(getattr(gl, f"GL_TEXTURE_GEN_{name}"))
    gl.glEnable(gl.GL_TEXTURE_2D)


def knot_and_floor(gl: Any, mesh: Surface) -> None:
    """Draw the scene of the shadow maps."""
    gl.glColor3f(0.9, 0.6, 0.4)
    draw(gl, mesh)
    gl.glColor3f(0.7, 0.75, 0.7)
    floor(gl, 4.0, -1.6)


def map_in_framebuffer(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A shadow map of 1024 x 1024 in a framebuffer object, compared by the texture unit."""
    side, mesh = 1024, knot(400, 24)
    texture, buffer = depth_texture(gl, side), gl.glGenFramebuffers(1)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, buffer)
    gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_DEPTH_ATTACHMENT, gl.GL_TEXTURE_2D, texture, 0)
    gl.glDrawBuffer(gl.GL_NONE)
    gl.glReadBuffer(gl.GL_NONE)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)

    def frame(number: int) -> None:
        lamp = (4.0 * math.cos(0.05 * number), 5.0, 4.0 * math.sin(0.05 * number))
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, buffer)
        look_from_lamp(gl, lamp, side)
        gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
        draw(gl, mesh)
        gl.glDisable(gl.GL_POLYGON_OFFSET_FILL)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
        look(gl, size, (4.0, 3.0, 5.0))
        clear(gl)
        light(gl, (*lamp, 1.0))
        project_from(gl, lamp)
        knot_and_floor(gl, mesh)

    return frame


def map_copied(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A shadow map drawn in the window and copied with glCopyTexSubImage2D; shadows darken in a second pass."""
    side, mesh = 1 << (min(size).bit_length() - 1), torus(1.2, 0.5, 80, 40)
    texture = depth_texture(gl, side)

    def scene(number: int) -> None:
        gl.glPushMatrix()
        gl.glRotatef(4.0 * number, 1.0, 1.0, 0.0)
        gl.glColor3f(0.5, 0.7, 0.9)
        draw(gl, mesh)
        gl.glPopMatrix()
        gl.glColor3f(0.7, 0.7, 0.65)
        floor(gl, 4.0, -1.8)

    def frame(number: int) -> None:
        lamp = (3.0, 5.0, 2.0)
        gl.glDisable(gl.GL_BLEND)
        gl.glDepthFunc(gl.GL_LESS)
        clear(gl)
        look_from_lamp(gl, lamp, side)
        scene(number)
        gl.glDisable(gl.GL_POLYGON_OFFSET_FILL)
        gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
        gl.glCopyTexSubImage2D(gl.GL_TEXTURE_2D, 0, 0, 0, 0, 0, side, side)
        clear(gl)
        look(gl, size, (4.0, 3.0, 5.0))
        light(gl, (*lamp, 1.0))
        gl.glDisable(gl.GL_LIGHT0)
        scene(number)
        gl.glEnable(gl.GL_LIGHT0)
        project_from(gl, lamp)
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_ONE, gl.GL_ONE)
        gl.glDepthFunc(gl.GL_EQUAL)
        scene(number)
        gl.glDisable(gl.GL_TEXTURE_2D)

    return frame


def accumulated_lamps(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A soft shadow: four shadow maps of an area light, averaged in the accumulation buffer."""
    side, samples = 256, 4
    shape = sphere(0.9, 40, 20)
    texture, buffer = depth_texture(gl, side), gl.glGenFramebuffers(1)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, buffer)
    gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_DEPTH_ATTACHMENT, gl.GL_TEXTURE_2D, texture, 0)
    gl.glDrawBuffer(gl.GL_NONE)
    gl.glReadBuffer(gl.GL_NONE)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)

    def scene() -> None:
        gl.glColor3f(0.9, 0.9, 0.6)
        draw(gl, shape)
        gl.glColor3f(0.7, 0.7, 0.7)
        floor(gl, 4.0, -1.2)
        gl.glPushMatrix()
        gl.glTranslatef(1.4, -0.6, 0.6)
        gl.glScalef(0.4, 0.6, 0.4)
        box(gl)
        gl.glPopMatrix()

    def frame(number: int) -> None:
        for sample in range(samples):
            angle = 2 * math.pi * sample / samples + 0.1 * number
            lamp = (2.5 + 0.3 * math.cos(angle), 5.0, 2.0 + 0.3 * math.sin(angle))
            gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, buffer)
            look_from_lamp(gl, lamp, side)
            gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
            scene()
            gl.glDisable(gl.GL_POLYGON_OFFSET_FILL)
            gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
            look(gl, size, (3.5, 3.0, 5.0))
            clear(gl)
            light(gl, (*lamp, 1.0))
            project_from(gl, lamp)
            scene()
            gl.glAccum(gl.GL_ACCUM if sample else gl.GL_LOAD, 1.0 / samples)
        gl.glAccum(gl.GL_RETURN, 1.0)

    return frame


def slide_projector(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
    """A picture projected onto hills with generated coordinates, modulated with the light."""
    mesh = terrain(60, 8.0)
    upload(gl, checkers(128), gl.GL_LINEAR, gl.GL_CLAMP_TO_EDGE)

    def frame(number: int) -> None:
        look(gl, size, (4.0, 4.0, 6.0))
        clear(gl)
        light(gl)
        project_from(gl, (2.0 * math.cos(0.1 * number), 6.0, 2.0 * math.sin(0.1 * number)))
        gl.glColor3f(1.0, 1.0, 1.0)
        draw(gl, mesh)

    return frame


PROGRAMS = tuple(map(program, (map_in_framebuffer, map_copied, accumulated_lamps, slide_projector)))
