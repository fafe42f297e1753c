"""Consecutive primitives of display lists, some with too few or too many vertices, are drawn as by Mesa."""

from typing import Any

import numpy as np
import pytest

from softshadow import gl as tokens
from softshadow.testing import compare

SIZE = (32, 24)


class Program:
    """A list of pairs of glBegin and glEnd with 1 to 6 vertices, most of them in one mode."""

    def __init__(self, seed: int) -> None:
        rng = np.random.default_rng(seed)
        self.is_unfilled = bool(rng.random() < 0.5)
        favourite, self.pairs = int(rng.integers(0, 10)), []
        # Mesa 22.3 writes behind its indices if a list has few vertices and completes primitives
        self.pairs.append((tokens.GL_POINTS, rng.uniform(-0.9, 0.9, (12, 6))))
        if rng.random() < 0.5:
            self.pairs.append((tokens.GL_QUADS, rng.uniform(-0.9, 0.9, (8, 6))))
        for _ in range(int(rng.integers(1, 6))):
            mode = favourite if rng.random() < 0.7 else int(rng.integers(0, 10))
            self.pairs.append((mode, rng.uniform(-0.9, 0.9, (int(rng.integers(1, 7)), 6))))

    def __call__(self, gl: Any) -> None:
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_LINE if self.is_unfilled else gl.GL_FILL)
        gl.glNewList(1, gl.GL_COMPILE)
        for mode, vertices in self.pairs:
            gl.glBegin(mode)
            for row in vertices:
                gl.glColor3f(*map(float, np.abs(row[3:])))
                gl.glVertex3f(*map(float, row[:3]))
            gl.glEnd()
        gl.glEndList()
        gl.glCallList(1)


@pytest.mark.mesa
@pytest.mark.parametrize("seed", [*range(12), *(pytest.param(seed, marks=pytest.mark.slow) for seed in range(12, 200))])
def test_consecutive_primitives_of_a_list_are_joined_as_by_mesa(seed: int) -> None:
    assert (comparison := compare(Program(seed), SIZE)), comparison


@pytest.mark.mesa
@pytest.mark.parametrize("mode", [tokens.GL_QUADS, tokens.GL_QUAD_STRIP])
def test_three_vertices_of_quads_draw_a_triangle_in_a_list(mode: int) -> None:
    def program(gl: Any) -> None:
        gl.glNewList(1, gl.GL_COMPILE)
        gl.glBegin(mode)
        for x, y in ((-0.8, -0.8), (0.8, -0.8), (0.6, 0.9)):
            gl.glVertex2f(x, y)
        gl.glEnd()
        gl.glEndList()
        gl.glCallList(1)

    comparison = compare(program, SIZE)
    assert comparison, comparison
    assert comparison.ours.color[..., 0].any()
