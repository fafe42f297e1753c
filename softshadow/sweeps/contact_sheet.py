"""The contact sheet of a sweep: a page with the picture of every point, each of which opens its report."""

from __future__ import annotations

import os
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from softshadow.errors import SoftShadowError
from softshadow.errors import Warning as SoftShadowWarning
from softshadow.inspection.files import refuse_foreign, write_whole
from softshadow.report.page import write_page
from softshadow.runs import run
from softshadow.sweeps.journal import Journal
from softshadow.sweeps.measured import load_scene, placed
from softshadow.sweeps.point import Point
from softshadow.sweeps.table import SweepTable
from softshadow.sweeps.task import Row

MOST_REPORTS = 200  # a report takes half a megabyte and a second; further cells open their picture


@dataclass(frozen=True)
class Cell:
    """A point on the sheet: URLs relative to the page, what its picture opens, and texts."""

    label: str
    figures: str
    recipe: str
    error: str
    size: tuple[int, int]
    picture: str
    link: str
    opens: str


def save_contact_sheet(
    points: Sequence[Point], table: SweepTable, journal: Path, path: str | os.PathLike[str], force: bool = False
) -> Path:
    """Write a page with the pictures of a sweep's points, and return its path.

    The pictures are those of the journal. The reports of the first `MOST_REPORTS` points are drawn now, into a folder
    beside the page.

    Raises
    ------
    ValueError                   the sweep has no pictures
    SoftShadowError              the page or a report cannot be written
    """
    target = Path(path)
    refuse_foreign(target, force)
    if not any(point.picture for point in points):
        raise ValueError(f"{path}: the sweep stored no pictures; expected `picture = true`")
    stored, reports = Journal(journal), target.with_suffix(".reports")
    varying = [name for name in table.columns if name.startswith("option_") or name in PLACES]
    varying = [name for name in varying if len({str(row.get(name)) for row in table.rows}) > 1]
    cells = []
    for index, (point, row) in enumerate(zip(points, table.rows, strict=True)):
        picture = stored.file_of(point.key)
        shown = relative(picture, target) if row["status"] == "ok" and picture.exists() else ""
        link = shown
        if shown and index < MOST_REPORTS:
            link = relative(report_of(point, reports), target)
        opens = "its report" if link != shown else "the picture"
        cells.append(
            Cell(label_of(row, varying), figures_of(row), row["recipe"], row["error"], point.size, shown, link, opens)
        )
    note = "Click a picture to open its report." if len(cells) <= MOST_REPORTS else (
        f"The first {MOST_REPORTS} pictures open a report; the command below a picture draws any other."
    )  # fmt: skip
    values = {"title": f"Sweep: {target.stem}", "cells": cells, "failed": len(table.failed), "note": note}
    return write_whole(target, lambda file: write_page(file, "sheet.html", **values), force)


PLACES = (
    "technique", "scene", "width_px", "height_px", "light_x", "light_y", "light_z", "light_w", "eye_x", "eye_y",
    "eye_z", "target_x", "target_y", "target_z", "fov_degrees", "threads", "repetition",
)  # fmt: skip
FIGURES = (
    ("hard_wrong_px", "{} pixels wrong"), ("soft_rms", "RMS {:.3g}"), ("frame_ms", "{:.3g} ms"),
)  # fmt: skip


def report_of(point: Point, folder: Path) -> Path:
    """Write the report of a point unless it is there, and return its path."""
    path = folder / f"{point.key}.html"
    if not path.exists():
        try:
            folder.mkdir(exist_ok=True)
        except OSError as error:
            raise SoftShadowError(f"{folder}: cannot be written ({error.strerror})") from None
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", SoftShadowWarning)  # the report has them
            run(point.technique, placed(load_scene(point.scene), point), point.size, **point.options).save(path)
    return path


def label_of(row: Row, varying: Sequence[str]) -> str:
    """Return what tells a point from the others: the columns that vary."""
    said = [f"{name.removeprefix('option_')} {row[name]}" for name in varying if row.get(name) is not None]
    return ", ".join(part.removeprefix("technique ") for part in said) or str(row["technique"])


def figures_of(row: Row) -> str:
    """Return the main figures of a point, as a text."""
    return ", ".join(text.format(row[name]) for name, text in FIGURES if row.get(name) is not None)


def relative(path: Path, page: Path) -> str:
    """Return the URL of a file, relative to the folder of a page."""
    return Path(os.path.relpath(path, page.parent)).as_posix()
