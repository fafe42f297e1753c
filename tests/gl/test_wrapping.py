"""The functions around calls: they have the calls' parameters, and their lines are shown in tracebacks."""

import inspect
import linecache
import traceback
from typing import Any

import pytest

from softshadow import gl
from softshadow.gl.fragment_state import glBlendFunc
from softshadow.gl.wrapping import Wrapping

TWICE = Wrapping("twice", "first = call({parameters})\nreturn first, call({parameters}), {has_text}")


def glDifference(minuend: int, subtrahend: int) -> int:
    return minuend - subtrahend


def glSum(*summands: int) -> int:
    return sum(summands)


def glPower(base: int, exponent: int = 2) -> int:
    return int(base**exponent)


def glNothing() -> None: ...


def unnamed(value: int) -> int:
    return value


def test_a_function_around_a_call_has_its_parameters() -> None:
    twice = TWICE.around(glDifference)
    assert twice(5, 3) == twice(minuend=5, subtrahend=3) == (2, 2, False)
    assert twice.__code__.co_varnames[:2] == ("minuend", "subtrahend")
    assert twice.__code__.co_name == twice.__name__ == "glDifference"
    assert str(inspect.signature(twice)) == "(minuend: int, subtrahend: int) -> int"


@pytest.mark.parametrize(
    ("call", "arguments", "result"),
    [(glSum, (1, 2, 3), 6), (glPower, (3,), 9), (glPower, (3, 3), 27), (glNothing, (), None), (unnamed, (4,), 4)],
)
def test_any_parameters_are_handed_on(call: Any, arguments: tuple[int, ...], result: int | None) -> None:
    assert TWICE.around(call)(*arguments) == (result, result, False)


def test_text_among_the_parameters_is_found() -> None:
    assert TWICE.around(unnamed)("1")[2]
    function = Wrapping("text", "return {has_text}").around(glDifference)
    assert [function(*pair) for pair in ((1, 2), ("1", 2), (1, "2"))] == [False, True, True]


def test_a_part_of_a_call_may_have_text() -> None:
    def _part(operation: str, number: int) -> None:
        pass

    assert not Wrapping("text of a part", "return {has_text}").around(_part)("glCall", 1)
    with (
        gl.create_context(4, 3),
        pytest.raises(TypeError, match=r"^glCopyTexImage2D\(width='2'\): expected an integer"),
    ):
        gl.glCopyTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, 0, 0, "2", 2, 0)  # type: ignore[arg-type]


def test_a_wrong_number_of_arguments_is_an_error_of_the_call() -> None:
    with gl.create_context(4, 3), pytest.raises(TypeError, match=r"^glStencilFunc\(\) missing 2 required"):
        gl.glStencilFunc(gl.GL_LESS)  # type: ignore[call-arg]


def test_tracebacks_show_the_line_that_calls() -> None:
    assert gl.glBlendFunc is not glBlendFunc
    with gl.create_context(4, 3), pytest.raises(gl.GLError) as caught:
        gl.glBlendFunc(77, 0)
    around = traceback.extract_tb(caught.value.__traceback__)[1]
    assert (around.name, around.line) == ("glBlendFunc", "return call(_0, _1)")
    linecache.checkcache()
    assert linecache.getline(around.filename, around.lineno or 0).strip() == around.line
