"""Matrix stacks, and calls that change the current matrix."""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow import matrices
from softshadow import tokens as gl
from softshadow.context import MATRIX_STACK_DEPTHS, Context
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.errors import fail, is_one_of, outside_begin
from softshadow.programs.inverse import (
    GENERAL,
    GENERAL_SCALE,
    ROTATION,
    TRANSLATION,
    UNIFORM_SCALE,
    UNKNOWN,
    known_kind,
)

SAME_SCALE = 1e-8  # a scale is uniform if its factors differ by less (Mesa, math/m_matrix.c)


def set_current(context: Context, matrix: np.ndarray, kind: int) -> None:
    """Replace the current matrix; Mesa inverts it by its `kind`, the transformations that it may contain."""
    context.flush()
    matrix.setflags(write=False)
    context.matrix_stack[-1] = matrix
    context.kind_stack[-1] = kind


def _matrix_argument(context: Context, m: Any) -> np.ndarray:
    """Return a matrix argument, 16 numbers in column-major order, as a matrix (4, 4)."""
    if isinstance(m, bytes | bytearray | memoryview):
        m = np.frombuffer(m, np.float64 if len(m) == 128 else np.float32)
    return context.frozen(m).reshape(4, 4).T


@in_lists
def glMatrixMode(mode: int) -> None:
    """Select the stack that matrix calls work on."""
    context = outside_begin("glMatrixMode")
    expected = "GL_MODELVIEW, GL_PROJECTION or GL_TEXTURE"
    if context is not None and is_one_of("glMatrixMode", "mode", mode, MATRIX_STACK_DEPTHS, expected):
        if mode != context.matrix_mode or mode == gl.GL_TEXTURE:
            context.touched |= gl.GL_TRANSFORM_BIT
        context.matrix_mode = mode


@in_lists
def glPushMatrix() -> None:
    """Push a copy of the current matrix onto its stack."""
    context = outside_begin("glPushMatrix")
    if context is None:
        return
    largest = MATRIX_STACK_DEPTHS[context.matrix_mode]
    if len(context.matrix_stack) == largest:
        fail(gl.GL_STACK_OVERFLOW, "glPushMatrix", f"this stack holds {largest} matrices")
    else:
        matrix, kinds = context.matrix_stack[-1], context.kind_stack
        kinds[-1] = known_kind(matrix, kinds[-1])
        kinds.append(kinds[-1])
        context.matrix_stack.append(matrix)


@in_lists
def glPopMatrix() -> None:
    """Restore the matrix of the last push."""
    context = outside_begin("glPopMatrix")
    if context is None:
        return
    if len(context.matrix_stack) == 1:
        fail(gl.GL_STACK_UNDERFLOW, "glPopMatrix", "there was no glPushMatrix before it")
    else:
        if context.matrix_stack[-1].tobytes() != context.matrix_stack[-2].tobytes():
            context.flush()
        context.matrix_stack.pop()
        context.kind_stack.pop()


@in_lists
def glLoadIdentity() -> None:
    """Replace the current matrix by the identity."""
    context = outside_begin("glLoadIdentity")
    if context is not None:
        # Mesa keeps the kind of the old matrix, and so inverts products with the identity more generally
        set_current(context, np.eye(4, dtype=context.real), context.kind_stack[-1] & ~UNKNOWN)


@in_lists
def glLoadMatrixf(m: Any) -> None:
    """Replace the current matrix by 16 numbers, column after column."""
    context = outside_begin("glLoadMatrixf")
    if context is not None:
        matrix = _matrix_argument(context, m)
        if matrix.tobytes() != context.matrix_stack[-1].tobytes():
            set_current(context, matrix, GENERAL | UNKNOWN)


@in_lists
def glMultMatrixf(m: Any) -> None:
    """Multiply the current matrix by 16 numbers, column after column."""
    context = outside_begin("glMultMatrixf")
    if context is not None:
        matrix = _matrix_argument(context, m)
        if matrix.tobytes() != np.eye(4, dtype=context.real).tobytes():  # Mesa skips the identity
            multiply_current(context, matrix, GENERAL | UNKNOWN)


@in_lists
def glLoadTransposeMatrixf(m: Any) -> None:
    """Replace the current matrix by 16 numbers, row after row."""
    glLoadMatrixf(np.reshape(m, (4, 4)).T)


@in_lists
def glMultTransposeMatrixf(m: Any) -> None:
    """Multiply the current matrix by 16 numbers, row after row."""
    glMultMatrixf(np.reshape(m, (4, 4)).T)


def multiply_current(context: Context, matrix: np.ndarray, kind: int) -> None:
    """Multiply the current matrix on the right by a matrix of a kind."""
    set_current(context, matrices.multiply(context.matrix_stack[-1], matrix), context.kind_stack[-1] | kind)


@in_lists
def glTranslatef(x: float, y: float, z: float) -> None:
    """Multiply the current matrix by a translation."""
    context = outside_begin("glTranslatef")
    if context is not None:
        product = matrices.translate(context.matrix_stack[-1], x, y, z)
        set_current(context, product, context.kind_stack[-1] | TRANSLATION)


@in_lists
def glScalef(x: float, y: float, z: float) -> None:
    """Multiply the current matrix by a scale."""
    context = outside_begin("glScalef")
    if context is not None:
        uniform = max(abs(x - y), abs(x - z)) < SAME_SCALE
        kind = context.kind_stack[-1] | (UNIFORM_SCALE if uniform else GENERAL_SCALE)
        set_current(context, matrices.scale(context.matrix_stack[-1], x, y, z), kind)


@in_lists
def glRotatef(angle: float, x: float, y: float, z: float) -> None:
    """Multiply the current matrix by a rotation: degrees about an axis."""
    context = outside_begin("glRotatef")
    if context is not None:
        context.flush()
    if context is not None and angle and (x or y or z):
        multiply_current(context, matrices.rotation(angle, x, y, z, context.real), ROTATION)


@in_lists
def glFrustum(left: float, right: float, bottom: float, top: float, zNear: float, zFar: float) -> None:
    """Multiply the current matrix by a perspective projection."""
    context = outside_begin("glFrustum")
    if context is None:
        return
    if zNear <= 0 or zFar <= 0 or left == right or bottom == top or zNear == zFar:
        expected = "expected left ≠ right, bottom ≠ top, near ≠ far and both more than 0"
        fail(gl.GL_INVALID_VALUE, "glFrustum", f"zNear={zNear}, zFar={zFar}: {expected}")
    else:
        multiply_current(context, matrices.frustum(left, right, bottom, top, zNear, zFar, context.real), GENERAL)


@in_lists
def glOrtho(left: float, right: float, bottom: float, top: float, zNear: float, zFar: float) -> None:
    """Multiply the current matrix by an orthographic projection."""
    context = outside_begin("glOrtho")
    if context is None:
        return
    if left == right or bottom == top or zNear == zFar:
        expected = "expected left ≠ right, bottom ≠ top and near ≠ far"
        fail(gl.GL_INVALID_VALUE, "glOrtho", f"left={left}, right={right}: {expected}")
    else:
        projection = matrices.ortho(left, right, bottom, top, zNear, zFar, context.real)
        multiply_current(context, projection, GENERAL_SCALE | TRANSLATION)


glLoadMatrixd, glMultMatrixd = glLoadMatrixf, glMultMatrixf
glLoadTransposeMatrixd, glMultTransposeMatrixd = glLoadTransposeMatrixf, glMultTransposeMatrixf
glTranslated, glScaled, glRotated = glTranslatef, glScalef, glRotatef


__all__ = spelled_like_gl(globals())
