"""Points of Bézier curves and surfaces, and tangents of surfaces, in float32 and in Mesa's order of operations.

All arrays end with an axis of the N points, so that NumPy's loops are long: control points of N points are (..., k, N),
those of all points (..., k, 1).

References: m_eval.c of Mesa 22.3.
"""

from __future__ import annotations

import numpy as np

F32 = np.float32
ONE = F32(1)


def curve(points: np.ndarray, t: np.ndarray) -> np.ndarray:
    """Return the points (k, N) at parameters t (N,) by Horner's scheme; `points` (order, k, N or 1)."""
    order = len(points)
    if order == 1:
        return np.broadcast_to(points[0], (points.shape[1], len(t))).copy()
    factor, s = F32(order - 1), ONE - t
    result = s * points[0] + factor * t * points[1]
    power = t * t
    for i in range(2, order):
        factor = factor * F32(order - i)
        factor = factor * (ONE / F32(i))
        result = s * result + factor * power * points[i]
        power = power * t
    return result


def surface(points: np.ndarray, u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Return the points (k, N) at parameters u, v (N,); `points` (u order, v order, k, 1)."""
    u_order, v_order = points.shape[:2]
    if v_order > u_order:
        if u_order == 1:
            return curve(points[0], v)
        return curve(np.stack([curve(points[:, j], u) for j in range(v_order)]), v)
    if v_order == 1:
        return curve(points[:, 0], u)
    return curve(np.stack([curve(points[i], v) for i in range(u_order)]), u)


def surface_with_tangents(
    points: np.ndarray, u: np.ndarray, v: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the points (k, N) of a surface, and its tangents along u and v, not scaled, by de Casteljau's algorithm.

    A map with a single row has no tangent across it, Mesa reads what lies behind it; here it is 0.
    """
    u_order, v_order = points.shape[:2]
    if min(u_order, v_order) == 1:  # the same curve twice
        points = np.repeat(points, 2 if u_order == 1 else 1, axis=0)
        points = np.repeat(points, 2 if v_order == 1 else 1, axis=1)
        u_order, v_order = points.shape[:2]
    if u_order < v_order:
        return _along_v(points, u, v)
    if v_order < u_order:
        point, dv, du = _along_v(points.swapaxes(0, 1), v, u, u_first=False)
        return point, du, dv
    return _square(points, u, v)


def _bilinear(net: np.ndarray, u: np.ndarray, v: np.ndarray, steps: int, u_first: bool) -> np.ndarray:
    """Return the net after the first `steps` bilinear steps, each of which leaves a row and a column less."""
    us, vs = ONE - u, ONE - v
    for _ in range(steps):
        if u_first:
            net = us * net[:-1] + u * net[1:]
            net = vs * net[:, :-1] + v * net[:, 1:]
        else:
            net = vs * net[:, :-1] + v * net[:, 1:]
            net = us * net[:-1] + u * net[1:]
    return net


def _square(points: np.ndarray, u: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return point and tangents of a surface with equal orders."""
    (a, b), (c, d) = _bilinear(points, u, v, len(points) - 2, u_first=True)
    us, vs = ONE - u, ONE - v
    du = vs * (c - a) + v * (d - b)
    dv = us * (b - a) + u * (d - c)
    return us * (vs * a + v * b) + u * (vs * c + v * d), du, dv


def _along_v(
    points: np.ndarray, u: np.ndarray, v: np.ndarray, u_first: bool = True
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return point and tangents of a surface whose order along v is the larger one.

    `u_first` tells whether the bilinear steps interpolate along u before v.
    """
    first, second = _bilinear(points, u, v, len(points) - 2, u_first)
    us, vs = ONE - u, ONE - v
    across, along = second - first, us * first + u * second
    while len(along) > 2:
        across = vs * across[:-1] + v * across[1:]
        along = vs * along[:-1] + v * along[1:]
    return vs * along[0] + v * along[1], vs * across[0] + v * across[1], along[1] - along[0]
