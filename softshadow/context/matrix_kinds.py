"""The kind of a matrix, compiled; equals `softshadow.programs.inverse.known_kind`, see tests/gl/test_matrix_stacks.py.

A program that looks at its scene anew before each draw loads or multiplies a matrix each time, and its kind must then
be derived from its elements.
"""

from __future__ import annotations

import numpy as np

from softshadow.jit import kernel
from softshadow.programs.inverse import (
    GENERAL,
    GENERAL_3D,
    GENERAL_SCALE,
    ROTATION,
    TOLERANCE,
    TRANSLATION,
    UNIFORM_SCALE,
)

ZERO, ONE = np.float32(0), np.float32(1)


@kernel
def derived_kind(m: np.ndarray) -> int:
    """Return the kind derived from the elements of a (4, 4) float32 matrix."""
    if not (m[3, 0] == ZERO and m[3, 1] == ZERO and m[3, 2] == ZERO and m[3, 3] == ONE):
        return GENERAL
    scales_only = m[0, 1] == ZERO and m[0, 2] == ZERO and m[1, 0] == ZERO
    scales_only = scales_only and m[1, 2] == ZERO and m[2, 0] == ZERO and m[2, 1] == ZERO
    is_2d = m[2, 0] == ZERO and m[2, 1] == ZERO and m[2, 2] == ONE and m[2, 3] == ZERO
    is_2d = is_2d and m[0, 2] == ZERO and m[1, 2] == ZERO
    kind = 0 if m[0, 3] == ZERO and m[1, 3] == ZERO and m[2, 3] == ZERO else TRANSLATION
    kind |= _scale_in_2d(m, scales_only) if is_2d else _scale(m, scales_only)
    if scales_only:
        return kind
    if is_2d:
        cosine = m[0, 0] * m[0, 1] + m[1, 0] * m[1, 1]
        return kind | (ROTATION if cosine * cosine <= TOLERANCE else GENERAL_3D)
    return kind | (ROTATION if _keeps_angles(m) else GENERAL_3D)


@kernel
def _scale_in_2d(m: np.ndarray, scales_only: bool) -> int:
    if scales_only:
        return 0 if m[0, 0] == ONE and m[1, 1] == ONE else GENERAL_SCALE
    off_x = (m[0, 0] * m[0, 0] + m[1, 0] * m[1, 0]) - ONE
    off_y = (m[0, 1] * m[0, 1] + m[1, 1] * m[1, 1]) - ONE
    return 0 if off_x * off_x <= TOLERANCE and off_y * off_y <= TOLERANCE else GENERAL_SCALE


@kernel
def _scale(m: np.ndarray, scales_only: bool) -> int:
    x = m[0, 0] if scales_only else _dot_columns(m, 0, 0)
    y = m[1, 1] if scales_only else _dot_columns(m, 1, 1)
    z = m[2, 2] if scales_only else _dot_columns(m, 2, 2)
    if (x - y) * (x - y) < TOLERANCE and (x - z) * (x - z) < TOLERANCE:
        return UNIFORM_SCALE if (x - ONE) * (x - ONE) > TOLERANCE else 0
    return GENERAL_SCALE


@kernel
def _keeps_angles(m: np.ndarray) -> bool:
    cosine = _dot_columns(m, 0, 1)
    if cosine * cosine >= TOLERANCE:
        return False
    x = (m[1, 0] * m[2, 1] - m[2, 0] * m[1, 1]) - m[0, 2]
    y = (m[2, 0] * m[0, 1] - m[0, 0] * m[2, 1]) - m[1, 2]
    z = (m[0, 0] * m[1, 1] - m[1, 0] * m[0, 1]) - m[2, 2]
    return bool((x * x + y * y) + z * z < TOLERANCE)


@kernel
def _dot_columns(m: np.ndarray, i: int, j: int) -> np.float32:
    return (m[0, i] * m[0, j] + m[1, i] * m[1, j]) + m[2, i] * m[2, j]
