"""Interpolation of what the vertex stage hands on: planes per triangle, values per fragment, perspective-correct.

The values are kept by column: (k, n), of which programs see the transpose. A column is then as long as the batch, and
loops over fragments are vectorised here and in the programs.
"""

from typing import NamedTuple

import numpy as np

from softshadow.jit import kernel
from softshadow.pipeline.constants import ONE, ZERO
from softshadow.pipeline.runs import Runs
from softshadow.pipeline.setup import Setup, edge_differences, line_gradient, line_plane, plane

LONG = 8  # fragments; a run of so many is worth a loop per column


class Planes(NamedTuple):
    """Planes of the triangles that are seen: values (P, k + 1, 3), and where among them each triangle's are (T,)."""

    values: np.ndarray
    place: np.ndarray


@kernel
def attribute_planes(window, values, back, vertices, front, seen, flat, provoking, planes):
    """Fill planes (P, k + 1, 3): of value / w for each column, last of 1 / w; flat columns hold the value itself.

    `vertices` (T, 3) are vertex numbers in the order of positive area, as for depth, `front` (T,) facing, `seen` (P,)
    the triangles that are needed, `provoking` (T,) the vertex that flat columns take.
    """
    k = values.shape[1]
    for n in range(seen.shape[0]):
        t = seen[n]
        v0, v1, v2 = vertices[t, 0], vertices[t, 1], vertices[t, 2]
        source = values if front[t] else back
        if v2 < 0:
            line_or_point_planes(window, source, v0, v1, flat, provoking[t], planes[n])
            continue
        dx01, dy01, dx20, dy20, over_area = edge_differences(window, v0, v1, v2)
        dx01, dy01, dx20, dy20 = dx01 * over_area, dy01 * over_area, dx20 * over_area, dy20 * over_area
        w0, w1, w2 = window[v0, 3], window[v1, 3], window[v2, 3]
        for c in range(k):
            if flat[c]:
                planes[n, c, 0] = source[provoking[t], c]
            else:
                planes[n, c, 0], planes[n, c, 1], planes[n, c, 2] = plane(
                    window[v0, 0], window[v0, 1], dx01, dy01, dx20, dy20,
                    source[v0, c] * w0, source[v1, c] * w1, source[v2, c] * w2,
                )  # fmt: skip
        planes[n, k, 0], planes[n, k, 1], planes[n, k, 2] = plane(
            window[v0, 0], window[v0, 1], dx01, dy01, dx20, dy20, w0, w1, w2
        )


@kernel
def line_or_point_planes(window, values, a, b, flat, provoking, planes):
    """Fill planes (k + 1, 3) of a line from vertex `a` to `b`, or of a point (`b` is -1): there all is constant."""
    k = values.shape[1]
    is_point = b < 0
    b = a if is_point else b
    w0, w1 = window[a, 3], window[b, 3]
    dx, dy, over_area = line_gradient(window, a, b)
    for c in range(k + 1):
        if c < k and flat[c]:
            planes[c, 0] = values[provoking, c]
            continue
        value0 = values[a, c] * w0 if c < k else w0
        value1 = values[b, c] * w1 if c < k else w1
        if is_point:
            planes[c, 0], planes[c, 1], planes[c, 2] = value0, ZERO, ZERO
        else:
            planes[c, 0], planes[c, 1], planes[c, 2] = line_plane(
                window[a, 0], window[a, 1], dx, dy, over_area, value0, value1
            )


@kernel
def interpolate(planes, places, rows, lefts, triangles, starts, coordinates, flat, out):
    """Write the values of each fragment, out (k + 1, n), of which the last row is w.

    `coordinates` holds 0, 1, 2 ... in the precision of the planes.
    """
    k = flat.shape[0]
    for r in range(rows.shape[0]):
        first, end = starts[r], starts[r + 1]
        of_triangle, j = planes[places[triangles[r]]], coordinates[rows[r]]
        columns = coordinates[lefts[r] : lefts[r] + end - first]
        if end - first < LONG:
            for n in range(end - first):
                i, values = columns[n], out[:, first + n]
                w_here = ONE / ((of_triangle[k, 1] * i + of_triangle[k, 0]) + of_triangle[k, 2] * j)
                for c in range(k):
                    if flat[c]:
                        values[c] = of_triangle[c, 0]
                    else:
                        values[c] = ((of_triangle[c, 1] * i + of_triangle[c, 0]) + of_triangle[c, 2] * j) * w_here
            continue
        w = out[k, first:end]
        base, step, across = of_triangle[k, 0], of_triangle[k, 1], of_triangle[k, 2] * j
        for n in range(end - first):
            w[n] = ONE / ((step * columns[n] + base) + across)
        for c in range(k):
            values = out[c, first:end]
            if flat[c]:
                values[:] = of_triangle[c, 0]
                continue
            base, step, across = of_triangle[c, 0], of_triangle[c, 1], of_triangle[c, 2] * j
            for n in range(end - first):
                values[n] = ((step * columns[n] + base) + across) * w[n]


def planes_of(
    triangles_seen: np.ndarray,
    triangles: Setup,
    window: np.ndarray,
    values: np.ndarray,
    back: np.ndarray | None,
    flat: np.ndarray,
    provoking: np.ndarray,
) -> Planes:
    """Return the planes of the triangles that are seen; see `attribute_planes`.

    Parameters
    ----------
    triangles_seen : (N,) int32, rows of `triangles`, each any number of times
    window : (V, 4) window x, y, z, 1/w
    values, back : (V, k) from the vertex stage, for front- and back-facing triangles
    flat : (k,) bool
    provoking : (T,) int32, by the triangles that ``triangles.ids`` numbers
    """
    place = np.full(len(triangles.ids), -1, np.int32)
    seen = np.empty(len(triangles.ids), np.int32)
    seen = seen[: number_in_order(triangles_seen, place, seen)]
    planes = np.empty((len(seen), values.shape[1] + 1, 3), window.dtype)
    attribute_planes(
        window, values, values if back is None else back, triangles.vertices, triangles.front, seen, flat,
        provoking[triangles.ids], planes,
    )  # fmt: skip
    return Planes(planes, place)


@kernel
def number_in_order(triangles, place, seen):
    """Number triangles in the order in which they are first seen, as runs will need their planes; returns how many.

    `place` (T,) holds -1s and receives the numbers, `seen` the triangles.
    """
    count = 0
    for t in triangles:
        if place[t] < 0:
            place[t], seen[count] = count, t
            count += 1
    return count


def inputs_at(runs: Runs, planes: Planes, flat: np.ndarray) -> np.ndarray:
    """Return what the fragment stage of a program gets: (n, k), one row per fragment, each column in one piece."""
    furthest = runs.left + np.diff(runs.start)
    size = int(max(runs.row.max(initial=0) + 1, furthest.max(initial=0)))
    out = np.empty((len(flat) + 1, runs.fragments), planes.values.dtype)
    interpolate(planes.values, planes.place, *runs, np.arange(size, dtype=out.dtype), flat, out)
    return out[:-1].T
