"""Maps and grids of evaluators: Bézier curves and surfaces of positions and attributes, and queries for them.

References: GL 2.1, sec. 5.1; eval.c of Mesa 22.3.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, current
from softshadow.context.evaluators import COMPONENTS, DIMENSIONS, Map
from softshadow.frozen import evolve
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.conversions import nearest_int
from softshadow.gl.errors import fail, is_one_of, outside_begin, wrong_enum

F32 = np.float32
LARGEST_ORDER = 30
A_TARGET = {1: "GL_MAP1_COLOR_4 … GL_MAP1_VERTEX_4", 2: "GL_MAP2_COLOR_4 … GL_MAP2_VERTEX_4"}


# -- maps --------------------------------------------------------------------------------------------------------------
@in_lists
def glMap1f(target: int, u1: float, u2: float, *arguments: Any) -> None:
    """Define a curve: (target, u1, u2, points (order, k)), or as in C (..., stride, order, points)."""
    *c_style, points = arguments
    points = np.asarray(points, F32)
    if c_style:
        stride, order = c_style
    else:
        order, stride = points.shape[0], points.shape[1] if points.ndim > 1 else 1
    if _refused("glMap1", 1, target, ((u1, u2, stride, order),)):
        return
    size, flat = COMPONENTS[target], points.reshape(-1)
    rows = np.stack([flat[i * stride : i * stride + size] for i in range(order)])
    _define(target, rows, (u1, u2))


@in_lists
def glMap2f(target: int, u1: float, u2: float, *arguments: Any) -> None:
    """Define a surface: (target, u1, u2, v1, v2, points (u order, v order, k)).

    As in C: (target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points).
    """
    points = np.asarray(arguments[-1], F32)
    if len(arguments) == 7:
        u_stride, u_order, v1, v2, v_stride, v_order = arguments[:-1]
    else:
        (v1, v2), (u_order, v_order, v_stride) = arguments[:-1], points.shape
        u_stride = v_stride * v_order
    if _refused("glMap2", 2, target, ((u1, u2, u_stride, u_order), (v1, v2, v_stride, v_order))):
        return
    size, flat = COMPONENTS[target], points.reshape(-1)
    starts = [[i * u_stride + j * v_stride for j in range(v_order)] for i in range(u_order)]
    _define(target, np.array([[flat[start : start + size] for start in row] for row in starts], F32), (u1, u2, v1, v2))


glMap1d, glMap2d = glMap1f, glMap2f


def _refused(operation: str, n: int, target: int, sides: tuple[tuple[float, float, int, int], ...]) -> bool:
    """Return whether the arguments are wrong: (first and last parameter, stride, order) for u, and for v."""
    if outside_begin(operation) is None:
        return True
    for first, last, _, _ in sides:
        if F32(first) == F32(last):
            fail(gl.GL_INVALID_VALUE, operation, f"{first}, {last}: expected two different parameters")
            return True
    for *_, order in sides:
        if not 1 <= order <= LARGEST_ORDER:
            fail(gl.GL_INVALID_VALUE, operation, f"order={order}: expected 1 to {LARGEST_ORDER}")
            return True
    if target not in COMPONENTS:
        wrong_enum(operation, "target", target, A_TARGET[n])
        return True
    if any(stride < COMPONENTS[target] for _, _, stride, _ in sides):
        fail(gl.GL_INVALID_VALUE, operation, f"stride={sides[0][2]}: expected {COMPONENTS[target]} or more")
        return True
    if current().active_unit:
        fail(gl.GL_INVALID_OPERATION, operation, "expected GL_TEXTURE0 to be active")
        return True
    if DIMENSIONS[target] != n:
        wrong_enum(operation, "target", target, A_TARGET[n])
        return True
    return False


def _define(target: int, points: np.ndarray, domain: tuple[float, ...]) -> None:
    context = current()
    context.separate()
    context.touched |= gl.GL_EVAL_BIT
    points.setflags(write=False)
    context.maps[int(target)] = Map(points, tuple(float(F32(value)) for value in domain))


@in_lists
def glMapGrid1f(un: int, u1: float, u2: float) -> None:
    """Define the parameters of glEvalMesh1 and glEvalPoint1: `un` steps from u1 to u2."""
    _set_grid("glMapGrid1", "grid1", ((un, u1, u2),))


@in_lists
def glMapGrid2f(un: int, u1: float, u2: float, vn: int, v1: float, v2: float) -> None:
    """Define the parameters of glEvalMesh2 and glEvalPoint2: `un` times `vn` steps."""
    _set_grid("glMapGrid2", "grid2", ((un, u1, u2), (vn, v1, v2)))


glMapGrid1d, glMapGrid2d = glMapGrid1f, glMapGrid2f


def _set_grid(operation: str, field: str, grids: tuple[tuple[int, float, float], ...]) -> None:
    context = outside_begin(operation)
    if context is None:
        return
    for n, _, _ in grids:
        if n < 1:
            fail(gl.GL_INVALID_VALUE, operation, f"n={n}: expected 1 or more")
            return
    context.separate()
    context.touched |= gl.GL_EVAL_BIT
    rounded = tuple((int(n), float(F32(first)), float(F32(last))) for n, first, last in grids)
    context.evaluators = evolve(context.evaluators, **{field: rounded[0] if field == "grid1" else rounded})


def switch_map(context: Context, cap: int, on: bool) -> None:
    """Enable or disable a map or GL_AUTO_NORMAL."""
    enabled = context.evaluators.enabled
    if (cap in enabled) != on:
        context.separate()
        context.touched |= gl.GL_EVAL_BIT | gl.GL_ENABLE_BIT
        context.evaluators = evolve(context.evaluators, enabled=enabled | {cap} if on else enabled - {cap})


# -- queries -----------------------------------------------------------------------------------------------------------
def glGetMapfv(target: int, query: int, v: Any = None) -> Any:
    """Return the control points, the orders or the domain of a map, float32; an array `v` is filled, too."""
    return _get("glGetMapfv", target, query, v, np.float32)


def glGetMapdv(target: int, query: int, v: Any = None) -> Any:
    """Return the control points, the orders or the domain of a map, float64; an array `v` is filled, too."""
    return _get("glGetMapdv", target, query, v, np.float64)


def glGetMapiv(target: int, query: int, v: Any = None) -> Any:
    """Return the control points, the orders or the domain of a map, rounded; an array `v` is filled, too."""
    return _get("glGetMapiv", target, query, v, np.int32)


def _get(operation: str, target: int, query: int, v: Any, dtype: type[np.generic]) -> Any:
    context = outside_begin(operation)
    if context is None or not is_one_of(operation, "target", target, COMPONENTS, f"{A_TARGET[1]}, {A_TARGET[2]}"):
        return None
    a_map = context.maps[target]
    answers: dict[int, Any] = {
        gl.GL_COEFF: a_map.points.reshape(-1), gl.GL_ORDER: a_map.points.shape[:-1], gl.GL_DOMAIN: a_map.domain,
    }  # fmt: skip
    if not is_one_of(operation, "query", query, answers, "GL_COEFF, GL_ORDER or GL_DOMAIN"):
        return None
    values = np.asarray(answers[query])
    answer = np.array([nearest_int(float(x)) for x in values] if dtype is np.int32 else values, dtype)
    if v is not None:
        np.asarray(v).reshape(-1)[: answer.size] = answer
    return answer


__all__ = spelled_like_gl(globals())
