"""Perspective-correct interpolation of vertex outputs: plane equations per triangle, values per fragment.

Values are stored by column, (k, n), and programs see the transpose: a column is as long as the chunk of fragments, and
loops over fragments are vectorised here and in the programs.
"""

from typing import NamedTuple

import numpy as np

from softshadow.jit import inlined, kernel
from softshadow.pipeline.constants import ONE, ZERO
from softshadow.pipeline.geometry.triangle_setup import edge_differences, line_gradient, line_plane, plane
from softshadow.pipeline.memory.scratch import scratch
from softshadow.pipeline.memory.threads import parts_of, share
from softshadow.pipeline.records import Setup, Spans

NOT_NEEDED = np.int32(-1)  # no number of a triangle
LONG_SPAN = 8  # fragments; from this length on, a loop per column pays
TRIANGLES_PER_TASK = 1 << 12  # whose planes are computed by one thread in one go


class AttributePlanes(NamedTuple):
    """The planes of visible triangles: values (P, 3, k + 1); `place` (T,): the row of each triangle's planes."""

    values: np.ndarray
    place: np.ndarray


@kernel
def attribute_planes(window, values, back, vertices, front, needed, flat, provoking, ids, planes):
    """Fill planes (P, 3, k + 1): of value / w for each column, last of 1 / w; flat columns hold the value itself.

    The three numbers of a plane are its value at pixel (0, 0) and its steps to the next column and row. `vertices`
    (T, 3) are vertex numbers in the order of positive area, as for depth, `front` (T,) facing, `needed` (P,) the
    triangles that are needed, ``provoking[ids[t]]`` the vertex that flat columns take.
    """
    k = np.uint64(values.shape[1])
    for number in range(needed.shape[0]):  # no views of rows: each would be counted as a reference, which takes longer
        n = np.uint64(number)
        t = np.uint64(needed[n])
        first, second, third, is_front = vertices[t, 0], vertices[t, 1], vertices[t, 2], front[t] != 0
        v0, v1, v2 = np.uint64(first), np.uint64(second), np.uint64(third)
        if third < 0:
            line_or_point_planes(window, values if is_front else back, first, second, planes, n)
        else:
            x, y, w0, w1, w2 = window[v0, 0], window[v0, 1], window[v0, 3], window[v1, 3], window[v2, 3]
            dx01, dy01, dx20, dy20, over_area = edge_differences(window, v0, v1, v2)
            dx01, dy01, dx20, dy20 = dx01 * over_area, dy01 * over_area, dx20 * over_area, dy20 * over_area
            for c in range(k):
                a0 = values[v0, c] if is_front else back[v0, c]
                a1 = values[v1, c] if is_front else back[v1, c]
                a2 = values[v2, c] if is_front else back[v2, c]
                planes[n, 0, c], planes[n, 1, c], planes[n, 2, c] = plane(
                    x, y, dx01, dy01, dx20, dy20, a0 * w0, a1 * w1, a2 * w2
                )
            planes[n, 0, k], planes[n, 1, k], planes[n, 2, k] = plane(x, y, dx01, dy01, dx20, dy20, w0, w1, w2)
        for c in range(k):
            if flat[c]:
                source = np.uint64(provoking[ids[t]])
                planes[n, 0, c] = values[source, c] if is_front else back[source, c]


@inlined
def line_or_point_planes(window, values, a, b, planes, n):
    """Fill row `n` of the planes: those of a line from vertex `a` to `b`, or of a point (`b` is -1), constant ones."""
    k = values.shape[1]
    if b < 0:
        w = window[a, 3]
        for c in range(k + 1):
            planes[n, 0, c], planes[n, 1, c], planes[n, 2, c] = (values[a, c] * w if c < k else w), ZERO, ZERO
        return
    w0, w1 = window[a, 3], window[b, 3]
    dx, dy, over_area = line_gradient(window, a, b)
    for c in range(k + 1):
        value0 = values[a, c] * w0 if c < k else w0
        value1 = values[b, c] * w1 if c < k else w1
        planes[n, 0, c], planes[n, 1, c], planes[n, 2, c] = line_plane(
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
        triangle_planes, j = planes[places[triangles[r]]], coordinates[rows[r]]
        at_origin, per_column, per_row = triangle_planes[0], triangle_planes[1], triangle_planes[2]
        columns = coordinates[lefts[r] : lefts[r] + end - first]
        if end - first < LONG_SPAN:
            for n in range(end - first):
                i, values = columns[n], out[:, first + n]
                w_here = ONE / ((per_column[k] * i + at_origin[k]) + per_row[k] * j)
                for c in range(k):
                    values[c] = (
                        at_origin[c] if flat[c] else ((per_column[c] * i + at_origin[c]) + per_row[c] * j) * w_here
                    )
            continue
        w, start, slope, row_term = out[k, first:end], at_origin[k], per_column[k], per_row[k] * j
        for n in range(end - first):
            w[n] = ONE / ((slope * columns[n] + start) + row_term)
        for c in range(k):
            values, start, slope, row_term = out[c, first:end], at_origin[c], per_column[c], per_row[c] * j
            if flat[c]:
                values[:] = start
                continue
            for n in range(end - first):
                values[n] = ((slope * columns[n] + start) + row_term) * w[n]


def planes_of(
    spans: Spans,
    triangles: Setup,
    window: np.ndarray,
    values: np.ndarray,
    back: np.ndarray | None,
    flat: np.ndarray,
    provoking: np.ndarray,
) -> AttributePlanes:
    """Return the planes of the triangles that spans belong to; see `attribute_planes`.

    Parameters
    ----------
    window : (V, 4) window x, y, z, 1/w
    values, back : (V, k) from the vertex stage, for front- and back-facing triangles
    flat : (k,) bool
    provoking : (T,) int32, by the triangles that ``triangles.ids`` numbers
    """
    place, needed = scratch(len(triangles.ids), np.int32), scratch(len(triangles.ids), np.int32)
    needed = needed[: number_triangles(spans.triangle, place, needed)]
    planes = scratch((len(needed), 3, values.shape[1] + 1), window.dtype)
    parts = parts_of(len(needed), TRIANGLES_PER_TASK)

    def fill_part(n: int) -> None:
        rows = slice(*parts[n])
        attribute_planes(
            window, values, values if back is None else back, triangles.vertices, triangles.front, needed[rows], flat,
            provoking, triangles.ids, planes[rows],
        )  # fmt: skip

    share(fill_part, len(parts))
    return AttributePlanes(planes, place)


def coordinates_of(spans: Spans, dtype: np.dtype) -> np.ndarray:
    """Return 0, 1, 2 ... as numbers of a type, as far as the rows and columns of the spans go."""
    largest = max(spans.row.max(initial=0), (spans.left + np.diff(spans.start)).max(initial=0))
    return np.arange(largest + 1, dtype=dtype)


@kernel
def number_triangles(triangles, place, needed):
    """Number the triangles of spans in drawing order; return how many they are.

    Neighbours in a mesh have vertices in common, so the processor's cache has them still. `place` (T,) receives the
    numbers, and -1 for other triangles; `needed` (T,) the triangles.
    """
    place[:] = NOT_NEEDED
    for r in range(triangles.shape[0]):
        place[np.uint64(triangles[r])] = 0
    n = np.uint64(0)
    for t in range(np.uint64(place.shape[0])):
        needed[n] = t
        is_needed = place[t] != NOT_NEEDED
        place[t] = np.int32(n) if is_needed else NOT_NEEDED  # of both types, Numba would make a float64
        n += np.uint64(is_needed)
    return n


def inputs_at(spans: Spans, planes: AttributePlanes, flat: np.ndarray) -> np.ndarray:
    """Return the inputs (n, k) of a program's fragment stage: a row per fragment, each column contiguous."""
    out = scratch((len(flat) + 1, spans.fragments), planes.values.dtype)
    coordinates = coordinates_of(spans, planes.values.dtype)
    interpolate(planes.values, planes.place, *spans, coordinates, flat, out)
    return out[:-1].T
