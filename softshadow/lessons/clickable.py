"""The report of a run as the output of a cell: pixels can be clicked, also where the lesson is only read."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from softshadow.runs import Run


class Clickable:
    """The report of a run and nothing else, so that no page prefers its picture."""

    def __init__(self, html: str, text: str) -> None:
        self._html, self._text = html, text

    def __repr__(self) -> str:
        return self._text

    def _repr_html_(self) -> str:
        return self._html


def clickable(run: Run) -> Clickable:
    """Return the report of a run, to click on its pixels.

    A run displays itself in a notebook, too, but pages made from notebooks show the picture of a run: many reports
    would make them heavy. Where a lesson wants a report in such a page, it asks for it by this function.

    Parameters
    ----------
    run : Run                    a small one: its report is stored in the page
    """
    bundle, _ = run._repr_mimebundle_()
    return Clickable(bundle["text/html"], bundle["text/plain"])
