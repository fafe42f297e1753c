"""Names with extension suffixes are those of Mesa, and two-sided stencil from before GL 2.0 draws as in Mesa."""

import inspect
from typing import Any

import numpy as np
import pytest

from softshadow import gl
from softshadow.testing import run_on_mesa

SIZE = (24, 16)
NAMES = [name for name in gl.__all__ if name not in dir(gl)]


def values(namespace: Any) -> dict[str, Any]:
    """What each name stands for: its number, or that it can be called."""
    values = {name: getattr(namespace, name) for name in NAMES}
    return {name: "call" if callable(value) else int(value) for name, value in values.items()}


@pytest.mark.mesa
def test_names_of_extensions_are_those_of_mesa():
    assert values(gl) == run_on_mesa(values, SIZE).returned
    assert len(NAMES) > 300


def test_every_name_is_imported_with_a_star():
    namespace: dict[str, Any] = {}
    exec("from softshadow.gl import *", namespace)
    assert namespace.keys() - {"__builtins__"} == set(gl.__all__)
    assert namespace["glActiveTextureARB"] is gl.glActiveTexture
    assert not any(inspect.ismodule(value) for value in namespace.values())


@pytest.mark.parametrize(
    ("name", "ends"),
    [
        ("glStencilFnc", "; did you mean 'glStencilFunc'?"),
        ("GL_STENCIL_TST", "; did you mean 'GL_STENCIL_TEST'?"),
        ("GL_XYZZY_ARB", "of OpenGL"),
    ],
)
def test_wrong_name_is_told_the_nearest(name, ends):
    with pytest.raises(AttributeError, match=f"{name} is not part of this subset of OpenGL") as raised:
        getattr(gl, name)
    assert str(raised.value).endswith(ends)


def two_sided_volume(gl: Any) -> Any:
    """A shadow volume's counting pass with GL_EXT_stencil_two_side, then GL 2.0's and ATI's calls among it."""
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glEnable(gl.GL_STENCIL_TEST_TWO_SIDE_EXT)
    for face, op in ((gl.GL_BACK, gl.GL_INCR_WRAP_EXT), (gl.GL_FRONT, gl.GL_DECR_WRAP_EXT)):
        gl.glActiveStencilFaceEXT(face)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, op)
        gl.glStencilMask(0xFF)
        gl.glStencilFunc(gl.GL_ALWAYS, 3, 0x0F)
    draw_both_facings(gl, -1.0)
    gl.glStencilFuncSeparateATI(gl.GL_EQUAL, gl.GL_NEVER, 255, 0xFF)  # GL 2.0's back state is not in use
    gl.glStencilOpSeparateATI(gl.GL_BACK, gl.GL_INVERT, gl.GL_ZERO, gl.GL_ZERO)
    draw_both_facings(gl, -0.5)
    gl.glActiveStencilFaceEXT(gl.GL_BACK)
    gl.glStencilFunc(gl.GL_GREATER, 9, 0x7F)
    states = [stencil_state(gl)]
    gl.glDisable(gl.GL_STENCIL_TEST_TWO_SIDE_EXT)
    draw_both_facings(gl, 0.0)
    return [*states, stencil_state(gl)]


def popped_side(gl: Any) -> Any:
    """glPopAttrib brings the active face and the switch back, not the extension's back state."""
    gl.glPushAttrib(gl.GL_STENCIL_BUFFER_BIT)
    gl.glEnable(gl.GL_STENCIL_TEST_TWO_SIDE_EXT)
    gl.glActiveStencilFaceEXT(gl.GL_BACK)
    gl.glStencilFunc(gl.GL_GREATER, 9, 0x7F)
    gl.glPopAttrib()
    states = [stencil_state(gl)]
    gl.glActiveStencilFaceEXT(gl.GL_BACK)
    return [*states, stencil_state(gl)]


def draw_both_facings(gl: Any, left: float) -> None:
    for corners in (((0, -1), (1, -1), (0.5, 1)), ((0.25, 1), (0.75, 1), (0.5, -1))):
        for order in (1, -1):
            gl.glBegin(gl.GL_TRIANGLES)
            for x, y in corners[:: order if left else 1]:
                gl.glVertex2f(left + x, y)
            gl.glEnd()


def stencil_state(gl: Any) -> list[int]:
    names = ("FUNC", "REF", "VALUE_MASK", "FAIL", "PASS_DEPTH_FAIL", "PASS_DEPTH_PASS", "WRITEMASK")
    tokens = [f"GL_STENCIL_{face}{name}" for face in ("", "BACK_") for name in names]
    tokens += ["GL_ACTIVE_STENCIL_FACE_EXT", "GL_STENCIL_TEST_TWO_SIDE_EXT"]
    return [int(gl.glGetIntegerv(getattr(gl, token))) for token in tokens]


@pytest.mark.mesa
def test_two_sided_stencil_of_the_extension_is_that_of_mesa():
    with gl.create_context(*SIZE):
        states = two_sided_volume(gl)
        ours = gl.glReadPixels(0, 0, *SIZE, gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE)
    theirs = run_on_mesa(two_sided_volume, SIZE)
    assert states == theirs.returned
    np.testing.assert_array_equal(ours, theirs.stencil)
    assert len(np.unique(ours)) >= 3


@pytest.mark.mesa
def test_popped_sides_are_those_of_mesa():
    with gl.create_context(*SIZE):
        assert popped_side(gl) == run_on_mesa(popped_side, SIZE).returned


def test_state_with_two_sides_prints_as_the_calls_that_make_it():
    with gl.create_context(*SIZE) as context:
        gl.glEnable(gl.GL_STENCIL_TEST_TWO_SIDE_EXT)
        gl.glActiveStencilFaceEXT(gl.GL_BACK)
        gl.glStencilMask(3)
        calls = context.state.stencil.calls()
    assert calls[1:3] == ["glEnable(GL_STENCIL_TEST_TWO_SIDE_EXT)", "glActiveStencilFaceEXT(GL_FRONT)"]
    assert calls[-2] == "glStencilMask(0x03)"
