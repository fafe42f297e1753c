"""One sentence about a pixel: lit, in shadow or background, and the fragment that decided it."""

from __future__ import annotations

from softshadow.inspection.history import PixelHistory
from softshadow.inspection.history_row import CLEARED, CULLED, HistoryRow


def explain(history: PixelHistory, visibility: float | None, valid: bool) -> str:
    """Return why a pixel is lit, partly lit or in shadow, with the step, the object and the test that decided it.

    Parameters
    ----------
    visibility : float or None   1 lit to 0 in shadow; None when the technique has no visibility map
    valid : bool                 whether the visibility is defined at the pixel
    """
    drawn = [row for row in history.rows if row.verdict == "passed" and row.object]
    if not any(row.verdict not in (CLEARED, CULLED) for row in history.rows):
        return f"{history.heading} is background: no triangle covers it."
    if not valid or visibility is None:
        if not drawn:
            return f"{history.heading} shows no surface: no fragment passed its tests there."
        row = _last_colored(history) or drawn[-1]
        return f"{history.heading} has no defined visibility in this technique: {_described(row)}."
    if visibility >= 1:
        row = _last_colored(history) or drawn[-1]
        return f"{history.heading} is lit: {_described(row)}."
    word = "in shadow" if visibility <= 0 else f"partly lit ({visibility:.2g} of the light)"
    row = _rejected_light(history) or _last_colored(history) or drawn[-1]
    return f"{history.heading} is {word}: {_described(row)}."


def _last_colored(history: PixelHistory) -> HistoryRow | None:
    """Return the last fragment that wrote colour."""
    for row in reversed(history.rows):
        if row.color_written:
            return row
    return None


def _rejected_light(history: PixelHistory) -> HistoryRow | None:
    """Return the fragment of the visible surface that the stencil or alpha test kept from adding light.

    It belongs to the object and triangle that coloured the pixel last, and comes after that colour.
    """
    colored = _last_colored(history)
    if colored is None:
        return None
    for row in history.rows[history.rows.index(colored) + 1 :]:
        same_surface = (row.object, row.triangle) == (colored.object, colored.triangle)
        if same_surface and row.verdict in ("stencil failed", "alpha failed"):
            return row
    return None


def _described(row: HistoryRow) -> str:
    object = f"{row.object}, triangle {row.triangle}" if row.object else f"draw {row.draw}, triangle {row.triangle}"
    return f"in step {row.title!r} ({object}), {row.reason}"
