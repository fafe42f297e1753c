"""Altered and recorded GL calls: what is written down is what is made."""

import numpy as np
import pytest

from softshadow import gl
from softshadow.errors import StateError
from softshadow.gallery.call_difference import MOST_PLACES, call_difference
from softshadow.gallery.calls import AlteredCall, RecordedNames, Token, spelled


@pytest.fixture(autouse=True)
def window() -> None:
    gl.create_context(4, 3)


def texts(names: RecordedNames) -> list[str]:
    return [call.text for call in names.calls]


def test_calls_are_written_as_the_program_spells_them() -> None:
    names = RecordedNames(gl, ())
    names.glEnable(names.GL_LIGHT0 + 1)
    names.glClear(names.GL_COLOR_BUFFER_BIT | names.GL_DEPTH_BUFFER_BIT)
    names.glBlendFunc(names.GL_ONE, names.GL_ZERO)
    names.glMultMatrixd(np.eye(4))
    assert texts(names)[:3] == [
        "glEnable(GL_LIGHT1)", "glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)", "glBlendFunc(GL_ONE, GL_ZERO)",
    ]  # fmt: skip
    assert texts(names)[3].startswith("glMultMatrixd([1, 0, 0, 0, 0, 1,")
    assert gl.glIsEnabled(gl.GL_LIGHT1)


def test_state_below_holds_numbers_without_names() -> None:
    names = RecordedNames(gl, ())
    names.glDepthFunc(names.GL_LEQUAL)
    assert isinstance(names.GL_LEQUAL, Token)
    assert type(gl.current().state.depth.func) is int


def test_call_is_replaced_left_out_or_given_other_arguments() -> None:
    names = RecordedNames(
        gl,
        [
            AlteredCall("glDepthFunc(GL_LEQUAL)", "glDepthFunc(GL_LESS)"),
            AlteredCall("glEnable(GL_CULL_FACE)", None),
            AlteredCall("glClearStencil", lambda value: (value + 1,)),
        ],
    )
    names.glDepthFunc(names.GL_LEQUAL)
    names.glEnable(names.GL_CULL_FACE)
    names.glEnable(names.GL_DEPTH_TEST)
    names.glClearStencil(4)
    assert texts(names) == ["glDepthFunc(GL_LESS)", "glEnable(GL_DEPTH_TEST)", "glClearStencil(5)"]
    assert gl.glGetIntegerv(gl.GL_DEPTH_FUNC) == gl.GL_LESS
    assert not gl.glIsEnabled(gl.GL_CULL_FACE)
    assert gl.glGetIntegerv(gl.GL_STENCIL_CLEAR_VALUE) == 5
    names.check()


def test_change_that_meets_no_call_is_an_error() -> None:
    names = RecordedNames(gl, [AlteredCall("glDepthFunc(GL_EQUAL)", None)])
    names.glDepthFunc(names.GL_LEQUAL)
    with pytest.raises(StateError, match=r"never calls glDepthFunc\(GL_EQUAL\)"):
        names.check()


def test_large_arrays_are_told_by_shape_and_compared_by_content() -> None:
    assert spelled(np.zeros((20, 3), np.float32)) == "float32 (20, 3)"
    one, other = RecordedNames(gl, ()), RecordedNames(gl, ())
    for names, value in ((one, 0), (other, 1)):
        names.glVertexPointer(3, names.GL_FLOAT, 0, np.full((20, 3), value, np.float32))
        names.glEnableClientState(names.GL_VERTEX_ARRAY)
        names.glDrawArrays(names.GL_TRIANGLES, 0, 20)
        names.end_step("draw")
    assert one.calls[0].text == "glVertexPointer(3, GL_FLOAT, 0, float32 (20, 3))"
    text = "glDrawArrays(GL_TRIANGLES, 0, 20)"
    assert call_difference(one.calls, other.calls) == f"@@ draw\n- {text}\n+ {text}, other values"
    assert call_difference(one.calls, one.calls) == ""


def test_difference_in_many_places_is_told_of_the_first() -> None:
    one, other = RecordedNames(gl, ()), RecordedNames(gl, ())
    for names, step in ((one, 1), (other, 2)):
        for width in range(1, MOST_PLACES + 4):
            names.glDepthFunc(names.GL_LESS)
            names.glLineWidth(width + 100 * step)
            names.glDepthFunc(names.GL_LEQUAL)
        names.end_step("draw")
    lines = call_difference(one.calls, other.calls).splitlines()
    assert len(lines) == 1 + 2 * MOST_PLACES + 1
    assert lines[-1] == "@@ and in 3 more places"


def test_difference_that_repeats_is_told_once() -> None:
    one, other = RecordedNames(gl, ()), RecordedNames(gl, ())
    for names, func in ((one, "GL_LESS"), (other, "GL_LEQUAL")):
        for width in range(1, 4):
            names.glLineWidth(width)
            names.glDepthFunc(getattr(names, func))
        names.end_step("draw")
    expected = "@@ draw\n- glDepthFunc(GL_LESS)\n+ glDepthFunc(GL_LEQUAL)\n  (3 times)"
    assert call_difference(one.calls, other.calls) == expected
