"""Evaluators: vertices of Bézier curves and surfaces, with colours, normals and texture coordinates.

References: GL 2.1, sec. 5.1; eval.c, vbo_exec_eval.c and vbo_exec_api.c of Mesa 22.3.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, Primitive, current
from softshadow.context.evaluators import COMPONENTS, DIMENSIONS, Map
from softshadow.frozen import evolve
from softshadow.gl.bezier import curve, surface, surface_with_tangents
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.conversions import nearest_int, vector
from softshadow.gl.errors import fail, is_one_of, outside_begin, wrong_enum
from softshadow.gl.immediate import glBegin, glEnd
from softshadow.gl.vertex_format import REST, add_vertex, carry_attribute

F32 = np.float32
LARGEST_ORDER = 30
A_TARGET = {1: "GL_MAP1_COLOR_4 … GL_MAP1_VERTEX_4", 2: "GL_MAP2_COLOR_4 … GL_MAP2_VERTEX_4"}
TEXTURE_MAPS = ("TEXTURE_COORD_4", "TEXTURE_COORD_3", "TEXTURE_COORD_2", "TEXTURE_COORD_1")
ATTRIBUTES = (("normal", ("NORMAL",)), ("color", ("COLOR_4",)), ("texcoord0", TEXTURE_MAPS))  # in Mesa's order
POSITIONS = ("VERTEX_4", "VERTEX_3")


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
    context.flush()
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
    context.flush()
    context.touched |= gl.GL_EVAL_BIT
    rounded = tuple((int(n), float(F32(first)), float(F32(last))) for n, first, last in grids)
    context.evaluators = evolve(context.evaluators, **{field: rounded[0] if field == "grid1" else rounded})


def switch_map(context: Context, cap: int, on: bool) -> None:
    """Enable or disable a map or GL_AUTO_NORMAL."""
    enabled = context.evaluators.enabled
    if (cap in enabled) != on:
        context.flush()
        context.touched |= gl.GL_EVAL_BIT | gl.GL_ENABLE_BIT
        context.evaluators = evolve(context.evaluators, enabled=enabled | {cap} if on else enabled - {cap})


# -- evaluation --------------------------------------------------------------------------------------------------------
def _enabled_map(context: Context, n: int, names: tuple[str, ...]) -> Map | None:
    """Return the first enabled map of several kinds, or None."""
    for name in names:
        target = getattr(gl, f"GL_MAP{n}_{name}")
        if target in context.evaluators.enabled:
            return context.maps[target]
    return None


def _values(a_map: Map, parameters: tuple[np.ndarray, ...], tangents: bool = False) -> Any:
    """Return the points of a map (N, k) at parameters (N,), or points and two tangents."""
    steps = []
    for number, parameter in enumerate(parameters):
        first, last = (F32(value) for value in a_map.domain[2 * number : 2 * number + 2])
        steps.append(((parameter - first) * (F32(1) / (last - first)))[:, None])
    if tangents:
        return surface_with_tangents(a_map.points, *steps)
    return curve(a_map.points[:, None, :], *steps) if len(steps) == 1 else surface(a_map.points, *steps)


def _evaluate(*parameters: np.ndarray) -> None:
    """Add a vertex to the primitive for each set of parameters (N,) float32: (u) or (u, v)."""
    context, n = current(), len(parameters)
    primitive = context.primitive
    if primitive is None:
        return
    primitive.from_list = False  # Mesa replays such primitives call by call
    found = {name: a_map for name, kinds in ATTRIBUTES if (a_map := _enabled_map(context, n, kinds)) is not None}
    position = _enabled_map(context, n, POSITIONS)
    sizes = {name: a_map.points.shape[-1] for name, a_map in found.items()}
    if n == 2 and gl.GL_AUTO_NORMAL in context.evaluators.enabled:
        sizes["normal"] = 3
    with np.errstate(all="ignore"):
        rows = {name: _values(a_map, parameters) for name, a_map in found.items()}
        if position is not None and "normal" in sizes and n == 2 and gl.GL_AUTO_NORMAL in context.evaluators.enabled:
            points, du, dv = _values(position, parameters, tangents=True)
            rows["normal"] = _normals(points, du, dv)
        elif position is not None:
            points = _values(position, parameters)
    for number in range(len(parameters[0])):
        for name, size in sizes.items():
            _make_room(context, name, size)
        if position is None:
            continue
        before = {name: context.attribute(name) for name in rows}
        for name, values in rows.items():
            value = (*values[number].tolist(), *REST[values.shape[1] :])
            primitive.change(name, before[name], value[: len(before[name])])
        add_vertex(context, *points[number].tolist())
        for name, value in before.items():
            primitive.change(name, None, value)
            primitive.steady.pop(name, None)


def _make_room(context: Context, name: str, size: int) -> None:
    """Make the vertices carry an attribute of `size` components (vbo_exec_fixup_vertex)."""
    buffer = context.vertex_buffer
    active = buffer.active_sizes.get(name, 0) if name in buffer.sizes else 0
    if size > buffer.sizes.get(name, 0):
        carry_attribute(context, name, size)
    elif size < active:  # Mesa also resets the last component that stays
        value = context.attribute(name)
        reset = (*value[: size - 1], *REST[size - 1 : len(value)])
        primitive: Primitive | None = context.primitive
        if primitive is not None:
            primitive.change(name, value, reset)
        context.set_attribute(name, reset)
        buffer.active_sizes[name] = size


def _normals(points: np.ndarray, du: np.ndarray, dv: np.ndarray) -> np.ndarray:
    """Return the normals (N, 3) of a surface from its tangents."""
    if points.shape[1] == 4:
        du = du[:, :3] * points[:, 3:] - du[:, 3:] * points[:, :3]
        dv = dv[:, :3] * points[:, 3:] - dv[:, 3:] * points[:, :3]
    (x, y, z), (a, b, c) = du[:, :3].T, dv[:, :3].T
    normals = np.stack([y * c - z * b, z * a - x * c, x * b - y * a], axis=1)
    squares = normals * normals
    length = (squares[:, 0] + squares[:, 1]) + squares[:, 2]
    scale = np.where(length != 0, F32(1) / np.sqrt(length), F32(1)).astype(F32)
    scaled: np.ndarray = normals * scale[:, None]
    return scaled


def _one(value: float | np.float32) -> np.ndarray:
    return np.array([value], F32)


@in_lists
def glEvalCoord1f(u: float) -> None:
    """Add the vertex of the enabled curves at a parameter."""
    _evaluate(_one(u))


@in_lists
def glEvalCoord2f(u: float, v: float) -> None:
    """Add the vertex of the enabled surfaces at two parameters."""
    _evaluate(_one(u), _one(v))


@in_lists
def glEvalCoord1fv(u: Any) -> None:
    """Add the vertex of the enabled curves at a parameter given as a vector."""
    _evaluate(_one(vector(u, 1)[0]))


@in_lists
def glEvalCoord2fv(u: Any) -> None:
    """Add the vertex of the enabled surfaces at two parameters given as a vector."""
    first, second = vector(u, 2)
    _evaluate(_one(first), _one(second))


glEvalCoord1d, glEvalCoord2d, glEvalCoord1dv, glEvalCoord2dv = (
    glEvalCoord1f, glEvalCoord2f, glEvalCoord1fv, glEvalCoord2fv,
)  # fmt: skip


def _step(grid: tuple[int, float, float]) -> np.float32:
    n, first, last = grid
    step: np.float32 = (F32(last) - F32(first)) / F32(n)
    return step


@in_lists
def glEvalPoint1(i: int) -> None:
    """Add the vertex of a grid point."""
    grid = current().evaluators.grid1
    _evaluate(_one(F32(i) * _step(grid) + F32(grid[1])))


@in_lists
def glEvalPoint2(i: int, j: int) -> None:
    """Add the vertex of a grid point."""
    u, v = current().evaluators.grid2
    _evaluate(_one(F32(i) * _step(u) + F32(u[1])), _one(F32(j) * _step(v) + F32(v[1])))


def _parameters(grid: tuple[int, float, float], first: int, last: int) -> np.ndarray:
    """Return the parameters of the grid points [first, last], each the one before plus a step."""
    step = _step(grid)
    return np.cumsum(np.array([F32(grid[1]) + F32(first) * step, *[step] * (last - first)], F32), dtype=F32)


@in_lists
def glEvalMesh1(mode: int, i1: int, i2: int) -> None:
    """Draw grid points of the enabled curves: GL_POINT or GL_LINE."""
    context = outside_begin("glEvalMesh1")
    modes = {gl.GL_POINT: gl.GL_POINTS, gl.GL_LINE: gl.GL_LINE_STRIP}
    if context is None or not is_one_of("glEvalMesh1", "mode", mode, modes, "GL_POINT or GL_LINE"):
        return
    if _enabled_map(context, 1, POSITIONS) is not None:
        _draw(modes[mode], _parameters(context.evaluators.grid1, i1, i2)) if i1 <= i2 else _draw(modes[mode])


@in_lists
def glEvalMesh2(mode: int, i1: int, i2: int, j1: int, j2: int) -> None:
    """Draw grid points of the enabled surfaces: GL_POINT, GL_LINE or GL_FILL."""
    context = outside_begin("glEvalMesh2")
    modes = (gl.GL_POINT, gl.GL_LINE, gl.GL_FILL)
    if context is None or not is_one_of("glEvalMesh2", "mode", mode, modes, "GL_POINT, GL_LINE or GL_FILL"):
        return
    if _enabled_map(context, 2, POSITIONS) is None or i1 > i2 or j1 > j2:
        return
    u, v = (
        _parameters(grid, first, last)
        for grid, first, last in zip(context.evaluators.grid2, (i1, j1), (i2, j2), strict=True)
    )
    if mode == gl.GL_POINT:
        _draw(gl.GL_POINTS, np.tile(u, len(v)), np.repeat(v, len(u)))
    elif mode == gl.GL_LINE:
        for each in v:
            _draw(gl.GL_LINE_STRIP, u, np.full_like(u, each))
        for each in u:
            _draw(gl.GL_LINE_STRIP, np.full_like(v, each), v)
    else:
        for low, high in pairwise(v):
            _draw(gl.GL_TRIANGLE_STRIP, np.repeat(u, 2), np.tile(np.array([low, high], F32), len(u)))


def _draw(mode: int, *parameters: np.ndarray) -> None:
    glBegin(mode)
    if parameters:
        _evaluate(*parameters)
    glEnd()


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
