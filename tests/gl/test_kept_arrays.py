"""Arrays that are read-only already are drawn as they are; all others are copied."""

import numpy as np
import pytest

from softshadow import gl
from softshadow.gl import array_snapshots as kept_arrays

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


@pytest.mark.parametrize("kind", [bytearray, bytes])
def test_of_buffers_only_bytes_cannot_change(context, kind):
    memory = kind(np.array([0, 1, 2], np.uint32).tobytes())
    indices = memoryview(memory).toreadonly() if kind is bytearray else memory
    gl.glVertexPointer(4, gl.GL_FLOAT, 0, frozen(CORNERS))
    gl.glDrawElements(gl.GL_TRIANGLES, 3, gl.GL_UNSIGNED_INT, indices)
    if kind is bytearray:
        memory[:] = bytes(12)
    assert last_draw(context).indices.tolist() == [0, 1, 2]


def test_indices_are_checked_at_every_draw(context):
    gl.glVertexPointer(4, gl.GL_FLOAT, 0, frozen(CORNERS))
    indices = frozen(np.array([0, 1, 2], np.int32))
    gl.glDrawElements(gl.GL_TRIANGLES, 3, gl.GL_UNSIGNED_INT, indices)
    for wrong, message in ((3, "vertex 3 is asked for, the array of positions has 3"), (-1, "index -1 is negative")):
        indices.setflags(write=True)
        indices[2] = wrong
        indices.setflags(write=False)
        with pytest.raises(ValueError, match=message):
            gl.glDrawElements(gl.GL_TRIANGLES, 3, gl.GL_UNSIGNED_INT, indices)


@pytest.mark.parametrize("count", [0, 1, 5])
def test_a_row_that_is_spread_is_there_once(count):
    row = np.array([1, -0.0, np.nan], np.float32)
    made = kept_arrays.spread(row, count)
    expected = np.broadcast_to(row, (count, 3))
    assert made.shape == expected.shape
    assert made.tobytes() == expected.tobytes()
    assert made.strides[0] == 0
    assert not made.flags.writeable
