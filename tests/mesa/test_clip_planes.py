"""User clip planes cut triangles where Mesa cuts them."""

from typing import Any

import numpy as np
import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa

PROJECTIONS = {
    "gluPerspective": (60, 1.3, 0.5, 20),
    "glOrtho": (-2, 2, -2, 2, -3, 3),
    "glFrustum": (-0.5, 0.4, -0.3, 0.6, 0.7, 9),
}


@pytest.mark.parametrize("projection", PROJECTIONS)
@pytest.mark.parametrize("seed", range(5))
def test_triangles_under_user_clip_planes_have_mesas_bits(projection: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    count = int(rng.integers(1, 4))
    planes = rng.permutation(6)[:count].tolist()
    equations = rng.normal(size=(count, 4)).tolist()
    positions, colors = rng.normal(0, 1, (30, 3)).tolist(), rng.random((30, 4)).tolist()

    def program(gl: Any) -> None:
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glMatrixMode(gl.GL_PROJECTION)
        getattr(gl, projection)(*PROJECTIONS[projection])
        gl.glMatrixMode(gl.GL_MODELVIEW)
        gl.glTranslatef(0, 0, -3)
        gl.glRotatef(30, 1, 2, 3)
        for plane, equation in zip(planes, equations, strict=True):
            gl.glClipPlane(gl.GL_CLIP_PLANE0 + plane, equation)
            gl.glEnable(gl.GL_CLIP_PLANE0 + plane)
        gl.glBegin(gl.GL_TRIANGLES)
        for position, color in zip(positions, colors, strict=True):
            gl.glColor4f(*color)
            gl.glVertex3f(*position)
        gl.glEnd()

    compared = compare(program, (64, 48))
    assert not compared.differences, str(compared)
