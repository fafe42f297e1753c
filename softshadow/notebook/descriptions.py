"""What figures show, in words; notebooks and pages made of them give the words to screen readers."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any
from weakref import WeakKeyDictionary

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PICTURES = ("image/png", "image/jpeg", "image/svg+xml")
_words: WeakKeyDictionary[Any, str] = WeakKeyDictionary()  # of axes


def describe(shown: Figure | Axes) -> str:
    """Return what a figure or axes show, in words.

    Of what this package draws these are the counts and ranges of the buffers; of other plots title, labels of the axes,
    and each series with its name and range.

    Parameters
    ----------
    shown : Figure or Axes       of matplotlib

    Examples
    --------
    >>> import numpy as np
    >>> import softshadow as ss
    >>> print(ss.notebook.describe(ss.notebook.show_stencil(np.eye(2, dtype=np.uint8), title="Two ones")))
    Two ones: 0 in 2 pixels, 1 in 2.
    """
    if hasattr(shown, "axes") and isinstance(shown.axes, list):  # a figure
        title = shown.get_suptitle()
        parts = [f"{title}."] if title else []
        return " ".join([*parts, *(axes_in_words(each) for each in shown.axes if each.axison)])
    return axes_in_words(shown)  # type: ignore[arg-type]


def describe_axes(ax: Axes, words: str) -> None:
    """Note what axes show; `describe` tells it, below their title."""
    _words[ax] = words
    tell_notebook()


def axes_in_words(ax: Axes) -> str:
    """Return the titles of axes, and what they show: the words noted for them, or labels and series."""
    title = " ".join(" ".join(ax.get_title(place) for place in ("left", "center", "right")).split())
    words = _words.get(ax) or "; ".join(_series_in_words(ax))
    return ": ".join(part.rstrip(".") for part in (title, words) if part) + "."


def _series_in_words(ax: Axes) -> list[str]:
    labels = [f"{axis}: {text}" for axis, text in (("x", ax.get_xlabel()), ("y", ax.get_ylabel())) if text]
    series = []
    for line in ax.get_lines():
        x, y = (list(map(float, values)) for values in (line.get_xdata(), line.get_ydata()))  # type: ignore[arg-type]
        name = str(line.get_label())
        if y:
            at = f"{len(y)} points, x {min(x):.4g} to {max(x):.4g}, y {min(y):.4g} to {max(y):.4g}"
            series.append(at if name.startswith("_") else f"{name}: {at}")
    return labels + series


class Described:
    """What turns figures into pictures for a notebook, with a description of each beside it."""

    def __init__(self, draw: Any) -> None:
        self._draw = draw

    def __call__(self, figure: Figure) -> Any:
        """Return the picture and its metadata."""
        drawn = self._draw(figure)
        data, metadata = drawn if isinstance(drawn, tuple) else (drawn, {})
        return data, {**metadata, "alt": describe(figure)}


def tell_notebook() -> None:
    """Let a notebook give the description of every figure to screen readers; without one, nothing happens."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    formatters = getattr(getattr(shell, "display_formatter", None), "formatters", {})
    figure = sys.modules["matplotlib.figure"].Figure
    for kind in PICTURES:
        draw = formatters[kind].type_printers.get(figure) if kind in formatters else None
        if draw is not None and not isinstance(draw, Described):
            formatters[kind].for_type(figure, Described(draw))
