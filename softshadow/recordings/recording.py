"""`record`: any program that draws with `softshadow.gl`, as a `Run`."""

from __future__ import annotations

from dataclasses import replace
from types import TracebackType
from typing import Any

from softshadow.context import Context
from softshadow.errors import StateError
from softshadow.gl import create_context
from softshadow.inspection import PixelHistory, Steps
from softshadow.recordings.recorded_run import run_of
from softshadow.recordings.steps import check_way
from softshadow.runs import Run


class Recording:
    """What a program draws between the beginning and the end of a ``with`` statement.

    Attributes
    ----------
    context : Context            the one that the program draws with
    """

    def __init__(self, context: Context, steps: str, program: str) -> None:
        self.context = context
        self._steps, self._program = steps, program
        self._run: Run | None = None
        self._is_open = True

    def __enter__(self) -> Recording:
        self.context.__enter__()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.context.__exit__()
        self._is_open = False
        if kind is None:
            self._run = self._divided()

    @property
    def run(self) -> Run:
        """The run: its image, depth and stencil buffer, steps, pixel histories and ledger; it can be saved.

        Raises
        ------
        StateError                   the ``with`` statement has not ended, or a call in it failed
        """
        if self._run is None:
            raise StateError("a recording has a run when its with statement has ended without an error")
        return self._run

    @property
    def steps(self) -> Steps:
        """The steps of the run."""
        return self.run.steps

    def pixel(self, x: int, y: int) -> PixelHistory:
        """Return every fragment that was generated at a pixel so far: x from the left, y from the top."""
        return self._so_far().pixel(x, y)

    def explain(self, x: int, y: int) -> str:
        """Return one sentence that says what a pixel shows, and why; inside of the ``with`` statement, so far."""
        return self._so_far().explain(x, y)

    def _so_far(self) -> Run:
        """Return the run; inside of the ``with`` statement, one of what has been drawn."""
        if not self._is_open:
            return self.run
        self.context.finish()
        frame, title = self.context.frame, self.context.open_step
        steps = frame.steps if title is None else [*frame.steps, (title, len(frame.commands))]
        frame = replace(frame, commands=list(frame.commands), steps=list(steps))
        return run_of("recording", frame, self._options, (), self._steps)

    @property
    def _options(self) -> dict[str, str]:
        return {"program": self._program} if self._program else {}

    def _divided(self) -> Run:
        self.context.finish()
        self.context.end_open_step()
        return run_of("recording", self.context.frame, self._options, (), self._steps)

    def __repr__(self) -> str:
        width, height = self.context.frame.size
        return f"Recording({width} x {height}, {'open' if self._run is None else f'{len(self._run)} steps'})"


def record(
    width: int = 640, height: int = 480, steps: str = "auto", program: str = "", **context_options: Any
) -> Recording:
    """Create a context, make it current, and record what is drawn with it; use it in a ``with`` statement.

    The steps of the run are those that the program begins with `gl.step`; without any, its debug groups, or its draws.

    Parameters
    ----------
    width, height : int, pixels
    steps : str                  how to divide the run if the program does not: "groups", "draws", "clears" or "auto"
    program : str                its name, for titles
    context_options              of `gl.create_context`

    Examples
    --------
    >>> from softshadow import gl
    >>> with gl.record(64, 48) as recording:
    ...     gl.step("a square")
    ...     gl.glRectf(-0.5, -0.5, 0.5, 0.5)
    >>> recording.run
    Run('recording', 64 x 48, 1 steps)
    >>> recording.pixel(32, 24)[-1].verdict
    'passed'
    """
    check_way(steps)
    context = create_context(width, height, **{"history_mb": None, **context_options})
    return Recording(context, steps, program)
