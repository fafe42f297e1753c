"""The page of a failure: why it happens, and the report of both runs, with the failure and with its cure."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from softshadow.report.page import data_url
from softshadow.report.run_page import RunPage, write_runs


@dataclass(frozen=True, eq=False)
class FailurePage:
    """What the page of a failure shows.

    Attributes
    ----------
    codes : tuple of str         what the codes in `reference` mean, a sentence each
    picture : (H, W, 3) uint8    both pictures side by side
    runs : (RunPage, RunPage)    with the failure, and with the cure
    pixel : (x, y)               to look at
    """

    name: str
    title: str
    reason: str
    reference: str
    codes: tuple[str, ...]
    scene: str
    size: tuple[int, int]
    counted: str
    number_wrong: int
    number_cured: int
    why_floor: str
    diff: str
    picture: np.ndarray
    runs: tuple[RunPage, RunPage]
    pixel: tuple[int, int]

    @property
    def picture_url(self) -> str:
        """The picture as a data URL."""
        return data_url(self.picture)


def write_failure_page(failure: FailurePage, path: Path) -> None:
    """Write the page of a failure as one file."""
    write_runs(path, failure.runs, failure, f"softshadow failures {failure.name}")
