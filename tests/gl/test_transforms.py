"""Matrix stacks, and planes and lights that are transformed by the current matrix."""

from typing import Any

import numpy as np
import pytest

from gl.gl_state import make
from softshadow import gl
from softshadow.context import MatrixStack
from softshadow.testing import run_on_mesa

SIZE = (10, 8)
STACKS = {"GL_MODELVIEW": 32, "GL_PROJECTION": 32, "GL_TEXTURE": 10}
STEPS = 300  # random matrix calls of one program


@pytest.mark.parametrize(("mode", "depth"), STACKS.items())
def test_stack_is_as_deep_as_gl_says(mode, depth):
    with gl.create_context(*SIZE, raise_errors=False):
        gl.glMatrixMode(getattr(gl, mode))
        codes = make(gl, [("glPushMatrix", ())] * depth + [("glPopMatrix", ())] * depth)
    overflow, underflow = codes[depth - 1], codes[-1]
    assert (overflow, underflow) == (gl.GL_STACK_OVERFLOW, gl.GL_STACK_UNDERFLOW)
    assert codes[: depth - 1] + codes[depth:-1] == [gl.GL_NO_ERROR] * (2 * depth - 2)


def test_pop_brings_the_pushed_matrix_back():
    with gl.create_context(*SIZE):
        gl.glTranslatef(1, 2, 3)
        gl.glPushMatrix()
        gl.glRotatef(30, 1, 1, 0)
        gl.glPopMatrix()
        expected = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [1, 2, 3, 1]]  # column after column
        np.testing.assert_array_equal(gl.glGetFloatv(gl.GL_MODELVIEW_MATRIX), expected)


@pytest.mark.parametrize("seed", range(10))
def test_calls_push_and_pop_as_the_stack_does(seed):
    """The calls contain what its methods do in most cases."""
    rng, expected = np.random.default_rng(seed), MatrixStack(STACKS["GL_PROJECTION"], np.float32)
    context = gl.create_context(*SIZE, raise_errors=False)
    gl.glMatrixMode(gl.GL_PROJECTION)
    for _ in range(STEPS):
        name = rng.choice(["push", "push", "pop", "translate", "perspective", "identity", "fill", "read"])
        error = gl.GL_NO_ERROR
        if name == "push":
            gl.glPushMatrix()
            error = gl.GL_NO_ERROR if expected.push() else gl.GL_STACK_OVERFLOW
        elif name == "pop":
            gl.glPopMatrix()
            error = gl.GL_NO_ERROR if expected.pop() else gl.GL_STACK_UNDERFLOW
        elif name == "identity":
            gl.glLoadIdentity()
            expected.load_identity()
        elif name == "perspective":  # whose kind must be derived before the next push
            gl.gluPerspective(45, 1, 1, 10)
            expected.perspective(45, 1, 1, 10)
        elif name == "read":
            assert gl.glGetFloatv(gl.GL_PROJECTION_MATRIX).tobytes() == expected.current.T.tobytes()
        else:
            for _ in range(100 if name == "fill" else 1):  # the queue has room for 128
                gl.glTranslatef(0.5, 0.25, 0.125)
                expected.translate(0.5, 0.25, 0.125)
        assert gl.glGetError() == error
        assert len(context.projection_stack) == len(expected)
    for level in range(len(expected)):
        assert context.projection_stack[level].tobytes() == expected[level].tobytes()
    assert context.projection_stack.kind == expected.kind


def test_each_texture_unit_has_its_own_matrix():
    with gl.create_context(*SIZE):
        gl.glMatrixMode(gl.GL_TEXTURE)
        gl.glActiveTexture(gl.GL_TEXTURE1)
        gl.glScalef(2, 2, 2)
        gl.glActiveTexture(gl.GL_TEXTURE0)
        np.testing.assert_array_equal(gl.glGetFloatv(gl.GL_TEXTURE_MATRIX), np.eye(4))


def test_matrices_of_an_exact_context_are_double_precision():
    with gl.create_context(*SIZE, precision="exact"):
        gl.glTranslated(0.1, 0, 0)
        assert gl.glGetDoublev(gl.GL_MODELVIEW_MATRIX)[3, 0] == 0.1


def test_unproject_undoes_project():
    with gl.create_context(*SIZE):
        gl.glMatrixMode(gl.GL_PROJECTION)
        gl.gluPerspective(50, 1.25, 0.5, 20)
        gl.glMatrixMode(gl.GL_MODELVIEW)
        gl.gluLookAt(1, 2, 3, 0, 0.5, 0, 0, 1, 0)
        window = gl.gluProject(0.25, -0.5, 1)
        # float64 rounding, magnified by the depths that a perspective crowds together
        np.testing.assert_allclose(gl.gluUnProject(*window), (0.25, -0.5, 1), atol=1e-12)


def test_point_at_infinity_has_no_window_coordinates():
    with gl.create_context(*SIZE):
        gl.glLoadMatrixf(np.diag([1, 1, 1, 0]).astype(np.float32))
        with pytest.raises(ValueError, match="infinity"):
            gl.gluProject(1, 2, 3)


def random_step(namespace: Any, rng: np.random.Generator) -> None:
    """Change the modelview matrix in one of GL's ways: what it is made by decides how it is inverted."""
    three, four = rng.uniform(-2, 2, 3).tolist(), rng.uniform(-90, 90, 4).tolist()
    loaded = rng.uniform(-2, 2, 16).astype(np.float32)
    steps = {
        "glLoadIdentity": (), "glTranslatef": three, "glRotatef": four, "glScalef": three, "glPushMatrix": (),
        "glPopMatrix": (), "glLoadMatrixf": (loaded,), "glMultMatrixf": (loaded,),
        "gluLookAt": rng.uniform(-3, 3, 9).tolist(),
    }  # fmt: skip
    name = str(rng.choice(list(steps), p=[0.2, 0.15, 0.2, 0.1, 0.1, 0.1, 0.05, 0.05, 0.05]))
    if name == "glScalef" and rng.integers(2):
        steps[name] = three[:1] * 3
    depth = namespace.glGetIntegerv(namespace.GL_MODELVIEW_STACK_DEPTH)
    if not (name == "glPopMatrix" and depth == 1) and not (name == "glPushMatrix" and depth == 32):
        getattr(namespace, name)(*steps[name])


@pytest.mark.mesa
@pytest.mark.parametrize("seed", range(4))
def test_planes_and_lights_in_eye_space_have_the_bits_of_mesa(seed):
    def program(namespace: Any) -> np.ndarray:
        rng, answers = np.random.default_rng(seed), []
        light = namespace.GL_LIGHT0
        for _ in range(STEPS):
            random_step(namespace, rng)
            place, direction, plane = rng.uniform(-3, 3, 4), rng.uniform(-3, 3, 3), rng.uniform(-3, 3, 4)
            if rng.integers(3):
                continue
            namespace.glLightfv(light, namespace.GL_POSITION, place.astype(np.float32))
            namespace.glLightfv(light, namespace.GL_SPOT_DIRECTION, direction.astype(np.float32))
            namespace.glClipPlane(namespace.GL_CLIP_PLANE1, plane)
            namespace.glTexGendv(namespace.GL_T, namespace.GL_EYE_PLANE, plane)
            answers += [*namespace.glGetLightfv(light, namespace.GL_POSITION)]
            answers += [*namespace.glGetLightfv(light, namespace.GL_SPOT_DIRECTION)]
            answers += [*namespace.glGetClipPlane(namespace.GL_CLIP_PLANE1)]
            answers += [*namespace.glGetTexGenfv(namespace.GL_T, namespace.GL_EYE_PLANE)]
        return np.array(answers, np.float32)

    with gl.create_context(*SIZE):
        ours = program(gl)
    np.testing.assert_array_equal(ours, run_on_mesa(program, SIZE).returned)


def test_numbers_that_are_too_large_become_infinite_without_a_warning():
    with gl.create_context(*SIZE):
        gl.glScaled(1e30, 1, 1)
        gl.glScaled(1e30, 1, 1)
        assert np.isinf(gl.glGetFloatv(gl.GL_MODELVIEW_MATRIX)[0, 0])
        gl.glMultMatrixd(np.full(16, 1e300))
        gl.glLightfv(gl.GL_LIGHT0, gl.GL_POSITION, (1e300, 0, 0, 1))
        gl.glClearColor(1e300, 0, 0, 0)
        gl.glRectf(-1e300, 0, 1, 1)
