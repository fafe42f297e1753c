"""The page of a failure: why it happens, both pictures, and the history of the pixel that shows it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from softshadow.inspection import PixelHistory
from softshadow.report.page import data_url, write_page


@dataclass(frozen=True, eq=False)
class FailurePage:
    """What the page of a failure shows.

    Attributes
    ----------
    picture : (H, W, 3) uint8    both pictures side by side
    histories : tuple            (label, history) of the ringed pixel, with the failure and with the cure
    """

    name: str
    title: str
    reason: str
    reference: str
    scene: str
    size: tuple[int, int]
    counted: str
    number_wrong: int
    number_cured: int
    why_floor: str
    diff: str
    picture: np.ndarray
    histories: tuple[tuple[str, PixelHistory], ...]


def write_failure_page(failure: FailurePage, path: Path) -> None:
    """Write the page of a failure as one file."""
    histories = [(label, history._repr_html_()) for label, history in failure.histories]
    write_page(path, "failure.html", failure=failure, picture=data_url(failure.picture), histories=histories)
