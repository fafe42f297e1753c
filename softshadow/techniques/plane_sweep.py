"""Triangulate what a chain of directed edges in the plane winds around, level by level.

The levels are the values of y at which an edge ends or two edges cross; between two of them the edges only have to be
sorted. The chain has to be closed, and nothing else: loops may cross themselves and each other, or share edges.

References
----------
Bentley & Ottmann 1979, "Algorithms for reporting and counting geometric intersections"; here all levels are
computed first.
"""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

# a slab thinner than this share of the range of levels comes from rounding, and covers no sample
THIN = 1e-12
# number of pairs of edges that are compared at a time
AT_A_TIME = 1 << 18


class Edges(NamedTuple):
    """Edges that run upwards from (x0, y0) to (x1, y1), each (E,) float64; sign is -1 if they run down in the chain."""

    x0: np.ndarray
    y0: np.ndarray
    x1: np.ndarray
    y1: np.ndarray
    sign: np.ndarray

    def x_at(self, y: np.ndarray | float) -> np.ndarray:
        """Return where the lines of the edges cross a level."""
        return self.x0 + (y - self.y0) / (self.y1 - self.y0) * (self.x1 - self.x0)


def triangulate_nonzero(chain: np.ndarray, low: float, high: float) -> np.ndarray:
    """Return triangles that cover, without overlap, the points with a winding number other than 0.

    Parameters
    ----------
    chain : (E, 2, 2) float64    edges from point to point; at every point as many edges end as begin
    low, high : float            the range of y that is covered

    Returns
    -------
    (N, 3, 2) float64            counter-clockwise; no corner of one lies within an edge of another
    """
    edges = upwards(chain, low, high)
    levels = levels_of(edges, low, high)
    slabs = trapezoids(edges, levels)
    bottom, top = levels[slabs[:, 2]], levels[slabs[:, 3]]
    # left and right end at the bottom, then at the top; where two edges cross, rounding may swap them
    sides = [Edges(*(part[side] for part in edges)) for side in slabs[:, :2].T]
    ends = np.array([[side.x_at(level) for side in sides] for level in (bottom, top)])
    ends.sort(axis=1)
    corners: dict[int, list[float]] = {}  # by level: of trapezoids that end there and that begin there
    for at_level, (left, right) in zip(slabs[:, 2:].T, ends, strict=True):
        for level, one, other in zip(at_level.tolist(), left.tolist(), right.tolist(), strict=True):
            corners.setdefault(level, []).extend((one, other))
    points = {level: np.unique(xs) for level, xs in corners.items()}
    triangles: list[list[list[float]]] = []
    for (_, _, i, j), ((lower_left, upper_left), (lower_right, upper_right)) in zip(
        slabs.tolist(), ends.transpose(2, 1, 0), strict=True
    ):
        lower = points[i][np.searchsorted(points[i], lower_left) : np.searchsorted(points[i], lower_right, "right")]
        upper = points[j][np.searchsorted(points[j], upper_left) : np.searchsorted(points[j], upper_right, "right")]
        triangles += strip(lower.tolist(), float(levels[i]), upper.tolist(), float(levels[j]))
    return np.array(triangles, np.float64).reshape(-1, 3, 2)


def trapezoids(edges: Edges, levels: np.ndarray) -> np.ndarray:
    """Return (N, 4) int: left and right edge, bottom and top level of the trapezoids inside the chain."""
    slabs: list[tuple[int, int, int, int]] = []
    begun: dict[tuple[int, int], int] = {}
    for index, (bottom, top) in enumerate(pairwise(levels)):
        spans = spans_between(edges, bottom, top)
        slabs += [(*span, first, index) for span, first in begun.items() if span not in spans]
        begun = {span: begun.get(span, index) for span in spans}
    slabs += [(*span, first, len(levels) - 1) for span, first in begun.items()]
    return np.array(slabs, np.int64).reshape(-1, 4)


def upwards(chain: np.ndarray, low: float, high: float) -> Edges:
    """Return the edges of a chain that have a part between two levels, without the horizontal ones."""
    start, end = chain[:, 0], chain[:, 1]
    falls = end[:, 1] < start[:, 1]
    bottom, top = np.where(falls[:, None], end, start), np.where(falls[:, None], start, end)
    between = (bottom[:, 1] < top[:, 1]) & (top[:, 1] > low) & (bottom[:, 1] < high)
    (x0, y0), (x1, y1) = bottom[between].T, top[between].T
    return Edges(x0, y0, x1, y1, np.where(falls, -1, 1)[between])


def levels_of(edges: Edges, low: float, high: float) -> np.ndarray:
    """Return the levels, ascending from low to high, between which no edge ends and no edges cross."""
    levels = [np.array([low, high]), edges.y0, edges.y1]
    number = len(edges.sign)
    rows = max(1, AT_A_TIME // max(number, 1))
    for first in range(0, number, rows):
        one = Edges(*(part[first : first + rows, None] for part in edges))
        begin, end = np.maximum(one.y0, edges.y0), np.minimum(one.y1, edges.y1)
        at_begin, at_end = one.x_at(begin) - edges.x_at(begin), one.x_at(end) - edges.x_at(end)
        crossing = (begin < end) & (at_begin * at_end < 0)
        share = at_begin[crossing] / (at_begin[crossing] - at_end[crossing])
        levels.append(begin[crossing] + share * (end - begin)[crossing])
    ascending = np.unique(np.clip(np.concatenate(levels), low, high))
    return ascending[np.append(True, np.diff(ascending) > THIN * (high - low))]


def spans_between(edges: Edges, bottom: float, top: float) -> dict[tuple[int, int], None]:
    """Return the pairs of edges, left and right, that bound the inside of the chain between two levels, in order."""
    middle = (bottom + top) / 2
    active = np.flatnonzero((edges.y0 < middle) & (edges.y1 > middle))
    order = active[np.argsort(edges.x_at(middle)[active], kind="stable")]
    inside = np.cumsum(edges.sign[order]) != 0
    changes = order[np.flatnonzero(np.diff(inside, prepend=False))].tolist()
    # if rounding has opened the chain, the last left edge has no right one
    return dict.fromkeys(zip(changes[::2], changes[1::2], strict=False))


def strip(lower: list[float], bottom: float, upper: list[float], top: float) -> list[list[list[float]]]:
    """Return counter-clockwise triangles between ascending points on two levels; all have an area."""
    fan = [[[a, bottom], [b, bottom], [upper[0], top]] for a, b in pairwise(lower)]
    return fan + [[[lower[-1], bottom], [b, top], [a, top]] for a, b in pairwise(upper)]
