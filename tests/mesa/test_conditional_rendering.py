"""Conditional rendering draws, clears and blits where Mesa does."""

from typing import Any

import pytest

from softshadow.testing import compare

MODES = ("GL_QUERY_WAIT", "GL_QUERY_BY_REGION_WAIT", "GL_QUERY_WAIT_INVERTED", "GL_QUERY_BY_REGION_WAIT_INVERTED")


def square(gl: Any, size: float, z: float = 0.0) -> None:
    gl.glBegin(gl.GL_QUADS)
    for x, y in ((-size, -size), (size, -size), (size, size), (-size, size)):
        gl.glVertex3f(x, y, z)
    gl.glEnd()


@pytest.mark.mesa
@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("is_hidden", [False, True])
@pytest.mark.parametrize("target", ["GL_SAMPLES_PASSED", "GL_ANY_SAMPLES_PASSED"])
def test_draws_depend_on_the_query_as_in_mesa(mode: str, is_hidden: bool, target: str) -> None:
    def program(gl: Any) -> list[int]:
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glColor3f(0.2, 0.4, 0.6)
        square(gl, 0.5, -0.5)
        query = gl.glGenQueries(1)
        gl.glBeginQuery(getattr(gl, target), query)
        square(gl, 0.4, 0.5 if is_hidden else -0.8)
        gl.glEndQuery(getattr(gl, target))
        gl.glNewList(1, gl.GL_COMPILE)
        gl.glBeginConditionalRender(query, getattr(gl, mode))
        gl.glColor3f(0.9, 0.1, 0.3)
        square(gl, 0.3, -0.9)
        gl.glRasterPos2f(-0.5, 0.7)
        gl.glBitmap(8, 1, 0, 0, 3, 4, bytes([255, 0, 0, 0]))
        gl.glEndConditionalRender()
        gl.glEndList()
        gl.glCallList(1)
        gl.glBeginConditionalRender(query, getattr(gl, mode))
        gl.glEnable(gl.GL_SCISSOR_TEST)
        gl.glScissor(2, 3, 4, 5)
        gl.glClearColor(0.5, 0.6, 0.7, 0.8)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
        gl.glEndConditionalRender()
        gl.glScissor(20, 3, 4, 5)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT)
        return [0]

    assert (comparison := compare(program, (32, 24))), comparison


@pytest.mark.mesa
def test_wrong_calls_have_mesas_error_codes() -> None:
    def program(gl: Any) -> list[int]:
        codes = []

        def attempt(name: str, *arguments: Any) -> None:
            try:
                getattr(gl, name)(*arguments)
            except Exception as error:
                if not hasattr(error, "err"):
                    raise
            codes.append(int(gl.glGetError()))

        wait = gl.GL_QUERY_WAIT
        attempt("glEndConditionalRender")
        attempt("glBeginConditionalRender", 0, wait)
        attempt("glBeginConditionalRender", 77, wait)
        first, second = (int(name) for name in gl.glGenQueries(2))
        attempt("glBeginConditionalRender", first, wait)
        gl.glBeginQuery(gl.GL_SAMPLES_PASSED, first)
        attempt("glBeginConditionalRender", first, wait)
        gl.glEndQuery(gl.GL_SAMPLES_PASSED)
        attempt("glBeginConditionalRender", first, gl.GL_LESS)
        attempt("glBeginConditionalRender", second, gl.GL_LESS)
        attempt("glBeginConditionalRender", first, wait)
        attempt("glBeginConditionalRender", first, wait)
        attempt("glEndConditionalRender")
        return codes

    assert (comparison := compare(program, (8, 8))), comparison
