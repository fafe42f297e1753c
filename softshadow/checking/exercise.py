"""An exercise: its task, and checks with their expected buffers or results."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from softshadow.lessons.program_check import BUFFERS


@dataclass(frozen=True)
class Check:
    """One check of a student's function.

    Attributes
    ----------
    title : str
    program : str                the name of the student's function
    expected : callable, str or None     the solution ``expected(gl)``, "listing:NAME", or the path of an .npz: a run
        that `Run.save` wrote, or the arrays of `buffers`, their bottom row first; None for the function `expected` of
        the exercise
    buffers : tuple of str       which are compared: "color", "depth", "stencil"
    allowed : int                pixels of each buffer that may differ
    cases : tuple or None        ((arguments, result), ...): the function is called with arguments, not with ``gl``
    within : float               largest difference of a right result, for `cases`
    points : float
    hint : str                   shown when the check fails
    """

    title: str = "buffers"
    program: str = "program"
    expected: Callable[[Any], Any] | str | None = None
    buffers: tuple[str, ...] = ("color",)
    allowed: int = 0
    cases: tuple[tuple[tuple[Any, ...], Any], ...] | None = None
    within: float = 0
    points: float = 1
    hint: str = ""

    def __post_init__(self) -> None:
        if isinstance(self.buffers, str) or not self.buffers or any(each not in BUFFERS for each in self.buffers):
            raise ValueError(f"check {self.title!r}: buffers={self.buffers!r}: expected some of {', '.join(BUFFERS)}")
        if self.allowed < 0:
            raise ValueError(f"check {self.title!r}: allowed={self.allowed}: expected 0 or more pixels")
        if not 0 <= self.points < math.inf:
            raise ValueError(f"check {self.title!r}: points={self.points}: expected 0 or more")


@dataclass(frozen=True)
class Exercise:
    """A task with checks.

    Attributes
    ----------
    source : str                 the path of its file, or "lesson:NAME"
    title, task : str
    size : (width, height) of the window, in pixels
    checks : tuple of Check
    start : str                  the code that a student begins with, or ""
    """

    source: str
    title: str
    task: str
    size: tuple[int, int]
    checks: tuple[Check, ...]
    start: str = ""

    @property
    def points(self) -> float:
        """The points of all checks."""
        return sum(check.points for check in self.checks)
