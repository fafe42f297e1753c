"""Predict, then run: a prediction is compared with what the program really did."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape
from types import EllipsisType
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Answer:
    """A question, the prediction (`...` for none), the true value, and the reason.

    `right` is None if nothing was predicted.
    """

    question: str
    prediction: Any
    value: Any
    because: str
    right: bool | None

    @property
    def verdict(self) -> str:
        """Whether the prediction is right, without the value if there was none."""
        if self.right is None:
            return "Not predicted yet: replace the three dots in the cell above, and run it again."
        return f"You predicted {shown(self.prediction)}: {'right' if self.right else 'not so'}."

    def __str__(self) -> str:
        if self.right is None:
            return f"{self.question}\n{self.verdict}"
        return f"{self.question}\n{self.verdict} It is {shown(self.value)}. {self.because}".rstrip()

    def __repr__(self) -> str:
        return str(self)

    def _repr_html_(self) -> str:
        answer = f"<p>It is <strong>{escape(shown(self.value))}</strong>. {escape(self.because)}</p>"
        if self.right is None:  # a reader without a notebook opens the answer; nobody sees it by accident
            answer = f"<details><summary>the answer</summary>{answer}</details>"
        sign = {None: "?", True: "✓", False: "✗"}[self.right]
        return (
            '<div style="border-left:4px solid #0a7;padding:0.2em 1em;margin:0.5em 0">'
            f"<p><strong>{sign} {escape(self.question)}</strong> {escape(self.verdict)}</p>{answer}</div>"
        )


def compare_prediction(
    question: str, prediction: Any | EllipsisType, value: Any, because: str = "", within: float = 0
) -> Answer:
    """Return whether a prediction is right, with the true value and the reason.

    Parameters
    ----------
    question : str               one sentence, which the answer repeats
    prediction                   what the student wrote; `...` means that there is none, and the answer stays folded
    value                        what the program did: a number, a text, a truth value or an array
    because : str                why it is so, in one or two sentences
    within : float               the largest difference, for numbers, of a prediction that is right

    Raises
    ------
    ValueError                   `within` is negative

    Examples
    --------
    >>> compare_prediction("How many bits has the stencil buffer?", 8, 8, "A byte for each pixel.")
    How many bits has the stencil buffer?
    You predicted 8: right. It is 8. A byte for each pixel.
    >>> compare_prediction("How many bits has the stencil buffer?", ..., 8).right is None
    True
    """
    if within < 0:
        raise ValueError(f"within={within}: expected a difference of at least 0")
    right = None if prediction is ... else agrees(prediction, value, within)
    return Answer(question, prediction, value, because, right)


def agrees(prediction: Any, value: Any, within: float) -> bool:
    """Return whether two values are equal, numbers up to a difference, and texts without regard to case and spaces."""
    if isinstance(prediction, str) and isinstance(value, str):
        return " ".join(prediction.casefold().split()) == " ".join(value.casefold().split())
    if isinstance(prediction, str) or isinstance(value, str):
        return False
    predicted, true = np.asarray(prediction), np.asarray(value)
    if predicted.shape != true.shape:
        return False
    if true.dtype.kind == "b" or predicted.dtype.kind not in "biuf":
        return bool((predicted == true).all())
    return bool((abs(predicted.astype(float) - true.astype(float)) <= within).all())


def shown(value: Any) -> str:
    """Return a value as a student would write it."""
    if isinstance(value, str):
        return value
    if isinstance(value, bool | np.bool_):
        return "yes" if value else "no"
    if isinstance(value, float | np.floating):
        return f"{value:.4g}"
    return str(value)
