"""Cut what a chain of directed edges in the plane winds around into triangles, level by level.

Between two levels at which an edge ends or two edges cross, the edges only have to be sorted. Nothing is assumed of the
chain but that it is closed: loops may cross themselves, each other, and run along each other.

References
----------
Bentley & Ottmann 1979, "Algorithms for reporting and counting geometric intersections", with all levels known at first.
"""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

# a slab this much thinner than the range of levels comes from rounding, and covers no sample
THIN = 1e-12
# pairs of edges that are compared at a time
AT_A_TIME = 1 << 18


class Edges(NamedTuple):
    """Edges that run upwards from (x0, y0) to (x1, y1), each (E,) float64; sign -1 where they ran down in the chain."""

    x0: np.ndarray
    y0: np.ndarray
    x1: np.ndarray
    y1: np.ndarray
    sign: np.ndarray

    def x_at(self, y: np.ndarray | float) -> np.ndarray:
        """Return where the edges' lines are at a level."""
        return self.x0 + (y - self.y0) / (self.y1 - self.y0) * (self.x1 - self.x0)


def cover(chain: np.ndarray, low: float, high: float) -> np.ndarray:
    """Return triangles that cover, without overlap, the points which the chain winds around in either sense.

    Parameters
    ----------
    chain : (E, 2, 2) float64    edges from point to point; at every point as many arrive as leave
    low, high : float            only between these two levels of y

    Returns
    -------
    (N, 3, 2) float64            counter-clockwise; no corner of one lies inside an edge of another
    """
    edges = upwards(chain, low, high)
    levels = levels_of(edges, low, high)
    slabs = [spans_between(edges, a, b) for a, b in pairwise(levels)]
    triangles: list[np.ndarray] = []
    for index, (bottom, top) in enumerate(slabs):
        below = slabs[index - 1][1] if index else bottom
        above = slabs[index + 1][0] if index + 1 < len(slabs) else top
        on_bottom, on_top = np.union1d(bottom, below), np.union1d(top, above)
        for (left_b, right_b), (left_t, right_t) in zip(bottom, top, strict=True):
            lower = on_bottom[(on_bottom >= left_b) & (on_bottom <= right_b)]
            upper = on_top[(on_top >= left_t) & (on_top <= right_t)]
            triangles += strip(lower, levels[index], upper, levels[index + 1])
    return np.array(triangles).reshape(-1, 3, 2)


def upwards(chain: np.ndarray, low: float, high: float) -> Edges:
    """Return the edges of a chain that have a part between two levels; a level edge bounds nothing from the side."""
    start, end = chain[:, 0], chain[:, 1]
    falls = end[:, 1] < start[:, 1]
    bottom, top = np.where(falls[:, None], end, start), np.where(falls[:, None], start, end)
    kept = (bottom[:, 1] < top[:, 1]) & (top[:, 1] > low) & (bottom[:, 1] < high)
    (x0, y0), (x1, y1) = bottom[kept].T, top[kept].T
    return Edges(x0, y0, x1, y1, np.where(falls, -1, 1)[kept])


def levels_of(edges: Edges, low: float, high: float) -> np.ndarray:
    """Return the levels between which no edge ends and none cross, ascending, from low to high."""
    found = [np.array([low, high]), edges.y0, edges.y1]
    count = len(edges.sign)
    rows = max(1, AT_A_TIME // max(count, 1))
    for first in range(0, count, rows):
        one = Edges(*(part[first : first + rows, None] for part in edges))
        begin, end = np.maximum(one.y0, edges.y0), np.minimum(one.y1, edges.y1)
        at_begin, at_end = one.x_at(begin) - edges.x_at(begin), one.x_at(end) - edges.x_at(end)
        crossing = (begin < end) & (at_begin * at_end < 0)
        share = at_begin[crossing] / (at_begin[crossing] - at_end[crossing])
        found.append(begin[crossing] + share * (end - begin)[crossing])
    levels = np.unique(np.clip(np.concatenate(found), low, high))
    return levels[np.append(True, np.diff(levels) > THIN * (high - low))]


def spans_between(edges: Edges, bottom: float, top: float) -> tuple[np.ndarray, np.ndarray]:
    """Return what the chain winds around between two levels: left and right (S, 2) at the bottom, and at the top."""
    middle = (bottom + top) / 2
    active = np.flatnonzero((edges.y0 < middle) & (edges.y1 > middle))
    across = Edges(*(part[active] for part in edges))
    order = np.argsort(across.x_at(middle), kind="stable")
    winding = np.cumsum(across.sign[order])
    before = np.concatenate([[0], winding[:-1]])
    left, right = order[(before == 0) & (winding != 0)], order[(before != 0) & (winding == 0)]
    count = min(len(left), len(right))  # where the chain is open by rounding, a left end has no right one
    at_bottom, at_top = across.x_at(bottom), across.x_at(top)
    spans = np.stack([left[:count], right[:count]], axis=1)
    return np.sort(at_bottom[spans], axis=1), np.sort(at_top[spans], axis=1)  # at a crossing the two round apart


def strip(lower: np.ndarray, bottom: float, upper: np.ndarray, top: float) -> list[np.ndarray]:
    """Return counter-clockwise triangles between ascending points on two levels; none without area."""
    fan = [[[a, bottom], [b, bottom], [upper[0], top]] for a, b in pairwise(lower)]
    fan += [[[lower[-1], bottom], [b, top], [a, top]] for a, b in pairwise(upper)]
    return [np.array(triangle) for triangle in fan]
