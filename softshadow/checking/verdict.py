"""The verdict on a student's function: one word, sentences, and what differs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

# the word of each verdict, and what it says
MEANINGS = {
    "equal": "as expected",
    "differs": "buffers differ",
    "wrong": "a result is wrong",
    "not-written": "not written yet",
    "gl-error": "a GL call failed",
    "python-error": "Python error",
    "exited": "the process ended before the function returned",
    "no-program": "the function is missing",
    "time": "ended by the time limit",
    "memory": "ended by the memory limit",
    "signal": "killed by a signal",
    "unreadable": "the file cannot be read",
}


@dataclass(frozen=True)
class Verdict:
    """The verdict on one check.

    Attributes
    ----------
    kind : str                   a key of `MEANINGS`
    message : str                one sentence or a few
    line : int or None           of the student's file, for errors
    traceback : str              of a Python or GL error, only the student's lines
    differences : tuple of dict  of each buffer that differs: `buffer`, `count`, `x`, `y` (from the top), `gl_y`,
        `value`, `expected` at the first pixel
    history, explanation : str   of the first differing pixel in the student's program
    expected_history, expected_explanation : str     the same in the solution; "" where it has no recording
    output : str                 the beginning of what the program printed
    """

    kind: str
    message: str
    line: int | None = None
    traceback: str = ""
    differences: tuple[Mapping[str, Any], ...] = ()
    history: str = ""
    explanation: str = ""
    expected_history: str = ""
    expected_explanation: str = ""
    output: str = ""

    @property
    def passed(self) -> bool:
        """Whether the program does what is expected."""
        return self.kind == "equal"

    def to_dict(self) -> dict[str, Any]:
        """Return the verdict for JSON."""
        return {"passed": self.passed, **asdict(self)}

    def __str__(self) -> str:
        parts = [self.message]
        if self.traceback:
            parts.append(self.traceback)
        if self.differences:
            parts.append("\n".join(difference_line(each) for each in self.differences))
        for title, explanation, history in (
            ("Your program", self.explanation, self.history),
            ("The solution", self.expected_explanation, self.expected_history),
        ):
            if history:
                parts.append(f"{title}: {explanation}\n\n{history}")
        if self.output and not self.passed:
            parts.append(f"It printed:\n{self.output}")
        return "\n\n".join(parts)


def difference_line(found: Mapping[str, Any]) -> str:
    """Return one line on a buffer that differs."""
    where = f"x={found['x']} y={found['y']} (GL y={found['gl_y']})"
    pixels = "1 pixel differs" if found["count"] == 1 else f"{found['count']} pixels differ"
    return f"{found['buffer']}: {pixels}, first at {where}: {found['value']}, expected {found['expected']}"
