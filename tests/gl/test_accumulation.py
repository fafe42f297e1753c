"""The accumulation buffer adds in 16 bits, truncated as in Mesa."""

from typing import Any

import numpy as np
import pytest

from gl.gl_state import make
from softshadow import gl
from softshadow.pipeline.execute import execute
from softshadow.testing import compare

SIZE = (40, 30)
OPERATIONS = ("GL_ACCUM", "GL_ACCUM", "GL_LOAD", "GL_ADD", "GL_MULT", "GL_RETURN")


def colours() -> np.ndarray:
    return gl.glReadPixels(0, 0, *SIZE, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)


@pytest.mark.parametrize(("calls", "value", "expected"), [(1, 1.0, 200), (2, 0.5, 200), (256, 1 / 256, 199)])
def test_sum_of_equal_images_is_the_image_but_for_what_is_cut_off(calls, value, expected):
    with gl.create_context(*SIZE):
        gl.glClearColor(200 / 255, 0, 0, 0)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_ACCUM_BUFFER_BIT)
        for _ in range(calls):
            gl.glAccum(gl.GL_ACCUM, value)
        gl.glAccum(gl.GL_RETURN, 1)
        assert (colours() == [expected, 0, 0, 0]).all()


def test_return_heeds_colour_mask_and_scissor_box():
    with gl.create_context(*SIZE):
        gl.glClearAccum(1, 1, 1, 1)
        gl.glClear(gl.GL_ACCUM_BUFFER_BIT)
        gl.glColorMask(0, 1, 1, 1)
        gl.glEnable(gl.GL_SCISSOR_TEST)
        gl.glScissor(0, 0, 3, 2)
        gl.glAccum(gl.GL_RETURN, 1)
        expected = np.zeros((SIZE[1], SIZE[0], 4), np.uint8)
        expected[:2, :3, 1:] = 255
        np.testing.assert_array_equal(colours(), expected)


def test_recording_gives_the_same_sums_again():
    with gl.create_context(*SIZE) as context:
        gl.glRectf(-1, -1, 0, 1)
        gl.glAccum(gl.GL_LOAD, 0.5)
        gl.glAccum(gl.GL_RETURN, 1)
        storage = context.frame.fresh_storage()
        for command in context.frame.commands:
            execute(command, storage)
        assert storage.window.color.same_as(context.storage.window.color)


def test_wrong_calls_have_their_error_codes():
    with gl.create_context(*SIZE, raise_errors=False):
        calls = [("glAccum", ("GL_LESS", 1)), ("glBindFramebuffer", ("GL_FRAMEBUFFER", gl.glGenFramebuffers(1)))]
        codes = make(gl, [*calls, ("glAccum", ("GL_LOAD", 1))])
    assert codes == [gl.GL_INVALID_ENUM, gl.GL_NO_ERROR, gl.GL_INVALID_OPERATION]


@pytest.mark.mesa
@pytest.mark.parametrize("seed", range(6))
def test_random_sums_are_those_of_mesa(seed):
    def program(namespace: Any) -> None:
        rng = np.random.default_rng(seed)
        namespace.glClearAccum(*rng.uniform(-1.2, 1.2, 4).tolist())
        namespace.glClear(namespace.GL_ACCUM_BUFFER_BIT)
        for _ in range(8):
            for _ in range(5):
                namespace.glColor4f(*rng.random(4).tolist())
                namespace.glRectf(*rng.uniform(-1, 1, 4).tolist())
            value = float(rng.choice([rng.uniform(-1.5, 1.5), 0.5, 1 / 3, 1.0, 1 / 256]))
            namespace.glAccum(getattr(namespace, str(rng.choice(OPERATIONS))), value)
            if rng.integers(3) == 0:
                namespace.glEnable(namespace.GL_SCISSOR_TEST)
                namespace.glScissor(*rng.integers(0, 30, 4).tolist())
        namespace.glAccum(namespace.GL_RETURN, 1.0)

    comparison = compare(program, SIZE)
    assert comparison, str(comparison)
