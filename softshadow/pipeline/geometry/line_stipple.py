"""Stippled lines: cut into the pieces that the pattern of glLineStipple lets through.

Mesa draws each piece as a line of its own, with ends interpolated in the window (draw_pipe_stipple.c). So a piece
follows the diamond exit rule at its own ends.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from softshadow.state import Lines

PATTERN_BITS = 16


class LinePieces(NamedTuple):
    """Pieces of lines, each with two vertices of its own: piece n has the vertices 2n and 2n + 1.

    window (2N, 4), values (2N, k); line (N,): the row of the line that each is a piece of; counter: the place in the
    pattern after the last line.
    """

    window: np.ndarray
    values: np.ndarray
    line: np.ndarray
    counter: int


def cut_into_pieces(
    window: np.ndarray, values: np.ndarray, restarts: np.ndarray, stipple: Lines, counter: int
) -> LinePieces:
    """Return the pieces of lines.

    Parameters
    ----------
    window : (L, 2, 4) window x, y, z and 1/w of both ends
    values : (L, 2, k) outputs of the vertex stage; flat ones are equal at both ends
    restarts : (L,) bool, whether the pattern begins anew
    counter : the place in the pattern before the first line

    References
    ----------
    GL 2.1, sec. 3.4.2.
    """
    real = window.dtype.type
    both, weights, rows = np.concatenate([window, values], axis=2), [], []
    for row, ((x0, y0), (x1, y1)) in enumerate(window[:, :, :2]):
        if restarts[row]:
            counter = 0
        dx, dy = abs(x1 - x0), abs(y1 - y0)
        length = np.sqrt(dx * dx + dy * dy) if stipple.smooth else max(dx, dy)
        pixels = int(np.ceil(length)) if np.isfinite(length) else 0
        places = (counter + np.arange(pixels)) // stipple.factor % PATTERN_BITS
        lit = np.concatenate([[0], stipple.pattern >> places & 1, [0]])
        begins, ends = np.flatnonzero(np.diff(lit) > 0), np.flatnonzero(np.diff(lit) < 0)
        for begin, end in zip(begins, ends, strict=True):
            weights.append((real(begin) / length, real(1) if end == pixels else real(end) / length))
            rows.append(row)
        counter += pixels
    line, t = np.array(rows, np.int64), np.array(weights, real).reshape(-1, 2, 1)
    first, last = both[line][:, :1], both[line][:, 1:]
    corners = np.where(t <= 0, first, np.where(t >= 1, last, first + t * (last - first)))
    corners = corners.astype(real).reshape(-1, both.shape[2])
    return LinePieces(np.ascontiguousarray(corners[:, :4]), np.ascontiguousarray(corners[:, 4:]), line, counter)
