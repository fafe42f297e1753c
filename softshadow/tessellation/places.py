"""Comparisons of vertices and edges in the plane of the sweep, and where two edges cross.

Everything is in double precision and in libGLU's order of operations, since the order of events depends on the last bit
(libtess, geom.c).
"""

from __future__ import annotations

from collections.abc import Callable

from softshadow.tessellation.half_edges import HalfEdge, Vertex


def is_before(u: Vertex, v: Vertex) -> bool:
    """Return whether the sweep reaches `u` not after `v`: by s, then by t."""
    return u.s < v.s or (u.s == v.s and u.t <= v.t)


def are_equal(u: Vertex, v: Vertex) -> bool:
    """Return whether two vertices are at the same place."""
    return u.s == v.s and u.t == v.t


def goes_left(edge: HalfEdge) -> bool:
    """Return whether an edge ends not after it begins."""
    return is_before(edge.dst, edge.org)


def goes_right(edge: HalfEdge) -> bool:
    """Return whether an edge begins not after it ends."""
    return is_before(edge.org, edge.dst)


def height(u: Vertex, v: Vertex, w: Vertex) -> float:
    """Return how far `v` is above the edge from `u` to `w`, at its s; 0 for a vertical edge."""
    return _height(u.s, u.t, v.s, v.t, w.s, w.t)


def side(u: Vertex, v: Vertex, w: Vertex) -> float:
    """Return a number with the sign of `height`, which is cheaper and more exact."""
    return _side(u.s, u.t, v.s, v.t, w.s, w.t)


def _height(us: float, ut: float, vs: float, vt: float, ws: float, wt: float) -> float:
    left, right = vs - us, ws - vs
    if left + right > 0:
        if left < right:
            return (vt - ut) + (ut - wt) * (left / (left + right))
        return (vt - wt) + (wt - ut) * (right / (left + right))
    return 0.0


def _side(us: float, ut: float, vs: float, vt: float, ws: float, wt: float) -> float:
    left, right = vs - us, ws - vs
    return (vt - wt) * left + (vt - ut) * right if left + right > 0 else 0.0


def crossing(o1: Vertex, d1: Vertex, o2: Vertex, d2: Vertex) -> Vertex:
    """Return a vertex where two edges cross: each coordinate is computed on its own, and lies within both edges."""
    vertex = Vertex()
    vertex.s = _coordinate([(each.s, each.t) for each in (o1, d1, o2, d2)])
    vertex.t = _coordinate([(each.t, each.s) for each in (o1, d1, o2, d2)])
    return vertex


Place = tuple[float, float]


def _coordinate(ends: list[Place]) -> float:
    """Return the first coordinate of the crossing of two edges; `ends` are their ends, with that coordinate first."""
    o1, d1, o2, d2 = ends
    if o1 > d1:
        o1, d1 = d1, o1
    if o2 > d2:
        o2, d2 = d2, o2
    if o1 > o2:
        o1, o2, d1, d2 = o2, o1, d2, d1
    if o2 > d1:  # they do not cross; as good as possible
        return (o2[0] + d1[0]) / 2
    if d1 <= d2:
        return _weighted(_height, (o1, o2, d1), o2[0], (o2, d1, d2), d1[0], 1.0)
    return _weighted(_side, (o1, o2, d1), o2[0], (o1, d2, d1), d2[0], -1.0)


def _weighted(
    measure: Callable[..., float], one: tuple[Place, ...], x: float, other: tuple[Place, ...], y: float, sign: float
) -> float:
    """Return a value between `x` and `y`, by the measured distances of the two."""
    a = measure(*one[0], *one[1], *one[2])
    b = sign * measure(*other[0], *other[1], *other[2])
    if a + b < 0:
        a, b = -a, -b
    a, b = max(a, 0.0), max(b, 0.0)
    if a <= b:
        return (x + y) / 2 if b == 0 else x + (y - x) * (a / (a + b))
    return y + (x - y) * (b / (a + b))
