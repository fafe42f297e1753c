"""The page of a failure, from its runs."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from softshadow.gallery.failure import Failure
from softshadow.report import FailurePage, write_failure_page
from softshadow.runs.saving import page_of


def write_page(failure: Failure, path: Path) -> None:
    """Draw a failure and its cure, and write their page as one file."""
    page = FailurePage(
        failure.name,
        failure.title,
        failure.reason,
        failure.reference,
        tuple(failure.codes),
        failure.scene.name,
        failure.size,
        failure.counted,
        failure.number_wrong,
        failure.number_cured,
        failure.remark,
        failure.diff,
        np.asarray(failure.picture()),
        (
            page_of(failure.wrong.record, "failure", {"wrong pixels": failure.wrong_pixels(failure.wrong)}),
            page_of(failure.cured.record, "cure", {"wrong pixels": failure.wrong_pixels(failure.cured)}),
        ),
        failure.pixel,
    )
    write_failure_page(page, path)
