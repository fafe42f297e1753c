"""Stippled lines: cut into the pieces that the pattern of glLineStipple lets through.

Mesa draws each piece as a line of its own, with ends interpolated in the window (draw_pipe_stipple.c). So a piece
follows the diamond exit rule at its own ends.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from softshadow.jit import inlined, kernel
from softshadow.pipeline.constants import ONE, ZERO
from softshadow.state import Lines

PATTERN_BITS = 16
CONTINUES = -1  # the pattern goes on at a line


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
    window: np.ndarray,
    values: np.ndarray,
    lines: np.ndarray,
    provoking: np.ndarray,
    flat: np.ndarray,
    places: np.ndarray,
    stipple: Lines,
    counter: int,
) -> LinePieces:
    """Return the pieces of lines.

    Parameters
    ----------
    window : (V, 4) window x, y, z and 1/w
    values : (V, k) outputs of the vertex stage
    lines : (L, 2) int32, vertices
    provoking : (L,) int32, the vertices whose values the columns take that are `flat` (k,)
    places : (L,) int32, the place in the pattern at which a line begins, or CONTINUES
    counter : the place in the pattern before the first line

    References
    ----------
    GL 2.1, sec. 3.4.2.
    """
    inputs = (
        window, values, lines, provoking, flat, places, stipple.smooth, stipple.factor, stipple.pattern, counter,
        np.empty(2, window.dtype),
    )  # fmt: skip
    n, counter_after = write_pieces(*inputs, *_room(0, window, values))
    pieces = _room(n, window, values)
    write_pieces(*inputs, *pieces)
    return LinePieces(*pieces, counter_after)


def places_of(restarts: np.ndarray) -> np.ndarray:
    """Return the places (L,) int32 of lines that begin the pattern anew, or continue it."""
    return np.where(restarts, 0, CONTINUES).astype(np.int32)


def place_after(window: np.ndarray, lines: np.ndarray, places: np.ndarray, stipple: Lines, counter: int) -> int:
    """Return the place in the pattern after lines, `LinePieces.counter`; the arguments are those of their pieces."""
    no_values, no_vertices, no_columns = np.empty((0, 0), window.dtype), np.empty(0, np.int32), np.empty(0, bool)
    _, counter_after = write_pieces(
        window, no_values, lines, no_vertices, no_columns, places, stipple.smooth, stipple.factor, stipple.pattern,
        counter, np.empty(2, window.dtype), *_room(0, window, no_values),
    )  # fmt: skip
    return int(counter_after)


def _room(n: int, window: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    return np.empty((2 * n, 4), window.dtype), np.empty((2 * n, values.shape[1]), values.dtype), np.empty(n, np.int32)


@kernel
def write_pieces(
    window, values, lines, provoking, flat, places, is_smooth, factor, pattern, counter, t, piece_window,
    piece_values, piece_lines,
):  # fmt: skip
    """Write the pieces if the arrays have room; return how many they are, and the place in the pattern after them.

    `t` (2,) is scratch. A line has as many pixels as its longer side, a smooth one as its length.
    """
    n_pieces, room = 0, len(piece_lines)
    for row in range(lines.shape[0]):
        a, b = lines[row, 0], lines[row, 1]
        if places[row] >= 0:
            counter = np.int64(places[row])
        dx, dy = abs(window[b, 0] - window[a, 0]), abs(window[b, 1] - window[a, 1])
        length = dy if dy > dx else dx
        if is_smooth:
            length = np.sqrt(dx * dx + dy * dy)
        pixels = int(np.ceil(length)) if np.isfinite(length) else 0
        begin, pixel = -1, 0
        place = counter // factor
        next_place = (place + 1) * factor - counter  # its first pixel
        while pixel < pixels:
            is_lit = pattern >> place % PATTERN_BITS & 1
            if is_lit and begin < 0:
                begin = pixel
            if begin >= 0 and not is_lit:
                if room:
                    t[0], t[1] = begin, pixel
                    t[0], t[1] = t[0] / length, t[1] / length
                    write_piece(window, values, a, b, provoking[row], flat, t, n_pieces, piece_window, piece_values)
                    piece_lines[n_pieces] = row
                begin, n_pieces = -1, n_pieces + 1
            pixel, place, next_place = next_place, place + 1, next_place + factor
        if begin >= 0:
            if room:
                t[0], t[1] = begin, ONE
                t[0] = t[0] / length
                write_piece(window, values, a, b, provoking[row], flat, t, n_pieces, piece_window, piece_values)
                piece_lines[n_pieces] = row
            n_pieces += 1
        counter += pixels
    return n_pieces, counter


@kernel
def write_piece(window, values, a, b, source, flat, t, n, piece_window, piece_values):
    """Write the ends of piece `n`, which lie at `t` (2,) between the vertices `a` and `b`."""
    for end in range(2):
        v = 2 * n + end
        for c in range(4):
            piece_window[v, c] = between(window[a, c], window[b, c], t[end])
        for c in range(values.shape[1]):
            first, last = (source, source) if flat[c] else (a, b)
            piece_values[v, c] = between(values[first, c], values[last, c], t[end])


@inlined
def between(first, last, t):
    """Return the value at `t` between two ends, exactly theirs beyond."""
    inner = first + t * (last - first)
    return first if t <= ZERO else last if t >= ONE else inner
