"""The page of a failure: its story, both pictures, and every fragment that met the pixel to click."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from softshadow.report.page import environment, inline

if TYPE_CHECKING:
    from softshadow.failures import Failure


def write(failure: Failure, path: Path) -> None:
    """Write the page of a failure as one file."""
    sides = (("with the failure", failure.wrong), ("with the cure", failure.cured))
    histories = [(side, run.pixel(*failure.pixel)._repr_html_()) for side, run in sides]
    page = environment().get_template("failure.html").render(
        failure=failure, picture=inline(failure.picture(), failure.name), histories=histories
    )  # fmt: skip
    path.write_text(page, encoding="utf-8")
