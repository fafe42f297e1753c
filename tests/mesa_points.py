"""Exact results of Mesa's shaders: a float colour per fragment, or the outputs of the vertex stage.

`fragments_on_mesa` draws one point per pixel into a float buffer: a point's attributes are constant, so the colours are
those of the fragment stage for exactly these inputs. `vertices_on_mesa` uses the feedback buffer of GL.
"""

import ctypes
from collections.abc import Callable
from typing import Any

import numpy as np

from softshadow.testing import run_on_mesa

SIDE = 32
POINTS = SIDE * SIDE
FEEDBACK_SHRINK = 0.01  # scale of the projection, so that no vertex is clipped
FEEDBACK_FLOATS = 13  # per point: token, x y z w, r g b a, s t r q

Arrays = dict[str, np.ndarray]  # "vertex", "color", "texcoord" (N, 4), "normal" (N, 3); float32


def pixel_centers() -> np.ndarray:
    """Return the pixel centres (POINTS, 2) in clip coordinates."""
    axis = (np.arange(SIDE) + 0.5) / SIDE * 2 - 1
    return np.stack(np.meshgrid(axis, axis), axis=-1).reshape(-1, 2)


def draw_points(gl: Any, arrays: Arrays) -> None:
    """Draw all points of the arrays."""
    settings = {
        "vertex": (gl.GL_VERTEX_ARRAY, lambda a: gl.glVertexPointer(4, gl.GL_FLOAT, 0, a)),
        "color": (gl.GL_COLOR_ARRAY, lambda a: gl.glColorPointer(4, gl.GL_FLOAT, 0, a)),
        "texcoord": (gl.GL_TEXTURE_COORD_ARRAY, lambda a: gl.glTexCoordPointer(4, gl.GL_FLOAT, 0, a)),
        "normal": (gl.GL_NORMAL_ARRAY, lambda a: gl.glNormalPointer(gl.GL_FLOAT, 0, a)),
    }
    for name, array in arrays.items():
        capability, point_to = settings[name]
        gl.glEnableClientState(capability)
        point_to(np.ascontiguousarray(array, np.float32))
    gl.glDrawArrays(gl.GL_POINTS, 0, len(arrays["vertex"]))


def load(gl: Any, mode: int, matrix: np.ndarray) -> None:
    gl.glMatrixMode(mode)
    gl.glLoadMatrixf(np.ascontiguousarray(matrix.T, np.float32))


def fragments_on_mesa(setup: Callable[[Any], None], arrays: Arrays) -> np.ndarray:
    """Return the colours (POINTS, 4) float32 of the fragments; the array "vertex" is added if missing."""

    def program(gl: Any) -> np.ndarray:
        target = gl.glGenTextures(1)
        gl.glBindTexture(gl.GL_TEXTURE_2D, target)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA32F, SIDE, SIDE, 0, gl.GL_RGBA, gl.GL_FLOAT, None)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
        gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, target, 0)
        gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
        gl.glViewport(0, 0, SIDE, SIDE)
        setup(gl)
        vertex = np.zeros((POINTS, 4), np.float32)
        vertex[:, :2], vertex[:, 3] = pixel_centers(), 1
        draw_points(gl, {"vertex": vertex, **arrays})
        return gl.glReadPixels(0, 0, SIDE, SIDE, gl.GL_RGBA, gl.GL_FLOAT)

    return run_on_mesa(program, (8, 8)).returned.reshape(-1, 4)


def vertices_on_mesa(
    setup: Callable[[Any], None], arrays: Arrays, modelview: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return colours and texture coordinates (N, 4) float32 of the vertex stage."""

    def program(gl: Any) -> np.ndarray:
        from OpenGL.raw.GL.VERSION import GL_1_0 as raw

        load(gl, gl.GL_PROJECTION, np.diag([FEEDBACK_SHRINK, FEEDBACK_SHRINK, FEEDBACK_SHRINK, 1]))
        load(gl, gl.GL_MODELVIEW, np.eye(4))
        one_texel = np.zeros((1, 1, 4), np.uint8)  # coordinates are generated for enabled units only
        gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, 1, 1, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, one_texel)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
        gl.glEnable(gl.GL_TEXTURE_2D)
        setup(gl)
        load(gl, gl.GL_MODELVIEW, modelview)
        buffer = np.zeros(FEEDBACK_FLOATS * len(arrays["vertex"]), np.float32)
        floats = buffer.ctypes.data_as(ctypes.POINTER(ctypes.c_float))
        raw.glFeedbackBuffer(len(buffer), gl.GL_4D_COLOR_TEXTURE, floats)
        raw.glRenderMode(gl.GL_FEEDBACK)
        draw_points(gl, arrays)
        assert raw.glRenderMode(gl.GL_RENDER) == len(buffer)
        return buffer

    rows = run_on_mesa(program, (8, 8)).returned.reshape(-1, FEEDBACK_FLOATS)
    return rows[:, 5:9], rows[:, 9:13]


def same_bits(a: np.ndarray, b: np.ndarray) -> bool:
    """Return whether all numbers are equal, NaN to NaN; +0 and -0 count as equal."""
    return bool(np.array_equal(a, b, equal_nan=True))
