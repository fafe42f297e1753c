"""Pictures that are accumulated, copied to textures and blitted among small draws are those of Mesa."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from softshadow.pipeline import choose
from softshadow.testing import compare

SIZE, SIDE = (40, 30), 16


def program_of(seed: int) -> Callable[[Any], list[np.ndarray]]:
    """Return a program that draws, clears, accumulates, copies and blits in random order; it returns two textures."""

    def program(gl: Any) -> list[np.ndarray]:
        rng = np.random.default_rng(seed)
        shapes = rng.uniform(-1, 1, (4, 6, 3)).astype(np.float32)
        colors, depths = (int(name) for name in gl.glGenTextures(2))
        framebuffer = int(gl.glGenFramebuffers(1))
        define(gl, depths, gl.GL_DEPTH_COMPONENT24, gl.GL_DEPTH_COMPONENT, gl.GL_UNSIGNED_INT)
        define(gl, colors, gl.GL_RGBA8, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, framebuffer)
        gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, colors, 0)
        clear(gl, rng)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
        gl.glClear(gl.GL_ACCUM_BUFFER_BIT)
        gl.glEnable(gl.GL_DEPTH_TEST)
        for _ in range(40):
            draw(gl, rng, shapes[int(rng.integers(4))])
            match rng.integers(12):
                case 0 | 1 | 2:
                    clear(gl, rng)
                case 3 | 4 | 5:
                    operation = rng.choice([gl.GL_LOAD, gl.GL_ACCUM, gl.GL_ACCUM, gl.GL_ADD, gl.GL_MULT, gl.GL_RETURN])
                    gl.glAccum(int(operation), float(rng.uniform(0, 1)))
                case 6 | 7:
                    gl.glBindTexture(gl.GL_TEXTURE_2D, int(rng.choice([colors, depths])))
                    gl.glCopyTexSubImage2D(gl.GL_TEXTURE_2D, 0, 2, 3, *rng.integers(0, 20, 2).tolist(), 13, 11)
                case 8:
                    switch_textures(gl, rng, colors)
                case 9:
                    gl.glBindFramebuffer(gl.GL_READ_FRAMEBUFFER, framebuffer)
                    gl.glBlitFramebuffer(0, 0, 9, 9, 3, 4, 12, 13, gl.GL_COLOR_BUFFER_BIT, gl.GL_NEAREST)
                    gl.glBindFramebuffer(gl.GL_READ_FRAMEBUFFER, 0)
                case 10:
                    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, framebuffer)
                    gl.glDisable(gl.GL_TEXTURE_2D)
                    draw(gl, rng, shapes[0])
                    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
                case 11:
                    gl.glReadBuffer(int(rng.choice([gl.GL_FRONT, gl.GL_NONE, gl.GL_FRONT])))
                    gl.glReadBuffer(gl.GL_FRONT)
        return [texels_of(gl, colors, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE), texels_of(gl, depths, gl.GL_DEPTH_COMPONENT)]

    return program


def define(gl: Any, texture: int, internal_format: int, format: int, type: int) -> None:
    """Define an image of a texture, and leave it bound."""
    gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, internal_format, SIDE, SIDE, 0, format, type, None)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_LINEAR)


def texels_of(gl: Any, texture: int, format: int, type: int | None = None) -> np.ndarray:
    """Return the texels of a texture, by default as floats."""
    gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
    return np.asarray(gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, format, gl.GL_FLOAT if type is None else type)).copy()


def clear(gl: Any, rng: np.random.Generator) -> None:
    """Clear all buffers, or one of them."""
    gl.glClearColor(*rng.random(4).tolist())
    both = gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT
    gl.glClear(int(rng.choice([both, both, gl.GL_DEPTH_BUFFER_BIT])))


def switch_textures(gl: Any, rng: np.random.Generator, texture: int) -> None:
    """Draw with the texture of colours from here on, or without."""
    gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
    (gl.glEnable if rng.random() < 0.6 else gl.glDisable)(gl.GL_TEXTURE_2D)


def draw(gl: Any, rng: np.random.Generator, shape: np.ndarray) -> None:
    """Draw two triangles in random colours, often a little moved."""
    gl.glBindTexture(gl.GL_TEXTURE_2D, int(rng.integers(1, 3)))
    gl.glLoadIdentity()
    if rng.random() < 0.5:
        gl.glTranslatef(*rng.uniform(-0.2, 0.2, 3).tolist())
    gl.glBegin(gl.GL_TRIANGLES)
    for corner in shape:
        gl.glColor4f(*rng.random(4).tolist())
        gl.glTexCoord2f(*corner[:2].tolist())
        gl.glVertex3f(*corner.tolist())
    gl.glEnd()


@pytest.mark.mesa
@pytest.mark.parametrize("fills", [False, True])
@pytest.mark.parametrize("seed", range(12))
def test_buffers_and_textures_are_those_of_mesa(seed, fills, monkeypatch):
    if fills:  # as draws of many fragments are
        monkeypatch.setattr(choose, "FEW_FRAGMENTS", -1)
    comparison = compare(program_of(seed), SIZE)
    assert comparison, str(comparison)
