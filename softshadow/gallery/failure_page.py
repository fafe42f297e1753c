"""The page of a failure, from its runs."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from softshadow.gallery.failure import Failure
from softshadow.report import FailurePage, write_failure_page


def write_page(failure: Failure, path: Path) -> None:
    """Draw a failure and its cure, and write their page as one file."""
    page = FailurePage(
        failure.name,
        failure.title,
        failure.reason,
        failure.reference,
        failure.scene.name,
        failure.size,
        failure.counted,
        failure.number_wrong,
        failure.number_cured,
        failure.remark,
        failure.diff,
        np.asarray(failure.picture()),
        (
            ("with the failure", failure.wrong.pixel(*failure.pixel)),
            ("with the cure", failure.cured.pixel(*failure.pixel)),
        ),
    )
    write_failure_page(page, path)
