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
            gl.glBegin(gl.GL_TRIANGLES)
            for _ in range(3):
                gl.glColor4f(*rng.random(4).tolist())
                gl.glTexCoord2f(*rng.uniform(-1, 2, 2).tolist())
                gl.glVertex2f(*rng.uniform(-1, 1, 2).tolist())
            gl.glEnd()

    return program


@pytest.mark.mesa
@pytest.mark.parametrize("seed", range(16))
def test_buffers_are_those_of_mesa(seed):
    comparison = compare(program_of(seed), SIZE)
    assert comparison, str(comparison)
