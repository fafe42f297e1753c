"""Matrix stacks and what changes the current matrix."""

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

SAME_SCALE = 1e-8  # a scale is uniform where its factors differ by less (Mesa, math/m_matrix.c)


def set_current(context: Context, matrix: np.ndarray, kind: int) -> None:
    """Make a matrix current. `kind` says what may be in it, and with that how Mesa inverts it."""
    context.settle()
    matrix.setflags(write=False)
    context.matrix_stack[-1] = matrix
    context.kind_stack[-1] = kind


def _given(context: Context, m: Any) -> np.ndarray:
    """Return a matrix argument, 16 numbers in GL's column-major order, as (4, 4) with column vectors."""
    if isinstance(m, bytes | bytearray | memoryview):
        m = np.frombuffer(m, np.float64 if len(m) == 128 else np.float32)
    return context.frozen(m).reshape(4, 4).T


@in_lists
def glMatrixMode(mode: int) -> None:
    """Choose the stack that matrix calls work on."""
    context = outside_begin("glMatrixMode")
    expected = "GL_MODELVIEW, GL_PROJECTION or GL_TEXTURE"
    if context is not None and is_one_of("glMatrixMode", "mode", mode, MATRIX_STACK_DEPTHS, expected):
        if mode != context.matrix_mode or mode == gl.GL_TEXTURE:
            context.touched |= gl.GL_TRANSFORM_BIT
        context.matrix_mode = mode


@in_lists
def glPushMatrix() -> None:
    """Put a copy of the current matrix on its stack."""
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
    """Go back to the matrix of the last push."""
    context = outside_begin("glPopMatrix")
    if context is None:
        return
    if len(context.matrix_stack) == 1:
        fail(gl.GL_STACK_UNDERFLOW, "glPopMatrix", "there was no glPushMatrix before it")
    else:
        if context.matrix_stack[-1].tobytes() != context.matrix_stack[-2].tobytes():
            context.settle()
        context.matrix_stack.pop()
        context.kind_stack.pop()


@in_lists
def glLoadIdentity() -> None:
    """Make the identity current."""
    context = outside_begin("glLoadIdentity")
    if context is not None:
        # Mesa keeps what the matrix before could have had in it, and so inverts the next one more generally
        set_current(context, np.eye(4, dtype=context.real), context.kind_stack[-1] & ~UNKNOWN)


@in_lists
def glLoadMatrixf(m: Any) -> None:
    """Make a matrix current: 16 numbers, column after column."""
    context = outside_begin("glLoadMatrixf")
    if context is not None:
        made = _given(context, m)
        if made.tobytes() != context.matrix_stack[-1].tobytes():
            set_current(context, made, GENERAL | UNKNOWN)


@in_lists
def glMultMatrixf(m: Any) -> None:
    """Multiply the current matrix from the right: 16 numbers, column after column."""
    context = outside_begin("glMultMatrixf")
    if context is not None:
        made = _given(context, m)
        if made.tobytes() != np.eye(4, dtype=context.real).tobytes():  # Mesa passes over an identity
            multiply_current(context, made, GENERAL | UNKNOWN)


@in_lists
def glLoadTransposeMatrixf(m: Any) -> None:
    """Make a matrix current: 16 numbers, row after row."""
    glLoadMatrixf(np.reshape(m, (4, 4)).T)


@in_lists
def glMultTransposeMatrixf(m: Any) -> None:
    """Multiply the current matrix from the right: 16 numbers, row after row."""
    glMultMatrixf(np.reshape(m, (4, 4)).T)


def multiply_current(context: Context, matrix: np.ndarray, kind: int) -> None:
    """Multiply the current matrix from the right by one of a kind."""
    set_current(context, matrices.multiply(context.matrix_stack[-1], matrix), context.kind_stack[-1] | kind)


@in_lists
def glTranslatef(x: float, y: float, z: float) -> None:
    """Move what is drawn from here on."""
    context = outside_begin("glTranslatef")
    if context is not None:
        made = matrices.translate(context.matrix_stack[-1], x, y, z)
        set_current(context, made, context.kind_stack[-1] | TRANSLATION)


@in_lists
def glScalef(x: float, y: float, z: float) -> None:
    """Scale what is drawn from here on."""
    context = outside_begin("glScalef")
    if context is not None:
        uniform = max(abs(x - y), abs(x - z)) < SAME_SCALE
        kind = context.kind_stack[-1] | (UNIFORM_SCALE if uniform else GENERAL_SCALE)
        set_current(context, matrices.scale(context.matrix_stack[-1], x, y, z), kind)


@in_lists
def glRotatef(angle: float, x: float, y: float, z: float) -> None:
    """Turn what is drawn from here on: degrees about an axis."""
    context = outside_begin("glRotatef")
    if context is not None:
        context.settle()
    if context is not None and angle and (x or y or z):
        multiply_current(context, matrices.rotation(angle, x, y, z, context.real), ROTATION)


@in_lists
def glFrustum(left: float, right: float, bottom: float, top: float, zNear: float, zFar: float) -> None:
    """Multiply by the perspective projection of a frustum."""
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
    """Multiply by the parallel projection of a box."""
    context = outside_begin("glOrtho")
    if context is None:
        return
    if left == right or bottom == top or zNear == zFar:
        expected = "expected left ≠ right, bottom ≠ top and near ≠ far"
        fail(gl.GL_INVALID_VALUE, "glOrtho", f"left={left}, right={right}: {expected}")
    else:
        made = matrices.ortho(left, right, bottom, top, zNear, zFar, context.real)
        multiply_current(context, made, GENERAL_SCALE | TRANSLATION)


glLoadMatrixd, glMultMatrixd = glLoadMatrixf, glMultMatrixf
glLoadTransposeMatrixd, glMultTransposeMatrixd = glLoadTransposeMatrixf, glMultTransposeMatrixf
glTranslated, glScaled, glRotated = glTranslatef, glScalef, glRotatef


__all__ = spelled_like_gl(globals())
