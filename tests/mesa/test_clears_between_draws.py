"""Clears among small draws leave Mesa's buffers: in scissor boxes, with masks, of some planes, and of textures."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from softshadow.testing import compare

SIZE = (40, 30)


def program_of(seed: int) -> Callable[[Any], list[int]]:
    """Return a program of small draws, clears of random planes and occlusion queries; it returns the counts."""

    def program(gl: Any) -> list[int]:
        rng = np.random.default_rng(seed)
        planes = gl.GL_COLOR_BUFFER_BIT, gl.GL_DEPTH_BUFFER_BIT, gl.GL_STENCIL_BUFFER_BIT
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glStencilOp(gl.GL_INCR_WRAP, gl.GL_DECR_WRAP, gl.GL_INVERT)
        queries = gl.glGenQueries(3).tolist()
        for n in range(30):
            if n % 10 == 0:
                gl.glBeginQuery(gl.GL_SAMPLES_PASSED, queries[n // 10])
            if rng.random() < 0.4:
                (gl.glEnable if rng.random() < 0.6 else gl.glDisable)(gl.GL_SCISSOR_TEST)
                gl.glScissor(*rng.integers(0, 15, 2).tolist(), *rng.integers(5, 25, 2).tolist())
            if rng.random() < 0.5:
                gl.glClearColor(*rng.random(4).tolist())
                gl.glClearDepth(float(rng.uniform(0.3, 1)))
                gl.glClearStencil(int(rng.integers(0, 256)))
                gl.glClear(sum(plane for plane in planes if rng.random() < 0.5))
            if rng.random() < 0.2:
                gl.glStencilMask(int(rng.integers(0, 256)))
                gl.glColorMask(*rng.integers(0, 2, 4).tolist())
                gl.glDepthMask(int(rng.integers(0, 2)))
            gl.glStencilFunc(gl.GL_LESS, int(rng.integers(0, 256)), 255)
            gl.glBegin(int(rng.choice([gl.GL_TRIANGLES, gl.GL_TRIANGLE_STRIP, gl.GL_LINES])))
            for _ in range(6):
                gl.glColor4f(*rng.random(4).tolist())
                gl.glVertex3f(*rng.uniform(-1, 1, 3).tolist())
            gl.glEnd()
            if n % 10 == 7:
                gl.glEndQuery(gl.GL_SAMPLES_PASSED)
        return [int(gl.glGetQueryObjectuiv(query, gl.GL_QUERY_RESULT)) for query in queries]

    return program


@pytest.mark.mesa
@pytest.mark.parametrize("seed", range(12))
def test_buffers_and_counts_are_those_of_mesa(seed):
    comparison = compare(program_of(seed), SIZE)
    assert comparison, str(comparison)


def framebuffer(gl: Any) -> tuple[int, int]:
    """Return a texture of 16 x 16 pixels and the framebuffer that draws to it."""
    texture, name = int(gl.glGenTextures(1)), int(gl.glGenFramebuffers(1))
    gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, 16, 16, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, None)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_LINEAR)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, name)
    gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, texture, 0)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT)
    return texture, name


def textured_program_of(seed: int) -> Callable[[Any], None]:
    """Return a program that clears and draws to textures, and draws with them to the window, in random order."""

    def program(gl: Any) -> None:
        rng = np.random.default_rng(seed)
        targets = [framebuffer(gl) for _ in range(3)]
        for _ in range(40):
            texture, name = targets[int(rng.integers(3))]
            draws_to_texture = rng.random() < 0.6
            gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, name if draws_to_texture else 0)
            gl.glViewport(0, 0, *((16, 16) if draws_to_texture else SIZE))
            if draws_to_texture and rng.random() < 0.6:
                gl.glClearColor(*rng.random(4).tolist())
                gl.glClear(gl.GL_COLOR_BUFFER_BIT)
            (gl.glDisable if draws_to_texture else gl.glEnable)(gl.GL_TEXTURE_2D)
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0 if draws_to_texture else texture)
            gl.glBegin(gl.GL_TRIANGLES)
            for _ in range(3):
                gl.glColor4f(*rng.random(4).tolist())
                gl.glTexCoord2f(*rng.random(2).tolist())
                gl.glVertex2f(*rng.uniform(-1, 1, 2).tolist())
            gl.glEnd()
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)

    return program


@pytest.mark.mesa
@pytest.mark.parametrize("seed", range(8))
def test_textures_that_are_cleared_and_drawn_to_are_those_of_mesa(seed):
    comparison = compare(textured_program_of(seed), SIZE)
    assert comparison, str(comparison)
