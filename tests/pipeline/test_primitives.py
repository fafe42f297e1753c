"""Primitive assembly in GL's order."""

import pytest

from softshadow import tokens as gl
from softshadow.pipeline.primitives import assemble


@pytest.mark.parametrize(
    ("mode", "count", "corners", "provoking"),
    [
        (gl.GL_TRIANGLES, 7, [[0, 1, 2], [3, 4, 5]], [2, 5]),
        (gl.GL_TRIANGLE_STRIP, 5, [[0, 1, 2], [2, 1, 3], [2, 3, 4]], [2, 3, 4]),
        (gl.GL_TRIANGLE_FAN, 5, [[0, 1, 2], [0, 2, 3], [0, 3, 4]], [2, 3, 4]),
        (gl.GL_QUADS, 9, [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]], [3, 3, 7, 7]),
        (gl.GL_QUAD_STRIP, 7, [[0, 1, 3], [0, 3, 2], [2, 3, 5], [2, 5, 4]], [3, 3, 5, 5]),
        (gl.GL_POLYGON, 5, [[1, 2, 0], [2, 3, 0], [3, 4, 0]], [0, 0, 0]),
    ],
)
def test_vertices_make_triangles_in_the_order_of_the_specification(mode, count, corners, provoking):
    made = assemble(mode, count)
    assert made.corners.tolist() == corners
    assert made.provoking.tolist() == provoking


@pytest.mark.parametrize("mode", range(gl.GL_TRIANGLES, gl.GL_POLYGON + 1))
@pytest.mark.parametrize("count", [0, 1, 2])
def test_too_few_vertices_make_no_triangle(mode, count):
    assert len(assemble(mode, count).corners) == 0
