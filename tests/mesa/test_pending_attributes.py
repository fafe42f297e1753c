"""Attributes that a program sets after some vertices: Mesa resets them before it draws, or makes them current first."""

import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa

CORNERS = ((-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9))
MATERIAL = (1.0, 0.4, 0.95, 0.87)
SETTINGS = {
    "material": lambda gl: gl.glMaterialfv(gl.GL_FRONT_AND_BACK, gl.GL_AMBIENT_AND_DIFFUSE, MATERIAL),
    "one material": lambda gl: gl.glMaterialfv(gl.GL_FRONT, gl.GL_AMBIENT, MATERIAL),
    "colour": lambda gl: gl.glColor4f(0.2, 0.9, 0.4, 0.5),
    "normal": lambda gl: gl.glNormal3f(0.5, 0.5, 0.7),
}
CHANGES = {
    "color material": lambda gl: gl.glEnable(gl.GL_COLOR_MATERIAL),
    "other material": lambda gl: (
        gl.glColorMaterial(gl.GL_FRONT, gl.GL_DIFFUSE), gl.glEnable(gl.GL_COLOR_MATERIAL)
    ),
    "attributes": lambda gl: (gl.glPushAttrib(gl.GL_CURRENT_BIT | gl.GL_LIGHTING_BIT), gl.glPopAttrib()),
    "viewport": lambda gl: gl.glViewport(1, 1, 15, 15),
}  # fmt: skip


@pytest.mark.parametrize("n_vertices", [4, 8, 9, 12])  # with more than 8, Mesa resets what a new attribute follows
@pytest.mark.parametrize("change", CHANGES)
@pytest.mark.parametrize("setting", SETTINGS)
def test_what_is_set_between_vertices_and_a_change_of_state(setting, change, n_vertices):
    def shape(gl, mode, count):
        gl.glBegin(mode)
        for n in range(count):
            gl.glVertex2f(*CORNERS[n % 4])
        gl.glEnd()

    def program(gl):
        gl.glEnable(gl.GL_LIGHTING)
        gl.glEnable(gl.GL_LIGHT0)
        shape(gl, gl.GL_TRIANGLE_FAN, n_vertices)
        SETTINGS[setting](gl)
        CHANGES[change](gl)
        shape(gl, gl.GL_QUADS, 4)
        return [gl.glGetMaterialfv(gl.GL_FRONT, gl.GL_AMBIENT), gl.glGetFloatv(gl.GL_CURRENT_COLOR)]

    comparison = compare(program, (16, 16))
    assert comparison, str(comparison)


@pytest.mark.parametrize("n_vertices", [0, 4])
@pytest.mark.parametrize("query", ["GL_CURRENT_COLOR", "GL_CURRENT_NORMAL", "GL_VIEWPORT"])
def test_a_colour_between_pairs_of_one_mode_is_pending_after_a_query(query, n_vertices):
    def pair(gl, color, count):
        gl.glBegin(gl.GL_QUADS)
        gl.glColor4f(*color)
        for x, y in CORNERS[:count]:
            gl.glVertex2f(x, y)
        gl.glEnd()

    def program(gl):
        gl.glEnable(gl.GL_COLOR_MATERIAL)
        pair(gl, (0.75, 0.5, 0.25, 1), 4)
        pair(gl, (0.5, 0.25, 0.75, 1), 4)
        gl.glGetFloatv(getattr(gl, query))
        pair(gl, (0.25, 0.75, 0.5, 1), n_vertices)
        material = gl.glGetMaterialfv(gl.GL_FRONT, gl.GL_DIFFUSE)
        gl.glPushAttrib(gl.GL_CURRENT_BIT)
        pair(gl, (1, 0, 1, 1), n_vertices)
        gl.glPopAttrib()
        return [material, gl.glGetFloatv(gl.GL_CURRENT_COLOR)]

    comparison = compare(program, (16, 16))
    assert comparison, str(comparison)
