"""Progress of a sweep or film: a bar on a terminal, a line a minute in a file, or JSON events."""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import click

from softshadow.cli.console import say

if TYPE_CHECKING:
    from softshadow.sweeps import Progress

EVERY = 60.0  # seconds between two lines when stderr is not a terminal
Report = Callable[["Progress"], None]
Started = Callable[["str | None"], None]


@contextmanager
def progress_shown(as_json: bool, of: str = "points") -> Iterator[tuple[Started, Report]]:
    """Give what is called when the workers are ready, and after every task; `of` says what the tasks are."""
    if as_json:
        yield events()
    elif sys.stderr.isatty():
        with bar(of) as (started, report):
            yield started, report
    else:
        yield say_address, lines(of)


def print_event(event: str, **contents: Any) -> None:
    """Print a line of JSON."""
    click.echo(json.dumps({"schema": "softshadow/sweep/1", "event": event, **contents}))


def events() -> tuple[Started, Report]:
    """Return what prints an event at the start, and after every point."""

    def report(progress: Progress) -> None:
        print_event("progress", **vars(progress))

    return (lambda dashboard: print_event("start", dashboard=dashboard)), report


def say_address(dashboard: str | None) -> None:
    """Print the address of the page on which Dask shows the cluster."""
    if dashboard:
        say(f"dashboard: {dashboard}")


def lines(of: str) -> Report:
    """Return what prints a line every minute, and one at the end."""
    start = said = time.monotonic()
    first: int | None = None

    def report(progress: Progress) -> None:
        nonlocal said, first
        now = time.monotonic()
        first = progress.done if first is None else first
        if now - said >= EVERY or progress.done == progress.total:
            said = now
            say(described(progress, (progress.done - first) / max(now - start, 1e-9), of))

    return report


def described(progress: Progress, rate: float, of: str = "points") -> str:
    """Return the state of a sweep or film as a text; `rate` is in tasks per second."""
    left = progress.total - progress.done
    time_left = f", about {duration(left / rate)} left" if rate > 0 and left else ""
    return (
        f"{progress.done} of {progress.total} {of} done, {progress.failed} failed, {left} left, {rate:.1f} {of}/s"
        f"{time_left}, {progress.workers} worker{'' if progress.workers == 1 else 's'}"
    )


def duration(seconds: float) -> str:
    """Return a time such as "1:02:03" (hours, minutes, seconds)."""
    hours, rest = divmod(round(seconds), 3600)
    return f"{hours}:{rest // 60:02d}:{rest % 60:02d}"


@contextmanager
def bar(of: str) -> Iterator[tuple[Started, Report]]:
    """Give what shows a bar on the terminal."""
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn
    from rich.table import Column

    console = Console(stderr=True)
    start = time.monotonic()
    first: int | None = None
    text = TextColumn("{task.description}", table_column=Column(ratio=1))  # takes two lines on a narrow terminal
    with Progress(BarColumn(bar_width=20), text, console=console, expand=True) as shown:
        task = shown.add_task("starting ...", total=None)

        def report(progress: Any) -> None:
            nonlocal first
            first = progress.done if first is None else first
            rate = (progress.done - first) / max(time.monotonic() - start, 1e-9)
            shown.update(task, total=progress.total, completed=progress.done, description=described(progress, rate, of))

        yield (lambda dashboard: shown.console.print(f"dashboard: {dashboard}") if dashboard else None), report
