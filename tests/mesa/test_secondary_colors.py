"""Secondary colours and fog coordinates where Mesa has rules of its own: lighting, pops, raster positions, pixels."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa
SIZE = (24, 16)
CORNERS = ((-1, -1), (1, -1), (0, 1))


def triangle(gl: Any) -> None:
    gl.glBegin(gl.GL_TRIANGLES)
    for number, (x, y) in enumerate(CORNERS):
        gl.glSecondaryColor3f(0.3 * number, 0.2, 0.9 - 0.3 * number)
        gl.glFogCoordf(0.9 - 0.9 * number)
        gl.glNormal3f(0.3 * x, 0.3 * y, 1)
        gl.glVertex2f(x, y)
    gl.glEnd()


def fogged_by_coordinates_without_their_sign(gl: Any) -> None:
    gl.glEnable(gl.GL_FOG)
    gl.glFogi(gl.GL_FOG_COORD_SRC, gl.GL_FOG_COORD)
    gl.glFogi(gl.GL_FOG_MODE, gl.GL_LINEAR)
    gl.glFogfv(gl.GL_FOG_COLOR, [1, 0, 0, 1])
    triangle(gl)


def summed_without_lighting(gl: Any) -> None:
    gl.glEnable(gl.GL_COLOR_SUM)
    gl.glColor3f(0.2, 0.1, 0.05)
    for model in (gl.GL_SMOOTH, gl.GL_FLAT):
        gl.glShadeModel(model)
        triangle(gl)
        gl.glTranslatef(0.5, 0, 0)


def summed_with_lighting(gl: Any) -> None:
    """With one colour nothing is added; the separate specular colour is added whatever GL_COLOR_SUM says."""
    for capability in (gl.GL_COLOR_SUM, gl.GL_LIGHTING, gl.GL_LIGHT0):
        gl.glEnable(capability)
    gl.glMaterialfv(gl.GL_FRONT_AND_BACK, gl.GL_SPECULAR, [0.5, 0.4, 0.3, 1])
    triangle(gl)
    gl.glLightModeli(gl.GL_LIGHT_MODEL_COLOR_CONTROL, gl.GL_SEPARATE_SPECULAR_COLOR)
    gl.glTranslatef(0.5, 0, 0)
    triangle(gl)


def popped(gl: Any) -> list[float]:
    """Mesa restores current values, but neither GL_COLOR_SUM nor GL_FOG_COORD_SRC."""
    gl.glPushAttrib(gl.GL_FOG_BIT | gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT)
    gl.glEnable(gl.GL_COLOR_SUM)
    gl.glFogi(gl.GL_FOG_COORD_SRC, gl.GL_FOG_COORD)
    gl.glSecondaryColor3ub(20, 30, 200)
    gl.glFogCoordd(3)
    triangle(gl)
    gl.glPopAttrib()
    triangle(gl)
    tokens = gl.GL_COLOR_SUM, gl.GL_FOG_COORD_SRC, gl.GL_CURRENT_FOG_COORD
    return [float(gl.glGetFloatv(token)) for token in tokens] + answers(gl)


def answers(gl: Any) -> list[float]:
    tokens = gl.GL_CURRENT_SECONDARY_COLOR, gl.GL_CURRENT_RASTER_SECONDARY_COLOR, gl.GL_CURRENT_RASTER_COLOR
    return [float(number) for token in tokens for number in gl.glGetFloatv(token)]


def raster_positions(gl: Any) -> list[float]:
    told = []
    gl.glFogi(gl.GL_FOG_COORD_SRC, gl.GL_FOG_COORD)
    gl.glEnable(gl.GL_COLOR_SUM)
    gl.glEnable(gl.GL_FOG)
    gl.glSecondaryColor3f(0.2, 1.3, -0.1)
    gl.glFogCoordf(0.7)
    pixels = np.full((4, 4, 4), 100, np.uint8)
    for lit in (False, True):
        (gl.glEnable if lit else gl.glDisable)(gl.GL_LIGHTING)
        gl.glEnable(gl.GL_LIGHT0)
        gl.glMaterialfv(gl.GL_FRONT_AND_BACK, gl.GL_SPECULAR, [0.5, 0.4, 0.3, 1])
        gl.glLightModeli(gl.GL_LIGHT_MODEL_COLOR_CONTROL, gl.GL_SEPARATE_SPECULAR_COLOR)
        for place in (gl.glRasterPos2f, gl.glWindowPos2f):
            place(0.25, 0.5)
            told += [float(gl.glGetFloatv(gl.GL_CURRENT_RASTER_DISTANCE)), *answers(gl)]
            gl.glDrawPixels(4, 4, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, pixels)
            gl.glBitmap(8, 2, -5, 0, 0, 0, bytes([255] * 8))
    return told


PROGRAMS = [
    fogged_by_coordinates_without_their_sign, summed_without_lighting, summed_with_lighting, popped, raster_positions,
]  # fmt: skip


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda program: program.__name__)
def test_programs_with_added_colours_are_those_of_mesa(program: Callable[[Any], Any]) -> None:
    compared = compare(program, SIZE)
    assert compared, str(compared)
    assert compared.ours.color.any()
