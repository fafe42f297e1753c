"""Lists whose primitives meet what stands around them give the buffers and names of Mesa."""

import contextlib

import numpy as np
import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa


def strip(gl, rng, count):
    gl.glBegin(gl.GL_TRIANGLE_STRIP)
    for _ in range(count):
        gl.glColor3f(*rng.random(3))
        gl.glVertex2f(*rng.uniform(-1, 1, 2))
    gl.glEnd()


@pytest.mark.parametrize("mode", ["GL_LINE", "GL_POINT", "GL_FILL"])
@pytest.mark.parametrize("counts", [(3, 3), (4, 5, 6), (5, 4, 3), (7, 3, 4), (3, 7, 3, 4), (4, 3, 5, 5)])
def test_consecutive_strips_are_joined(counts, mode):
    def program(gl):
        rng = np.random.default_rng(len(counts))
        gl.glPolygonMode(gl.GL_FRONT_AND_BACK, getattr(gl, mode))
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_ONE, gl.GL_ONE)
        gl.glNewList(1, gl.GL_COMPILE)
        for count in counts:
            strip(gl, rng, count)
        gl.glEndList()
        gl.glCallList(1)
        gl.glEnable(gl.GL_CULL_FACE)
        gl.glCallList(1)

    comparison = compare(program, (33, 20))
    assert comparison, str(comparison)


def test_strips_with_an_attribute_call_between():
    def program(gl):
        rng = np.random.default_rng(1)
        gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_LINE)
        gl.glNewList(1, gl.GL_COMPILE)
        strip(gl, rng, 4)
        gl.glColor3f(1, 0, 0)
        strip(gl, rng, 5)
        gl.glNormal3f(0, 0, 1)
        strip(gl, rng, 4)
        gl.glEndList()
        gl.glCallList(1)

    comparison = compare(program, (33, 20))
    assert comparison, str(comparison)


def test_a_primitive_of_a_list_called_inside_a_primitive_is_left_out():
    def program(gl):
        gl.glNewList(1, gl.GL_COMPILE)
        gl.glBegin(gl.GL_TRIANGLES)
        gl.glColor3f(1, 0, 0)
        for vertex in ((-1, -1), (1, -1), (0, 1)):
            gl.glVertex2f(*vertex)
        gl.glEnd()
        gl.glEndList()
        gl.glColor3f(0, 1, 0)
        gl.glBegin(gl.GL_QUADS)
        gl.glVertex2f(-1, -1)
        gl.glVertex2f(0.5, -1)
        with contextlib.suppress(Exception):  # the error, which PyOpenGL raises at glEnd only
            gl.glCallList(1)
        gl.glVertex2f(0.5, 1)
        gl.glVertex2f(-1, 1)
        with contextlib.suppress(Exception):
            gl.glEnd()

    comparison = compare(program, (33, 20))
    assert comparison, str(comparison)


def test_names_of_lists_are_never_used_twice():
    def program(gl):
        names = [gl.glGenLists(3)]
        gl.glDeleteLists(names[0], 2)
        names += [gl.glGenLists(1), gl.glGenLists(3)]
        gl.glNewList(20, gl.GL_COMPILE)
        gl.glEndList()
        gl.glDeleteLists(20, 1)
        names.append(gl.glGenLists(2))
        gl.glNewList(2**32 - 3, gl.GL_COMPILE)
        gl.glEndList()
        names += [gl.glGenLists(2), gl.glGenLists(2)]
        return [int(name) for name in names]

    comparison = compare(program, (4, 4))
    assert comparison, str(comparison)


def test_enable_accepts_the_arrays_of_client_memory():
    def program(gl):
        gl.glEnable(gl.GL_VERTEX_ARRAY)
        gl.glVertexPointer(2, gl.GL_FLOAT, 0, np.array([[-1, -1], [1, -1], [0, 1]], np.float32))
        gl.glDrawArrays(gl.GL_TRIANGLES, 0, 3)
        enabled = [bool(gl.glIsEnabled(gl.GL_VERTEX_ARRAY)), bool(gl.glIsEnabled(gl.GL_TEXTURE_COORD_ARRAY))]
        gl.glDisable(gl.GL_VERTEX_ARRAY)
        gl.glDisableClientState(gl.GL_EDGE_FLAG_ARRAY)
        gl.glDisableClientState(gl.GL_INDEX_ARRAY)
        return [*enabled, bool(gl.glIsEnabled(gl.GL_VERTEX_ARRAY))]

    comparison = compare(program, (33, 20))
    assert comparison, str(comparison)


@pytest.mark.parametrize("lit", [False, True])
@pytest.mark.parametrize(
    "mode", ["GL_POLYGON", "GL_QUADS", "GL_TRIANGLES", "GL_TRIANGLE_FAN", "GL_QUAD_STRIP", "GL_LINE_LOOP"]
)
def test_a_model_that_sets_the_material_of_each_face(mode, lit):
    """Its faces are one draw, and materials that are set again are left out."""

    def program(gl):
        rng = np.random.default_rng(3)
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glEnable(gl.GL_LIGHT0)
        (gl.glEnable if lit else gl.glDisable)(gl.GL_LIGHTING)
        gl.glNewList(1, gl.GL_COMPILE)
        for face in range(80):
            gl.glColor3f(0.5, 0.25, face // 30 / 2)
            gl.glBegin(getattr(gl, mode))
            corner = rng.uniform(-1.1, 1.1, 3)
            for _ in range(3 if mode == "GL_TRIANGLES" else 4):
                gl.glNormal3f(*rng.normal(size=3))
                gl.glVertex3f(*(corner + rng.uniform(-0.4, 0.4, 3)))
            gl.glEnd()
        gl.glEndList()
        for switch in (gl.GL_COLOR_MATERIAL, gl.GL_CULL_FACE):
            gl.glCallList(1)
            gl.glEnable(switch)
            gl.glMaterialfv(gl.GL_FRONT, gl.GL_DIFFUSE, (0.1, 0.9, 0.3, 1.0))
            gl.glRotatef(20.0, 1.0, 1.0, 0.0)
        gl.glCallList(1)

    comparison = compare(program, (33, 20))
    assert comparison, str(comparison)
