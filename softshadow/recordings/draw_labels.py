"""Names of draws by where they come from: a call of a trace, or a line of a program.

Histories of pixels and titles of steps show them. They are part of the debug groups around a draw.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from softshadow.context import Context


class DrawLabels:
    """Labels the draws of one context at a time; a primitive keeps its label from glBegin to glEnd."""

    def __init__(self) -> None:
        self._before: list[str] | None = None  # the debug groups, while a labelled primitive is open

    def draw(self, context: Context, label: str, call: Callable[[], Any]) -> Any:
        """Make a call that draws, under a label; within a primitive, the label is that of its glBegin."""
        if context.primitive is not None:
            return call()
        before = list(context.labels)
        context.labels[-1:] = [f"{before[-1]}, {label}"] if before else [label]
        try:
            return call()
        finally:
            if context.primitive is not None:  # parts of it may be drawn before glEnd
                self._before = before
            else:
                context.labels[:] = before

    def end(self, context: Context, call: Callable[[], Any]) -> Any:
        """Make the call glEnd, under the label of its glBegin."""
        try:
            return call()
        finally:
            if self._before is not None:
                context.labels[:], self._before = self._before, None
