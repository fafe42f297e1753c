"""Matrix stacks and GLU's cameras."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from softshadow import matrices
from softshadow import tokens as gl
from softshadow.context import MATRIX_STACK_DEPTHS, Context, current
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.errors import fail, is_one_of, outside_begin


def _set_current(context: Context, matrix: np.ndarray) -> None:
    matrix.setflags(write=False)
    context.matrix_stack[-1] = matrix


def _given(context: Context, m: Any) -> np.ndarray:
    """Return a matrix argument, 16 numbers in GL's column-major order, as (4, 4) with column vectors."""
    return np.array(m, np.float64).reshape(4, 4).T.astype(context.real)


@in_lists
def glMatrixMode(mode: int) -> None:
    """Choose the stack that matrix calls work on."""
    context = outside_begin("glMatrixMode")
    expected = "GL_MODELVIEW, GL_PROJECTION or GL_TEXTURE"
    if context is not None and is_one_of("glMatrixMode", "mode", mode, MATRIX_STACK_DEPTHS, expected):
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
        context.matrix_stack.append(context.matrix_stack[-1])


@in_lists
def glPopMatrix() -> None:
    """Go back to the matrix of the last push."""
    context = outside_begin("glPopMatrix")
    if context is None:
        return
    if len(context.matrix_stack) == 1:
        fail(gl.GL_STACK_UNDERFLOW, "glPopMatrix", "there was no glPushMatrix before it")
    else:
        context.matrix_stack.pop()


@in_lists
def glLoadIdentity() -> None:
    """Make the identity current."""
    context = outside_begin("glLoadIdentity")
    if context is not None:
        _set_current(context, np.eye(4, dtype=context.real))


@in_lists
def glLoadMatrixf(m: Any) -> None:
    """Make a matrix current: 16 numbers, column after column."""
    context = outside_begin("glLoadMatrixf")
    if context is not None:
        _set_current(context, _given(context, m))


@in_lists
def glMultMatrixf(m: Any) -> None:
    """Multiply the current matrix from the right: 16 numbers, column after column."""
    context = outside_begin("glMultMatrixf")
    if context is not None:
        _multiply(context, _given(context, m))


def _multiply(context: Context, matrix: np.ndarray) -> None:
    _set_current(context, matrices.multiply(context.matrix_stack[-1], matrix))


@in_lists
def glTranslatef(x: float, y: float, z: float) -> None:
    """Move what is drawn from here on."""
    context = outside_begin("glTranslatef")
    if context is not None:
        _set_current(context, matrices.translate(context.matrix_stack[-1], x, y, z))


@in_lists
def glScalef(x: float, y: float, z: float) -> None:
    """Scale what is drawn from here on."""
    context = outside_begin("glScalef")
    if context is not None:
        _set_current(context, matrices.scale(context.matrix_stack[-1], x, y, z))


@in_lists
def glRotatef(angle: float, x: float, y: float, z: float) -> None:
    """Turn what is drawn from here on: degrees about an axis."""
    context = outside_begin("glRotatef")
    if context is not None:
        _multiply(context, matrices.rotation(angle, x, y, z, context.real))


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
        _multiply(context, matrices.frustum(left, right, bottom, top, zNear, zFar, context.real))


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
        _multiply(context, matrices.ortho(left, right, bottom, top, zNear, zFar, context.real))


glLoadMatrixd, glMultMatrixd = glLoadMatrixf, glMultMatrixf
glTranslated, glScaled, glRotated = glTranslatef, glScalef, glRotatef


# -- GLU ---------------------------------------------------------------------------------------------------------------
def gluPerspective(fovy: float, aspect: float, zNear: float, zFar: float) -> None:
    """Multiply by a perspective projection. `fovy` in degrees; does nothing where GLU does nothing."""
    context = outside_begin("gluPerspective")
    sine = math.sin(math.radians(fovy / 2))
    if context is not None and zFar != zNear and sine != 0 and aspect != 0:
        _multiply(context, matrices.perspective(fovy, aspect, zNear, zFar, context.real))


@in_lists
def gluOrtho2D(left: float, right: float, bottom: float, top: float) -> None:
    """Multiply by a parallel projection of a rectangle, depth -1 to 1."""
    glOrtho(left, right, bottom, top, -1, 1)


@in_lists
def gluLookAt(
    eyeX: float, eyeY: float, eyeZ: float,
    centerX: float, centerY: float, centerZ: float,
    upX: float, upY: float, upZ: float,
) -> None:  # fmt: skip
    """Multiply by the view of an eye that looks at a centre."""
    context = outside_begin("gluLookAt")
    if context is not None:
        eye, center, up = (eyeX, eyeY, eyeZ), (centerX, centerY, centerZ), (upX, upY, upZ)
        _set_current(context, matrices.look_at(context.matrix_stack[-1], eye, center, up))


def gluProject(
    objX: float, objY: float, objZ: float, model: Any = None, proj: Any = None, view: Any = None
) -> tuple[float, float, float]:  # fmt: skip
    """Return the window coordinates of a point, in double precision; y from the bottom."""
    transform, box = _double(model, proj, view)
    clip = transform @ np.array([objX, objY, objZ, 1.0])
    if clip[3] == 0:
        raise ValueError("gluProject: the point projects to infinity (w = 0)")
    ndc = clip[:3] / clip[3] * 0.5 + 0.5
    return float(box[0] + ndc[0] * box[2]), float(box[1] + ndc[1] * box[3]), float(ndc[2])


def gluUnProject(
    winX: float, winY: float, winZ: float, model: Any = None, proj: Any = None, view: Any = None
) -> tuple[float, float, float]:  # fmt: skip
    """Return the point whose window coordinates these are, in double precision."""
    transform, box = _double(model, proj, view)
    ndc = np.array([(winX - box[0]) / box[2], (winY - box[1]) / box[3], winZ, 1.0]) * 2 - 1
    ndc[3] = 1.0
    try:
        point = np.linalg.solve(transform, ndc)
    except np.linalg.LinAlgError:
        raise ValueError("gluUnProject: the matrices have no inverse") from None
    if point[3] == 0:
        raise ValueError("gluUnProject: the point lies at infinity (w = 0)")
    return float(point[0] / point[3]), float(point[1] / point[3]), float(point[2] / point[3])


def _double(model: Any, proj: Any, view: Any) -> tuple[np.ndarray, tuple[float, ...]]:
    """Return projection times modelview in double precision, and the viewport; the current ones where None."""
    context = current()
    modelview = context.modelview_stack[-1] if model is None else np.reshape(model, (4, 4)).T
    projection = context.projection_stack[-1] if proj is None else np.reshape(proj, (4, 4)).T
    standing = context.state.viewport
    box = (standing.x, standing.y, standing.width, standing.height) if view is None else tuple(view)
    return projection.astype(np.float64) @ modelview.astype(np.float64), box


__all__ = spelled_like_gl(globals())
