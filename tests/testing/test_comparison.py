"""Differences are counted per pixel and located in both conventions."""

import numpy as np
import pytest

from softshadow.testing import Comparison, ProgramResult, difference, differences


def result(**changed):
    planes = {
        "color": np.zeros((4, 6, 4), np.uint8),
        "depth": np.zeros((4, 6), np.uint32),
        "stencil": np.zeros((4, 6), np.uint8),
    }
    return ProgramResult(**(planes | changed))


def test_equal_buffers_have_no_difference():
    assert differences(result(), result()) == ()
    comparison = Comparison(result(), result(), ())
    assert comparison
    assert str(comparison) == "no pixel differs"


def test_a_pixel_counts_once_however_many_channels_differ():
    color = np.zeros((4, 6, 4), np.uint8)
    color[1, 2, :3] = 9
    color[3, 0, 1] = 1
    (found,) = differences(result(color=color), result())
    assert (found.buffer, found.count, found.x, found.y, found.y_from_top) == ("color", 2, 2, 1, 2)
    assert (found.ours, found.theirs) == ([9, 9, 9, 0], [0, 0, 0, 0])


def test_a_difference_prints_both_rows_and_both_values():
    depth = np.zeros((4, 6), np.uint32)
    depth[0, 5] = 16777215
    (found,) = differences(result(), result(depth=depth))
    assert str(found) == "depth: 1 differ, first at x=5, y=0 (row 3 from the top): 0 and 16777215"


def test_returned_arrays_are_compared_too():
    ours = result(returned=[np.zeros((2, 2), np.float32), "a word", np.array([1, 2, 3])])
    theirs = result(returned=[np.zeros((2, 2), np.float32), "another", np.array([1, 5, 3])])
    (found,) = differences(ours, theirs)
    assert (found.buffer, found.count, found.x, found.ours, found.theirs) == ("returned[2]", 1, 1, 2, 5)


def test_nan_equals_nan_and_minus_zero_equals_zero():
    assert difference("returned[0]", np.array([[np.nan, 0.0]]), np.array([[np.nan, -0.0]])) is None


def test_different_shapes_are_refused():
    with pytest.raises(ValueError, match="depth: shapes"):
        differences(result(depth=np.zeros((1, 1), np.uint32)), result())
