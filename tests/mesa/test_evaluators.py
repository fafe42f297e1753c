"""Curves and surfaces of evaluators are drawn as by Mesa."""

from typing import Any

import numpy as np
import pytest

from softshadow import gl as tokens
from softshadow.testing import compare

SIZE = (40, 30)


class Program:
    """Random maps, and meshes, points and coordinates of them, directly or in a display list."""

    def __init__(self, seed: int) -> None:
        self.rng = rng = np.random.default_rng(seed)
        self.n = int(rng.integers(1, 3))
        self.orders = tuple(int(order) for order in rng.integers(2, 6, self.n))
        self.has_w, self.auto, self.in_list, self.lit = (bool(rng.random() < p) for p in (0.3, 0.6, 0.4, 0.6))
        self.colors, self.normals = (bool(rng.random() < p) for p in (0.5, 0.3))
        self.texture = int(rng.integers(0, 5))
        self.grid = tuple(int(n) for n in rng.integers(2, 6, 2))
        self.domain = tuple(float(x) for x in rng.choice([-1.0, 0.0, 0.5, 1.0, 2.0, 3.0], 2, replace=False))
        self.ways = [str(way) for way in rng.choice(["mesh", "points", "coords", "mixed"], 2)]
        self.mode = str(rng.choice(["GL_FILL", "GL_FILL", "GL_LINE", "GL_POINT"]))
        self.points = {size: self._points(size) for size in (1, 2, 3, 4)}
        self.colored = np.abs(self._points(4))

    def _points(self, size: int) -> np.ndarray:
        points = self.rng.uniform(-0.9, 0.9, (*self.orders, size)).astype(np.float32)
        if size == 4:
            points[..., 3] = 1 + np.abs(points[..., 3])
        return points

    def _define(self, gl: Any, name: str, points: np.ndarray) -> None:
        target, d = getattr(gl, f"GL_MAP{self.n}_{name}"), self.domain
        if self.n == 1:
            gl.glMap1f(target, *d, points)
        else:
            gl.glMap2f(target, *d, d[1], d[0] + 5, points)
        gl.glEnable(target)

    def __call__(self, gl: Any) -> np.ndarray:
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glPointSize(3)
        self._define(gl, "VERTEX_4" if self.has_w else "VERTEX_3", self.points[4 if self.has_w else 3])
        if self.colors:
            self._define(gl, "COLOR_4", self.colored)
        if self.normals:
            self._define(gl, "NORMAL", self.points[3])
        if self.texture:
            self._define(gl, f"TEXTURE_COORD_{self.texture}", self.points[self.texture])
            gl.glEnable(gl.GL_TEXTURE_2D)
            gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
            texels = np.arange(64, dtype=np.uint8).reshape(4, 4, 4) * 3 + 60
            gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, 4, 4, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)
        if self.auto:
            gl.glEnable(gl.GL_AUTO_NORMAL)
        if self.lit:
            for name in ("GL_LIGHTING", "GL_LIGHT0", "GL_COLOR_MATERIAL", "GL_NORMALIZE"):
                gl.glEnable(getattr(gl, name))
            gl.glLightModeli(gl.GL_LIGHT_MODEL_TWO_SIDE, 1)
        d = self.domain
        if self.n == 1:
            gl.glMapGrid1f(self.grid[0], *d)
        else:
            gl.glMapGrid2f(self.grid[0], *d, self.grid[1], d[1], d[0] + 5)
        gl.glColor4f(0.9, 0.6, 0.3, 0.5)
        if self.in_list:
            gl.glNewList(1, gl.GL_COMPILE)
        for way in self.ways:
            self._draw(gl, way)
        if self.in_list:
            gl.glEndList()
            gl.glCallList(1)
        gl.glPushAttrib(gl.GL_ENABLE_BIT)
        gl.glDisable(gl.GL_AUTO_NORMAL)
        gl.glPopAttrib()
        # not the current colour, normal and texture coordinates: Mesa's are mixed up by a vertex of a new format
        names = ("GL_AUTO_NORMAL", f"GL_MAP{self.n}_GRID_DOMAIN", f"GL_MAP{self.n}_GRID_SEGMENTS")
        return np.concatenate([np.ravel(gl.glGetFloatv(getattr(gl, name))) for name in names])

    def _draw(self, gl: Any, way: str) -> None:
        u, v = self.grid
        if way == "mesh":
            mode = getattr(gl, "GL_LINE" if self.n == 1 and self.mode == "GL_FILL" else self.mode)
            gl.glEvalMesh1(mode, 0, u) if self.n == 1 else gl.glEvalMesh2(mode, 0, u, 0, v - 1)
            return
        gl.glBegin(gl.GL_LINE_STRIP if self.n == 1 else gl.GL_TRIANGLE_STRIP)
        for i in range(6):
            if way == "mixed" and i % 3 == 1:
                gl.glColor3f(0.1 * i, 0.5, 0.25)
                gl.glTexCoord2f(0.3, 0.1 * i)
                gl.glNormal3f(0, 0.1 * i, 1)
                gl.glVertex2f(0.1 * i, 0.7)
            elif way == "points":
                gl.glEvalPoint1(i) if self.n == 1 else gl.glEvalPoint2(i % 3, i // 2)
            else:
                gl.glEvalCoord1f(0.2 * i) if self.n == 1 else gl.glEvalCoord2d(0.2 * i, 0.3 * (i % 2) + 0.5)
        gl.glEnd()


SEEDS = [*range(16), *(pytest.param(seed, marks=pytest.mark.slow) for seed in range(16, 200))]


@pytest.mark.mesa
@pytest.mark.parametrize("seed", SEEDS)
def test_curves_and_surfaces_are_those_of_mesa(seed: int) -> None:
    assert (comparison := compare(Program(seed), SIZE)), comparison


def test_evaluated_attributes_do_not_become_current() -> None:
    with tokens.create_context(*SIZE):
        program = Program(3)
        program(tokens)
        tokens.glColor4f(0.1, 0.2, 0.3, 0.4)
        tokens.glBegin(tokens.GL_POINTS)
        tokens.glEvalCoord2f(0.5, 0.5)
        tokens.glEnd()
        assert program.n == 2
        assert program.colors
        assert tokens.glGetFloatv(tokens.GL_CURRENT_COLOR).tolist() == pytest.approx([0.1, 0.2, 0.3, 0.4])
