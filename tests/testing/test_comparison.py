"""Differences are counted per pixel, and located in both row orders."""

import numpy as np
import pytest

from softshadow.testing import ProgramComparison, ProgramResult, compare, difference, differences, run_here


def result(**changed):
    planes = {
        "color": np.zeros((4, 6, 4), np.uint8),
        "depth": np.zeros((4, 6), np.uint32),
        "stencil": np.zeros((4, 6), np.uint8),
    }
    return ProgramResult(**(planes | changed))


def test_equal_buffers_have_no_difference():
    assert differences(result(), result()) == ()
    comparison = ProgramComparison(result(), result(), ())
    assert comparison
    assert str(comparison) == "no pixel differs"


def test_a_pixel_counts_once_however_many_channels_differ():
    color = np.zeros((4, 6, 4), np.uint8)
    color[1, 2, :3] = 9
    color[3, 0, 1] = 1
    (first,) = differences(result(color=color), result())
    assert (first.buffer, first.count, first.x, first.y, first.y_from_top) == ("color", 2, 2, 1, 2)
    assert (first.ours, first.theirs) == ([9, 9, 9, 0], [0, 0, 0, 0])


def test_a_difference_prints_both_rows_and_both_values():
    depth = np.zeros((4, 6), np.uint32)
    depth[0, 5] = 16777215
    (first,) = differences(result(), result(depth=depth))
    assert str(first) == "depth: 1 differ, first at x=5, y=0 (row 3 from the top): 0 and 16777215"


def test_returned_arrays_are_compared_too():
    ours = result(returned=[np.zeros((2, 2), np.float32), "a word", np.array([1, 2, 3])])
    theirs = result(returned=[np.zeros((2, 2), np.float32), "another", np.array([1, 5, 3])])
    (first,) = differences(ours, theirs)
    assert (first.buffer, first.count, first.x, first.ours, first.theirs) == ("returned[2]", 1, 1, 2, 5)


@pytest.mark.parametrize(
    ("ours", "theirs", "name"),
    [
        (np.zeros(3), np.array([0, 1, 0]), "returned"),
        (7, 8, "returned"),
        ({"map": np.ones((2, 2))}, {"map": np.eye(2)}, "returned['map']"),
    ],
)
def test_what_is_returned_alone_or_in_a_dict_is_compared_too(ours, theirs, name):
    assert [each.buffer for each in differences(result(returned=ours), result(returned=theirs))] == [name]


def test_arrays_that_only_one_program_returns_are_named():
    with pytest.raises(ValueError, match=r"returned\[0\], returned\[1\] and returned\[0\]"):
        differences(result(returned=[1, 2]), result(returned=[1]))


def test_nan_equals_nan_and_minus_zero_equals_zero():
    assert difference("returned[0]", np.array([[np.nan, 0.0]]), np.array([[np.nan, -0.0]])) is None


def test_different_shapes_are_refused():
    with pytest.raises(ValueError, match="depth: shapes"):
        differences(result(depth=np.zeros((1, 1), np.uint32)), result())


def stencilled_triangle(gl):
    gl.glClearColor(0.2, 0.4, 0.6, 0.8)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT)
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_INCR)
    gl.glBegin(gl.GL_TRIANGLES)
    for x, y, z in ((-1, -1, 0), (1, -1, 0.5), (-1, 1, -0.5)):
        gl.glVertex3f(x, y, z)
    gl.glEnd()
    return [gl.glReadPixels(0, 0, 2, 1, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT)]


def test_a_program_runs_here_with_its_first_row_at_the_bottom():
    buffers = run_here(stencilled_triangle, (6, 4))
    assert buffers.stencil[0, 0] == 1
    assert buffers.stencil[3, 5] == 0
    np.testing.assert_array_equal(buffers.color[3, 5], [51, 102, 153, 204])
    np.testing.assert_array_equal(buffers.returned[0], (buffers.depth[:1, :2] / (2**24 - 1)).astype(np.float32))


def test_a_context_that_was_current_is_current_again_after_a_program():
    from softshadow import gl

    with gl.create_context(3, 3):
        run_here(stencilled_triangle, (6, 4))
        assert gl.glGetIntegerv(gl.GL_VIEWPORT)[2] == 3


@pytest.mark.mesa
def test_one_program_leaves_the_same_buffers_here_and_on_mesa():
    assert str(compare(stencilled_triangle, (6, 4))) == "no pixel differs"


@pytest.mark.mesa
def test_a_program_that_asks_where_it_runs_is_caught():
    def two_faced(gl):
        gl.glClearStencil(1 if b"Mesa" in gl.glGetString(gl.GL_VERSION) else 2)
        gl.glClear(gl.GL_STENCIL_BUFFER_BIT)

    comparison = compare(two_faced, (6, 4))
    assert not comparison
    first, _, history = str(comparison).partition("\n")
    assert first == "stencil: 24 differ, first at x=0, y=0 (row 3 from the top): 2 and 1"
    assert history.endswith("glClear: stencil 2")


@pytest.mark.mesa
def test_comparison_tells_the_history_of_the_first_differing_pixel():
    def program(gl):
        gl.glRectf(-0.5, -0.5, 0.5, 0.5 if gl.__name__ == "softshadow.gl" else 0.4)

    comparison = compare(program, (32, 32))
    assert not comparison
    assert comparison.history.gl_y == comparison.differences[0].y
    assert [row.verdict for row in comparison.history][-1] == "passed"
    assert str(comparison).endswith(str(comparison.history))
    assert compare(lambda gl: gl.glRectf(-1, -1, 1, 1), (32, 32)).history is None


def test_what_is_no_program_or_no_size_is_told():
    with pytest.raises(TypeError, match=r"program=None: expected a function program\(gl\)"):
        run_here(None, (4, 4))
    with pytest.raises(TypeError, match=r"size=64: expected \(width, height\)"):
        run_here(print, 64)
