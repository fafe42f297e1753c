"""A recorded C program, replayed: colour, depth and stencil are those of Mesa for the same calls."""

from pathlib import Path

import pytest

from paths import TRACE
from recordings.traced_program import TracedProgram
from softshadow import gl
from softshadow.testing.trace_comparison import compare_trace

pytestmark = pytest.mark.mesa


def test_every_pixel_of_each_frame_equals_that_of_mesa() -> None:
    compared = compare_trace(TRACE)
    assert [each.frame for each in compared] == [0, 1, 2, 3]
    assert all(compared), "\n".join(map(str, compared))


def test_a_difference_is_told_with_its_pixel(tmp_path: Path) -> None:
    traced = TracedProgram()
    traced.glClear(gl.GL_COLOR_BUFFER_BIT)
    traced.glEnable(gl.GL_COLOR_MATERIAL)
    traced.glNoSuchCall(1)  # neither side has it
    traced.triangle()
    traced.swap()
    (equal,) = compare_trace(traced.save(tmp_path))
    assert equal
    assert "glNoSuchCall" in str(equal)
    traced.glWeightivARB(1, [1])
    traced.glLogicOp(gl.GL_INVERT)
    traced.glUseProgram(3)  # its draws are left out here; Mesa makes them without a program
    traced.triangle((-1.0, -1.0), (0.0, -1.0), (-1.0, 0.0))
    traced.glEnable(gl.GL_COLOR_LOGIC_OP)
    traced.triangle((-1.0, -1.0), (0.0, -1.0), (-1.0, 0.0))
    (differs,) = compare_trace(traced.save(tmp_path), [1])
    assert not differs
    assert str(differs).startswith("frame 1: color: ")
    assert " differ, first at x=0, y=0" in str(differs)
