"""Interpolation of what the vertex stage hands on: planes per triangle, values per fragment, perspective-correct."""

import numpy as np

from softshadow.jit import kernel
from softshadow.pipeline.constants import ONE
from softshadow.pipeline.fragments import Fragments
from softshadow.pipeline.setup import Setup, edge_differences, line_gradient, line_plane, plane


@kernel
def attribute_planes(window, values, back, vertices, front, wanted, flat, provoking, planes):
    """Fill planes (n, k + 1, 3): of value / w for each column, last of 1 / w; flat columns hold the value itself.

    `vertices` (n, 3) are vertex numbers in the order of positive area, as for depth, `front` (n,) facing, `wanted` (n,)
    which triangles are needed, `provoking` (n,) the vertex that flat columns take.
    """
    k = values.shape[1]
    for t in range(vertices.shape[0]):
        if not wanted[t]:
            continue
        v0, v1, v2 = vertices[t, 0], vertices[t, 1], vertices[t, 2]
        source = values if front[t] else back
        if v2 < 0:
            line_or_point_planes(window, source, v0, v1, flat, provoking[t], planes[t])
            continue
        dx01, dy01, dx20, dy20, over_area = edge_differences(window, v0, v1, v2)
        dx01, dy01, dx20, dy20 = dx01 * over_area, dy01 * over_area, dx20 * over_area, dy20 * over_area
        w0, w1, w2 = window[v0, 3], window[v1, 3], window[v2, 3]
        for c in range(k):
            if flat[c]:
                planes[t, c, 0] = source[provoking[t], c]
            else:
                planes[t, c, 0], planes[t, c, 1], planes[t, c, 2] = plane(
                    window[v0, 0], window[v0, 1], dx01, dy01, dx20, dy20,
                    source[v0, c] * w0, source[v1, c] * w1, source[v2, c] * w2,
                )  # fmt: skip
        planes[t, k, 0], planes[t, k, 1], planes[t, k, 2] = plane(
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
            planes[c, 0] = value0
        else:
            planes[c, 0], planes[c, 1], planes[c, 2] = line_plane(
                window[a, 0], window[a, 1], dx, dy, over_area, value0, value1
            )


@kernel
def interpolate(planes, rows, columns, numbers, coordinates, flat, out):
    """Write the values of each fragment, (n, k); `coordinates` holds 0, 1, 2 ... in the precision of the planes."""
    k = out.shape[1]
    for n in range(rows.shape[0]):
        t = numbers[n]
        i, j = coordinates[columns[n]], coordinates[rows[n]]
        w = ONE / ((planes[t, k, 1] * i + planes[t, k, 0]) + planes[t, k, 2] * j)
        for c in range(k):
            if flat[c]:
                out[n, c] = planes[t, c, 0]
            else:
                out[n, c] = ((planes[t, c, 1] * i + planes[t, c, 0]) + planes[t, c, 2] * j) * w


def planes_of(
    wanted: np.ndarray,
    triangles: Setup,
    window: np.ndarray,
    values: np.ndarray,
    back: np.ndarray | None,
    flat: np.ndarray,
    provoking: np.ndarray,
) -> np.ndarray:
    """Return the planes (n, k + 1, 3) of all triangles, filled for the wanted ones; see `attribute_planes`.

    Parameters
    ----------
    wanted : (N,) int32, rows of `triangles`, each any number of times
    window : (V, 4) window x, y, z, 1/w
    values, back : (V, k) from the vertex stage, for front- and back-facing triangles
    flat : (k,) bool
    provoking : (T,) int32, by the triangles that ``triangles.ids`` numbers
    """
    is_wanted = np.zeros(len(triangles.ids), np.uint8)
    is_wanted[wanted] = 1
    planes = np.zeros((len(triangles.ids), values.shape[1] + 1, 3), window.dtype)
    attribute_planes(
        window, values, values if back is None else back, triangles.vertices, triangles.front, is_wanted, flat,
        provoking[triangles.ids], planes,
    )  # fmt: skip
    return planes


def inputs_at(fragments: Fragments, planes: np.ndarray, flat: np.ndarray) -> np.ndarray:
    """Return what the fragment stage of a program gets: (n, k), one row per fragment."""
    size = int(max(fragments.row.max(initial=0), fragments.column.max(initial=0))) + 1
    out = np.empty((len(fragments.row), len(flat)), planes.dtype)
    interpolate(planes, *fragments, np.arange(size, dtype=planes.dtype), flat, out)
    return out
