"""Draws in display lists, from arrays and between glBegin and glEnd, leave the buffers and current values of Mesa."""

from functools import partial

import numpy as np
import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa

CORNERS = np.array([(-0.9, -0.9), (-0.1, -0.8), (0.0, -0.1), (-0.8, -0.2), (-0.5, 0.9), (0.1, 0.6)], np.float32)
COLORS = np.array([(i & 1, i / 5, 1 - i / 5, 1) for i in range(6)], np.float32)
NORMALS = np.array([(0, 0, 1), (0.6, 0, 0.8), (0, 0.6, 0.8), (1, 0, 0), (0, 1, 0), (0, 0, -1)], np.float32)
INDICES = np.array((0, 2, 1, 3, 1, 2, 1, 5), np.uint32)
MODES = (
    "GL_POINTS", "GL_LINES", "GL_LINE_LOOP", "GL_LINE_STRIP", "GL_TRIANGLES", "GL_TRIANGLE_STRIP", "GL_TRIANGLE_FAN",
    "GL_QUADS", "GL_QUAD_STRIP", "GL_POLYGON",
)  # fmt: skip
ATTRIBUTES = ("GL_CURRENT_COLOR", "GL_CURRENT_NORMAL")


@pytest.mark.thin(3)
@pytest.mark.parametrize("lit", [False, True], ids=["unlit", "lit"])
@pytest.mark.parametrize("arrays", [(), ("color",), ("color", "normal")], ids=["positions", "colors", "normals"])
@pytest.mark.parametrize("call", ["elements", "arrays", "two draws"])
@pytest.mark.parametrize("mode", ["GL_QUADS", "GL_TRIANGLE_STRIP", "GL_LINE_LOOP"])
@pytest.mark.parametrize("how", ["GL_COMPILE", "GL_COMPILE_AND_EXECUTE"])
def test_a_draw_from_arrays_and_the_values_that_it_leaves(how, mode, call, arrays, lit):
    def program(gl):
        gl.glColor3f(0.5, 0.25, 0.75)
        for capability in ("GL_LIGHTING", "GL_LIGHT0", "GL_COLOR_MATERIAL"):
            (gl.glEnable if lit else gl.glDisable)(getattr(gl, capability))
        gl.glNewList(1, getattr(gl, how))
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        gl.glVertexPointer(2, gl.GL_FLOAT, 0, CORNERS)
        if "color" in arrays:
            gl.glEnableClientState(gl.GL_COLOR_ARRAY)
            gl.glColorPointer(4, gl.GL_FLOAT, 0, COLORS)
        if "normal" in arrays:
            gl.glEnableClientState(gl.GL_NORMAL_ARRAY)
            gl.glNormalPointer(gl.GL_FLOAT, 0, NORMALS)
        kind = getattr(gl, mode)
        if call == "elements":
            gl.glDrawElements(kind, len(INDICES), gl.GL_UNSIGNED_INT, INDICES)
        elif call == "arrays":
            gl.glDrawArrays(kind, 1, 4)
        else:
            for part in (INDICES[:4], INDICES[4:]):
                gl.glDrawElements(kind, len(part), gl.GL_UNSIGNED_INT, part)
        gl.glEndList()
        values = [np.asarray(gl.glGetFloatv(getattr(gl, name))) for name in ATTRIBUTES]
        gl.glRectf(0.1, 0.1, 0.9, 0.9)
        gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
        gl.glCallList(1)
        gl.glRectf(0.1, -0.9, 0.9, -0.1)
        return values + [np.asarray(gl.glGetFloatv(getattr(gl, name))) for name in ATTRIBUTES]

    comparison = compare(program, (33, 20))
    assert comparison, str(comparison)


@pytest.mark.parametrize("count", range(1, 5))
@pytest.mark.parametrize("mode", ["GL_LINE_LOOP", "GL_LINE_STRIP", "GL_POLYGON"])
@pytest.mark.parametrize("how", ["GL_COMPILE", "GL_COMPILE_AND_EXECUTE"])
def test_a_pair_and_the_values_that_it_leaves(how, mode, count):
    def program(gl):
        gl.glEnable(gl.GL_LIGHTING)
        gl.glEnable(gl.GL_COLOR_MATERIAL)
        gl.glNewList(1, getattr(gl, how))
        gl.glBegin(getattr(gl, mode))
        gl.glColor4f(0.5, 0.25, 0.75, 1.0)
        for i in range(count):
            gl.glColor4f(*COLORS[i].tolist())
            gl.glNormal3f(*map(float, NORMALS[i]))
            gl.glVertex2f(*CORNERS[i].tolist())
        gl.glEnd()
        gl.glEndList()
        values = [np.asarray(gl.glGetFloatv(getattr(gl, name))) for name in ATTRIBUTES]
        gl.glRectf(0.1, 0.1, 0.9, 0.9)
        return [*values, gl.glGetMaterialfv(gl.GL_FRONT, gl.GL_DIFFUSE)]

    comparison = compare(program, (33, 20))
    assert comparison, str(comparison)


@pytest.mark.thin(3)
@pytest.mark.parametrize("elements", [False, True], ids=["arrays", "elements"])
@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("after", [None, ("GL_TRIANGLES", 3), ("same", 2), ("same", 5)], ids=str)
def test_vertices_that_are_left_over_and_a_pair_that_follows(after, mode, elements):
    """The stencil buffer counts the fragments of a pixel, the depth buffer has the last one.

    Vertices that no index names are outside the view: where Mesa clips, it cuts quads in another way.
    """
    corners = np.random.default_rng(5).uniform(-0.9, 0.9, (16, 3)).astype(np.float32)
    corners[[1, 6, 10, 15]] += 1.2
    indices = np.array([4, 14, 7, 8, 14, 12, 5, 13, 2, 3, 9, 11, 0, 11, 8, 12], np.uint32)

    def program(gl, count):
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glStencilFunc(gl.GL_ALWAYS, 0, 255)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_INCR)
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glDepthFunc(gl.GL_ALWAYS)
        gl.glNewList(1, gl.GL_COMPILE)
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        gl.glVertexPointer(3, gl.GL_FLOAT, 0, corners)
        if elements:
            gl.glDrawElements(getattr(gl, mode), count, gl.GL_UNSIGNED_INT, indices)
        else:
            gl.glDrawArrays(getattr(gl, mode), 0, count)
        if after is not None:
            following, n = after
            gl.glBegin(getattr(gl, mode if following == "same" else following))
            for i in range(n):
                gl.glVertex3f(*corners[i].tolist())
            gl.glEnd()
        gl.glEndList()
        gl.glCallList(1)
        gl.glCallList(1)  # Mesa draws both at once

    for count in (1, 3, 7, 16):
        comparison = compare(partial(program, count=count), (33, 20))
        assert comparison, f"{count} vertices: {comparison}"


@pytest.mark.parametrize("mode", ["GL_QUADS", "GL_TRIANGLE_STRIP"])
@pytest.mark.parametrize("order", ["pair arrays", "arrays pair", "pair pair arrays", "arrays pair arrays"])
def test_the_last_of_consecutive_draws_decides_whether_values_become_current(order, mode):
    def program(gl):
        kind = getattr(gl, mode)
        gl.glEnable(gl.GL_LIGHTING)
        gl.glEnable(gl.GL_LIGHT0)
        gl.glNormal3f(0.6, 0.0, 0.8)
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        gl.glVertexPointer(2, gl.GL_FLOAT, 0, CORNERS)
        gl.glEnableClientState(gl.GL_NORMAL_ARRAY)
        gl.glNormalPointer(gl.GL_FLOAT, 0, NORMALS)
        gl.glNewList(1, gl.GL_COMPILE)
        for part in order.split():
            if part == "arrays":
                gl.glDrawArrays(kind, 0, 4)
                continue
            gl.glBegin(kind)
            for i in range(4):
                gl.glNormal3f(*map(float, NORMALS[i + 1]))
                gl.glVertex2f(*CORNERS[i].tolist())
            gl.glEnd()
        gl.glEndList()
        gl.glCallList(1)
        gl.glRectf(0.1, 0.1, 0.9, 0.9)
        return [np.asarray(gl.glGetFloatv(getattr(gl, name))) for name in ATTRIBUTES]

    comparison = compare(program, (33, 20))
    assert comparison, str(comparison)
