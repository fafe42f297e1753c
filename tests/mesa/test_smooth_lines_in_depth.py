"""Smooth lines of any length, seen in perspective, have the coverage and the depths of Mesa."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa

MODES = ("GL_LINES", "GL_LINE_STRIP", "GL_LINE_LOOP", "GL_TRIANGLES", "GL_POLYGON")


def random_lines(seed: int) -> Callable[[Any], None]:
    """Return a program that draws a few lines, many of them shorter than a pixel, or the edges of polygons."""
    rng = np.random.default_rng(seed)
    center = np.array([rng.uniform(-6, 6), rng.uniform(-4, 4), -40])
    positions = np.float32(center + rng.normal(0, rng.choice([6, 1, 0.2]), (rng.integers(2, 7), 3)))
    colors = rng.random((len(positions), 4)).astype(np.float32)
    mode, width = str(rng.choice(MODES)), float(rng.choice([1, 1.5, 3, 6.3]))
    blended, stippled, flat, in_list, clipped = (rng.random(5) < 0.3).tolist()

    def program(gl: Any) -> None:
        for capability in (gl.GL_DEPTH_TEST, gl.GL_LINE_SMOOTH):
            gl.glEnable(capability)
        gl.glLineWidth(width)
        if blended:
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE)
        if stippled:
            gl.glEnable(gl.GL_LINE_STIPPLE)
            gl.glLineStipple(2, 0x5F37)
        gl.glShadeModel(gl.GL_FLAT if flat else gl.GL_SMOOTH)
        gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_LINE)
        gl.glMatrixMode(gl.GL_PROJECTION)
        gl.glFrustum(-1, 1, -0.75, 0.75, 5, 60)
        gl.glMatrixMode(gl.GL_MODELVIEW)
        if clipped:  # by the near plane
            gl.glTranslatef(4, 2, 33)
        if in_list:
            gl.glNewList(1, gl.GL_COMPILE)
        gl.glBegin(getattr(gl, mode))
        for position, color in zip(positions.tolist(), colors.tolist(), strict=True):
            gl.glColor4f(*color)
            gl.glVertex3f(*position)
        gl.glEnd()
        if in_list:
            gl.glEndList()
            gl.glCallList(1)

    return program


def check(seeds: range) -> None:
    for seed in seeds:
        compared = compare(random_lines(seed), (160, 120))
        assert compared, f"seed {seed}: {compared}"


def test_smooth_lines_in_perspective_are_those_of_mesa() -> None:
    check(range(60))


@pytest.mark.slow
def test_thousands_of_smooth_lines_are_those_of_mesa() -> None:
    check(range(60, 3000))
