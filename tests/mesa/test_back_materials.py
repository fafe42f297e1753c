"""Back materials that change from vertex to vertex give Mesa's colours, under all kinds of lights.

What Mesa computes from registers that were never written depends on its compiler ("unwritten registers" in
known_differences.py). Only the programs with plain lights (directional, without highlights) read such registers.
"""

from typing import Any

import numpy as np
import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa

SIZE = (24, 20)
FACES = ("GL_BACK", "GL_BACK", "GL_FRONT", "GL_FRONT_AND_BACK")
COLORS = ("GL_AMBIENT", "GL_DIFFUSE", "GL_SPECULAR", "GL_EMISSION", "GL_AMBIENT_AND_DIFFUSE")


def set_light(gl: Any, rng: np.random.Generator, light: int, plain: bool) -> None:
    gl.glEnable(light)
    for name in ("GL_AMBIENT", "GL_DIFFUSE", "GL_SPECULAR"):
        gl.glLightfv(light, getattr(gl, name), (*(rng.integers(0, 5, 3) / 4).tolist(), 1.0))
    place = rng.integers(-3, 4, 3).tolist()
    if plain or rng.random() < 0.4:
        gl.glLightfv(light, gl.GL_POSITION, (*place[:2], 2.0 * float(rng.choice([-1, 1])), 0.0))
        return
    gl.glLightfv(light, gl.GL_POSITION, (*place[:2], 3.0 * float(rng.choice([-1, 1])), 1.0))
    if rng.random() < 0.4:
        gl.glLightf(light, gl.GL_LINEAR_ATTENUATION, 0.25)
    if rng.random() < 0.4:
        gl.glLightf(light, gl.GL_SPOT_CUTOFF, 60.0)
        gl.glLightf(light, gl.GL_SPOT_EXPONENT, float(rng.choice([0, 2])))


def program_of(seed: int, plain: bool):
    """Return a program with plain lights and materials of any face, or with any lights and materials of both faces."""
    faces = FACES if plain else FACES[3:]

    def program(gl: Any) -> None:
        rng = np.random.default_rng(seed)
        gl.glEnable(gl.GL_LIGHTING)
        gl.glLightModeli(gl.GL_LIGHT_MODEL_TWO_SIDE, 1)
        gl.glLightModeli(gl.GL_LIGHT_MODEL_LOCAL_VIEWER, int(rng.random() < 0.3))
        if not plain and rng.random() < 0.3:
            gl.glLightModeli(gl.GL_LIGHT_MODEL_COLOR_CONTROL, gl.GL_SEPARATE_SPECULAR_COLOR)
        if rng.random() < 0.3:
            gl.glEnable(gl.GL_NORMALIZE)
        for number in range(int(rng.integers(0, 4))):
            set_light(gl, rng, gl.GL_LIGHT0 + number, plain)
        if not plain and rng.random() < 0.4:
            gl.glMaterialf(getattr(gl, str(rng.choice(faces))), gl.GL_SHININESS, float(rng.choice([1, 2, 8])))
        if rng.random() < 0.6:
            gl.glEnable(gl.GL_COLOR_MATERIAL)
            gl.glColorMaterial(getattr(gl, str(rng.choice(faces))), getattr(gl, str(rng.choice(COLORS))))
        given = [(str(rng.choice(faces)), str(rng.choice(COLORS))) for _ in range(int(rng.integers(0, 3)))]
        inside, colored = rng.random() < 0.7, rng.random() < 0.7
        gl.glClear(gl.GL_COLOR_BUFFER_BIT)
        gl.glBegin(gl.GL_TRIANGLES)
        for x, y, z in rng.uniform(-1, 1, (12, 3)).tolist():
            if colored:
                gl.glColor4f(*(rng.integers(0, 256, 4) / 255).tolist())
            for face, parameter in given if inside else ():
                color = (*(rng.integers(0, 5, 3) / 4).tolist(), 1.0)
                gl.glMaterialfv(getattr(gl, face), getattr(gl, parameter), color)
            gl.glVertex3f(x, y, z)
        gl.glEnd()

    return program


@pytest.mark.parametrize("plain", [True, False])
@pytest.mark.parametrize("first", range(0, 20, 10))
def test_back_materials_that_vary_give_the_colours_of_mesa(first, plain):
    for seed in range(first, first + 10):
        comparison = compare(program_of(seed, plain), SIZE)
        assert comparison, f"seed {seed}: {comparison}"


@pytest.mark.parametrize("follows", [True, False])
def test_a_light_in_the_place_of_a_vertex_makes_its_back_white_like_its_front(follows):
    """The distance is 0 there, and its attenuation not a number; no register is read that was never written."""

    def program(gl: Any) -> None:
        for capability in (gl.GL_LIGHTING, gl.GL_LIGHT0):
            gl.glEnable(capability)
        if follows:
            gl.glEnable(gl.GL_COLOR_MATERIAL)
        gl.glLightModeli(gl.GL_LIGHT_MODEL_TWO_SIDE, 1)
        gl.glLightfv(gl.GL_LIGHT0, gl.GL_POSITION, (0.0, 0.0, 0.0, 1.0))
        gl.glLightf(gl.GL_LIGHT0, gl.GL_QUADRATIC_ATTENUATION, 0.5)
        gl.glShadeModel(gl.GL_FLAT)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT)
        for side in (-1, 1):
            gl.glBegin(gl.GL_TRIANGLES)
            for x, y in ((side, -1), (side, 1), (0, 0)):
                color = 0.5, 0.25 * x + 0.5, 0.75, 1.0
                gl.glColor4f(*color)
                if not follows:
                    gl.glMaterialfv(gl.GL_FRONT_AND_BACK, gl.GL_DIFFUSE, color)
                gl.glVertex2f(x, y)
            gl.glEnd()

    comparison = compare(program, SIZE)
    assert comparison, str(comparison)
