"""Programs in the style of textbooks and demos draw the same as on Mesa."""

import functools
from typing import Any

import numpy as np
import pytest

from gl.pasted_programs import PASTED
from softshadow.testing import compare

SIZE = (96, 72)


@pytest.mark.mesa
@pytest.mark.parametrize("name", PASTED)
def test_pasted_program_draws_as_on_mesa(name):
    comparison = compare(functools.partial(PASTED[name], size=SIZE), SIZE)
    assert comparison.differences == ()
    assert len(np.unique(comparison.ours.color.reshape(-1, 4), axis=0)) >= 3


def signed_sums(gl: Any) -> None:
    """Every byte of a texture plus a byte of the colour minus one half: all of them lie half way between two bytes."""
    texels = np.zeros((1, 256, 4), np.uint8)
    texels[0] = np.arange(256)[:, None]
    gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, 256, 1, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MAG_FILTER, gl.GL_NEAREST)
    gl.glEnable(gl.GL_TEXTURE_2D)
    gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_COMBINE)
    for name in (gl.GL_COMBINE_RGB, gl.GL_COMBINE_ALPHA):
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, name, gl.GL_ADD_SIGNED)
    operands = (gl.GL_SRC_COLOR, gl.GL_ONE_MINUS_SRC_COLOR)
    for row in range(16):
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_OPERAND0_RGB, operands[row & 1])
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_OPERAND1_RGB, operands[row >> 1 & 1])
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_SOURCE0_RGB, (gl.GL_TEXTURE, gl.GL_PREVIOUS)[row >> 2 & 1])
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_SOURCE1_RGB, (gl.GL_PREVIOUS, gl.GL_TEXTURE)[row >> 2 & 1])
        gl.glColor4ub(3 + 16 * row, 140 + 5 * row, 255 - row, 7 * row)
        gl.glBegin(gl.GL_QUADS)
        for x, y in ((0, row), (1, row), (1, row + 1), (0, row + 1)):
            gl.glTexCoord2f(x, 0.5)
            gl.glVertex2f(2 * x - 1, y / 8 - 1)
        gl.glEnd()


@pytest.mark.mesa
def test_signed_sums_of_bytes_are_rounded_as_on_mesa():
    assert compare(signed_sums, (256, 16)).differences == ()
