"""Inverse of a 4x4 matrix in float32, with Mesa's formula for each kind of matrix: for normals, planes and lights.

A rotation is transposed, a scale is divided, and so on. Other formulas give other last bits, and generated texture
coordinates carry these bits into shadow comparisons. The calls that built a matrix tell its kind; the kind of loaded
and multiplied matrices is derived from their elements.

References: m_matrix.c of Mesa 22.3 (analyse_from_scratch, analyse_from_flags and the inversion functions).
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import numpy as np

TOLERANCE = np.float32(1e-6) * np.float32(1e-6)  # for squared values: how far a matrix may be from a rotation
SMALLEST_DETERMINANT = np.float32(1e-25)
ONE = np.float32(1.0)
# the kind of a matrix: flags for what it may contain; 0 is the identity
ROTATION, TRANSLATION, UNIFORM_SCALE, GENERAL_SCALE, GENERAL_3D, GENERAL, UNKNOWN = (1 << i for i in range(7))
LENGTH_PRESERVING = ROTATION | TRANSLATION
ANGLE_PRESERVING = LENGTH_PRESERVING | UNIFORM_SCALE
WITHOUT_ROTATION = TRANSLATION | UNIFORM_SCALE | GENERAL_SCALE
AFFINE = ANGLE_PRESERVING | GENERAL_SCALE | GENERAL_3D
Row = Sequence[np.float32] | np.ndarray
Rows = list[list[np.float32]]


def dot(a: Row, b: Row) -> np.float32:
    """Return the dot product, summed from left to right, each step rounded."""
    total = a[0] * b[0]
    for x, y in zip(a[1:], b[1:], strict=True):
        total = total + x * y
    return np.float32(total)


def cross(a: Row, b: Row) -> Row:
    """Return the cross product of two vectors, in float32."""
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def squared(x: np.float32) -> np.float32:
    """Return x times x."""
    return x * x


# -- kind of a matrix, whose rows are lists: numbers of arrays take twice as long --------------------------------------
def is_affine(m: Rows) -> bool:
    """Return whether the last row is (0, 0, 0, 1)."""
    return m[3] == [0, 0, 0, 1]


def scales_only(m: Rows) -> bool:
    """Return whether the upper left 3x3 is diagonal."""
    return not (m[0][1] or m[0][2] or m[1][0] or m[1][2] or m[2][0] or m[2][1])


def is_2d(m: Rows) -> bool:
    """Return whether an affine matrix leaves z unchanged (Mesa's MATRIX_2D)."""
    return m[2] == [0, 0, 1, 0] and not (m[0][2] or m[1][2])


def columns_of(m: Rows) -> tuple[Row, Row, Row]:
    """Return the columns of the upper left 3x3."""
    x, y, z, _ = m
    return [x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]


def scale_kind(m: Rows) -> str:
    """Return "none", "uniform" or "general" for an affine matrix."""
    c1, c2, c3 = columns_of(m)
    if is_2d(m):
        if scales_only(m):
            return "none" if m[0][0] == 1 and m[1][1] == 1 else "general"
        unit = squared(dot(c1[:2], c1[:2]) - ONE) <= TOLERANCE and squared(dot(c2[:2], c2[:2]) - ONE) <= TOLERANCE
        return "none" if unit else "general"
    sizes = (m[0][0], m[1][1], m[2][2]) if scales_only(m) else (dot(c1, c1), dot(c2, c2), dot(c3, c3))
    if squared(sizes[0] - sizes[1]) < TOLERANCE and squared(sizes[0] - sizes[2]) < TOLERANCE:
        return "uniform" if squared(sizes[0] - ONE) > TOLERANCE else "none"
    return "general"


def keeps_angles(m: Rows) -> bool:
    """Return whether the columns of an affine matrix are orthogonal, up to one scale per matrix, and right-handed."""
    if scales_only(m):
        return True
    c1, c2, c3 = columns_of(m)
    if is_2d(m):
        return bool(squared(dot(c1[:2], c2[:2])) <= TOLERANCE)
    if squared(dot(c1, c2)) >= TOLERANCE:
        return False
    rest = [x - y for x, y in zip(cross(c1, c2), c3, strict=True)]
    return bool(dot(rest, rest) < TOLERANCE)


def known_kind(matrix: np.ndarray, kind: int = UNKNOWN) -> int:
    """Return `kind`, or the kind derived from the elements of the (4, 4) matrix if `kind` is UNKNOWN."""
    if not kind & UNKNOWN:
        return kind
    return _kind_of(np.asarray(matrix, np.float32).tobytes())


@lru_cache(maxsize=256)
def _kind_of(elements: bytes) -> int:
    """Return the kind derived from the elements of a (4, 4) float32 matrix."""
    m = [list(row) for row in np.frombuffer(elements, np.float32).reshape(4, 4)]
    with np.errstate(all="ignore"):
        if not is_affine(m):
            return GENERAL
        scale = {"none": 0, "uniform": UNIFORM_SCALE, "general": GENERAL_SCALE}[scale_kind(m)]
        translation = TRANSLATION if m[0][3] or m[1][3] or m[2][3] else 0
        if scales_only(m):
            return scale | translation
        return scale | translation | (ROTATION if keeps_angles(m) else GENERAL_3D)


# -- inverses ---------------------------------------------------------------------------------------------------------
def is_length_preserving(matrix: np.ndarray, kind: int = UNKNOWN) -> bool:
    """Return whether Mesa regards a (4, 4) float32 matrix as composed of rotations and translations."""
    return not known_kind(matrix, kind) & ~LENGTH_PRESERVING


def inverse(matrix: np.ndarray, kind: int = UNKNOWN) -> np.ndarray:
    """Return the inverse of a (4, 4) matrix in float32; the identity if the matrix is singular, as in Mesa."""
    m = np.asarray(matrix, np.float32)
    return _inverse(m.tobytes(), known_kind(m, kind)).copy()


@lru_cache(maxsize=256)  # programs set several planes under one matrix
def _inverse(elements: bytes, kind: int) -> np.ndarray:
    """Return the inverse of a (4, 4) float32 matrix of a known kind."""
    m = np.frombuffer(elements, np.float32).reshape(4, 4)
    with np.errstate(all="ignore"):
        if kind & ~AFFINE:
            inverted = inverse_of_general(m)
        elif not kind & ~WITHOUT_ROTATION:
            inverted = inverse_of_scale(m)
        elif not kind & ~ANGLE_PRESERVING:
            inverted = inverse_of_rotation(m, bool(kind & UNIFORM_SCALE))
        else:
            inverted = inverse_of_affine(m)
    return np.eye(4, dtype=np.float32) if inverted is None else inverted


def with_translation(m: np.ndarray, linear: np.ndarray) -> np.ndarray:
    """Return the inverse of an affine matrix, whose 3x3 part is `linear`."""
    out = np.zeros((4, 4), np.float32)
    out[:3, :3] = linear
    out[3, 3] = ONE
    x, y, z = m[:3, 3]
    if x or y or z:
        c1, c2, c3 = linear.T
        out[:3, 3] = -((x * c1 + y * c2) + z * c3)
    return out


def inverse_of_scale(m: np.ndarray) -> np.ndarray | None:
    """Return the inverse of a matrix that scales and translates; None if it has none."""
    sizes = np.diagonal(m)[:3]
    if (sizes == 0).any():
        return None
    out = np.diag(np.append(ONE / sizes, ONE))
    if m[:3, 3].any():
        out[:3, 3] = -(m[:3, 3] * (ONE / sizes))
    return out


def inverse_of_rotation(m: np.ndarray, scaled: bool) -> np.ndarray | None:
    """Return the inverse of a matrix that rotates and translates, and scales uniformly; None if it has none."""
    if not scaled:
        return with_translation(m, m[:3, :3].T)
    scale = dot(m[0, :3], m[0, :3])
    return None if scale == 0 else with_translation(m, (ONE / scale) * m[:3, :3].T)


def inverse_of_affine(m: np.ndarray) -> np.ndarray | None:
    """Return the inverse by cofactors; positive and negative terms of the determinant are summed separately."""
    terms = [
        m[0, 0] * m[1, 1] * m[2, 2],
        m[1, 0] * m[2, 1] * m[0, 2],
        m[2, 0] * m[0, 1] * m[1, 2],
        -m[2, 0] * m[1, 1] * m[0, 2],
        -m[1, 0] * m[0, 1] * m[2, 2],
        -m[0, 0] * m[2, 1] * m[1, 2],
    ]
    positive = negative = np.float32(0)
    for term in terms:
        if term >= 0:
            positive = positive + term
        else:
            negative = negative + term
    determinant = positive + negative
    if abs(determinant) < SMALLEST_DETERMINANT:
        return None
    d = ONE / determinant
    linear = np.array(
        [
            [
                (m[1, 1] * m[2, 2] - m[2, 1] * m[1, 2]) * d,
                -(m[0, 1] * m[2, 2] - m[2, 1] * m[0, 2]) * d,
                (m[0, 1] * m[1, 2] - m[1, 1] * m[0, 2]) * d,
            ],
            [
                -(m[1, 0] * m[2, 2] - m[2, 0] * m[1, 2]) * d,
                (m[0, 0] * m[2, 2] - m[2, 0] * m[0, 2]) * d,
                -(m[0, 0] * m[1, 2] - m[1, 0] * m[0, 2]) * d,
            ],
            [
                (m[1, 0] * m[2, 1] - m[2, 0] * m[1, 1]) * d,
                -(m[0, 0] * m[2, 1] - m[2, 0] * m[0, 1]) * d,
                (m[0, 0] * m[1, 1] - m[1, 0] * m[0, 1]) * d,
            ],
        ],
        np.float32,
    )
    return with_translation(m, linear)


def inverse_of_general(m: np.ndarray) -> np.ndarray | None:
    """Return the inverse by Gaussian elimination; pivoting only swaps adjacent rows, from the bottom up."""
    rows = np.concatenate([m, np.eye(4, dtype=np.float32)], axis=1)
    for k in range(4):
        for i in range(3, k, -1):
            if abs(rows[i, k]) > abs(rows[i - 1, k]):
                rows[[i, i - 1]] = rows[[i - 1, i]]
        if rows[k, k] == 0:
            return None
        for i in range(k + 1, 4):
            rows[i, k + 1 :] -= (rows[i, k] / rows[k, k]) * rows[k, k + 1 :]
    for k in range(3, -1, -1):
        rows[k, 4:] = (ONE / rows[k, k]) * rows[k, 4:]
        for i in range(k):
            rows[i, 4:] -= rows[k, 4:] * rows[i, k]
    return rows[:, 4:].copy()
