"""Products of queued matrix operations, compiled; equal to the functions of `softshadow.matrices`, bit for bit.

A queue is a run of float64 numbers: an operation's code, then its arguments. `carry_out` computes in float32, each
operation rounded on its own; `carry_out_by_textbook` calls the readable functions, in either precision.
"""

from __future__ import annotations

import numpy as np

from softshadow import matrices
from softshadow.jit import allocating_kernel, kernel

IDENTITY, PUSH, TRANSLATE, SCALE, ROTATE, LOOK_AT, LOAD, MULTIPLY = range(8)
SIZES = (1, 1, 4, 4, 6, 10, 17, 17)  # numbers of each operation in the queue, its code included
SIZE_OF = np.array(SIZES)
ZERO, ONE = np.float32(0), np.float32(1)
SHORTEST_AXIS = np.float32(matrices.SHORTEST_AXIS)
single = np.float32


@allocating_kernel
def carry_out(queue: np.ndarray, end: int, levels: np.ndarray, level: int) -> int:
    """Carry out the operations before `end` on the matrices (N, 4, 4) float32; return the level of the last one.

    PUSH copies a matrix to the next level; the others change the matrix of their level. The caller bounds the levels.
    The loops are short on purpose: unrolled, they would take seconds to compile.
    """
    right, v = np.empty((4, 4), single), np.empty(16, single)
    i = 0
    while i < end:
        code = int(queue[i])
        for k in range(SIZE_OF[code] - 1):
            v[k] = single(queue[i + 1 + k])
        m = levels[level]
        if code == PUSH:
            level += 1
        if code <= PUSH:
            for k in range(16):
                unit = ONE if k % 5 == 0 else ZERO
                levels[level, k >> 2, k & 3] = unit if code == IDENTITY else m[k >> 2, k & 3]
        elif code == TRANSLATE:
            _translate(m, v[0], v[1], v[2])
        elif code == SCALE:
            for k in range(12):
                m[k & 3, k >> 2] *= v[k >> 2]
        else:
            for k in range(16):
                unit = ONE if k % 5 == 0 else ZERO
                right[k & 3, k >> 2] = unit if code < LOAD else v[k]
            if code == ROTATE:
                _set_rotation(right, v)
            elif code == LOOK_AT:
                for k in range(3):
                    right[1, k] = v[6 + k]
                    right[2, k] = single(queue[i + 4 + k] - queue[i + 1 + k])
                _set_view(right)
            for row in range(4):
                a, b, c, d = m[row, 0], m[row, 1], m[row, 2], m[row, 3]
                for column in range(4):
                    total = (a * right[0, column] + b * right[1, column]) + c * right[2, column]
                    m[row, column] = right[row, column] if code == LOAD else total + d * right[3, column]
            if code == LOOK_AT:
                _translate(m, -v[0], -v[1], -v[2])
        i += SIZE_OF[code]
    return level


@kernel
def _translate(m: np.ndarray, x: np.float32, y: np.float32, z: np.float32) -> None:
    for row in range(4):
        m[row, 3] = ((m[row, 0] * x + m[row, 1] * y) + m[row, 2] * z) + m[row, 3]


@kernel
def _set_rotation(m: np.ndarray, v: np.ndarray) -> None:
    """Set the upper left 3x3 of the identity to a rotation; `v` is sine, cosine, x, y, z."""
    sine, cosine, axis = v[0], v[1], v[2:5]
    directions = 0
    for k in range(3):
        directions += axis[k] != ZERO
    length = np.sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2])
    if directions != 1 and length <= SHORTEST_AXIS:
        return
    versine = ONE - cosine
    for i in range(3):
        for j in range(3):
            along = axis[i if i == j else 3 - i - j]
            turn = -sine if (j - i) % 3 == 1 else sine
            if directions == 1:  # about a coordinate axis, with exact zeros and ones
                off = turn if along > ZERO else -turn
                unit, off = (cosine, ZERO) if along == ZERO else (ONE, off)
                m[i, j] = unit if i == j else off
            else:
                both = versine * ((axis[i] / length) * (axis[j] / length))
                m[i, j] = both + cosine if i == j else both + turn * (along / length)


@kernel
def _set_view(m: np.ndarray) -> None:
    """Replace the rows "-", up and forward by side, up and backward, of length 1."""
    for step in range(3):  # side = forward x up, up = side x forward
        if step > 0:
            out, p, q = (0, 2, 1) if step == 1 else (1, 0, 2)
            for k in range(3):
                i, j = (k + 1) % 3, (k + 2) % 3
                m[out, k] = m[p, i] * m[q, j] - m[p, j] * m[q, i]
        row = 2 - 2 * step
        if row >= 0:
            length = np.sqrt((m[row, 0] * m[row, 0] + m[row, 1] * m[row, 1]) + m[row, 2] * m[row, 2])
            if length != ZERO:
                for k in range(3):
                    m[row, k] = m[row, k] / length
    for k in range(3):
        m[2, k] = -m[2, k]


def carry_out_by_textbook(queue: np.ndarray, end: int, levels: np.ndarray, level: int) -> int:
    """Do what `carry_out` does, in the precision of `levels`."""
    real, i = levels.dtype.type, 0
    with np.errstate(all="ignore"):
        while i < end:
            code = int(queue[i])
            a = queue[i + 1 : i + SIZES[code]].tolist()
            i += SIZES[code]
            base = levels[level].copy()
            if code == PUSH:
                level += 1
                levels[level] = base
            elif code == IDENTITY:
                levels[level] = np.eye(4)
            elif code == LOAD:
                levels[level] = np.reshape(a, (4, 4)).T
            elif code == TRANSLATE:
                levels[level] = matrices.translate(base, *a)
            elif code == SCALE:
                levels[level] = matrices.scale(base, *a)
            elif code == LOOK_AT:
                levels[level] = matrices.look_at(base, a[:3], a[3:6], a[6:])
            elif code == ROTATE:
                levels[level] = matrices.multiply(base, matrices.rotation_of(*map(real, a)))
            else:
                levels[level] = matrices.multiply(base, np.reshape(a, (4, 4)).T.astype(real))
    return level
