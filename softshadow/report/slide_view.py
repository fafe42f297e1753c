"""Where the slides of a run look: a part of the picture with many edges of counts or of shadow, and a pixel in it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from softshadow.inspection import Steps
from softshadow.report.questions import middle_of

COLUMNS, ROWS = 24, 16  # of the part whose counts are written out: digits that the last row of a room can read


@dataclass(frozen=True)
class SlideView:
    """A part of the picture, and a pixel in it; x and y from the top left corner, in pixels."""

    left: int
    top: int
    width: int
    height: int
    x: int
    y: int

    def part_of(self, buffer: np.ndarray) -> np.ndarray:
        """Return the part of a buffer (H, W, ...)."""
        return buffer[self.top : self.top + self.height, self.left : self.left + self.width]


def counts_anywhere(steps: Steps) -> bool:
    """Return whether the stencil buffer has different values after some step."""
    return any((step.stencil != step.stencil[0, 0]).any() for step in steps)


def slide_view(steps: Steps) -> SlideView:
    """Return the part with the most edges, and the middle of the pixels in it that are in shadow, if there are any.

    Edges are those between stencil counts after all steps; without counts, those of the visibility, or of the picture.
    """
    height, width = steps[0].stencil.shape
    columns, rows = min(COLUMNS, width), min(ROWS, height)
    maps = steps.maps
    if counts_anywhere(steps):
        looked_at = [step.stencil for step in steps]
    else:
        looked_at = [maps["visibility"] if "visibility" in maps else steps[-1].image.astype(np.float32).sum(axis=2)]
    edges = sum((_edges(each) for each in looked_at), np.zeros((height, width), np.int64))
    sums = np.zeros((height + 1, width + 1), np.int64)
    sums[1:, 1:] = edges.cumsum(0).cumsum(1)
    inside = sums[rows:, columns:] - sums[:-rows, columns:] - sums[rows:, :-columns] + sums[:-rows, :-columns]
    top, left = (int(place) for place in np.unravel_index(int(inside.argmax()), inside.shape))
    part = (slice(top, top + rows), slice(left, left + columns))
    chosen = maps["visibility"][part] < 0.5 if "visibility" in maps else np.zeros((rows, columns), np.bool_)
    if "visibility" in maps and "valid" in maps:
        chosen = chosen & maps["valid"][part]
    x, y = middle_of(chosen if chosen.any() else np.ones((rows, columns), np.bool_))
    return SlideView(left, top, columns, rows, left + x, top + y)


def _edges(values: np.ndarray) -> np.ndarray:
    """Return 1 where a pixel differs from the one to its right or the one below, (H, W)."""
    found = np.zeros(values.shape, np.int64)
    found[:, :-1] |= values[:, 1:] != values[:, :-1]
    found[:-1] |= values[1:] != values[:-1]
    return found
