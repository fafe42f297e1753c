"""Lines are cut where the pattern of the stipple begins and ends, pixel by pixel along them."""

import numpy as np
import pytest

from softshadow.pipeline.geometry.line_stipple import cut_into_pieces, place_after, places_of
from softshadow.state import Lines


def runs_of(lit):
    """Return the first and end pixel of each run of lit pixels."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], lit, [0]])))
    return list(zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True))


def pieces_by_pixels(ends, restarts, stipple, counter):
    """Return line, and weights of both ends, of each piece; pixel by pixel, for lines with two ends (L, 2, 2)."""
    pieces = []
    for line, ((x0, y0), (x1, y1)) in enumerate(ends):
        counter = 0 if restarts[line] else counter
        dx, dy = abs(x1 - x0), abs(y1 - y0)
        length = np.sqrt(dx * dx + dy * dy) if stipple.smooth else max(dx, dy)
        n = int(np.ceil(length)) if np.isfinite(length) else 0
        lit = [stipple.pattern >> (counter + pixel) // stipple.factor % 16 & 1 for pixel in range(n)]
        for first, end in runs_of(lit):
            pieces.append((line, np.float32(first) / length, np.float32(1) if end == n else np.float32(end) / length))
        counter += n
    return pieces, counter


@pytest.mark.interpreted
@pytest.mark.parametrize("seed", range(30))
def test_pieces_are_the_runs_of_lit_pixels(seed):
    rng = np.random.default_rng(seed)
    count = int(rng.integers(0, 9))
    stipple = Lines(bool(seed % 2), True, int(rng.choice([1, 2, 3, 300])), int(rng.integers(0, 1 << 16)))
    window = rng.uniform(-40, 90, (2 * count, 4)).astype(np.float32)
    if seed % 3 == 0:
        window = window.round()
    if count and seed % 5 == 0:
        window[0, :2] = np.nan, np.inf
    values, flat = rng.random((2 * count, 3), np.float32), np.array([False, True, False])
    lines, restarts = rng.permutation(2 * count).astype(np.int32).reshape(-1, 2), rng.random(count) < 0.5
    places = places_of(restarts)
    cut = cut_into_pieces(window, values, lines, np.ascontiguousarray(lines[:, 1]), flat, places, stipple, 5)
    expected, counter = pieces_by_pixels(window[lines][:, :, :2], restarts, stipple, 5)
    assert cut.counter == counter == place_after(window, lines, places, stipple, 5)
    assert cut.line.tolist() == [line for line, *_ in expected]
    for n, (line, *weights) in enumerate(expected):
        a, b = lines[line]
        for end, t in enumerate(weights):
            for rows, all_rows in ((cut.window, window), (cut.values, values)):
                first, last = all_rows[a].copy(), all_rows[b]
                if rows is cut.values:
                    first[flat] = last[flat]
                inner = first if t <= 0 else last if t >= 1 else first + t * (last - first)
                assert np.array_equal(rows[2 * n + end], inner, equal_nan=True)
