"""``softshadow sweep``: measure every point of a sweep file, here or on a cluster, into one table."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from softshadow.cli.arguments import check_opened, examples, force, open_file, output_option
from softshadow.cli.console import CHECK_FAILED, say, say_if_compiling, say_marked, say_written
from softshadow.cli.names import complete_files
from softshadow.cli.sweep_progress import progress_shown

if TYPE_CHECKING:
    from softshadow.sweeps import SweepTable

SHOWN_FAILURES = 5


@click.command(
    epilog=examples(
        "softshadow sweep sweep.toml -o map-sizes.csv --workers 1",
        "softshadow sweep sweep.toml --workers 1 --plot x=map_size,y=wrong_px,color=technique",
    )
)
@click.argument("file", metavar="FILE.toml", shell_complete=complete_files)
@output_option("The table: .csv, .parquet or .json.  [default: FILE.csv]", "TABLE")
@click.option("--resume", is_flag=True, help="Go on with the journal of an earlier sweep.")
@click.option("--workers", type=click.IntRange(1), help="Number of processes.  [default: one for each core]")
@click.option("--scheduler", metavar="ADDRESS", help="A Dask scheduler that runs already: tcp://HOST:PORT.")
@click.option("--plot", "plots", multiple=True, metavar="x=,y=,color=", help="Also plot columns; repeatable.")
@click.option("--sheet", is_flag=True, help="Also write a page with all pictures; each opens its report.")
@open_file
@force
@click.option("--json", "as_json", is_flag=True, help="Print progress and result as JSON, one event in a line.")
@click.pass_context
def sweep(
    context: click.Context, file: str, output: str | None, resume: bool, workers: int | None, scheduler: str | None,
    plots: tuple[str, ...], sheet: bool, opened: bool, force: bool, as_json: bool,
) -> None:  # fmt: skip
    """Measure techniques over options, scenes, lights, cameras and sizes.

    FILE.toml says what is varied. Each point is written to a journal beside the table as soon as it is finished, so an
    interrupted sweep goes on with --resume. A point that fails becomes a row with its error; then the exit code is 1.
    """
    from softshadow.sweeps import PlotRequest, perform, read_specification, save_contact_sheet, save_plot

    requests = [PlotRequest.parse(text) for text in plots]
    if opened and not (requests or sheet):
        check_opened(opened, None)
    target = Path(output or Path(file).with_suffix(".csv").name)
    if scheduler is not None and workers is not None:
        raise click.UsageError("--scheduler and --workers: expected only one of them")
    specification = read_specification(file)
    if sheet and not specification.picture:
        raise click.UsageError(f"--sheet: {file} stores no pictures; expected picture = true")
    say_if_compiling()
    with progress_shown(as_json) as (started, report):
        table = perform.sweep(
            specification, target, resume=resume, workers=processes(workers), scheduler=scheduler, force=force,
            report=report, started=started,
        )  # fmt: skip
    written = [target]
    for number, request in enumerate(requests):
        name = f"{target.stem}{f'-{number + 1}' if number else ''}.png"
        written.append(save_plot(table, target.with_name(name), request, force))
    if sheet:
        page = target.with_suffix(".html")
        journal = target.with_suffix(".journal")
        written.append(save_contact_sheet(perform.points_of(specification), table, journal, page, force))
    end(table, written, as_json, opened)
    if table.failed:
        context.exit(CHECK_FAILED)


def processes(wanted: int | None) -> int:
    """Return how many processes measure: those wanted, else one for each core if distributed is installed."""
    from softshadow.sweeps.dask_engine import is_installed

    if wanted is not None:
        return wanted
    if not is_installed():
        say("one process measures, because distributed is not installed (pip install 'softshadow[sweep]')")
        return 1
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def end(table: SweepTable, written: list[Path], as_json: bool, opened: bool) -> None:
    """Print how the sweep ended: what failed, and what was written."""
    failed = table.failed
    if as_json:
        from softshadow.cli.sweep_progress import print_event

        failures: list[Any] = [{"recipe": row["recipe"], "error": row["error"]} for row in failed]
        print_event("end", points=len(table), failed=len(failed), failures=failures, written=list(map(str, written)))
    else:
        click.echo(f"{len(table)} points, {len(table) - len(failed)} measured, {len(failed)} failed")
    for row in failed[:SHOWN_FAILURES]:
        say_marked("error", f"{row['recipe']}: {row['error']}")
    if len(failed) > SHOWN_FAILURES:
        say(f"and {len(failed) - SHOWN_FAILURES} more, in the column 'error'")
    say_written(*written, opened=opened)
