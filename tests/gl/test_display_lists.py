"""Display lists record calls, not their results."""

import numpy as np
import pytest

from gl.gl_state import make
from softshadow import gl

SIZE = (8, 6)


@pytest.fixture(autouse=True)
def context():
    with gl.create_context(*SIZE) as context:
        yield context


def test_compiling_carries_nothing_out():
    gl.glNewList(1, gl.GL_COMPILE)
    gl.glEnable(gl.GL_BLEND)
    gl.glTranslatef(1, 0, 0)
    gl.glEndList()
    assert not gl.glIsEnabled(gl.GL_BLEND)
    np.testing.assert_array_equal(gl.glGetFloatv(gl.GL_MODELVIEW_MATRIX), np.eye(4))


def test_compile_and_execute_carries_out_and_keeps(context):
    gl.glNewList(1, gl.GL_COMPILE_AND_EXECUTE)
    gl.glTranslatef(1, 0, 0)
    gl.glRectf(-1, -1, 1, 1)
    gl.glEndList()
    assert len(context.frame.commands) == 1
    gl.glCallList(1)
    assert len(context.frame.commands) == 2
    assert gl.glGetFloatv(gl.GL_MODELVIEW_MATRIX)[3, 0] == 2


def test_calls_that_ask_or_make_objects_are_carried_out_at_once():
    gl.glNewList(1, gl.GL_COMPILE)
    gl.glEnable(gl.GL_BLEND)
    assert not gl.glIsEnabled(gl.GL_BLEND)
    assert gl.glGetIntegerv(gl.GL_LIST_INDEX) == 1
    assert gl.glGetIntegerv(gl.GL_LIST_MODE) == gl.GL_COMPILE
    texture = gl.glGenTextures(1)
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    gl.glEndList()
    assert texture == 1
    assert gl.glGetBooleanv(gl.GL_VERTEX_ARRAY)


def test_list_may_call_lists_and_be_half_a_primitive(context):
    gl.glNewList(1, gl.GL_COMPILE)
    gl.glVertex2f(0, 0)
    gl.glEndList()
    gl.glNewList(2, gl.GL_COMPILE)
    gl.glCallList(1)
    gl.glVertex2f(1, 0)
    gl.glEndList()
    gl.glBegin(gl.GL_TRIANGLES)
    gl.glCallList(2)
    gl.glVertex2f(0, 1)
    gl.glEnd()
    drawn = context.frame.commands[-1].vertices.position[:, :2]
    np.testing.assert_array_equal(drawn, [[0, 0], [1, 0], [0, 1]])


def test_list_that_calls_itself_ends():
    gl.glNewList(1, gl.GL_COMPILE)
    gl.glTranslatef(1, 0, 0)
    gl.glCallList(1)
    gl.glEndList()
    gl.glCallList(1)
    assert gl.glGetFloatv(gl.GL_MODELVIEW_MATRIX)[3, 0] == gl.glGetIntegerv(gl.GL_MAX_LIST_NESTING)


def test_arrays_of_a_list_are_those_of_when_it_was_made():
    matrix = np.eye(4, dtype=np.float32)
    gl.glNewList(1, gl.GL_COMPILE)
    gl.glMultMatrixf(matrix)
    gl.glEndList()
    matrix[:] = 7
    gl.glCallList(1)
    np.testing.assert_array_equal(gl.glGetFloatv(gl.GL_MODELVIEW_MATRIX), np.eye(4))


def test_several_lists_are_counted_from_the_base():
    first = gl.glGenLists(3)
    for step in range(3):
        gl.glNewList(first + step, gl.GL_COMPILE)
        gl.glTranslatef(10**step, 0, 0)
        gl.glEndList()
    gl.glListBase(first)
    gl.glCallLists(np.array([2, 0, 2], np.uint8))
    assert gl.glGetFloatv(gl.GL_MODELVIEW_MATRIX)[3, 0] == 201
    gl.glListBase(first - ord("a"))
    gl.glCallLists("b")
    assert gl.glGetFloatv(gl.GL_MODELVIEW_MATRIX)[3, 0] == 211


def test_names_are_given_in_a_row_and_taken_back():
    gl.glNewList(2, gl.GL_COMPILE)
    gl.glEndList()
    first = gl.glGenLists(2)
    assert first == 3
    assert gl.glIsList(first + 1)
    gl.glDeleteLists(first, 2)
    assert not gl.glIsList(first + 1)
    assert gl.glGenLists(0) == 0


def test_wrong_calls_have_their_error_codes():
    with gl.create_context(*SIZE, raise_errors=False):
        codes = make(
            gl,
            [
                ("glNewList", (0, "GL_COMPILE")),
                ("glNewList", (1, "GL_LESS")),
                ("glEndList", ()),
                ("glGenLists", (-1,)),
                ("glDeleteLists", (1, -1)),
                ("glCallList", (0,)),
                ("glNewList", (1, "GL_COMPILE")),
                ("glNewList", (2, "GL_COMPILE")),
            ],
        )
    value, operation = gl.GL_INVALID_VALUE, gl.GL_INVALID_OPERATION
    assert codes == [value, gl.GL_INVALID_ENUM, operation, value, value, value, 0, operation]


def test_errors_in_a_list_do_not_stop_it():
    gl.glNewList(1, gl.GL_COMPILE)
    gl.glEnable(gl.GL_LESS)
    gl.glCallList(0)
    gl.glDrawArrays(gl.GL_LESS, 0, 3)
    gl.glEnable(gl.GL_BLEND)
    gl.glEndList()
    assert gl.glGetError() == gl.GL_NO_ERROR
    with pytest.raises(gl.GLError, match="glEnable"):
        gl.glCallList(1)
    assert gl.glGetError() == gl.GL_INVALID_ENUM
    assert gl.glIsEnabled(gl.GL_BLEND)


def test_errors_in_a_list_do_not_stop_the_lists_after_it():
    for name, cap in ((1, gl.GL_LESS), (2, gl.GL_BLEND)):
        gl.glNewList(name, gl.GL_COMPILE)
        gl.glEnable(cap)
        gl.glEndList()
    with pytest.raises(gl.GLError, match="glEnable"):
        gl.glCallLists(np.array([1, 2], np.uint32))
    assert gl.glIsEnabled(gl.GL_BLEND)


def test_list_that_ends_in_an_open_primitive_ends_with_an_error():
    gl.glNewList(1, gl.GL_COMPILE_AND_EXECUTE)
    gl.glBegin(gl.GL_LINES)
    with pytest.raises(gl.GLError, match="glEndList"):
        gl.glEndList()
    gl.glEnd()
    assert gl.glIsList(1)
    assert gl.glGetError() == gl.GL_INVALID_OPERATION


@pytest.mark.parametrize(("name", "mode"), [(0, gl.GL_COMPILE), (2, gl.GL_LESS), (2, gl.GL_COMPILE)])
def test_list_cannot_start_in_another(name, mode):
    gl.glNewList(1, gl.GL_COMPILE)
    with pytest.raises(gl.GLError, match="GL_INVALID_OPERATION"):
        gl.glNewList(name, mode)
