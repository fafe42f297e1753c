"""The check of an exercise: the buffers of a student's program beside those of the solution."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING, Any

from softshadow.testing import differences, history_of_first, run_here, run_recorded

if TYPE_CHECKING:
    from softshadow.inspection.history import PixelHistory
    from softshadow.testing import BufferDifference

BUFFERS = ("color", "depth", "stencil")


@dataclass(frozen=True)
class ProgramCheck:
    """Whether a program leaves the expected buffers; if not, what differs, and the history of the first such pixel."""

    differences: tuple[BufferDifference, ...]
    history: PixelHistory | None
    error: str | None

    @property
    def passed(self) -> bool:
        """Whether the program ran to its end and no pixel differs."""
        return self.error is None and not self.differences

    def __str__(self) -> str:
        if self.passed:
            return "Right: every pixel is as expected."
        if self.error is not None:
            return f"The program ended with an error: {self.error}"
        found = "\n".join(map(str, self.differences))
        return f"Not yet. Your program and the solution:\n{found}\n\nYour first different pixel:\n{self.history}"

    def __repr__(self) -> str:
        return str(self)

    def _repr_html_(self) -> str:
        history = "" if self.history is None else self.history._repr_html_()
        text = str(self) if self.history is None else str(self).partition("\n\nYour first")[0]
        heading, _, rest = text.partition("\n")
        lines = "<br>".join(map(escape, rest.splitlines()))
        return f"<p><strong>{escape(heading)}</strong></p><p>{lines}</p>{history}"


def check_program(
    program: Callable[[Any], Any],
    solution: Callable[[Any], Any],
    size: tuple[int, int] = (64, 64),
    buffers: tuple[str, ...] = ("color",),
) -> ProgramCheck:
    """Return whether a program leaves the same buffers as the solution of an exercise.

    Parameters
    ----------
    program, solution            ``program(gl)``
    size : (width, height) of the window, in pixels
    buffers : tuple of str       which are compared: "color", "depth", "stencil"

    Raises
    ------
    ValueError                   an unknown buffer

    Examples
    --------
    >>> def red(gl):
    ...     gl.glClearColor(1, 0, 0, 1)
    ...     gl.glClear(gl.GL_COLOR_BUFFER_BIT)
    >>> check_program(red, red)
    Right: every pixel is as expected.
    """
    for buffer in buffers:
        if buffer not in BUFFERS:
            raise ValueError(f"buffers={buffers!r}: expected some of {', '.join(BUFFERS)}")
    try:
        result, frame = run_recorded(program, size)
    except Exception as error:  # a student's program may end in any way
        return ProgramCheck((), None, f"{type(error).__name__}: {error}")
    found = tuple(each for each in differences(result, run_here(solution, size)) if each.buffer in buffers)
    return ProgramCheck(found, history_of_first(frame, found), None)
