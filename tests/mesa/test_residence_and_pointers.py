"""Residence and priorities of textures, and the pointers that GL has been given, are those of Mesa."""

import ctypes
from typing import Any

import numpy as np
import pytest

from softshadow import gl
from softshadow.testing import compare

pytestmark = pytest.mark.mesa
ARRAY = np.zeros((4, 4), np.float32)
POINTERS = [f"GL_{name}_ARRAY_POINTER" for name in ("VERTEX", "NORMAL", "COLOR", "INDEX", "TEXTURE_COORD", "EDGE_FLAG")]


def code_of(call: Any, *arguments: Any) -> int:
    """Return the error of a call, 0 if there is none."""
    try:
        call(*arguments)
    except Exception as error:  # GLError of either package
        return int(error.err)  # type: ignore[attr-defined]
    return 0


def residence(gl: Any) -> list[Any]:
    """Return who is resident, and priorities."""
    names = gl.glGenTextures(4)
    target = gl.GL_TEXTURE_2D
    told: list[Any] = []
    for name in names[:2]:
        gl.glBindTexture(target, name)

    def priorities() -> None:
        for name in names[:2]:
            gl.glBindTexture(target, name)
            for pname in (gl.GL_TEXTURE_PRIORITY, gl.GL_TEXTURE_RESIDENT):
                told.append([float(np.ravel(gl.glGetTexParameterfv(target, pname))[0]),
                             float(np.ravel(gl.glGetTexParameteriv(target, pname))[0])])  # fmt: skip

    priorities()
    told += [np.ravel(gl.glAreTexturesResident(names)), np.ravel(gl.glAreTexturesResident(2, names))]
    told.append(np.ravel(gl.glAreTexturesResident(2, names, np.zeros(2, np.uint8))))
    gl.glPrioritizeTextures(3, names, np.array([0.25, 7.0, 0.5], np.float32))
    priorities()
    gl.glPrioritizeTextures(
        4, np.array([0, names[1], 99, names[0]], np.uint32), np.array([1, -2, 0.5, 0.1], np.float32)
    )
    priorities()
    gl.glBindTexture(target, names[2])  # its priority was set before it became a texture
    told.append([float(np.ravel(gl.glGetTexParameterfv(target, gl.GL_TEXTURE_PRIORITY))[0])])
    gl.glNewList(1, gl.GL_COMPILE)
    gl.glPrioritizeTextures(2, names, np.array([0.75, 0.625], np.float32))
    gl.glEndList()
    priorities()
    gl.glCallList(1)
    priorities()
    gl.glDeleteTextures([int(names[3])])
    wrong = np.array([names[0], 99], np.uint32), np.array([0], np.uint32), names[3:]
    told.append([code_of(gl.glAreTexturesResident, name) for name in wrong])
    told.append([code_of(gl.glAreTexturesResident, -1, names, np.zeros(4, np.uint8)),
                 code_of(gl.glPrioritizeTextures, -1, names, np.zeros(4, np.float32))])  # fmt: skip
    gl.glPushAttrib(gl.GL_TEXTURE_BIT)
    gl.glPrioritizeTextures(1, names, np.array([0.125], np.float32))
    gl.glBindTexture(target, names[0])
    for value in (0.3, -1.0, 1.5):
        gl.glTexParameterf(target, gl.GL_TEXTURE_PRIORITY, value)
        priorities()
    gl.glPopAttrib()
    priorities()
    return told


def pointers(gl: Any) -> list[float]:
    """Return -1 for pointers to the arrays that were given, and the addresses of the others."""
    arrays = {name: ARRAY.copy() for name in POINTERS}
    bytes_of_flags, told = np.zeros(8, np.uint8), []

    def ask() -> None:
        for name in POINTERS[:-1]:
            address = int(gl.glGetPointerv(getattr(gl, name)))
            told.append(-1 if address == arrays[name].ctypes.data else address)

    ask()
    gl.glVertexPointer(4, gl.GL_FLOAT, 0, arrays[POINTERS[0]])
    gl.glNormalPointer(gl.GL_FLOAT, 16, arrays[POINTERS[1]])
    gl.glColorPointer(3, gl.GL_FLOAT, 16, arrays[POINTERS[2]])
    gl.glIndexPointer(gl.GL_FLOAT, 16, arrays[POINTERS[3]])
    gl.glTexCoordPointer(2, gl.GL_FLOAT, 16, arrays[POINTERS[4]])
    gl.glEdgeFlagPointer(0, bytes_of_flags)
    ask()
    gl.glClientActiveTexture(gl.GL_TEXTURE1)
    gl.glTexCoordPointer(2, gl.GL_FLOAT, 16, None)
    ask()
    gl.glBindBuffer(gl.GL_ARRAY_BUFFER, gl.glGenBuffers(1))
    gl.glBufferData(gl.GL_ARRAY_BUFFER, ARRAY, gl.GL_STATIC_DRAW)
    gl.glColorPointer(3, gl.GL_FLOAT, 16, ctypes.c_void_p(4))
    gl.glVertexPointer(3, gl.GL_FLOAT, 16, None)
    ask()
    told += [float(code_of(gl.glGetPointerv, pname)) for pname in (gl.GL_VERTEX_ARRAY, 7)]
    told += [int(gl.glGetPointerv(getattr(gl, f"GL_{name}_BUFFER_POINTER"))) for name in ("FEEDBACK", "SELECTION")]
    return told


def test_residence_and_priorities_are_those_of_mesa() -> None:
    compared = compare(lambda gl: [np.array(each, np.float64) for each in residence(gl)], (4, 4))
    assert compared, str(compared)


def test_pointers_are_the_arrays_and_offsets_of_mesa() -> None:
    compared = compare(lambda gl: np.array(pointers(gl)), (4, 4))
    assert compared, f"{compared}\n{compared.ours.returned}\n{compared.theirs.returned}"


def test_pointers_are_addresses_of_the_memory_that_is_read_or_written() -> None:
    with gl.create_context(4, 4):
        hits, values = gl.glSelectBuffer(16), gl.glFeedbackBuffer(8, gl.GL_3D)
        assert gl.glGetPointerv(gl.GL_SELECTION_BUFFER_POINTER) == hits.ctypes.data
        assert gl.glGetPointerv(gl.GL_FEEDBACK_BUFFER_POINTER, params := np.zeros(1, np.uint64)) == values.ctypes.data
        assert params == values.ctypes.data
        flags = np.ones(4, np.uint8)
        gl.glEdgeFlagPointer(0, flags)
        assert gl.glGetPointerv(gl.GL_EDGE_FLAG_ARRAY_POINTER) == flags.ctypes.data
        gl.glVertexPointer(3, gl.GL_FLOAT, 0, [[1, 2, 3]])
        address = int(gl.glGetPointerv(gl.GL_VERTEX_ARRAY_POINTER))
        assert list((ctypes.c_float * 3).from_address(address)) == [1, 2, 3]
