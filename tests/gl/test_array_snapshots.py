"""Immutable arrays are recorded without a copy; all others are copied once for each of their contents."""

import numpy as np
import pytest

from softshadow import gl
from softshadow.gl import constant_attributes

CORNERS = np.array([(-1, -1, 0, 1), (3, -1, 0, 1), (-1, 3, 0, 1)], np.float32)


@pytest.fixture
def context():
    context = gl.create_context(4, 4)
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    return context


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


def test_recorded_indices_are_always_a_copy(context):
    """Kernels do not check bounds, and the owner of a read-only array can make it writeable again."""
    indices = frozen(np.array([0, 1, 2], np.uint32))
    gl.glVertexPointer(4, gl.GL_FLOAT, 0, CORNERS)
    gl.glDrawElements(gl.GL_TRIANGLES, 3, gl.GL_UNSIGNED_INT, indices)
    assert not np.shares_memory(last_draw(context).indices, indices)


def test_arrays_that_become_writeable_are_read_again(context):
    corners = frozen(CORNERS)
    gl.glVertexPointer(4, gl.GL_FLOAT, 0, corners)
    gl.glDrawArrays(gl.GL_TRIANGLES, 0, 3)
    corners.setflags(write=True)
    for x in (-0.5, 0.5):
        corners[1, 0] = x
        gl.glDrawArrays(gl.GL_TRIANGLES, 0, 3)
        assert (last_draw(context).vertices.position == corners).all()


def test_recorded_arrays_do_not_change_with_the_callers_arrays(context):
    corners, indices = CORNERS.copy(), np.array([0, 1, 2], np.uint32)
    views = corners.view(), indices.view()
    for view in views:
        view.setflags(write=False)  # the memory is still writeable
    gl.glVertexPointer(4, gl.GL_FLOAT, 0, views[0])
    gl.glDrawElements(gl.GL_TRIANGLES, 3, gl.GL_UNSIGNED_INT, views[1])
    corners[:], indices[:] = 0, 0
    assert (last_draw(context).vertices.position == CORNERS).all()
    assert last_draw(context).indices.tolist() == [0, 1, 2]


@pytest.mark.parametrize("kind", [bytearray, bytes])
def test_buffers_other_than_bytes_are_copied(context, kind):
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
    for wrong, message in (
        (3, "vertex 3 is outside the array of positions, which has 3"),
        (-1, "index -1 is negative"),
    ):
        indices.setflags(write=True)
        indices[2] = wrong
        indices.setflags(write=False)
        with pytest.raises(ValueError, match=message):
            gl.glDrawElements(gl.GL_TRIANGLES, 3, gl.GL_UNSIGNED_INT, indices)


@pytest.mark.parametrize("count", [0, 1, 5])
def test_repeated_rows_share_their_memory(count):
    row = np.array([1, -0.0, np.nan], np.float32)
    rows = constant_attributes.repeat_row(row, count)
    expected = np.broadcast_to(row, (count, 3))
    assert rows.shape == expected.shape
    assert rows.tobytes() == expected.tobytes()
    assert rows.strides[0] == 0
    assert not rows.flags.writeable
