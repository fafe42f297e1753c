"""One sentence about a pixel: lit, shaded or dark, and the fragment that decided it."""

from __future__ import annotations

from softshadow.inspection.history import CLEARED, CULLED, HistoryRow, PixelHistory

FAILED = ("stencil failed", "alpha failed", "depth failed")


def explain(history: PixelHistory, visibility: float | None, valid: bool) -> str:
    """Return why a pixel is lit, partly lit or in shadow, with the step, the object and the test that decided it.

    Parameters
    ----------
    visibility : float or None   1 lit to 0 in shadow; None when the technique has not said
    valid : bool                 whether the visibility is defined there
    """
    drawn = [row for row in history.rows if row.verdict == "passed" and row.object]
    if not any(row.verdict not in (CLEARED, CULLED) for row in history.rows):
        return f"{history.heading} is background: no triangle covers it."
    if not valid or visibility is None:
        if not drawn:
            return f"{history.heading} shows no surface: no fragment passed its tests there."
        told = _told(_last_colored(history) or drawn[-1])
        return f"{history.heading} is where the technique says nothing about the light: {told}."
    if visibility >= 1:
        decided = _last_colored(history) or drawn[-1]
        return f"{history.heading} is lit: {_told(decided)}."
    word = "in shadow" if visibility <= 0 else f"partly lit ({visibility:.2g} of the light)"
    decided = _left_out(history) or _last_colored(history) or drawn[-1]
    return f"{history.heading} is {word}: {_told(decided)}."


def _last_colored(history: PixelHistory) -> HistoryRow | None:
    """Return the last fragment that wrote colour."""
    for row in reversed(history.rows):
        if row.color_written:
            return row
    return None


def _left_out(history: PixelHistory) -> HistoryRow | None:
    """Return the fragment of the visible surface that a test kept from adding light.

    It is of the object and triangle that coloured the pixel last, later than that, and failed in stencil or alpha test.
    """
    colored = _last_colored(history)
    if colored is None:
        return None
    for row in history.rows[history.rows.index(colored) + 1 :]:
        if row.verdict in FAILED[:2] and (row.object, row.triangle) == (colored.object, colored.triangle):
            return row
    return None


def _told(row: HistoryRow) -> str:
    object = f"{row.object}, triangle {row.triangle}" if row.object else f"draw {row.draw}, triangle {row.triangle}"
    return f"in step {row.title!r} ({object}), {row.reason}"
