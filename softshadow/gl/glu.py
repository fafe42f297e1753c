"""GLU's cameras, projections, and window coordinates of points."""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow.context import current, thread
from softshadow.context.matrix_stacks import packed_perspective
from softshadow.gl.calls import in_lists, is_allowed, is_ready, spelled_like_gl
from softshadow.gl.errors import outside_begin
from softshadow.gl.transforms import glOrtho, glScalef, glTranslatef


def gluPerspective(fovy: float, aspect: float, zNear: float, zFar: float) -> None:
    """Multiply by a perspective projection, `fovy` in degrees; do nothing for arguments that GLU ignores."""
    context = thread.context
    if not (context.ready or is_allowed(context, gluPerspective, fovy, aspect, zNear, zFar)):
        return
    packed = packed_perspective(fovy, aspect, zNear, zFar)
    if packed:
        if not context.ready:
            context.separate()
        context.matrix_stack.multiply_packed(packed)


@in_lists
def gluOrtho2D(left: float, right: float, bottom: float, top: float) -> None:
    """Multiply by an orthographic projection of a rectangle, depth -1 to 1."""
    glOrtho(left, right, bottom, top, -1, 1)


def gluLookAt(
    eyeX: float, eyeY: float, eyeZ: float,
    centerX: float, centerY: float, centerZ: float,
    upX: float, upY: float, upZ: float,
) -> None:  # fmt: skip
    """Multiply by the view matrix of an eye looking at a centre."""
    context = thread.context
    places = (eyeX, eyeY, eyeZ, centerX, centerY, centerZ, upX, upY, upZ)
    if context.ready or is_ready(context, gluLookAt, *places):
        context.matrix_stack.look_at(*places)


@in_lists
def gluPickMatrix(x: float, y: float, deltax: float, deltay: float, viewport: Any = None) -> None:
    """Multiply by a matrix that enlarges a region around a window position to the whole window, for selection."""
    if viewport is None:  # as in PyOpenGL
        view = current().state.viewport
        viewport = (view.x, view.y, view.width, view.height)
    left, bottom, width, height = (int(value) for value in np.ravel(viewport)[:4])
    if deltax > 0 and deltay > 0:
        glTranslatef((width - 2 * (x - left)) / deltax, (height - 2 * (y - bottom)) / deltay, 0)
        glScalef(width / deltax, height / deltay, 1.0)


def gluProject(
    objX: float, objY: float, objZ: float, model: Any = None, proj: Any = None, view: Any = None
) -> tuple[float, float, float] | None:  # fmt: skip
    """Return the window coordinates of a point, in double precision; y counts from the bottom.

    Matrices and viewport default to the current ones.

    Raises
    ------
    ValueError
        The point projects to infinity.
    """
    if any(argument is None for argument in (model, proj, view)) and outside_begin("gluProject") is None:
        return None
    model, proj, (left, bottom, width, height) = _current_or(model, proj, view)
    x, y, z, w = _applied(proj, _applied(model, (float(objX), float(objY), float(objZ), 1.0)))
    if w == 0:
        raise ValueError("gluProject: the point projects to infinity (w = 0)")
    x, y, z = (coordinate / w * 0.5 + 0.5 for coordinate in (x, y, z))
    return x * width + left, y * height + bottom, z


def gluUnProject(
    winX: float, winY: float, winZ: float, model: Any = None, proj: Any = None, view: Any = None
) -> tuple[float, float, float] | None:  # fmt: skip
    """Return the point with these window coordinates, in double precision.

    Matrices and viewport default to the current ones.

    Raises
    ------
    ValueError
        The matrices have no inverse, or the point lies at infinity.
    """
    if any(argument is None for argument in (model, proj, view)) and outside_begin("gluUnProject") is None:
        return None
    model, proj, (left, bottom, width, height) = _current_or(model, proj, view)
    with np.errstate(all="ignore"):  # a viewport without a side gives infinities, as in GLU
        across, up = (np.float64(winX) - left) / width, (np.float64(winY) - bottom) / height
        ndc = (float(across * 2 - 1), float(up * 2 - 1), float(winZ * 2 - 1), 1.0)
    inverse = _inverse(_product(model, proj))
    if inverse is None:
        raise ValueError("gluUnProject: the matrices have no inverse")
    x, y, z, w = _applied(inverse, ndc)
    if w == 0:
        raise ValueError("gluUnProject: the point lies at infinity (w = 0)")
    return x / w, y / w, z / w


def gluUnProject4(
    winX: float, winY: float, winZ: float, clipW: float, model: Any = None, proj: Any = None, view: Any = None,
    near: float = 0.0, far: float = 1.0,
) -> tuple[float, float, float, float] | None:  # fmt: skip
    """Return the homogeneous point with these window coordinates and this clip w; `near`, `far` as in glDepthRange.

    Matrices and viewport default to the current ones.

    Raises
    ------
    ValueError
        The matrices have no inverse.
    """
    if any(argument is None for argument in (model, proj, view)) and outside_begin("gluUnProject4") is None:
        return None
    model, proj, (left, bottom, width, height) = _current_or(model, proj, view)
    with np.errstate(all="ignore"):  # as in gluUnProject
        across, up = (np.float64(winX) - left) / width, (np.float64(winY) - bottom) / height
        depth = (np.float64(winZ) - near) / (np.float64(far) - near)
        ndc = (float(across * 2 - 1), float(up * 2 - 1), float(depth * 2 - 1), float(clipW))
    inverse = _inverse(_product(model, proj))
    if inverse is None:
        raise ValueError("gluUnProject4: the matrices have no inverse")
    x, y, z, w = _applied(inverse, ndc)
    return x, y, z, w


def _current_or(model: Any, proj: Any, view: Any) -> tuple[list[float], list[float], tuple[float, ...]]:
    """Return two matrices as 16 numbers in column order, and a viewport; None means the current one."""
    context = current()
    viewport = context.state.viewport
    box = (viewport.x, viewport.y, viewport.width, viewport.height) if view is None else tuple(np.ravel(view).tolist())
    stacks = ((model, context.modelview_stack), (proj, context.projection_stack))
    both = [stack[-1].T if matrix is None else np.asarray(matrix) for matrix, stack in stacks]
    columns = [np.ravel(matrix).astype(np.float64).tolist() for matrix in both]
    return columns[0], columns[1], box


def _applied(m: list[float], point: tuple[float, ...]) -> tuple[float, ...]:
    """Return a matrix times a point, summed in GLU's order."""
    x, y, z, w = point
    return tuple(x * m[i] + y * m[4 + i] + z * m[8 + i] + w * m[12 + i] for i in range(4))


def _product(a: list[float], b: list[float]) -> list[float]:
    """Return the matrix that applies `a`, then `b`, summed in GLU's order."""
    return [a[i] * b[j] + a[i + 1] * b[4 + j] + a[i + 2] * b[8 + j] + a[i + 3] * b[12 + j]
            for i in range(0, 16, 4) for j in range(4)]  # fmt: skip


def _inverse(m: list[float]) -> list[float] | None:
    """Return the inverse of a matrix by cofactors, each summed in GLU's order; None if there is none."""
    cofactors = [0.0] * 16
    for place, terms in COFACTORS:
        (sign, a, b, c), *rest = terms
        total = sign * m[a] * m[b] * m[c]
        for sign, a, b, c in rest:
            total += sign * m[a] * m[b] * m[c]
        cofactors[place] = total
    determinant = m[0] * cofactors[0] + m[1] * cofactors[4] + m[2] * cofactors[8] + m[3] * cofactors[12]
    if determinant == 0:
        return None
    scale = 1.0 / determinant
    return [cofactor * scale for cofactor in cofactors]


def _cofactors() -> list[tuple[int, list[tuple[float, int, int, int]]]]:
    """Return the places in the inverse with their six terms: a sign and three places in a matrix in column order.

    References: libGLU, project.c, __gluInvertMatrixd.
    """
    table = []
    for row in range(4):
        p, q, r = (i for i in range(4) if i != row)
        for column in range(4):
            u, v, w = (4 * i for i in range(4) if i != column)
            sign = -1.0 if (row + column) % 2 else 1.0
            products = [
                (sign, u + p, v + q, w + r), (-sign, u + p, v + r, w + q), (-sign, v + p, u + q, w + r),
                (sign, v + p, u + r, w + q), (sign, w + p, u + q, v + r), (-sign, w + p, u + r, v + q),
            ]  # fmt: skip
            table.append((4 * row + column, products))
    return table


COFACTORS = _cofactors()


__all__ = spelled_like_gl(globals())
