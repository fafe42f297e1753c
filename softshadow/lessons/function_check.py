"""The check of an exercise that is a function: its results for given arguments beside the right ones."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from html import escape
from typing import Any

from softshadow.lessons.prediction import agrees, shown


@dataclass(frozen=True)
class FunctionCheck:
    """Whether a function returns what is expected, and one sentence on it; `passed` is None if it is not written."""

    passed: bool | None
    sentence: str

    def __str__(self) -> str:
        return self.sentence

    def __repr__(self) -> str:
        return self.sentence

    def _repr_html_(self) -> str:
        sign = {None: "?", True: "✓", False: "✗"}[self.passed]
        return f"<p><strong>{sign}</strong> {escape(self.sentence)}</p>"


def check_function(
    function: Callable[..., Any], cases: Iterable[tuple[tuple[Any, ...], Any]], within: float = 0
) -> FunctionCheck:
    """Return whether a function gives the right result in every case, or the first case in which it does not.

    Parameters
    ----------
    function : callable          the student's; it returns `...` as long as it is not written
    cases : iterable of (arguments, expected)
    within : float               the largest difference, for numbers, of a right result

    Examples
    --------
    >>> check_function(lambda a, b: a + b, [((1, 2), 3), ((2, 2), 4)])
    Right in all 2 cases.
    >>> check_function(lambda a, b: a * b, [((1, 2), 3)])
    Not yet: for (1, 2) it returns 2; expected 3.
    """
    number = 0
    for arguments, expected in cases:
        number += 1
        told = f"({', '.join(map(shown, arguments))})"
        try:
            result = function(*arguments)
        except Exception as error:  # a student's function may end in any way
            return FunctionCheck(False, f"Not yet: for {told} it ends with {type(error).__name__}: {error}")
        if result is ...:
            return FunctionCheck(
                None, "Not written yet: replace the three dots in the function, and run both cells again."
            )
        if not agrees(result, expected, within):
            return FunctionCheck(False, f"Not yet: for {told} it returns {shown(result)}; expected {shown(expected)}.")
    return FunctionCheck(True, f"Right in all {number} cases.")
