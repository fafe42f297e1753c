"""Carry out a sweep: measure the points that the journal does not have, and write each of them before the next."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from softshadow.sweeps.journal import Journal
from softshadow.sweeps.measured import Result, Row
from softshadow.sweeps.one_process import measured_here
from softshadow.sweeps.point import Point

Engine = Callable[[Sequence[Point]], Iterator[tuple[Point, Result]]]


@dataclass(frozen=True)
class Progress:
    """How far a sweep is: points done (failed ones included), failed, and all; how many workers there are now."""

    done: int
    failed: int
    total: int
    workers: int = 1


def execute(
    points: Sequence[Point],
    journal_path: Path,
    engine: Engine = measured_here,
    *,
    resume: bool = False,
    report: Callable[[Progress], Any] = lambda progress: None,
    workers: Callable[[], int] = lambda: 1,
) -> list[Row]:
    """Measure points, and return their rows in the order of the points.

    Parameters
    ----------
    points : sequence of Point   equal points are measured once
    journal_path : Path          each row is on the disk before it is reported; pictures are in a folder beside it
    engine : callable            measures points in any order; one after the other in this process by default
    resume : bool                go on with a journal that exists: what it has is not measured again
    report : callable            called with the progress at the beginning and after every point
    workers : callable           returns how many workers there are now

    Raises
    ------
    SoftShadowError              the journal exists and `resume` is not set, or it cannot be written
    """
    keys = [point.key for point in points]
    with Journal(journal_path) as journal:
        rows = journal.open(resume)
        left = {key: point for key, point in zip(keys, points, strict=True) if key not in rows}
        by_point = {id(point): key for key, point in left.items()}
        wanted = set(keys)
        have = [rows[key] for key in wanted if key in rows]
        done, failed = len(have), sum(row["status"] != "ok" for row in have)

        def progress() -> Progress:
            return Progress(done, failed, len(wanted), workers())

        report(progress())
        for point, result in engine(list(left.values())):
            key = by_point.get(id(point)) or point.key
            if key not in rows:  # a worker that was lost may have been followed by another one
                rows[key] = {**result.row, "recipe": point.recipe, "key": key}
                done, failed = done + 1, failed + (result.row["status"] != "ok")
                journal.add(key, Result(rows[key], result.picture))
            report(progress())
    return [rows[key] for key in keys]
