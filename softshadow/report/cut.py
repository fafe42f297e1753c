"""Cutting triangles with a plane, and joining the segments to outlines."""

from __future__ import annotations

import numpy as np

CLOSE = 1e-9  # of the largest coordinate: ends nearer than this are one point


def cut_triangles(triangles: np.ndarray, origin: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """Return the segments (N, 2, 3) in which a plane cuts triangles (T, 3, 3) float64.

    A corner in the plane counts as in front of it, so that neighbours agree; a triangle in the plane is not cut.
    """
    heights = (triangles - origin) @ normal
    above = heights >= 0
    cut = above.any(axis=1) & ~above.all(axis=1)
    triangles, heights, above = triangles[cut], heights[cut], above[cut]
    # the corner that is alone on its side, then the other two
    alone = np.where(above.sum(axis=1) == 1, above.argmax(axis=1), (~above).argmax(axis=1))
    rows = np.arange(len(triangles))
    segments = np.empty((len(triangles), 2, 3))
    for place, step in enumerate((1, 2)):
        other = (alone + step) % 3
        h0, h1 = heights[rows, alone], heights[rows, other]
        share = (h0 / (h0 - h1))[:, None]
        segments[:, place] = triangles[rows, alone] + share * (triangles[rows, other] - triangles[rows, alone])
    return segments


def join_segments(segments: np.ndarray) -> list[np.ndarray]:
    """Return segments (N, 2, 2) joined to polylines (M, 2); closed ones repeat their first point."""
    if not len(segments):
        return []
    grid = CLOSE * max(float(np.abs(segments).max()), 1e-300)
    keys = [tuple(tuple(end) for end in pair) for pair in np.round(segments / grid).astype(np.int64).tolist()]
    at: dict[tuple[int, ...], list[int]] = {}
    for number, pair in enumerate(keys):
        for key in pair:
            at.setdefault(key, []).append(number)
    left = {number for number, (a, b) in enumerate(keys) if a != b}
    lines: list[np.ndarray] = []
    # ends that belong to one segment only begin open lines; what is left then is closed
    for start in [key for key, numbers in at.items() if len(numbers) == 1] + list(at):
        line: list[np.ndarray] = []
        key = start
        while following := [n for n in at[key] if n in left]:
            number = following[0]
            left.discard(number)
            end = 0 if keys[number][0] == key else 1
            if not line:
                line.append(segments[number, end])
            line.append(segments[number, 1 - end])
            key = keys[number][1 - end]
        if line:
            lines.append(np.array(line))
    return lines
