"""Textures that are made, loaded, changed and deleted among small draws leave Mesa's buffers."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from softshadow.testing import compare

SIZE = (40, 30)


def change_texture(gl: Any, rng: np.random.Generator) -> None:
    """Load the bound texture or a part of it, make its mipmaps, or set a filter or a wrap mode."""
    what, side = int(rng.integers(6)), int(rng.choice([4, 8]))
    image = rng.integers(0, 256, (side, side, 4), dtype=np.uint8)
    if what < 2:
        for level in range(3 if what else 1):  # with one level, most filters make it incomplete
            part, smaller = np.ascontiguousarray(image[:: 1 << level, :: 1 << level]), side >> level
            gl.glTexImage2D(
                gl.GL_TEXTURE_2D, level, gl.GL_RGBA, smaller, smaller, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, part
            )
    elif what == 2:
        if gl.glGetTexLevelParameteriv(gl.GL_TEXTURE_2D, 0, gl.GL_TEXTURE_WIDTH) >= 4:
            part = np.ascontiguousarray(image[:3, :3])
            gl.glTexSubImage2D(gl.GL_TEXTURE_2D, 0, 1, 1, 3, 3, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, part)
    elif what == 3:
        if gl.glGetTexLevelParameteriv(gl.GL_TEXTURE_2D, 0, gl.GL_TEXTURE_WIDTH):
            gl.glGenerateMipmap(gl.GL_TEXTURE_2D)
    else:
        name, values = [
            (gl.GL_TEXTURE_MIN_FILTER, (gl.GL_NEAREST, gl.GL_LINEAR, gl.GL_NEAREST_MIPMAP_NEAREST)),
            (gl.GL_TEXTURE_WRAP_S, (gl.GL_REPEAT, gl.GL_CLAMP_TO_EDGE, gl.GL_MIRRORED_REPEAT)),
        ][what - 4]
        gl.glTexParameteri(gl.GL_TEXTURE_2D, name, int(rng.choice(values)))


def draw_triangle(gl: Any, rng: np.random.Generator) -> None:
    """Draw a random triangle with texture coordinates."""
    gl.glBegin(gl.GL_TRIANGLES)
    for _ in range(3):
        gl.glColor4f(*rng.random(4).tolist())
        gl.glTexCoord2f(*rng.uniform(-1, 2, 2).tolist())
        gl.glVertex2f(*rng.uniform(-1, 1, 2).tolist())
    gl.glEnd()


def program_of(seed: int) -> Callable[[Any], None]:
    """Return a program of small textured draws to the window, between which textures change."""

    def program(gl: Any) -> None:
        rng = np.random.default_rng(seed)
        names = gl.glGenTextures(4).tolist()
        gl.glEnable(gl.GL_TEXTURE_2D)
        for _ in range(80):
            if rng.random() < 0.6:
                gl.glBindTexture(gl.GL_TEXTURE_2D, int(rng.choice([0, *names])))
            if rng.random() < 0.6:
                change_texture(gl, rng)
            if rng.random() < 0.1:
                (gl.glEnable if rng.random() < 0.7 else gl.glDisable)(gl.GL_TEXTURE_2D)
            if rng.random() < 0.05:
                gl.glDeleteTextures([int(rng.choice(names))])
            draw_triangle(gl, rng)

    return program


def program_with_framebuffers(seed: int) -> Callable[[Any], None]:
    """Return a program that draws to textures and to the window in turns; textures change, and others are attached."""

    def program(gl: Any) -> None:
        rng = np.random.default_rng(seed)
        names, targets, attached = gl.glGenTextures(5).tolist(), gl.glGenFramebuffers(2).tolist(), {}
        gl.glEnable(gl.GL_TEXTURE_2D)
        for name in names:
            gl.glBindTexture(gl.GL_TEXTURE_2D, name)
            gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
            gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, 8, 8, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, bytes(256))

        def attach(target: int) -> None:
            attached[target] = int(rng.choice(names))
            gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, attached[target], 0)

        for _ in range(80):
            target = int(rng.choice([0, *targets]))
            gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, target)
            if target and (target not in attached or rng.random() < 0.2):
                attach(target)
            gl.glViewport(0, 0, *(SIZE if target == 0 else (8, 8)))
            unattached = [name for name in names if name != attached.get(target)]
            for name in [*rng.choice(unattached, int(rng.integers(2))), rng.choice(unattached)]:
                gl.glBindTexture(gl.GL_TEXTURE_2D, int(name))
                image = rng.integers(0, 256, (8, 8, 4), dtype=np.uint8)
                if (what := rng.random()) < 0.3:
                    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, 8, 8, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, image)
                elif what < 0.6:
                    part = np.ascontiguousarray(image[:3, :5])
                    gl.glTexSubImage2D(gl.GL_TEXTURE_2D, 0, 2, 1, 5, 3, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, part)
                elif what < 0.7:
                    gl.glCopyTexSubImage2D(gl.GL_TEXTURE_2D, 0, 1, 1, 0, 0, 4, 4)
            draw_triangle(gl, rng)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
        gl.glViewport(0, 0, *SIZE)
        for n, name in enumerate(names):  # so that the texels are compared, too
            gl.glBindTexture(gl.GL_TEXTURE_2D, name)
            gl.glColor3f(1, 1, 1)
            gl.glBegin(gl.GL_QUADS)
            for u, v in ((0, 0), (1, 0), (1, 1), (0, 1)):
                gl.glTexCoord2f(u, v)
                gl.glVertex2f(-1 + 0.4 * (n + u), v - 1)
            gl.glEnd()

    return program


@pytest.mark.mesa
@pytest.mark.parametrize("seed", range(16))
def test_buffers_are_those_of_mesa(seed):
    comparison = compare(program_of(seed), SIZE)
    assert comparison, str(comparison)


@pytest.mark.mesa
@pytest.mark.parametrize("seed", range(16))
def test_buffers_are_those_of_mesa_with_framebuffers(seed):
    comparison = compare(program_with_framebuffers(seed), SIZE)
    assert comparison, str(comparison)
