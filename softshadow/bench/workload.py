"""A workload: a named frame program with its size and amounts."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

from softshadow.testing.timing import DrawFrame, FrameProgram


@dataclass(frozen=True)
class Workload:
    """A named frame program with its window size and amounts.

    Attributes
    ----------
    name, title : str
    prepare : (gl, size, **amounts) -> Frame
    size : (width, height) in pixels
    amounts : further arguments of `prepare` that set the amount of work, such as {"triangles": 70000}
    aim : float or None          target: at least this many times as fast as llvmpipe with equal threads
    """

    name: str
    title: str
    prepare: Callable[..., DrawFrame]
    size: tuple[int, int]
    amounts: Mapping[str, Any] = field(default_factory=dict)
    aim: float | None = None

    @property
    def program(self) -> FrameProgram:
        """The frame program; it is picklable, to be sent to Mesa's process."""
        return partial(self.prepare, size=self.size, **self.amounts)

    def resized(self, size: tuple[int, int]) -> Workload:
        """Return the workload with another window size."""
        return replace(self, size=size)

    def with_amounts(self, **amounts: Any) -> Workload:
        """Return the workload with other amounts."""
        return replace(self, amounts={**self.amounts, **amounts})
