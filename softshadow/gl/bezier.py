"""Points of Bézier curves and surfaces, and tangents of surfaces, in float32 and in Mesa's order of operations.

References: m_eval.c of Mesa 22.3.
"""

from __future__ import annotations

import numpy as np

from softshadow.jit import inlined, kernel, read_only

F32 = np.float32
ONE = F32(1)
ANY_DOMAIN = (0.0, 1.0)


def curve(points: np.ndarray, domain: tuple[float, ...], u: np.ndarray) -> np.ndarray:
    """Return the points (N, k) of a curve at parameters u (N,) in `domain`; control points (order, k)."""
    return surface(points[:, np.newaxis], (*domain, *ANY_DOMAIN), u, u)  # of order 1 along v, so v is not used


def surface(points: np.ndarray, domain: tuple[float, ...], u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Return the points (N, k) of a surface at parameters u, v (N,); control points (u order, v order, k).

    The domain is (first u, last u, first v, last v).
    """
    if points.shape[1] > points.shape[0]:
        points, domain, u, v = points.swapaxes(0, 1), (*domain[2:], *domain[:2]), v, u
    result: np.ndarray = _evaluated(points, domain, u, v, 1, True)[0]
    return result


def surface_with_tangents(
    points: np.ndarray, domain: tuple[float, ...], u: np.ndarray, v: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the points (N, k) of a surface, and its tangents along u and v, not scaled, by de Casteljau's algorithm.

    A map with a single row has no tangent across it, Mesa reads what lies behind it; here it is 0.
    """
    u_order, v_order = points.shape[:2]
    if min(u_order, v_order) == 1:  # the same curve twice
        points = np.repeat(points, 2 if u_order == 1 else 1, axis=0)
        points = np.repeat(points, 2 if v_order == 1 else 1, axis=1)
        u_order, v_order = points.shape[:2]
    if v_order < u_order:
        swapped = points.swapaxes(0, 1), (*domain[2:], *domain[:2]), v, u
        point, dv, du = _evaluated(*swapped, 3, False)
    else:
        point, du, dv = _evaluated(points, domain, u, v, 3, True)
    return point, du, dv


def _evaluated(
    points: np.ndarray, domain: tuple[float, ...], u: np.ndarray, v: np.ndarray, n_results: int, u_first: bool
) -> np.ndarray:
    """Return points (1, N, k), or points and tangents (3, N, k)."""
    points, u, v = read_only(np.ascontiguousarray(points)), np.ascontiguousarray(u), np.ascontiguousarray(v)
    result = np.empty((n_results, len(u), points.shape[2]), F32)
    evaluate(points, np.array(domain, F32), u, v, u_first, np.empty(points.shape, F32), result)
    return result


@kernel
def evaluate(points, domain, us, vs, u_first, net, result):
    """Write the points at all parameters, and two tangents where `result` has room for them; `net` is scratch.

    Tangents need a surface whose order along v is at least that along u. `u_first` tells whether the bilinear steps
    interpolate along u before v.
    """
    u_scale, v_scale = ONE / (domain[1] - domain[0]), ONE / (domain[3] - domain[2])
    for n in range(us.shape[0]):
        u, v = (us[n] - domain[0]) * u_scale, (vs[n] - domain[2]) * v_scale
        if result.shape[0] == 1:
            for i in range(points.shape[0]):
                write_on_curve(points[i], v, net[i, 0])
            write_on_curve(net[:, 0], u, result[0, n])
        else:
            for c in range(points.shape[2]):
                for i in range(points.shape[0]):
                    for j in range(points.shape[1]):
                        net[i, j, c] = points[i, j, c]
                write_tangents(net[:, :, c], u, v, u_first, result[:, n, c])


@inlined
def write_on_curve(points, t, point):
    """Write the point (k,) of a curve by Horner's scheme; `points` (order, k)."""
    order = points.shape[0]
    for c in range(points.shape[1]):
        value = points[0, c]
        if order > 1:
            factor, s, power = F32(order - 1), ONE - t, t * t
            value = s * value + factor * t * points[1, c]
            for i in range(2, order):
                factor = factor * F32(order - i)
                factor = factor * (ONE / F32(i))
                value = s * value + factor * power * points[i, c]
                power = power * t
        point[c] = value


@inlined
def write_tangents(net, u, v, u_first, result):
    """Write a component of the point, and of its tangents along u and v; `net` (u order, v order) changes."""
    us, vs = ONE - u, ONE - v
    rows, columns = net.shape
    while rows > 2:  # bilinear steps, each of which leaves a row and a column less
        if u_first:
            step_along_u(net, rows, columns, us, u)
            step_along_v(net, rows - 1, columns, vs, v)
        else:
            step_along_v(net, rows, columns, vs, v)
            step_along_u(net, rows, columns - 1, us, u)
        rows, columns = rows - 1, columns - 1
    if columns == 2:
        a, b, c, d = net[0, 0], net[0, 1], net[1, 0], net[1, 1]
        result[0] = us * (vs * a + v * b) + u * (vs * c + v * d)
        result[1] = vs * (c - a) + v * (d - b)
        result[2] = us * (b - a) + u * (d - c)
    else:
        for j in range(columns):  # the first row becomes the curve along v, the second one the tangent along u
            first, second = net[0, j], net[1, j]
            net[0, j], net[1, j] = us * first + u * second, second - first
        while columns > 2:
            step_along_v(net, 2, columns, vs, v)
            columns -= 1
        result[0] = vs * net[0, 0] + v * net[0, 1]
        result[1] = vs * net[1, 0] + v * net[1, 1]
        result[2] = net[0, 1] - net[0, 0]


@inlined
def step_along_u(net, rows, columns, us, u):
    """Interpolate between rows of the net, which leaves one row less; us = 1 - u."""
    for i in range(rows - 1):
        for j in range(columns):
            net[i, j] = us * net[i, j] + u * net[i + 1, j]


@inlined
def step_along_v(net, rows, columns, vs, v):
    """Interpolate between columns of the net, which leaves one column less; vs = 1 - v."""
    for i in range(rows):
        for j in range(columns - 1):
            net[i, j] = vs * net[i, j] + v * net[i, j + 1]
