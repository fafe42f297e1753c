"""Small draws to framebuffer objects, whose attachments change among them, are those of Mesa."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from softshadow import gl as own_gl
from softshadow.gl import GLError
from softshadow.testing import compare

SIZE, SIDE = (40, 30), 24
BOX, TEXTURES = 7, 3


def program_of(seed: int) -> Callable[[Any], list[np.ndarray]]:
    """Return a program of small draws to the window and to textures in turns; it returns the textures."""

    def program(gl: Any) -> list[np.ndarray]:
        rng = np.random.default_rng(seed)
        quadric, textures = gl.gluNewQuadric(), [texture_of(gl) for _ in range(TEXTURES)]
        framebuffer, depths = int(gl.glGenFramebuffers(1)), int(gl.glGenRenderbuffers(1))
        gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, depths)
        gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, gl.GL_DEPTH_COMPONENT24, SIDE, SIDE)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, framebuffer)
        gl.glFramebufferRenderbuffer(gl.GL_FRAMEBUFFER, gl.GL_DEPTH_ATTACHMENT, gl.GL_RENDERBUFFER, depths)
        for texture in textures:
            attach(gl, texture)
            gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
        gl.glNewList(BOX, gl.GL_COMPILE)
        polygons(gl, rng, gl.GL_QUADS)
        gl.glEndList()
        gl.glEnable(gl.GL_DEPTH_TEST)
        shown = textures[0]
        for _ in range(8):
            in_window = rng.random() < 0.3
            gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0 if in_window else framebuffer)
            gl.glViewport(0, 0, *(SIZE if in_window else (SIDE, SIDE)))
            if not in_window:
                drawn, shown = rng.permutation(textures)[:2].tolist()
                attach(gl, drawn)
                gl.glDrawBuffer(gl.GL_COLOR_ATTACHMENT0)
            if rng.random() < 0.5:
                gl.glClearColor(*rng.random(4).tolist())
                gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
            gl.glBindTexture(gl.GL_TEXTURE_2D, shown)
            (gl.glEnable if rng.random() < 0.4 else gl.glDisable)(gl.GL_TEXTURE_2D)
            (gl.glEnable if rng.random() < 0.4 else gl.glDisable)(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_ONE, gl.GL_ONE)
            for _ in range(5):
                draw(gl, rng, quadric)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
        return [texels_of(gl, texture) for texture in textures]

    return program


def texture_of(gl: Any) -> int:
    """Return a texture of colours."""
    texture, form = int(gl.glGenTextures(1)), (gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)
    gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, SIDE, SIDE, 0, *form, None)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_LINEAR)
    return texture


def attach(gl: Any, texture: int) -> None:
    """Let the bound framebuffer draw colours to a texture."""
    gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, texture, 0)


def texels_of(gl: Any, texture: int) -> np.ndarray:
    """Return the texels of a texture."""
    gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
    return np.asarray(gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)).copy()


def draw(gl: Any, rng: np.random.Generator, quadric: Any) -> None:
    """Draw a rectangle, a pair, a list or a sphere, under a matrix of its own."""
    gl.glPushMatrix()
    gl.glTranslatef(*rng.uniform(-0.8, 0.8, 3).tolist())
    gl.glScalef(0.4, 0.4, 0.4)
    gl.glColor4f(*rng.random(4).tolist())
    match rng.integers(4):
        case 0:
            gl.glRectf(-1, -1, 1, 1)
        case 1:
            polygons(gl, rng, int(rng.choice([gl.GL_QUADS, gl.GL_TRIANGLE_STRIP, gl.GL_LINE_LOOP])))
        case 2:
            gl.glCallList(BOX)
        case 3:
            gl.gluSphere(quadric, 1.0, 6, 4)
    gl.glPopMatrix()


def polygons(gl: Any, rng: np.random.Generator, mode: int) -> None:
    """Draw eight vertices as one pair."""
    gl.glBegin(mode)
    for corner in rng.uniform(-1, 1, (8, 3)).tolist():
        gl.glTexCoord2f(*corner[:2])
        gl.glVertex3f(*corner)
    gl.glEnd()


@pytest.mark.mesa
@pytest.mark.parametrize("seed", range(16))
def test_textures_and_window_are_those_of_mesa(seed):
    comparison = compare(program_of(seed), SIZE)
    assert comparison, str(comparison)


def test_a_framebuffer_that_becomes_incomplete_refuses_small_draws():
    """Two textures of one shape: depth from one, stencil from the other is what drivers do not support."""
    own_gl.create_context(*SIZE)
    form = own_gl.GL_DEPTH_STENCIL, own_gl.GL_UNSIGNED_INT_24_8
    own_gl.glBindFramebuffer(own_gl.GL_FRAMEBUFFER, own_gl.glGenFramebuffers(1))
    points = own_gl.GL_DEPTH_ATTACHMENT, own_gl.GL_STENCIL_ATTACHMENT
    textures = own_gl.glGenTextures(2).tolist()
    for texture in textures:
        own_gl.glBindTexture(own_gl.GL_TEXTURE_2D, texture)
        own_gl.glTexImage2D(own_gl.GL_TEXTURE_2D, 0, own_gl.GL_DEPTH24_STENCIL8, SIDE, SIDE, 0, *form, None)
    for point in points:
        own_gl.glFramebufferTexture2D(own_gl.GL_FRAMEBUFFER, point, own_gl.GL_TEXTURE_2D, textures[0], 0)
    own_gl.glDrawBuffer(own_gl.GL_NONE)
    own_gl.glRectf(0, 0, 1, 1)
    own_gl.glFramebufferTexture2D(own_gl.GL_FRAMEBUFFER, points[0], own_gl.GL_TEXTURE_2D, textures[1], 0)
    with pytest.raises(GLError, match="not complete"):
        own_gl.glRectf(0, 0, 1, 1)
    own_gl.glFramebufferTexture2D(own_gl.GL_FRAMEBUFFER, points[1], own_gl.GL_TEXTURE_2D, textures[1], 0)
    own_gl.glRectf(0, 0, 1, 1)
