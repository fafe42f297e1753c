"""Blending of single fragments: factors, equations, and the special cases of llvmpipe."""

from dataclasses import replace

import numpy as np
import pytest

from softshadow import tokens as gl
from softshadow.image import FORMATS, Image
from softshadow.pipeline.shade.blend import blend_ops, compared_alpha
from softshadow.pipeline.shade.color_writes import color_writer
from softshadow.pipeline.shade.visible_spans import Spans
from softshadow.state import Blend, State

F32 = np.float32
FIRST_PIXEL = Spans(*np.zeros((3, 1), np.int32), np.arange(2))  # type: ignore[call-arg]
SOURCE, TARGET = (0.25, 2.0, -1.5, 0.5), (1.0, -3.0, 0.75, 4.0)


def blended(internal, source=SOURCE, target=TARGET, **blend):
    """Return the cell (4,) of a buffer that held `target` after a fragment of colour `source`."""
    image = Image.new(FORMATS[internal], 1, 1, internal)
    image.cells[0, 0] = target
    state = replace(State(), blend=Blend(enabled=True, **blend))
    color_writer(state, image)(FIRST_PIXEL, np.array([source], F32))
    return image.cells[0, 0].tolist()


def func(source, target):
    return {"src_rgb": source, "src_alpha": source, "dst_rgb": target, "dst_alpha": target}


@pytest.mark.parametrize(
    ("equation", "expected"),
    [
        (gl.GL_FUNC_ADD, [1.25, -1.0, -0.75, 4.5]),
        (gl.GL_FUNC_SUBTRACT, [-0.75, 5.0, -2.25, -3.5]),
        (gl.GL_FUNC_REVERSE_SUBTRACT, [0.75, -5.0, 2.25, 3.5]),
        (gl.GL_MIN, [0.25, -3.0, -1.5, 0.5]),
        (gl.GL_MAX, [1.0, 2.0, 0.75, 4.0]),
    ],
)
def test_floats_are_blended_without_clamping(equation, expected):
    ones = func(gl.GL_ONE, gl.GL_ONE)
    assert blended(gl.GL_RGBA32F, equation_rgb=equation, equation_alpha=equation, **ones) == expected


@pytest.mark.parametrize(
    ("source", "target", "expected"),
    [
        (gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA, [0.625, -0.5, -0.375, 2.25]),
        (gl.GL_DST_COLOR, gl.GL_ZERO, [0.25, -6.0, -1.125, 2.0]),
        (gl.GL_DST_ALPHA, gl.GL_ONE_MINUS_DST_ALPHA, [-2.0, 17.0, -8.25, -10.0]),
        (gl.GL_SRC_ALPHA_SATURATE, gl.GL_ONE, [0.25, -9.0, 5.25, 4.5]),
        (gl.GL_CONSTANT_COLOR, gl.GL_CONSTANT_ALPHA, [-0.5, -6.0, 6.0, 9.0]),
    ],
)
def test_factors_of_floats_may_leave_0_to_1(source, target, expected):
    assert blended(gl.GL_RGBA32F, color=(-10.0, 0.0, -3.0, 2.0), **func(source, target)) == expected


def test_the_minimum_ignores_factors():
    assert blended(gl.GL_RGBA32F, equation_rgb=gl.GL_MIN, **func(gl.GL_ZERO, gl.GL_ZERO))[:3] == [0.25, -3.0, -1.5]


def test_floats_are_written_unchanged_under_a_logic_operation():
    assert blended(gl.GL_RGBA32F, logic_enabled=True, logic_op=gl.GL_XOR) == list(SOURCE)


def test_a_buffer_without_alpha_is_read_as_alpha_one():
    assert blended(gl.GL_RGB32F, target=(1.0, 1.0, 1.0, 1.0), **func(gl.GL_ONE, gl.GL_DST_ALPHA))[:3] == [1.25, 3, -0.5]
    ops = blend_ops(Blend(src_rgb=gl.GL_ONE_MINUS_DST_ALPHA, dst_alpha=gl.GL_DST_ALPHA), FORMATS[gl.GL_RGB8])
    assert (ops.src_rgb, ops.src_alpha, ops.dst_alpha) == (gl.GL_ZERO, gl.GL_ZERO, gl.GL_ZERO)


def test_a_single_channel_is_interpolated_in_one_step():
    over = func(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
    source, target = (0.1, 0.0, 0.0, 0.3), (0.7, 0.0, 0.0, 1.0)
    assert blended(gl.GL_R32F, source, target, **over)[0] == F32(0.7) + F32(0.3) * (F32(0.1) - F32(0.7))
    assert blended(gl.GL_RG32F, source, target, **over)[0] == F32(0.1) * F32(0.3) + F32(0.7) * (F32(1) - F32(0.3))


def test_alphas_are_compared_in_the_precision_of_the_buffer():
    state = replace(State(), alpha=replace(State().alpha, enabled=True, func=gl.GL_GREATER, ref=0.5))
    alpha = np.array([0.25, 0.5, 0.501], F32)
    codes, ref = compared_alpha(state, Image.new(FORMATS[gl.GL_RGBA8], 1, 1), alpha)
    assert (codes.tolist(), ref) == ([64, 128, 128], 128)
    codes, ref = compared_alpha(state, Image.new(FORMATS[gl.GL_RGBA32F], 1, 1), alpha)
    assert (codes.tolist(), ref) == ([0, 1, 2], 1)


def test_a_color_that_does_not_fit_an_integer_is_written_as_0():
    large = (np.inf, 8421505.0, 8421504.0, np.inf)  # times 255: on both sides of 2**31
    image = Image.new(FORMATS[gl.GL_RGBA8], 1, 1)
    color_writer(State(), image)(FIRST_PIXEL, np.array([large], F32))
    assert image.cells[0, 0].tolist() == [0, 0, 255, 0]


def test_an_alpha_without_room_in_the_buffer_is_clamped():
    over = func(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
    assert blended(gl.GL_R8, (0.5, 0.0, 0.0, np.inf), (7, 0, 0, 255), **over)[0] == 128
