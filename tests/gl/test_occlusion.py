"""Occlusion queries count the fragments that pass every test."""

from typing import Any

import numpy as np
import pytest

from gl.gl_state import make
from softshadow import gl
from softshadow.testing import compare

SIZE = (40, 30)


def counted(target: int) -> int:
    """Return the result of a query about a square of a quarter of the window."""
    query = gl.glGenQueries(1)
    gl.glBeginQuery(target, query)
    gl.glRectf(-1, -1, 0, 0)
    gl.glEndQuery(target)
    return gl.glGetQueryObjectuiv(query, gl.GL_QUERY_RESULT)


def test_fragments_that_pass_are_counted():
    with gl.create_context(*SIZE):
        assert counted(gl.GL_SAMPLES_PASSED) == SIZE[0] * SIZE[1] // 4
        assert counted(gl.GL_ANY_SAMPLES_PASSED) == 1


def test_fragments_that_fail_a_test_are_not_counted():
    with gl.create_context(*SIZE):
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glStencilFunc(gl.GL_NEVER, 0, 255)
        assert (counted(gl.GL_SAMPLES_PASSED), counted(gl.GL_ANY_SAMPLES_PASSED)) == (0, 0)


def test_fragments_are_counted_where_nothing_is_written():
    with gl.create_context(*SIZE):
        gl.glColorMask(0, 0, 0, 0)
        assert counted(gl.GL_SAMPLES_PASSED) == SIZE[0] * SIZE[1] // 4


def test_several_draws_add_up_and_clears_do_not_count():
    with gl.create_context(*SIZE):
        query = gl.glGenQueries(1)
        gl.glBeginQuery(gl.GL_SAMPLES_PASSED, query)
        assert gl.glGetQueryiv(gl.GL_SAMPLES_PASSED, gl.GL_CURRENT_QUERY) == query
        gl.glRectf(-1, -1, 0, 0)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT)
        gl.glRectf(0, 0, 1, 1)
        gl.glEndQuery(gl.GL_SAMPLES_PASSED)
        assert gl.glGetQueryObjectiv(query, gl.GL_QUERY_RESULT) == SIZE[0] * SIZE[1] // 2
        assert gl.glGetQueryObjectiv(query, gl.GL_QUERY_RESULT_AVAILABLE) == 1


def test_name_becomes_a_query_when_it_first_counts():
    with gl.create_context(*SIZE):
        query = gl.glGenQueries(1)
        assert not gl.glIsQuery(query)
        gl.glBeginQuery(gl.GL_SAMPLES_PASSED, query)
        assert gl.glIsQuery(query)
        gl.glDeleteQueries(1, [query])
        assert not gl.glIsQuery(query)
        assert gl.glGetQueryiv(gl.GL_SAMPLES_PASSED, gl.GL_CURRENT_QUERY) == 0


def test_wrong_calls_have_their_error_codes():
    operation, enum = gl.GL_INVALID_OPERATION, gl.GL_INVALID_ENUM
    with gl.create_context(*SIZE, raise_errors=False):
        first, second = gl.glGenQueries(2).tolist()
        wrong = {
            ("glBeginQuery", ("GL_LESS", first)): enum,
            ("glEndQuery", ("GL_SAMPLES_PASSED",)): operation,
            ("glBeginQuery", ("GL_SAMPLES_PASSED", 0)): operation,
            ("glGetQueryObjectiv", (first, "GL_QUERY_RESULT")): operation,
            ("glBeginQuery", ("GL_SAMPLES_PASSED", first)): gl.GL_NO_ERROR,
            ("glBeginQuery", ("GL_SAMPLES_PASSED", second)): operation,
            ("glGetQueryObjectuiv", (first, "GL_QUERY_RESULT")): operation,
            ("glEndQuery", ("GL_ANY_SAMPLES_PASSED",)): operation,
            ("glGenQueries", (-1,)): gl.GL_INVALID_VALUE,
        }
        assert make(gl, list(wrong)) == list(wrong.values())


@pytest.mark.mesa
def test_counts_are_those_of_mesa():
    def program(namespace: Any) -> list[np.ndarray]:
        rng, counts = np.random.default_rng(1), []
        namespace.glEnable(namespace.GL_DEPTH_TEST)
        queries = namespace.glGenQueries(3)
        for draw in range(12):
            if draw == 6:
                namespace.glEnable(namespace.GL_ALPHA_TEST)
                namespace.glAlphaFunc(namespace.GL_GREATER, 0.4)
            query = int(queries[draw % 3])
            namespace.glBeginQuery(namespace.GL_SAMPLES_PASSED, query)
            namespace.glBegin(namespace.GL_TRIANGLES)
            for _ in range(6):
                namespace.glColor4f(*rng.random(4).tolist())
                namespace.glVertex3f(*rng.uniform(-1, 1, 3).tolist())
            namespace.glEnd()
            namespace.glEndQuery(namespace.GL_SAMPLES_PASSED)
            counts.append(int(namespace.glGetQueryObjectuiv(query, namespace.GL_QUERY_RESULT)))
        return [np.array(counts)]

    comparison = compare(program, SIZE)
    assert comparison, str(comparison)
