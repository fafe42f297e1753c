"""Matrix stacks, and calls that change the current matrix.

The calls only queue their numbers (`softshadow.context.matrix_stacks`). A call that changes a matrix first draws the
collected vertices, if there are any.
"""

from __future__ import annotations

from math import hypot
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import MATRIX_STACK_DEPTHS, Context, thread
from softshadow.context.matrix_stacks import LAST, NUMBER
from softshadow.gl.calls import in_lists, is_allowed, is_ready, spelled_like_gl
from softshadow.gl.errors import fail, is_one_of, outside_begin
from softshadow.gl.refusals import CONVERTING, refusal
from softshadow.programs.inverse import UNKNOWN


def _matrix_argument(context: Context, m: Any) -> np.ndarray:
    """Return a matrix argument, 16 numbers in column-major order, as a matrix (4, 4)."""
    if isinstance(m, bytes | bytearray | memoryview):
        m = np.frombuffer(m, np.float64 if len(m) == 128 else np.float32)
    return context.frozen(m).reshape(4, 4).T


def glMatrixMode(mode: int) -> None:
    """Select the stack that matrix calls work on."""
    context = thread.context
    try:
        if not (context.ready or is_allowed(context, glMatrixMode, mode)):
            return
        if mode not in MATRIX_STACK_DEPTHS:
            is_one_of("glMatrixMode", "mode", mode, MATRIX_STACK_DEPTHS, "GL_MODELVIEW, GL_PROJECTION or GL_TEXTURE")
            return
        if mode != context.matrix_mode or mode == gl.GL_TEXTURE:
            context.touched |= gl.GL_TRANSFORM_BIT
            context.select_matrices(mode)
    except CONVERTING as error:
        raise refusal(glMatrixMode, error, mode) from error


def glPushMatrix() -> None:
    """Push a copy of the current matrix onto its stack."""
    context = thread.context
    if not (context.ready or is_allowed(context, glPushMatrix)):
        return
    stack = context.matrix_stack
    below, kind, end = stack.below, stack.unresolved_kind, stack.end
    if len(below) < stack.most_below and not kind & UNKNOWN and end <= LAST:  # `stack.push` in two thirds of the time
        below.append((kind, stack.known, end))
        stack.end = end + NUMBER
    elif not stack.push():
        fail(gl.GL_STACK_OVERFLOW, "glPushMatrix", f"this stack holds {stack.limit} matrices")


def glPopMatrix() -> None:
    """Restore the matrix of the last push."""
    context = thread.context
    stack = context.matrix_stack
    if not context.ready:
        if not is_allowed(context, glPopMatrix):
            return
        if not context.ready and stack.below and not stack.equals_pushed:
            context.separate()
            context.ready = True
    below = stack.below
    if len(below) > stack.level:  # `stack.pop` in two thirds of the time
        stack.unresolved_kind, stack.known, stack.end = below.pop()
    elif not stack.pop():
        fail(gl.GL_STACK_UNDERFLOW, "glPopMatrix", "there was no glPushMatrix before it")


def glLoadIdentity() -> None:
    """Replace the current matrix by the identity."""
    context = thread.context
    if context.ready or is_ready(context, glLoadIdentity):
        context.matrix_stack.load_identity()


@in_lists
def glLoadMatrixf(m: Any) -> None:
    """Replace the current matrix by 16 numbers, column after column."""
    context = outside_begin("glLoadMatrixf")
    if context is not None:
        matrix, stack = _matrix_argument(context, m), context.matrix_stack
        if matrix.tobytes() != stack.current.tobytes():
            context.separate()
            stack.load(matrix)


@in_lists
def glMultMatrixf(m: Any) -> None:
    """Multiply the current matrix by 16 numbers, column after column."""
    context = outside_begin("glMultMatrixf")
    if context is not None:
        matrix = _matrix_argument(context, m)
        if matrix.tobytes() != context.identity.tobytes():  # Mesa skips the identity
            context.separate()
            context.matrix_stack.multiply(matrix)


@in_lists
def glLoadTransposeMatrixf(m: Any) -> None:
    """Replace the current matrix by 16 numbers, row after row."""
    glLoadMatrixf(np.reshape(m, (4, 4)).T)


@in_lists
def glMultTransposeMatrixf(m: Any) -> None:
    """Multiply the current matrix by 16 numbers, row after row."""
    glMultMatrixf(np.reshape(m, (4, 4)).T)


def glTranslatef(x: float, y: float, z: float) -> None:
    """Multiply the current matrix by a translation."""
    context = thread.context
    try:
        if context.ready or is_ready(context, glTranslatef, x, y, z):
            context.matrix_stack.translate(x, y, z)
    except CONVERTING as error:
        raise refusal(glTranslatef, error, x, y, z) from error


def glScalef(x: float, y: float, z: float) -> None:
    """Multiply the current matrix by a scale."""
    context = thread.context
    try:
        if context.ready or is_ready(context, glScalef, x, y, z):
            context.matrix_stack.scale(x, y, z)
    except CONVERTING as error:
        raise refusal(glScalef, error, x, y, z) from error


def glRotatef(angle: float, x: float, y: float, z: float) -> None:
    """Multiply the current matrix by a rotation: degrees about an axis."""
    context = thread.context
    try:
        hypot(angle, x, y, z)  # the quickest question whether these are numbers
        if (context.ready or is_ready(context, glRotatef, angle, x, y, z)) and angle and (x or y or z):
            context.matrix_stack.rotate(angle, x, y, z)
    except CONVERTING as error:
        raise refusal(glRotatef, error, angle, x, y, z) from error


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
        context.separate()
        context.matrix_stack.frustum(left, right, bottom, top, zNear, zFar)


def glOrtho(left: float, right: float, bottom: float, top: float, zNear: float, zFar: float) -> None:
    """Multiply the current matrix by an orthographic projection."""
    context = thread.context
    try:
        hypot(left, right, bottom, top, zNear, zFar)  # the quickest question whether these are numbers
        if not (context.ready or is_allowed(context, glOrtho, left, right, bottom, top, zNear, zFar)):
            return
        if left == right or bottom == top or zNear == zFar:
            expected = "expected left ≠ right, bottom ≠ top and near ≠ far"
            fail(gl.GL_INVALID_VALUE, "glOrtho", f"left={left}, right={right}: {expected}")
        else:
            if not context.ready:
                context.separate()
            context.matrix_stack.ortho(left, right, bottom, top, zNear, zFar)
    except CONVERTING as error:
        raise refusal(glOrtho, error, left, right, bottom, top, zNear, zFar) from error


glLoadMatrixd, glMultMatrixd = glLoadMatrixf, glMultMatrixf
glLoadTransposeMatrixd, glMultTransposeMatrixd = glLoadTransposeMatrixf, glMultTransposeMatrixf
glTranslated, glScaled, glRotated = glTranslatef, glScalef, glRotatef


__all__ = spelled_like_gl(globals())
