"""What is measured: a frame program with its size and amounts, by name."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

from softshadow.testing.timing import Frame, FrameProgram


@dataclass(frozen=True)
class Workload:
    """A frame program, and how much of it there is.

    Attributes
    ----------
    name, title : str
    prepare : (gl, size, **amounts) -> Frame
    size : (width, height) in pixels
    amounts : what else decides how much there is to do, such as {"triangles": 70000}
    aim : float or None          how many times as fast as llvmpipe, at equal threads, it is meant to be at least
    """

    name: str
    title: str
    prepare: Callable[..., Frame]
    size: tuple[int, int]
    amounts: Mapping[str, Any] = field(default_factory=dict)
    aim: float | None = None

    @property
    def program(self) -> FrameProgram:
        """The frame program: picklable, so that Mesa's process can have it."""
        return partial(self.prepare, size=self.size, **self.amounts)

    def resized(self, size: tuple[int, int]) -> Workload:
        """Return the same workload in a window of another size."""
        return replace(self, size=size)

    def with_amounts(self, **amounts: Any) -> Workload:
        """Return the same workload with other amounts."""
        return replace(self, amounts={**self.amounts, **amounts})
