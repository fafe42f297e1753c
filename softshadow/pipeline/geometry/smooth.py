"""Smooth lines and points (GL_LINE_SMOOTH, GL_POINT_SMOOTH): rectangles whose fragments have a coverage.

Mesa makes two triangles of each, wider by half a pixel on all sides. Four more values at their corners say where a
fragment lies; the fragment's alpha is multiplied by the coverage that follows from them (draw_pipe_aaline.c,
draw_pipe_aapoint.c, nir_draw_helpers.c).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from softshadow.jit import kernel
from softshadow.programs import Program

ALPHA = 3
PLACE_COLUMNS = 4  # values that tell where a fragment lies
LARGEST_SIZE = 255.0
# the same for fragments that are covered as a whole
INSIDE_LINE, INSIDE_POINT = (0.0, 1.0, 0.0, 1.0), (0.0, 0.0, 0.0, 1.0)


class Rectangles(NamedTuple):
    """Rectangles with four vertices each: window (4N, 4), values (4N, k), places (4N, 4), triangles (2N, 3) int32."""

    window: np.ndarray
    values: np.ndarray
    places: np.ndarray
    triangles: np.ndarray


def smooth_lines(window: np.ndarray, values: np.ndarray, width: float) -> Rectangles:
    """Return the rectangles of lines; `window` (L, 2, 4) and `values` (L, 2, k) are those of both ends."""
    real = window.dtype.type
    half_width = real(1) if width <= 1 else real(0.5) * real(min(width, LARGEST_SIZE)) + real(0.5)
    along = window[:, 1, :2] - window[:, 0, :2]
    length = np.sqrt(along[:, 0] * along[:, 0] + along[:, 1] * along[:, 1])
    cos, sin = np.empty_like(length), np.empty_like(length)
    write_directions(along, cos, sin)
    half_length = real(0.5) * length
    half_length = np.where(half_length < real(0.5), real(2) * half_length, half_length + real(0.5))
    corners, places = np.repeat(window, 2, axis=1), np.empty((len(window), 4, PLACE_COLUMNS), real)
    for corner in range(4):
        u, v = real(-0.5 if corner < 2 else 0.5), half_width if corner % 2 == 0 else -half_width
        corners[:, corner, 0] += u * cos - v * sin
        corners[:, corner, 1] += u * sin + v * cos
        places[:, corner, 0], places[:, corner, 1] = -v, half_width
        places[:, corner, 2], places[:, corner, 3] = half_length if corner >= 2 else -half_length, half_length
    return _rectangles(corners, np.repeat(values, 2, axis=1), places, ((2, 1, 0), (3, 1, 2)))


@kernel
def write_directions(along, cos, sin):
    """Write the cosines and sines (L,) of the angles of lines (L, 2), by the functions of the C library, as Mesa does.

    Interpreted, they are those of double precision.
    """
    for n in range(along.shape[0]):
        angle = math.atan2(along[n, 1], along[n, 0])
        cos[n], sin[n] = math.cos(angle), math.sin(angle)


def smooth_points(window: np.ndarray, values: np.ndarray, sizes: np.ndarray, per_vertex: bool) -> Rectangles:
    """Return the squares of points; `window` (P, 4), `values` (P, k), `sizes` (P,).

    A size that all points share is at least 2, one of the vertex stage is not (`per_vertex`).
    """
    real = window.dtype.type
    radius = real(0.5) * (sizes if per_vertex else np.maximum(sizes, real(2)))
    k = real(1) / radius
    k = real(1) - real(2) * k + k * k
    corners, places = np.repeat(window[:, None], 4, axis=1), np.ones((len(window), 4, PLACE_COLUMNS), real)
    for corner, (u, v) in enumerate(((-1, -1), (1, -1), (1, 1), (-1, 1))):
        corners[:, corner, 0] += u * radius
        corners[:, corner, 1] += v * radius
        places[:, corner, 0], places[:, corner, 1], places[:, corner, 2] = u, v, k
    return _rectangles(corners, np.repeat(values[:, None], 4, axis=1), places, ((0, 1, 2), (0, 2, 3)))


def _rectangles(
    corners: np.ndarray, values: np.ndarray, places: np.ndarray, triangles: tuple[tuple[int, int, int], ...]
) -> Rectangles:
    first = 4 * np.arange(len(corners), dtype=np.int32)
    window, values, places = (
        np.ascontiguousarray(rows.reshape(-1, rows.shape[2])) for rows in (corners, values, places)
    )
    return Rectangles(
        window,
        values,
        places,
        np.ascontiguousarray((first[:, None, None] + np.array(triangles, np.int32)).reshape(-1, 3)),
    )


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
