"""Arrays that are read-only already are drawn as they are; all others are copied."""

import numpy as np
import pytest

from softshadow import gl
from softshadow.gl import kept_arrays

CORNERS = np.array([(-1, -1, 0, 1), (3, -1, 0, 1), (-1, 3, 0, 1)], np.float32)


@pytest.fixture
def context():
    made = gl.create_context(4, 4)
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    return made


def frozen(array: np.ndarray) -> np.ndarray:
    array = array.copy()
    array.setflags(write=False)
    return array


def last_draw(context):
    return context.frame.commands[-1]


def test_read_only_arrays_are_not_copied(context):
    corners, indices = frozen(CORNERS), frozen(np.array([0, 1, 2], np.uint32))
    gl.glVertexPointer(4, gl.GL_FLOAT, 0, corners)
    gl.glDrawElements(gl.GL_TRIANGLES, 3, gl.GL_UNSIGNED_INT, indices)
    assert np.shares_memory(last_draw(context).vertices.position, corners)
    assert np.shares_memory(last_draw(context).indices, indices)


def test_what_is_recorded_does_not_change_with_the_callers_arrays(context):
    corners, indices = CORNERS.copy(), np.array([0, 1, 2], np.uint32)
    views = corners.view(), indices.view()
    for view in views:
        view.setflags(write=False)  # the memory can be written to all the same
    gl.glVertexPointer(4, gl.GL_FLOAT, 0, views[0])
    gl.glDrawElements(gl.GL_TRIANGLES, 3, gl.GL_UNSIGNED_INT, views[1])
    corners[:], indices[:] = 0, 0
    assert (last_draw(context).vertices.position == CORNERS).all()
    assert last_draw(context).indices.tolist() == [0, 1, 2]


@pytest.mark.parametrize("is_large", [False, True])
def test_the_largest_index_decides_how_many_vertices_there_have_to_be(context, monkeypatch, is_large):
    monkeypatch.setattr(kept_arrays, "LARGE", 0 if is_large else 4)
    gl.glVertexPointer(4, gl.GL_FLOAT, 0, frozen(CORNERS))
    for _ in range(2):  # the second time, what was found the first time is known
        indices = frozen(np.array([0, 1, 3], np.int32))
        with pytest.raises(ValueError, match="vertex 3 is asked for, the array of positions has 3"):
            gl.glDrawElements(gl.GL_TRIANGLES, 3, gl.GL_UNSIGNED_INT, indices)
        with pytest.raises(ValueError, match="index -1 is negative"):
            gl.glDrawElements(gl.GL_TRIANGLES, 3, gl.GL_UNSIGNED_INT, frozen(np.array([0, 1, -1], np.int32)))


@pytest.mark.parametrize("count", [0, 1, 5])
def test_a_row_that_is_spread_is_there_once(count):
    row = np.array([1, -0.0, np.nan], np.float32)
    made = kept_arrays.spread(row, count)
    expected = np.broadcast_to(row, (count, 3))
    assert made.shape == expected.shape
    assert made.tobytes() == expected.tobytes()
    assert made.strides[0] == 0
    assert not made.flags.writeable
