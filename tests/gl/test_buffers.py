"""Buffer objects and vertex arrays draw what Mesa draws."""

import ctypes
from typing import Any

import numpy as np
import pytest

from softshadow import gl
from softshadow.testing import compare, run_on_mesa

SIZE = (32, 24)
# position, normal, colour of a quad strip that leans through the window
VERTICES = np.array(
    [
        [x, y, z, 0, 0.6, 0.8, x * x, 0.5, y * y]
        for x, y, z in ((-0.9, -0.7, 0.2), (-0.8, 0.8, -0.4), (-0.1, -0.9, 0.9), (0.1, 0.6, 0.1), (0.8, -0.5, -0.8),
                        (0.9, 0.95, 0.6))
    ],
    np.float32,
)  # fmt: skip
STRIDE = VERTICES.strides[0]
INDICES = np.array([0, 1, 3, 2, 2, 3, 5, 4], np.uint16)


def start(gl: Any) -> None:
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glRotatef(20, 1, 2, 3)


def draw_from_buffers(gl: Any) -> None:
    """One interleaved buffer, offsets of three kinds, indices in a second buffer, part of it replaced in between."""
    start(gl)
    vertices, indices = (int(name) for name in gl.glGenBuffers(2))
    gl.glBindBuffer(gl.GL_ARRAY_BUFFER, vertices)
    gl.glBufferData(gl.GL_ARRAY_BUFFER, VERTICES.nbytes, VERTICES, gl.GL_STATIC_DRAW)
    gl.glBindBuffer(gl.GL_ELEMENT_ARRAY_BUFFER, indices)
    gl.glBufferData(gl.GL_ELEMENT_ARRAY_BUFFER, INDICES, gl.GL_STATIC_DRAW)
    gl.glVertexPointer(3, gl.GL_FLOAT, STRIDE, None)
    gl.glColorPointer(3, gl.GL_FLOAT, STRIDE, ctypes.c_void_p(24))
    gl.glBindBuffer(gl.GL_ARRAY_BUFFER, 0)
    for array in (gl.GL_VERTEX_ARRAY, gl.GL_COLOR_ARRAY):
        gl.glEnableClientState(array)
    gl.glDrawElements(gl.GL_QUADS, 4, gl.GL_UNSIGNED_SHORT, None)
    gl.glBindBuffer(gl.GL_ARRAY_BUFFER, vertices)
    gl.glBufferSubData(gl.GL_ARRAY_BUFFER, 24, 12, np.array([1, 0, 0.5], np.float32))
    gl.glDrawRangeElements(gl.GL_QUADS, 0, 5, 4, gl.GL_UNSIGNED_SHORT, ctypes.c_void_p(8))
    gl.glDrawArrays(gl.GL_TRIANGLES, 0, 3)


def ask_buffers(gl: Any) -> list[Any]:
    """What is answered about buffers, before and after one is deleted."""
    first, second = (int(name) for name in gl.glGenBuffers(2))
    answers: list[Any] = [bool(gl.glIsBuffer(first))]
    gl.glBindBuffer(gl.GL_ARRAY_BUFFER, first)
    answers += [bool(gl.glIsBuffer(first)), bool(gl.glIsBuffer(second))]
    gl.glBufferData(gl.GL_ARRAY_BUFFER, 20, None, gl.GL_STREAM_COPY)
    gl.glBufferSubData(gl.GL_ARRAY_BUFFER, 4, np.arange(16, dtype=np.uint8))
    gl.glNormalPointer(gl.GL_FLOAT, 0, ctypes.c_void_p(4))
    for name in ("GL_BUFFER_SIZE", "GL_BUFFER_USAGE"):
        answers.append(int(np.ravel(gl.glGetBufferParameteriv(gl.GL_ARRAY_BUFFER, getattr(gl, name)))[0]))
    answers.append(np.asarray(gl.glGetBufferSubData(gl.GL_ARRAY_BUFFER, 4, 8)).view(np.uint8).tolist())
    for _ in range(2):
        for name in ("GL_ARRAY_BUFFER_BINDING", "GL_ELEMENT_ARRAY_BUFFER_BINDING", "GL_NORMAL_ARRAY_BUFFER_BINDING"):
            answers.append(int(gl.glGetIntegerv(getattr(gl, name))))
        gl.glDeleteBuffers(1, [first])
    return answers


def draw_interleaved(gl: Any) -> None:
    """Layouts of glInterleavedArrays, and the client state that they leave, kept and brought back."""
    start(gl)
    gl.glPushClientAttrib(gl.GL_CLIENT_VERTEX_ARRAY_BIT)
    bytes_of_colors = np.zeros(6, np.dtype([("color", "u1", 4), ("position", "f4", 3)]))
    bytes_of_colors["color"] = np.arange(24).reshape(6, 4) * 10
    bytes_of_colors["position"] = VERTICES[:, :3]
    gl.glInterleavedArrays(gl.GL_C4UB_V3F, 0, bytes_of_colors.tobytes())
    gl.glDrawArrays(gl.GL_TRIANGLE_STRIP, 0, 4)
    turned = np.ascontiguousarray(VERTICES[:, [6, 7, 8, 0, 1, 2]])
    gl.glInterleavedArrays(gl.GL_C3F_V3F, 0, turned.tobytes())
    gl.glMultiDrawArrays(gl.GL_TRIANGLES, np.array([3, 1], np.int32), np.array([3, 3], np.int32), 2)
    gl.glPopClientAttrib()
    gl.glDrawArrays(gl.GL_QUADS, 0, 4)  # nothing is enabled any more


def draw_elements_one_by_one(gl: Any) -> None:
    """glArrayElement inside glBegin, of arrays of several types, lit."""
    start(gl)
    for capability in ("GL_LIGHTING", "GL_LIGHT0", "GL_COLOR_MATERIAL"):
        gl.glEnable(getattr(gl, capability))
    keep = [
        gl.glVertexPointerd(VERTICES[:, :3].astype(np.float64)),
        gl.glColorPointerub((VERTICES[:, 6:9] * 255).astype(np.uint8)),
        gl.glNormalPointerb((VERTICES[:, 3:6] * 127).astype(np.int8)),
    ]
    for array in (gl.GL_VERTEX_ARRAY, gl.GL_COLOR_ARRAY, gl.GL_NORMAL_ARRAY):
        gl.glEnableClientState(array)
    gl.glBegin(gl.GL_QUAD_STRIP)
    for index in (0, 1, 2, 3, 4, 5):
        gl.glArrayElement(index)
    gl.glEnd()
    gl.glDrawElementsub(gl.GL_TRIANGLES, np.array([0, 3, 5], np.uint8))
    del keep


def draw_without_types(gl: Any) -> list[Any]:
    """PyOpenGL's calls without a type."""
    gl.glMaterial(gl.GL_FRONT, gl.GL_DIFFUSE, [0.25, 0.5, 0.75, 1])
    gl.glTexParameter(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
    gl.glLight(gl.GL_LIGHT0, gl.GL_POSITION, [1, 2, 3, 0])
    gl.glTranslate(0.25, 0, 0)
    gl.glScale(0.5, 0.75, 1)
    gl.glRotate(30, 0, 0, 1)
    gl.glLoadTransposeMatrixf(np.array(gl.glGetFloatv(gl.GL_MODELVIEW_MATRIX)).T)
    gl.glMultTransposeMatrixd(np.diag([1.0, 0.9, 1, 1]))
    gl.glBegin(gl.GL_TRIANGLES)
    for color, corner in (((1, 0, 0), (-1, -1)), ((0, 1, 0, 0.5), (1, -1, 0.5)), ((0, 0, 1), (0, 1, 0, 2))):
        gl.glColor(*color)
        gl.glNormal(0, 0, 1)
        gl.glTexCoord(0.5, 0.25)
        gl.glVertex(*corner)
    gl.glEnd()
    gl.glColor([0.5, 0.5, 0.25])
    state = (gl.glGetFloatv(gl.GL_CURRENT_COLOR), gl.glGetMaterialfv(gl.GL_FRONT, gl.GL_DIFFUSE))
    return [np.array(answer).tolist() for answer in state]


def draw_arrays_in_lists(gl: Any) -> list[Any]:
    """Attributes without an array have the values that are current when the list is called."""
    start(gl)
    keep = np.ascontiguousarray(VERTICES[:, :3]), np.ascontiguousarray(VERTICES[:, 6:9])
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, keep[0])
    gl.glColorPointer(3, gl.GL_FLOAT, 0, keep[1])
    for name in (1, 2):
        gl.glColor4f(0.25, 1, 0.5, 1)
        gl.glNewList(name, gl.GL_COMPILE)
        gl.glDrawArrays(gl.GL_TRIANGLES, 0, 3)
        gl.glColor3f(0, 0.5, 1)
        gl.glDrawElements(gl.GL_TRIANGLE_STRIP, 4, gl.GL_UNSIGNED_SHORT, np.array([2, 3, 4, 5], np.uint16))
        gl.glEnableClientState(gl.GL_COLOR_ARRAY)
        gl.glDrawArrays(gl.GL_TRIANGLES, 2, 3)
        gl.glDisableClientState(gl.GL_COLOR_ARRAY)
        gl.glEndList()
    answers = []
    for name, color in ((1, (1, 0.5, 0, 0.5)), (2, (0.5, 0, 0.5, 1)), (1, (1, 1, 0, 1))):
        gl.glTranslatef(0.1, 0.05, 0)
        gl.glColor4f(*color)
        gl.glCallList(name)
        answers.append(np.array(gl.glGetFloatv(gl.GL_CURRENT_COLOR)).tolist())
    del keep
    return answers


PROGRAMS = {
    f.__name__: f
    for f in (draw_from_buffers, draw_interleaved, draw_elements_one_by_one, draw_without_types, draw_arrays_in_lists)
}


@pytest.mark.mesa
@pytest.mark.parametrize("name", PROGRAMS)
def test_buffers_and_arrays_draw_as_on_mesa(name):
    assert compare(PROGRAMS[name], SIZE).differences == ()


def renderbuffer_sizes(gl: Any) -> list[int]:
    gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, gl.glGenRenderbuffers(1))
    names = ("WIDTH", "HEIGHT", "INTERNAL_FORMAT", *(f"{c}_SIZE" for c in ("RED", "ALPHA", "DEPTH", "STENCIL")))
    answers = []
    for internal in (None, gl.GL_RGBA8, gl.GL_RGB8, gl.GL_DEPTH_COMPONENT24, gl.GL_DEPTH24_STENCIL8, gl.GL_R32F):
        if internal is not None:
            gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, internal, 5, 7)
        for name in names:
            token = getattr(gl, f"GL_RENDERBUFFER_{name}")
            answers.append(int(np.ravel(gl.glGetRenderbufferParameteriv(gl.GL_RENDERBUFFER, token))[0]))
    return answers


@pytest.mark.mesa
def test_renderbuffers_answer_as_on_mesa():
    with gl.create_context(*SIZE):
        ours = renderbuffer_sizes(gl)
    assert ours == run_on_mesa(renderbuffer_sizes, SIZE).returned


@pytest.mark.mesa
def test_buffers_answer_as_on_mesa():
    with gl.create_context(*SIZE):
        ours = ask_buffers(gl)
    assert ours == run_on_mesa(ask_buffers, SIZE).returned


def test_array_for_an_offset_is_refused():
    with gl.create_context(*SIZE):
        gl.glBindBuffer(gl.GL_ARRAY_BUFFER, 1)
        with pytest.raises(TypeError, match="a buffer object is bound, expected an offset"):
            gl.glVertexPointer(3, gl.GL_FLOAT, 0, VERTICES)


def test_buffer_that_is_too_short_is_refused():
    with gl.create_context(*SIZE):
        gl.glBindBuffer(gl.GL_ARRAY_BUFFER, 1)
        gl.glBufferData(gl.GL_ARRAY_BUFFER, 24, None, gl.GL_STATIC_DRAW)
        gl.glVertexPointer(3, gl.GL_FLOAT, 0, None)
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        with pytest.raises(ValueError, match="vertex 2 is outside the array"):
            gl.glDrawArrays(gl.GL_TRIANGLES, 0, 3)
