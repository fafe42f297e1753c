"""Smooth lines shorter than a pixel, as clipping and curves of many points make them."""

from math import cos, pi, sin
from typing import Any

import numpy as np
import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa
SIZE = (200, 150)
CELL = 10  # pixels: each line has a cell of its own


@pytest.mark.parametrize("width", [1.0, 2.5])
def test_smooth_lines_shorter_than_a_pixel_have_mesas_alpha(width: float) -> None:
    def program(gl: Any) -> None:
        rng = np.random.default_rng(5)
        gl.glMatrixMode(gl.GL_PROJECTION)
        gl.gluOrtho2D(0, SIZE[0], 0, SIZE[1])
        gl.glEnable(gl.GL_LINE_SMOOTH)
        gl.glLineWidth(width)
        gl.glBegin(gl.GL_LINES)
        for cell_x in range(0, SIZE[0], CELL):
            for cell_y in range(0, SIZE[1], CELL):
                (x, y), angle, length = rng.uniform(3, 7, 2), rng.uniform(0, 2 * pi), rng.uniform(0, 1.2)
                gl.glVertex2f(cell_x + x, cell_y + y)
                gl.glVertex2f(cell_x + x + length * cos(angle), cell_y + y + length * sin(angle))
        gl.glEnd()

    compared = compare(program, SIZE)
    assert compared, str(compared)
    alpha = compared.ours.color[..., 3]
    assert np.count_nonzero((alpha > 0) & (alpha < 255)) > 300
