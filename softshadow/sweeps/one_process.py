"""The engine that needs nothing: points are measured one after the other, in this process."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from softshadow.sweeps.measured import Result, measure
from softshadow.sweeps.point import Point


def measured_here(points: Sequence[Point]) -> Iterator[tuple[Point, Result]]:
    """Yield each point with its result, in order."""
    for point in points:
        yield point, measure(point)
