"""Facts about stencil and depth from conformance tests hold here and on Mesa."""

from typing import Any

import numpy as np
import pytest

from mesa.conformance import FULL, FUNCTIONS, SIZE, holds, passes, quad
from softshadow.testing import compare

pytestmark = pytest.mark.mesa

OPS = {  # of a value and a reference, 8 bits
    "GL_KEEP": lambda s, ref: s, "GL_ZERO": lambda s, ref: 0, "GL_REPLACE": lambda s, ref: ref,
    "GL_INCR": lambda s, ref: min(s + 1, 255), "GL_DECR": lambda s, ref: max(s - 1, 0),
    "GL_INCR_WRAP": lambda s, ref: (s + 1) % 256, "GL_DECR_WRAP": lambda s, ref: (s - 1) % 256,
    "GL_INVERT": lambda s, ref: 255 - s,
}  # fmt: skip


@pytest.mark.parametrize("function", FUNCTIONS)
def test_stencil_function_compares_the_masked_reference_with_the_masked_value(function: str) -> None:
    """dEQP-GLES3.functional.fragment_ops.stencil.cmp_*: below, at and above the value; and with a mask."""
    cases = [(reference, mask) for reference in (0, 3, 4, 5, 255) for mask in (255, 1, 0)]

    def program(gl: Any) -> list[np.ndarray]:
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glStencilOp(gl.GL_ZERO, gl.GL_KEEP, gl.GL_INVERT)
        rows = []
        for reference, mask in cases:
            gl.glClearStencil(4)
            gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
            gl.glStencilFunc(getattr(gl, function), reference, mask)
            quad(gl)
            rows.append(gl.glReadPixels(0, 0, *SIZE, gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE))
        return rows

    compared = compare(program, SIZE)
    assert compared, str(compared)
    for (reference, mask), plane in zip(cases, compared.ours.returned, strict=True):
        holds(plane, 251 if passes(function, reference & mask, 4 & mask) else 0)


@pytest.mark.parametrize("op", OPS)
@pytest.mark.parametrize("outcome", ["stencil_fail", "depth_fail", "depth_pass"])
def test_stencil_op_of_each_outcome_writes_under_the_mask(op: str, outcome: str) -> None:
    """dEQP-GLES3.functional.fragment_ops.stencil.depth_fail_replace, incr_stencil_fail and others; write masks too."""
    cases = [(value, mask) for value in (0, 1, 127, 254, 255) for mask in (255, 0x0F)]

    def program(gl: Any) -> list[np.ndarray]:
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glDepthFunc(gl.GL_NEVER if outcome == "depth_fail" else gl.GL_ALWAYS)
        gl.glStencilFunc(gl.GL_NEVER if outcome == "stencil_fail" else gl.GL_ALWAYS, 0xA5, 255)
        ops = [
            getattr(gl, op) if outcome == name else gl.GL_KEEP for name in ("stencil_fail", "depth_fail", "depth_pass")
        ]
        gl.glStencilOp(*ops)
        rows = []
        for value, mask in cases:
            gl.glStencilMask(255)
            gl.glClearStencil(value)
            gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
            gl.glStencilMask(mask)
            quad(gl)
            rows.append(gl.glReadPixels(0, 0, *SIZE, gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE))
        return rows

    compared = compare(program, SIZE)
    assert compared, str(compared)
    for (value, mask), plane in zip(cases, compared.ours.returned, strict=True):
        holds(plane, (value & ~mask) | (OPS[op](value, 0xA5) & mask))


def test_each_facing_has_its_own_stencil_state() -> None:
    """piglit stencil-twoside, dEQP-GLES3.functional.fragment_ops.depth_stencil.stencil_depth_funcs (front and back)."""

    def program(gl: Any) -> None:
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glStencilOpSeparate(gl.GL_FRONT, gl.GL_KEEP, gl.GL_KEEP, gl.GL_INCR_WRAP)
        gl.glStencilOpSeparate(gl.GL_BACK, gl.GL_KEEP, gl.GL_KEEP, gl.GL_DECR_WRAP)
        for clockwise, box in ((False, (-1, -1, 0, 1)), (True, (0, -1, 1, 1))):
            quad(gl, 0, box, clockwise)
        gl.glFrontFace(gl.GL_CW)  # facing follows glFrontFace
        quad(gl, 0, (0, -1, 1, 0), clockwise=True)

    compared = compare(program, SIZE)
    assert compared, str(compared)
    holds(compared.ours.stencil[:, :8], 1)
    holds(compared.ours.stencil[8:, 8:], 255)
    holds(compared.ours.stencil[:8, 8:], 0)


@pytest.mark.parametrize("function", FUNCTIONS)
def test_depth_function_compares_the_fragment_with_the_buffer(function: str) -> None:
    """piglit depthfunc, dEQP-GLES3.functional.fragment_ops.depth.cmp_*: nearer, equal and farther fragments."""

    def program(gl: Any) -> None:
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glDepthFunc(gl.GL_ALWAYS)
        quad(gl, 0.0)
        gl.glDepthFunc(getattr(gl, function))
        for column, z in enumerate((-0.5, 0.0, 0.5)):
            quad(gl, z, (-1 + column * 0.5, -1, -0.5 + column * 0.5, 1))

    compared = compare(program, SIZE)
    assert compared, str(compared)
    middle = int(compared.ours.depth[0, 15])
    for column, depth in enumerate((round(0.25 * FULL), middle, round(0.75 * FULL))):
        seen = compared.ours.depth[:, 4 * column : 4 * column + 4]
        expected = depth if passes(function, depth, middle) else middle
        assert np.abs(seen.astype(int) - expected).max() <= 1  # a quarter of the range is no whole number of steps


def test_failed_stencil_test_leaves_depth_and_color() -> None:
    """dEQP-GLES3.functional.fragment_ops.random: stencil comes before depth."""

    def program(gl: Any) -> None:
        for capability in (gl.GL_STENCIL_TEST, gl.GL_DEPTH_TEST):
            gl.glEnable(capability)
        gl.glStencilFunc(gl.GL_NEVER, 1, 255)
        gl.glStencilOp(gl.GL_REPLACE, gl.GL_ZERO, gl.GL_ZERO)
        quad(gl)

    compared = compare(program, SIZE)
    assert compared, str(compared)
    holds(compared.ours.stencil, 1)
    holds(compared.ours.depth, FULL)
    holds(compared.ours.color, [0, 0, 0, 0])


@pytest.mark.parametrize("test", ["scissor", "alpha"])
def test_fragment_discarded_before_the_stencil_test_changes_nothing(test: str) -> None:
    """dEQP-GLES3.functional.fragment_ops.scissor, GL 2.1 sec. 4.1.4: both come before stencil."""

    def program(gl: Any) -> None:
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glStencilOp(gl.GL_INCR, gl.GL_INCR, gl.GL_INCR)
        gl.glEnable(gl.GL_SCISSOR_TEST if test == "scissor" else gl.GL_ALPHA_TEST)
        gl.glScissor(0, 0, 8, 16)
        gl.glAlphaFunc(gl.GL_GREATER, 0.5)
        gl.glColor4f(1, 0, 0, 1)
        quad(gl, 0, (-1, -1, 0, 1))
        gl.glColor4f(1, 0, 0, 0.2)
        quad(gl, 0, (0, -1, 1, 1))

    compared = compare(program, SIZE)
    assert compared, str(compared)
    holds(compared.ours.stencil[:, :8], 1)
    holds(compared.ours.stencil[:, 8:], 0)


def test_without_a_depth_test_the_stencil_op_is_that_of_a_pass_and_no_depth_is_written() -> None:
    """dEQP-GLES3.functional.fragment_ops.depth_stencil.stencil_depth_funcs (no depth test), GL 2.1 sec. 4.1.5."""

    def program(gl: Any) -> None:
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glDepthFunc(gl.GL_NEVER)
        gl.glStencilOp(gl.GL_ZERO, gl.GL_ZERO, gl.GL_REPLACE)
        gl.glStencilFunc(gl.GL_ALWAYS, 7, 0)
        quad(gl)

    compared = compare(program, SIZE)
    assert compared, str(compared)
    holds(compared.ours.stencil, 7)
    holds(compared.ours.depth, FULL)


def test_clear_obeys_scissor_and_masks_but_no_test() -> None:
    """piglit masked-clear, scissor-stencil-clear, dEQP-GLES3.functional.depth_stencil_clear.*_scissored_masked."""

    def program(gl: Any) -> None:
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glStencilFunc(gl.GL_NEVER, 0, 255)
        gl.glEnable(gl.GL_SCISSOR_TEST)
        gl.glScissor(0, 0, 8, 16)
        gl.glStencilMask(0x0F)
        gl.glDepthMask(gl.GL_FALSE)
        gl.glColorMask(1, 0, 0, 1)
        gl.glClearColor(1, 1, 1, 1)
        gl.glClearDepth(0)
        gl.glClearStencil(0x1FF)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)

    compared = compare(program, SIZE)
    assert compared, str(compared)
    holds(compared.ours.stencil[:, :8], 0x0F)
    holds(compared.ours.color[:, :8], [255, 0, 0, 255])
    holds(compared.ours.depth, FULL)
    holds(compared.ours.stencil[:, 8:], 0)
