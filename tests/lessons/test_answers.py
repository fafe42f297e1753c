"""Predictions, functions and programs of students are judged: right, wrong, missing, or broken."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softshadow.lessons import check_function, check_program, compare_prediction


@pytest.mark.parametrize(
    ("prediction", "value", "right"),
    [
        (1, 1, True),
        (1.0, np.uint8(1), True),
        (1, 2, False),
        (True, np.bool_(True), True),
        (False, True, False),
        ("Red ", "red", True),
        ("red", "green", False),
        ("1", 1, False),
        ([1, 2], np.array([1, 2]), True),
        ([1, 2, 3], np.array([1, 2]), False),
        (..., 1, None),
    ],
)
def test_a_prediction_is_right_wrong_or_missing(prediction: object, value: object, right: bool | None) -> None:
    answer = compare_prediction("How many?", prediction, value, "So it is.")
    assert answer.right is right
    assert ("So it is." in str(answer)) == (right is not None)
    assert ("<details>" in answer._repr_html_()) == (right is None)


@given(st.floats(-10, 10), st.floats(0, 1))
def test_numbers_within_the_allowed_difference_are_right(value: float, within: float) -> None:
    assert compare_prediction("?", value + within / 2, value, within=within).right
    assert not compare_prediction("?", value + 2 * within + 1e-6, value, within=within).right


def test_a_negative_difference_is_refused() -> None:
    with pytest.raises(ValueError, match="within=-1"):
        compare_prediction("?", 1, 1, within=-1)


def test_text_is_escaped_in_pages() -> None:
    assert "<b>" not in compare_prediction("<b>?", "<b>", "x", "<b>")._repr_html_()


def test_a_function_is_right_wrong_missing_or_ends_with_an_error() -> None:
    cases = [((1,), 2), ((2,), 4)]
    assert check_function(lambda n: 2 * n, cases).passed is True
    wrong = check_function(lambda n: n + 1, cases)
    assert wrong.passed is False
    assert str(wrong) == "Not yet: for (2) it returns 3; expected 4."
    assert check_function(lambda n: ..., cases).passed is None
    assert "ZeroDivisionError" in str(check_function(lambda n: n / 0, cases))


def red(gl):
    gl.glClearColor(1, 0, 0, 1)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT)


def red_with_a_mark(gl):
    red(gl)
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilFunc(gl.GL_ALWAYS, 1, 255)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
    gl.glColorMask(False, False, False, False)
    gl.glRectf(-1, -1, 0, 0)


def test_only_the_named_buffers_are_compared() -> None:
    assert check_program(red_with_a_mark, red, (8, 8)).passed
    check = check_program(red_with_a_mark, red, (8, 8), ("color", "stencil"))
    assert not check.passed
    (difference,) = check.differences
    assert (difference.buffer, difference.count) == ("stencil", 16)
    assert "GL_REPLACE" in str(check) or "REPLACE" in str(check)  # the history of the first pixel
    assert "stencil: 16 differ" in check._repr_html_()


def test_a_program_that_fails_gets_its_error() -> None:
    def broken(gl):
        gl.glEnable(gl.GL_KEEP)

    check = check_program(broken, red, (8, 8))
    assert not check.passed
    assert "GL_INVALID_ENUM" in str(check)
    with pytest.raises(ValueError, match="'colour'"):
        check_program(red, red, buffers=("colour",))
