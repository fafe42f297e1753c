"""The page of the tour: an overview, and a chapter for each stop."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from softshadow.report.page import Section, write_page
from softshadow.scene import Scene


@dataclass(frozen=True)
class Visit:
    """A stop of the tour that has been drawn; `picture`, `report`, `npz` and `error` are URLs.

    `error` is the picture of the difference from ray casting, "" without a visibility; `error_words` tells its extent.
    `failures` has name and title of the known failures of the technique.
    """

    name: str
    title: str
    look_at: str
    picture: str
    sections: list[Section]
    ledger: list[dict[str, object]]
    warnings: list[str]
    npz: str
    paper: str
    command: str
    report: str
    error: str
    error_words: str
    failures: list[tuple[str, str]]


@dataclass(frozen=True, eq=False)
class TourPage:
    """What the page of the tour shows.

    Attributes
    ----------
    left_out : (title, reason)   of each stop whose technique refused the scene
    arguments : str              of the command line, for this scene and size
    """

    scene: Scene
    size: tuple[int, int]
    visits: Sequence[Visit]
    left_out: Sequence[tuple[str, str]]
    arguments: str


def write_tour_page(tour: TourPage, path: Path) -> None:
    """Write the page of the tour; its pictures stand in the folders beside it."""
    write_page(path, "tour.html", tour=tour)
