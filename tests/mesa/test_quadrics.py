"""GLU's quadrics are drawn as by libGLU on Mesa, pixel for pixel."""

from typing import Any

import numpy as np
import pytest

from softshadow.testing import compare

SIZE = (40, 30)


class Program:
    """A random sphere, cylinder and disk, directly or in a display list."""

    def __init__(self, seed: int) -> None:
        rng = np.random.default_rng(seed)
        self.style = str(rng.choice(["GLU_FILL", "GLU_FILL", "GLU_LINE", "GLU_POINT", "GLU_SILHOUETTE"]))
        # libGLU does not set the normals of GLU_FLAT points
        kinds = (
            ["GLU_SMOOTH", "GLU_NONE"] if self.style in ("GLU_POINT", "GLU_SILHOUETTE") else ["GLU_SMOOTH", "GLU_FLAT"]
        )
        self.normals = str(rng.choice(kinds))
        self.side = str(rng.choice(["GLU_OUTSIDE", "GLU_INSIDE"]))
        self.textured, self.in_list = bool(rng.random() < 0.4), bool(rng.random() < 0.3)
        self.sizes = [float(np.float32(x)) for x in rng.uniform(0.2, 0.9, 5)]
        self.numbers = [int(n) for n in rng.integers(3, 9, 4)]
        self.angles = [float(x) for x in rng.uniform(-200, 400, 2)]
        self.turn = rng.uniform(-1, 1, 4).tolist()

    def __call__(self, gl: Any) -> list[int]:
        gl.glEnable(gl.GL_DEPTH_TEST)
        for name in ("GL_LIGHTING", "GL_LIGHT0", "GL_NORMALIZE"):
            gl.glEnable(getattr(gl, name))
        gl.glLightModeli(gl.GL_LIGHT_MODEL_TWO_SIDE, 1)
        if self.textured:
            gl.glEnable(gl.GL_TEXTURE_2D)
            gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
            texels = np.arange(64, dtype=np.uint8).reshape(4, 4, 4) * 3 + 60
            gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, 4, 4, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)
        quad = gl.gluNewQuadric()
        gl.gluQuadricDrawStyle(quad, getattr(gl, self.style))
        gl.gluQuadricNormals(quad, getattr(gl, self.normals))
        gl.gluQuadricOrientation(quad, getattr(gl, self.side))
        gl.gluQuadricTexture(quad, int(self.textured))
        gl.glRotatef(90 * self.turn[0], *self.turn[1:])
        if self.in_list:
            gl.glNewList(1, gl.GL_COMPILE)
        a, b, c, d, e = self.sizes
        i, j, k, m = self.numbers
        gl.gluSphere(quad, a, max(i, j), min(i, j))  # with more stacks than slices libGLU reads behind a table
        gl.glTranslatef(0.2, 0.3, 0.1)
        gl.gluCylinder(quad, b, c, d, j, k - 2)
        gl.glTranslatef(-0.5, -0.4, -0.2)
        gl.gluPartialDisk(quad, 0.0 if i % 2 else b / 2, e + 0.1, k, m - 2, *self.angles)
        gl.gluDisk(quad, b / 3, b, m, 1)
        if self.in_list:
            gl.glEndList()
            gl.glCallList(1)
        gl.gluDeleteQuadric(quad)
        return [0]


SEEDS = [*range(12), *(pytest.param(seed, marks=pytest.mark.slow) for seed in range(12, 200))]


@pytest.mark.mesa
@pytest.mark.parametrize("seed", SEEDS)
def test_quadrics_are_those_of_libglu(seed: int) -> None:
    assert (comparison := compare(Program(seed), SIZE)), comparison


@pytest.mark.mesa
def test_a_list_keeps_the_style_with_which_it_was_compiled() -> None:
    def program(gl: Any) -> None:
        quadric = gl.gluNewQuadric()
        gl.gluQuadricDrawStyle(quadric, gl.GLU_LINE)
        gl.glNewList(1, gl.GL_COMPILE)
        gl.gluSphere(quadric, 0.7, 8, 6)
        gl.glEndList()
        gl.gluQuadricDrawStyle(quadric, gl.GLU_FILL)
        gl.glCallList(1)

    comparison = compare(program, SIZE)
    assert comparison, comparison
    drawn = comparison.ours.color[..., 0] > 0
    assert 0 < drawn.sum() < 0.5 * np.pi * 0.7**2 * drawn.size / 4, "lines, not the whole disc"


@pytest.mark.mesa
def test_the_radius_of_a_ring_of_lines_is_not_rounded() -> None:
    def program(gl: Any) -> None:
        rng, quadric = np.random.default_rng(0), gl.gluNewQuadric()
        gl.gluQuadricDrawStyle(quadric, gl.GLU_LINE)
        gl.glEnable(gl.GL_DEPTH_TEST)
        for _ in range(40):
            gl.glLoadIdentity()
            gl.gluPerspective(50, 1.3, 0.5, 20)
            gl.gluLookAt(*rng.uniform(-3, 3, 3).tolist(), 0, 0, 0, 0, 1, 0.1)
            radius = round(rng.uniform(0.3, 1.2), 1)
            gl.gluDisk(quadric, radius, radius, int(rng.integers(3, 12)), 2)

    assert (comparison := compare(program, SIZE)), comparison


@pytest.mark.mesa
def test_strings_are_those_of_libglu() -> None:
    def program(gl: Any) -> np.ndarray:
        texts = [gl.gluErrorString(code) for code in (0, 1280, 1281, 1282, 1283, 1284, 1285, 1286, 100900, 100902)]
        texts += [gl.gluGetString(gl.GLU_VERSION), gl.gluGetString(gl.GLU_EXTENSIONS)]
        texts.append(str(bool(gl.gluCheckExtension(b"two", b"one two three"))).encode())
        texts.append(str(bool(gl.gluCheckExtension(b"tw", b"one two three"))).encode())
        return np.frombuffer(b"|".join(texts), np.uint8)

    assert (comparison := compare(program, (4, 4))), comparison


@pytest.mark.mesa
def test_pick_matrices_are_those_of_libglu() -> None:
    def program(gl: Any) -> np.ndarray:
        gl.gluPickMatrix(10.5, 7.25, 3.0, 5.5, [1, 2, 30, 20])
        gl.gluPickMatrix(10.5, 7.25, 0.0, 5.5, [1, 2, 30, 20])
        return np.ravel(gl.glGetFloatv(gl.GL_MODELVIEW_MATRIX))

    assert (comparison := compare(program, (32, 24))), comparison
