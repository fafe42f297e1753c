"""Carry out tasks, points or frames: compute those that the journal does not have, and write each before the next."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from softshadow.sweeps.dask_engine import dask_engine
from softshadow.sweeps.journal import PICTURES, Journal
from softshadow.sweeps.measured import POINTS
from softshadow.sweeps.task import Result, Row, Task, Work

Engine = Callable[[Sequence[Any]], Iterator[tuple[Any, Result]]]


@dataclass(frozen=True)
class Progress:
    """How far it is: tasks done (failed ones included), failed, and all; how many workers there are now."""

    done: int
    failed: int
    total: int
    workers: int = 1


def execute(
    tasks: Sequence[Task],
    journal_path: Path,
    engine: Engine = POINTS.here,
    *,
    resume: bool = False,
    report: Callable[[Progress], Any] = lambda progress: None,
    workers: Callable[[], int] = lambda: 1,
    files: tuple[str, str] = PICTURES,
) -> list[Row]:
    """Compute tasks, and return their rows in the order of the tasks.

    Parameters
    ----------
    tasks : sequence of Task     points of a sweep or frames of a film; equal ones are computed once
    journal_path : Path          each row is on the disk before it is reported; files are in a folder beside it
    engine : callable            computes tasks in any order; by default points, one after the other in this process
    resume : bool                go on with a journal that exists: what it has is not computed again
    report : callable            called with the progress at the beginning and after every task
    workers : callable           returns how many workers there are now
    files : pair of str          ending of the folder and of the files in it

    Raises
    ------
    SoftShadowError              the journal exists and `resume` is not set, or it cannot be written
    """
    keys = [task.key for task in tasks]
    with Journal(journal_path, files) as journal:
        rows = journal.open(resume)
        left = {key: task for key, task in zip(keys, tasks, strict=True) if key not in rows}
        by_task = {id(task): key for key, task in left.items()}
        wanted = set(keys)
        have = [rows[key] for key in wanted if key in rows]
        done, failed = len(have), sum(row["status"] != "ok" for row in have)

        def progress() -> Progress:
            return Progress(done, failed, len(wanted), workers())

        report(progress())
        for task, result in engine(list(left.values())):
            key = by_task.get(id(task)) or task.key
            if key not in rows:  # a worker that was lost may have been followed by another one
                rows[key] = {**result.row, "recipe": task.recipe, "key": key}
                done, failed = done + 1, failed + (result.row["status"] != "ok")
                journal.add(key, Result(rows[key], result.file))
            report(progress())
    return [rows[key] for key in keys]


@contextmanager
def engine_for(
    work: Work, scheduler: str | None, workers: int | None
) -> Iterator[tuple[Engine, Callable[[], int], str | None]]:
    """Give an engine, what counts its workers, and the address of its page or None.

    Parameters
    ----------
    scheduler : str | None       address of a Dask scheduler that runs already
    workers : int | None         without one: 1 computes in this process, None starts a process for each core

    Raises
    ------
    SoftShadowError              see `dask_engine`
    """
    if scheduler is None and workers == 1:
        yield work.here, lambda: 1, None
    else:
        with dask_engine(work, scheduler, workers) as engine:
            yield engine, engine.workers, engine.dashboard
