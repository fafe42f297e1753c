"""`sweep`: carry out a sweep file, here or on a cluster, and return its table."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from softshadow.errors import SoftShadowError
from softshadow.inspection.files import refuse_foreign
from softshadow.sweeps.execution import Progress, engine_for, execute
from softshadow.sweeps.measured import POINTS
from softshadow.sweeps.point import Point
from softshadow.sweeps.specification import Specification, read_specification, specified
from softshadow.sweeps.table import SweepTable, check_suffix


def sweep(
    specification: str | os.PathLike[str] | Mapping[str, Any] | Specification,
    output: str | os.PathLike[str] = "sweep.csv",
    *,
    resume: bool = False,
    workers: int | None = 1,
    scheduler: str | None = None,
    force: bool = False,
    report: Callable[[Progress], Any] = lambda progress: None,
    started: Callable[[str | None], Any] = lambda dashboard: None,
) -> SweepTable:
    """Measure every point of a sweep, and return the table, which is also written.

    Each point is written to a journal beside the table (``sweep.journal``) as soon as it is finished. A sweep that was
    stopped, in whatever way, goes on with `resume`; no point is measured twice.

    Parameters
    ----------
    specification                a sweep file (.toml), or its content as a mapping (docs/sweeps.md)
    output : path                of the table: .csv, .json or .parquet
    resume : bool                go on with the journal that is there
    workers : int | None         1: in this process; more: so many processes; None: one for each core
    scheduler : str              address of a Dask scheduler that runs already, such as "tcp://host:8786"
    force : bool                 also overwrite a table that this package did not write
    report : callable            called with a `Progress` at the beginning and after every point
    started : callable           called with the address of the cluster's page, or None, when it is ready

    Returns
    -------
    SweepTable                   in the order of the specification, the same bytes however it was computed, except for
                                 times, memory and machine

    Raises
    ------
    SoftShadowError              the file is wrong (key, and what was expected), a journal exists, the disk is full, the
                                 scheduler is lost

    Examples
    --------
    >>> import softshadow as ss, tempfile
    >>> file = f"{tempfile.mkdtemp()}/sizes.csv"
    >>> table = ss.sweep({"technique": "blob", "size": ["16x12", "32x24"], "measure": ["counts"]}, file)
    >>> table["width_px"]
    array([16., 32.])
    """
    target = Path(output)
    check_suffix(target)
    refuse_foreign(target, force or resume)
    points = points_of(specification)
    journal = target.with_suffix(".journal")
    with engine_for(POINTS, scheduler, workers) as (engine, count_workers, dashboard):
        started(dashboard)
        rows = execute(points, journal, engine, resume=resume, report=report, workers=count_workers)
    table = SweepTable(rows)
    table.save(target, force=force or resume)
    return table


def points_of(given: str | os.PathLike[str] | Mapping[str, Any] | Specification) -> list[Point]:
    """Return the points of a sweep; a wrong option is an error that names the file."""
    specification = specification_of(given)
    try:
        return specification.points()
    except (ValueError, TypeError) as error:
        raise SoftShadowError(f"{given if isinstance(given, str | Path) else 'specification'}: {error}") from None


def specification_of(given: str | os.PathLike[str] | Mapping[str, Any] | Specification) -> Specification:
    """Return a specification from a file, a mapping, or itself."""
    if isinstance(given, Specification):
        return given
    if isinstance(given, Mapping):
        return specified(dict(given), "specification")
    return read_specification(given)
