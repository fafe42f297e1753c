"""The GL state of each step as calls, with what changed since the step before."""

from __future__ import annotations

from collections.abc import Sequence

NEW, SAME, GONE = "new", "same", "gone"


def marked_calls(before: Sequence[str], now: Sequence[str]) -> list[tuple[str, str]]:
    """Return the calls of a state, each with "new" or "same"; then those of the state before that are gone.

    Examples
    --------
    >>> marked_calls(["glDepthMask(GL_TRUE)"], ["glEnable(GL_BLEND)"])
    [('glEnable(GL_BLEND)', 'new'), ('glDepthMask(GL_TRUE)', 'gone')]
    """
    calls = [(call, SAME if call in before else NEW) for call in now]
    return calls + [(call, GONE) for call in before if call not in now]
