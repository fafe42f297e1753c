"""Window coordinates halfway between two steps of 1/256 pixel are rounded as on Mesa."""

import random
from typing import Any

import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa

SIZE = (97, 61)
VIEWPORT = (-16, -32, 128, 128)  # a power of two, and not at (0, 0): window coordinates are exact, negative ones too
SIZES = (1, 2, 2.5, 2.501953125, 3, 4, 5.5)


def add_primitives(gl: Any, mode: str, seed: int) -> None:
    """Draw 50 primitives with corners close to pixel edges and centres, on multiples of 1/512 pixel; colours add up."""
    chosen = random.Random(seed)
    gl.glViewport(*VIEWPORT)
    gl.glOrtho(0, VIEWPORT[2], 0, VIEWPORT[3], -1, 1)
    gl.glEnable(gl.GL_BLEND)
    gl.glBlendFunc(gl.GL_ONE, gl.GL_ONE)
    for _ in range(50):
        gl.glPointSize(chosen.choice(SIZES))
        gl.glLineWidth(chosen.choice(SIZES))
        gl.glColor3ub(*(chosen.randrange(1, 40) for _ in range(3)))
        gl.glBegin(getattr(gl, mode))
        for _ in range(6):
            gl.glVertex2f(*(chosen.randrange(256) / 2 + chosen.randrange(-3, 4) / 512 for _ in range(2)))
        gl.glEnd()


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("mode", ["GL_POINTS", "GL_LINES", "GL_TRIANGLES"])
def test_coordinates_halfway_between_two_subpixels_are_rounded_as_on_mesa(mode: str, seed: int) -> None:
    compared = compare(lambda gl: add_primitives(gl, mode, seed), SIZE)
    assert compared.ours.color[..., :3].any()
    assert compared, str(compared)
