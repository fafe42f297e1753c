"""Smooth lines and points (GL_LINE_SMOOTH, GL_POINT_SMOOTH): rectangles whose fragments have a coverage.

Mesa makes two triangles of each, wider by half a pixel on all sides. Four more values at their corners say where a
fragment lies; the fragment's alpha is multiplied by the coverage that follows from them (draw_pipe_aaline.c,
draw_pipe_aapoint.c, nir_draw_helpers.c).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from softshadow.jit import kernel
from softshadow.pipeline.constants import HALF, ONE, TWO
from softshadow.programs import Program

ALPHA = 3
PLACE_COLUMNS = 4  # values that tell where a fragment lies
LARGEST_SIZE = 255.0
# the same for fragments that are covered as a whole
INSIDE_LINE, INSIDE_POINT = (0.0, 1.0, 0.0, 1.0), (0.0, 0.0, 0.0, 1.0)
LINE_TRIANGLES, POINT_TRIANGLES = ((2, 1, 0), (3, 1, 2)), ((0, 1, 2), (0, 2, 3))  # by the corners of a rectangle


def smooth_lines(
    window: np.ndarray,
    values: np.ndarray,
    lines: np.ndarray,
    provoking: np.ndarray,
    flat: np.ndarray,
    widths: np.ndarray,
    corners: np.ndarray,
    corner_values: np.ndarray,
) -> None:
    """Write the rectangles of lines, four vertices each; their triangles are `LINE_TRIANGLES`.

    Parameters
    ----------
    window, values : (V, 4) and (V, k) of vertices
    lines : (L, 2) int32, vertices
    provoking : (L,) int32, the vertices whose values the columns take that are `flat` (at least k)
    widths : (L,) float64, in pixels
    corners, corner_values : receive window (4L, 4) and values (4L, k + 4), of which the last are the places
    """
    real = window.dtype.type
    wide = real(0.5) * np.minimum(widths, LARGEST_SIZE).astype(real) + real(0.5)
    half_widths = np.where(widths <= 1, real(1), wide)
    write_line_corners(window, values, lines, provoking, flat, half_widths, corners, corner_values)


@kernel
def write_line_corners(window, values, lines, provoking, flat, half_widths, corners, corner_values):
    """Write what `smooth_lines` does.

    The angles of lines are computed by the functions of the C library, as Mesa does; interpreted, they are those of
    double precision.
    """
    k = values.shape[1]
    for n in range(lines.shape[0]):
        a, b, source, half_width = lines[n, 0], lines[n, 1], provoking[n], half_widths[n]
        x, y = window[b, 0] - window[a, 0], window[b, 1] - window[a, 1]
        angle = math.atan2(y, x)
        corners[4 * n, 0], corners[4 * n, 1] = math.cos(angle), math.sin(angle)
        cos, sin = corners[4 * n, 0], corners[4 * n, 1]  # rounded to the type of the window
        half_length = HALF * np.sqrt(x * x + y * y)
        half_length = TWO * half_length if half_length < HALF else half_length + HALF
        for corner in range(4):
            m, end = 4 * n + corner, a if corner < 2 else b
            u, v = -HALF if corner < 2 else HALF, half_width if corner % 2 == 0 else -half_width
            corners[m, 0] = window[end, 0] + (u * cos - v * sin)
            corners[m, 1] = window[end, 1] + (u * sin + v * cos)
            corners[m, 2], corners[m, 3] = window[end, 2], window[end, 3]
            for c in range(k):
                corner_values[m, c] = values[source if flat[c] else end, c]
            corner_values[m, k], corner_values[m, k + 1] = -v, half_width
            corner_values[m, k + 2] = half_length if corner >= 2 else -half_length
            corner_values[m, k + 3] = half_length


def smooth_points(
    window: np.ndarray,
    values: np.ndarray,
    points: np.ndarray,
    sizes: np.ndarray,
    corners: np.ndarray,
    corner_values: np.ndarray,
) -> None:
    """Write the squares of points (P,) int32 with `sizes` (P,), as `smooth_lines`; triangles are `POINT_TRIANGLES`."""
    radius = window.dtype.type(0.5) * sizes
    write_point_corners(window, values, points, radius, corners, corner_values)


@kernel
def write_point_corners(window, values, points, radius, corners, corner_values):
    """Write what `smooth_points` does."""
    k = values.shape[1]
    for n in range(points.shape[0]):
        point, over_radius = points[n], ONE / radius[n]
        inner = ONE - TWO * over_radius + over_radius * over_radius
        for corner in range(4):
            m = 4 * n + corner
            u, v = ONE if corner == 1 or corner == 2 else -ONE, ONE if corner >= 2 else -ONE
            corners[m, 0], corners[m, 1] = window[point, 0] + u * radius[n], window[point, 1] + v * radius[n]
            corners[m, 2], corners[m, 3] = window[point, 2], window[point, 3]
            for c in range(k):
                corner_values[m, c] = values[point, c]
            corner_values[m, k], corner_values[m, k + 1] = u, v
            corner_values[m, k + 2], corner_values[m, k + 3] = inner, ONE


def line_coverage(places: np.ndarray) -> np.ndarray:
    """Return the coverage (n,) of fragments of smooth lines, from their places (n, 4)."""
    real = places.dtype.type
    across, along = (np.clip(places[:, c + 1] - np.abs(places[:, c]), real(0), real(1)) for c in (0, 2))
    return across * along


def point_coverage(places: np.ndarray) -> np.ndarray:
    """Return the coverage (n,) of fragments of smooth points, from their places (n, 4).

    Mesa 22.3 confuses the two sides: the alpha at the rim is not changed, and the inner part, whose coverage should be
    1, is multiplied by a number above 1 (nir_draw_helpers.c).
    """
    x, y, k, one = places.T
    distance = x * x + y * y
    return np.where(k >= distance, (places.dtype.type(1) / (one - k)) * (one - distance), one)


def is_outside_point(places: np.ndarray) -> np.ndarray:
    """Return which fragments (n,) lie outside of their smooth point."""
    x, y, _, one = places.T
    return x * x + y * y > one


COVERAGES: dict[str, Callable[[np.ndarray], np.ndarray]] = {"line": line_coverage, "point": point_coverage}


def with_coverage(program: Program, columns: int, kind: str) -> Program:
    """Return a program whose alpha is multiplied by a coverage; the places follow the `columns` of the program."""

    def shade(inputs: np.ndarray, uniforms: Mapping[str, Any], out: np.ndarray) -> None:
        program.shade(inputs[:, :columns], uniforms, out)
        out[:, ALPHA] *= COVERAGES[kind](inputs[:, columns : columns + PLACE_COLUMNS])

    return replace(program, shade=shade)
