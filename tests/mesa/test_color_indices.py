"""Colour indices are state that is set, pushed, restored and queried as in Mesa, and draw nothing."""

from typing import Any

import numpy as np
import pytest

from softshadow import gl
from softshadow.testing import compare

pytestmark = pytest.mark.mesa
SIZE = (32, 24)
FLOATS = np.array([[2.5], [7.25], [-3.0]], np.float32)
CORNERS = np.array([[-0.8, -0.9], [0.9, -0.3], [0.1, 0.8]], np.float32)
STATE = ("CURRENT_INDEX", "INDEX_CLEAR_VALUE", "INDEX_WRITEMASK", "INDEX_LOGIC_OP", "INDEX_MODE", "INDEX_BITS",
         "CURRENT_RASTER_INDEX", "INDEX_ARRAY", "INDEX_ARRAY_TYPE", "INDEX_ARRAY_STRIDE",
         "INDEX_ARRAY_BUFFER_BINDING", "RGBA_MODE")  # fmt: skip


def asked(gl: Any) -> list[float]:
    """Return all state of colour indices, in three types."""
    tokens = [getattr(gl, f"GL_{name}") for name in STATE]
    answers = [read(token) for token in tokens for read in (gl.glGetFloatv, gl.glGetIntegerv, gl.glGetBooleanv)]
    return [float(np.ravel(answer)[0]) for answer in answers]


def calls(gl: Any) -> list[Any]:
    """Return the state after each kind of call, and errors."""
    told = [asked(gl)]
    for name, values in (
        ("d", (3.75,)), ("f", (1e30,)), ("i", (-70000,)), ("s", (-5,)), ("ub", (200,)), ("dv", ([0.1],)),
        ("fv", ([4.5],)), ("iv", (np.array([123456789], np.int32),)), ("sv", ([77],)), ("ubv", ([255],)),
    ):  # fmt: skip
        getattr(gl, f"glIndex{name}")(*values)
        told.append(asked(gl))
    for mask, clear in ((0x0F0F, 3.9), (0xFFFFFFFF, -2.5), (0, 5e9), (1, 1e30)):
        gl.glIndexMask(mask)
        gl.glClearIndex(clear)
        told.append(asked(gl))
    gl.glEnable(gl.GL_INDEX_LOGIC_OP)
    told.append([*asked(gl), float(gl.glIsEnabled(gl.GL_INDEX_LOGIC_OP))])
    return told


def stacks_and_lists(gl: Any) -> list[Any]:
    """Return the state between pushes, pops and calls of a list."""
    told = []
    gl.glNewList(1, gl.GL_COMPILE)
    gl.glIndexf(41.5)
    gl.glIndexMask(0x77)
    gl.glClearIndex(9)
    gl.glEndList()
    told.append(asked(gl))
    for bit in ("CURRENT_BIT", "COLOR_BUFFER_BIT", "ENABLE_BIT", "ALL_ATTRIB_BITS", "LIGHTING_BIT"):
        gl.glPushAttrib(getattr(gl, f"GL_{bit}"))
        gl.glIndexi(len(told))
        gl.glIndexMask(len(told) * 3)
        gl.glClearIndex(len(told) * 5)
        gl.glEnable(gl.GL_INDEX_LOGIC_OP)
        told.append(asked(gl))
        gl.glCallList(1)
        told.append(asked(gl))
        gl.glPopAttrib()
        told.append(asked(gl))
        gl.glDisable(gl.GL_INDEX_LOGIC_OP)
    return told


def arrays(gl: Any) -> list[Any]:
    """Return the state while arrays of indices are set and drawn with; draw a triangle with each."""
    told = [asked(gl)]
    gl.glVertexPointer(2, gl.GL_FLOAT, 0, CORNERS)
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    gl.glEnableClientState(gl.GL_INDEX_ARRAY)
    for kind, dtype, stride in (("FLOAT", np.float32, 0), ("UNSIGNED_BYTE", np.uint8, 1), ("SHORT", np.int16, 4),
                                ("INT", np.int32, 4), ("DOUBLE", np.float64, 8)):  # fmt: skip
        indices = np.arange(12).astype(dtype)
        gl.glIndexPointer(getattr(gl, f"GL_{kind}"), stride, indices)
        gl.glDrawArrays(gl.GL_TRIANGLES, 0, 3)
        told.append(asked(gl))
        gl.glBegin(gl.GL_TRIANGLES)
        for i in range(3):
            gl.glArrayElement(i)
        gl.glEnd()
        told.append(asked(gl))
    gl.glBindBuffer(gl.GL_ARRAY_BUFFER, gl.glGenBuffers(1))
    gl.glBufferData(gl.GL_ARRAY_BUFFER, FLOATS, gl.GL_STATIC_DRAW)
    gl.glIndexPointer(gl.GL_FLOAT, 0, None)
    told.append(asked(gl))
    gl.glPushClientAttrib(gl.GL_CLIENT_VERTEX_ARRAY_BIT)
    gl.glDisableClientState(gl.GL_INDEX_ARRAY)
    gl.glBindBuffer(gl.GL_ARRAY_BUFFER, 0)
    told.append(asked(gl))
    gl.glInterleavedArrays(gl.GL_V2F, 0, CORNERS)
    gl.glPopClientAttrib()
    told.append(asked(gl))
    gl.glBindBuffer(gl.GL_ARRAY_BUFFER, 0)
    gl.glInterleavedArrays(gl.GL_V2F, 0, CORNERS)
    told.append(asked(gl))
    return told


def between_begin_and_end(gl: Any) -> list[Any]:
    """Draw quads and lines with an index for each vertex, and return the state."""
    told = []
    for mode in (gl.GL_QUADS, gl.GL_LINE_STRIP, gl.GL_TRIANGLES):
        for side in (0.9, 0.5):
            gl.glBegin(mode)
            for corner, (x, y) in enumerate(((-1, -1), (1, -0.9), (0.8, 1), (-0.7, 0.6), (0.1, 0), (0.2, 0.3))):
                if corner > 1:
                    gl.glIndexi(corner)
                gl.glColor3f(0.3 * corner % 1, side, 0.2)
                gl.glVertex2f(x * side, y * side)
            gl.glEnd()
        told.append(asked(gl))
    return told


def check(program: Any) -> None:
    compared = compare(lambda gl: [np.array(each, np.float64) for each in program(gl)], SIZE)
    assert compared, str(compared)


def test_every_call_sets_the_state_of_mesa() -> None:
    check(calls)


def test_stacks_and_lists_restore_and_set_the_state_of_mesa() -> None:
    check(stacks_and_lists)


def test_arrays_of_indices_change_no_pixel_and_set_the_current_index() -> None:
    check(arrays)


def test_vertices_carry_indices_and_draw_the_pixels_of_mesa() -> None:
    check(between_begin_and_end)


def test_indices_are_numbers_and_other_types_of_arrays_are_errors() -> None:
    with gl.create_context(4, 4):
        with pytest.raises(TypeError, match=r"glIndexf\(c='2'\): expected a number"):
            gl.glIndexf("2")
        with pytest.raises(gl.GLError, match="GL_INVALID_ENUM"):
            gl.glIndexPointer(gl.GL_UNSIGNED_SHORT, 0, FLOATS)
        gl.glBegin(gl.GL_LINES)
        for call in (gl.glIndexMask, gl.glClearIndex):
            with pytest.raises(gl.GLError, match="GL_INVALID_OPERATION"):
                call(1)
