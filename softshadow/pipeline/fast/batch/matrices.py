"""Matrices of each draw in a table; equals `geometry.geometry.process_geometry`, see fast/test_batch.py.

The product and the inverses have the operations of `softshadow.matrices` and `softshadow.programs.inverse`.
"""

import numpy as np

from softshadow.jit import allocating_kernel, kernel
from softshadow.pipeline.constants import ONE, ZERO
from softshadow.programs.inverse import AFFINE, ANGLE_PRESERVING, SMALLEST_DETERMINANT, UNIFORM_SCALE, WITHOUT_ROTATION


@kernel
def multiply(left, right, out):
    """Write the product of two matrices: ((l0 r0 + l1 r1) + l2 r2) + l3 r3."""
    for i in range(4):
        for j in range(4):
            first = left[i, 0] * right[0, j] + left[i, 1] * right[1, j]
            out[i, j] = (first + left[i, 2] * right[2, j]) + left[i, 3] * right[3, j]


@kernel
def invert(m, kind, out):
    """Write the inverse of a matrix by the formula for its kind; the identity if it is singular."""
    for i in range(4):
        for j in range(4):
            out[i, j] = ONE if i == j else ZERO
    if kind & ~AFFINE:
        _invert_general(m, out)
    elif not kind & ~WITHOUT_ROTATION:
        _invert_scale(m, out)
    elif not kind & ~ANGLE_PRESERVING:
        factor, scaled = ONE, (kind & UNIFORM_SCALE) != 0
        if scaled:
            factor = (m[0, 0] * m[0, 0] + m[0, 1] * m[0, 1]) + m[0, 2] * m[0, 2]
            if factor == ZERO:
                return
            factor = ONE / factor
        for i in range(3):
            for j in range(3):
                out[i, j] = factor * m[j, i] if scaled else m[j, i]
        _invert_translation(m, out)
    elif _invert_linear(m, out):
        _invert_translation(m, out)


@kernel
def _invert_translation(m, out):
    """Write the last column of the inverse of an affine matrix, whose 3x3 part is written already."""
    x, y, z = m[0, 3], m[1, 3], m[2, 3]
    if x != ZERO or y != ZERO or z != ZERO:
        for i in range(3):
            out[i, 3] = -((x * out[i, 0] + y * out[i, 1]) + z * out[i, 2])


@kernel
def _invert_scale(m, out):
    """Write the inverse of a matrix that scales and translates."""
    if m[0, 0] == ZERO or m[1, 1] == ZERO or m[2, 2] == ZERO:
        return
    translates = m[0, 3] != ZERO or m[1, 3] != ZERO or m[2, 3] != ZERO
    for i in range(3):
        out[i, i] = ONE / m[i, i]
        if translates:
            out[i, 3] = -(m[i, 3] * (ONE / m[i, i]))


@kernel
def _invert_linear(m, out):
    """Write the inverse of the 3x3 part by cofactors; return whether it has one."""
    positive, negative = ZERO, ZERO
    for term in (
        m[0, 0] * m[1, 1] * m[2, 2], m[1, 0] * m[2, 1] * m[0, 2], m[2, 0] * m[0, 1] * m[1, 2],
        -m[2, 0] * m[1, 1] * m[0, 2], -m[1, 0] * m[0, 1] * m[2, 2], -m[0, 0] * m[2, 1] * m[1, 2],
    ):  # fmt: skip
        if term >= ZERO:
            positive += term
        else:
            negative += term
    determinant = positive + negative
    if abs(determinant) < SMALLEST_DETERMINANT:
        return False
    d = ONE / determinant
    out[0, 0] = (m[1, 1] * m[2, 2] - m[2, 1] * m[1, 2]) * d
    out[0, 1] = -(m[0, 1] * m[2, 2] - m[2, 1] * m[0, 2]) * d
    out[0, 2] = (m[0, 1] * m[1, 2] - m[1, 1] * m[0, 2]) * d
    out[1, 0] = -(m[1, 0] * m[2, 2] - m[2, 0] * m[1, 2]) * d
    out[1, 1] = (m[0, 0] * m[2, 2] - m[2, 0] * m[0, 2]) * d
    out[1, 2] = -(m[0, 0] * m[1, 2] - m[1, 0] * m[0, 2]) * d
    out[2, 0] = (m[1, 0] * m[2, 1] - m[2, 0] * m[1, 1]) * d
    out[2, 1] = -(m[0, 0] * m[2, 1] - m[2, 0] * m[0, 1]) * d
    out[2, 2] = (m[0, 0] * m[1, 1] - m[1, 0] * m[0, 1]) * d
    return True


@allocating_kernel
def _invert_general(m, out):
    """Write the inverse by Gaussian elimination; pivoting only swaps adjacent rows, from the bottom up."""
    rows = np.empty((4, 8), m.dtype)
    for i in range(4):
        for j in range(4):
            rows[i, j], rows[i, 4 + j] = m[i, j], ONE if i == j else ZERO
    for k in range(4):
        for i in range(3, k, -1):
            if abs(rows[i, k]) > abs(rows[i - 1, k]):
                for j in range(8):
                    rows[i, j], rows[i - 1, j] = rows[i - 1, j], rows[i, j]
        if rows[k, k] == ZERO:
            return
        for i in range(k + 1, 4):
            factor = rows[i, k] / rows[k, k]
            for j in range(k + 1, 8):
                rows[i, j] -= factor * rows[k, j]
    for k in range(3, -1, -1):
        factor = ONE / rows[k, k]
        for j in range(4, 8):
            rows[k, j] = factor * rows[k, j]
        for i in range(k):
            for j in range(4, 8):
                rows[i, j] -= rows[k, j] * rows[i, k]
    for i in range(4):
        for j in range(4):
            out[i, j] = rows[i, 4 + j]
