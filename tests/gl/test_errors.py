"""Refused calls: raised with a helpful message, recorded for glGetError."""

from typing import Any

import pytest

from softshadow import gl
from softshadow.errors import StateError
from softshadow.testing import run_on_mesa

SIZE = (8, 6)
# allowed between glBegin and glEnd (GL 2.1, sec. 2.6.3), besides vertices and their attributes
OUTSIDE_ONLY = {
    "glEnable": ("GL_BLEND",), "glDisable": ("GL_BLEND",), "glDepthFunc": ("GL_LESS",), "glDepthMask": (1,),
    "glStencilFunc": ("GL_LESS", 0, 255), "glStencilOp": ("GL_KEEP",) * 3, "glColorMask": (1, 1, 1, 1),
    "glBlendFunc": ("GL_ONE", "GL_ONE"), "glClear": ("GL_COLOR_BUFFER_BIT",), "glClearColor": (0, 0, 0, 0),
    "glCullFace": ("GL_BACK",), "glViewport": (0, 0, 1, 1), "glScissor": (0, 0, 1, 1), "glMatrixMode": ("GL_TEXTURE",),
    "glLoadIdentity": (), "glTranslatef": (1, 2, 3), "glPushMatrix": (), "glPushAttrib": ("GL_FOG_BIT",),
    "glLightf": ("GL_LIGHT0", "GL_SPOT_EXPONENT", 1), "glFogf": ("GL_FOG_START", 1), "glShadeModel": ("GL_FLAT",),
    "glBindTexture": ("GL_TEXTURE_2D", 0), "glPolygonOffset": (1, 1), "glBegin": ("GL_QUADS",), "glGenLists": (1,),
    "glNewList": (1, "GL_COMPILE"), "glFinish": (), "glFlush": (), "glHint": ("GL_FOG_HINT", "GL_NICEST"),
}  # fmt: skip


@pytest.mark.parametrize(
    ("call", "arguments", "message"),
    [
        ("glDepthFunc", ("GL_KEEP",), "GL_INVALID_ENUM: glDepthFunc(func=GL_KEEP): expected GL_NEVER … GL_ALWAYS"),
        ("glBegin", (12,), "GL_INVALID_ENUM: glBegin(mode=12): expected GL_POINTS … GL_POLYGON"),
        ("glLineWidth", (-1,), "GL_INVALID_VALUE: glLineWidth(width=-1): expected more than 0"),
        ("glPopMatrix", (), "GL_STACK_UNDERFLOW: glPopMatrix: there was no glPushMatrix before it"),
        ("glEnd", (), "GL_INVALID_OPERATION: glEnd: there was no glBegin before it"),
        ("glEnable", ("GL_LESS",), "GL_INVALID_ENUM: glEnable(cap=GL_LESS): expected a capability of this subset"),
    ],
)
def test_message_names_the_call_the_argument_and_what_was_expected(call, arguments, message):
    with gl.create_context(*SIZE), pytest.raises(gl.GLError) as raised:
        getattr(gl, call)(*(getattr(gl, a) if isinstance(a, str) else a for a in arguments))
    assert str(raised.value) == message
    assert raised.value.operation == call


def test_error_is_raised_and_recorded_until_it_is_asked_for():
    with gl.create_context(*SIZE):
        with pytest.raises(gl.GLError) as raised:
            gl.glDepthFunc(gl.GL_KEEP)
        assert raised.value.err == gl.GL_INVALID_ENUM
        assert (raised.value.baseOperation, raised.value.result) == ("glDepthFunc", None)
        assert raised.value.description == "invalid enumerant"
        assert (gl.glGetError(), gl.glGetError()) == (gl.GL_INVALID_ENUM, gl.GL_NO_ERROR)


def test_first_error_stands_until_it_is_asked_for():
    with gl.create_context(*SIZE, raise_errors=False):
        gl.glLineWidth(-1)
        gl.glDepthFunc(gl.GL_KEEP)
        assert gl.glGetError() == gl.GL_INVALID_VALUE


def inside(namespace: Any, name: str) -> int:
    """Return the error code of a call between glBegin and glEnd."""
    arguments = [getattr(namespace, a) if isinstance(a, str) else a for a in OUTSIDE_ONLY[name]]
    namespace.glBegin(namespace.GL_TRIANGLES)
    getattr(namespace, name)(*arguments)
    namespace.glEnd()
    return int(namespace.glGetError())


def test_state_stands_still_between_begin_and_end():
    with gl.create_context(*SIZE, raise_errors=False):
        assert {name: inside(gl, name) for name in OUTSIDE_ONLY} == dict.fromkeys(OUTSIDE_ONLY, gl.GL_INVALID_OPERATION)


@pytest.mark.mesa
def test_state_stands_still_between_begin_and_end_on_mesa():
    def program(namespace: Any) -> dict[str, int]:
        return {name: inside(namespace, name) for name in OUTSIDE_ONLY}

    codes = run_on_mesa(program, SIZE, raise_errors=False).returned
    assert codes == dict.fromkeys(OUTSIDE_ONLY, gl.GL_INVALID_OPERATION)


def test_incomplete_framebuffer_cannot_be_drawn_to_or_cleared():
    with gl.create_context(*SIZE, raise_errors=False):
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
        for draw in (lambda: gl.glBegin(gl.GL_QUADS), lambda: gl.glClear(gl.GL_COLOR_BUFFER_BIT)):
            draw()
            assert gl.glGetError() == gl.GL_INVALID_FRAMEBUFFER_OPERATION


@pytest.mark.parametrize("name", ["glTessellate", "glCreateShader", "GL_TEXTURE_4D_SGIS"])
def test_name_outside_the_subset_is_said_to_be_so(name):
    with pytest.raises(AttributeError, match=f"{name} is not part of this subset of OpenGL"):
        getattr(gl, name)


def test_namespace_holds_nothing_but_gl():
    own = {"Context", "GLError", "create_context", "describe_primitives", "program", "record", "step"}
    assert {name for name in dir(gl) if not name.startswith(("gl", "GL_", "GLU_"))} == own


def test_context_before_is_current_again_after_with():
    with gl.create_context(3, 3) as outer:
        with gl.create_context(4, 4):
            gl.glViewport(0, 0, 2, 2)
        assert gl.current() is outer
        assert gl.glGetIntegerv(gl.GL_VIEWPORT)[2] == 3


def test_call_without_a_context_says_what_to_do():
    before = gl.make_current(None)
    try:
        with pytest.raises(StateError, match="create_context"):
            gl.glEnable(gl.GL_BLEND)
    finally:
        gl.make_current(before)
