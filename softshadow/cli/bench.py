"""``softshadow bench``: measure workloads, compare with Mesa and with earlier reports."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from softshadow.cli.arguments import Size, as_json, examples
from softshadow.cli.bench_corpus import bench_corpus, is_of_corpus
from softshadow.cli.console import CHECK_FAILED, print_json, print_warnings_once, say, say_written, table
from softshadow.errors import SoftShadowError

if TYPE_CHECKING:
    from softshadow.bench.growth import Growth
    from softshadow.bench.peers import Peer
    from softshadow.bench.regression import TimeChange
    from softshadow.bench.results import Report, WorkloadResult
    from softshadow.bench.workload import Workload


class Threads(click.ParamType):
    """Numbers of threads, separated by commas."""

    name = "N,N"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> list[int]:
        """Return the numbers of a text such as "1,2"."""
        if isinstance(value, list):
            return value
        numbers = [int(part) for part in value.split(",") if part.strip().isdigit()]
        if len(numbers) != value.count(",") + 1 or min(numbers, default=0) < 1:
            self.fail(f"{value!r}: expected numbers of threads, at least 1, as in 1,2", param, ctx)
        return list(dict.fromkeys(numbers))


@click.command(
    epilog=examples(
        "softshadow bench w4",
        "softshadow bench corpus --against mesa",
        "softshadow bench features/fog-exp+scissor --against mesa",
    )
)
@click.argument("names", metavar="[WORKLOAD]...", nargs=-1)
@click.option(
    "--against", metavar="mesa|softpipe|FILE.json", multiple=True,
    help="Compare with Mesa's llvmpipe or softpipe, or with an earlier --json report; repeatable.",
)  # fmt: skip
@click.option("--threads", type=Threads(), default="1", show_default=True, help="Numbers of threads to measure.")
@click.option("--rounds", type=click.IntRange(1), default=7, show_default=True, help="Number of timed frames.")
@click.option("--size", type=Size(), help="Window size, instead of the workload's own.")
@click.option("--scaling", metavar="AXIS", help="Vary resolution, triangles, samples, lights or kind (of light).")
@click.option("--starts", is_flag=True, help="Also measure the first frame of a new process, cold and warm.")
@click.option("--plot", metavar="FILE", help="Write a plot (.png, .svg, .pdf); needs matplotlib.")
@as_json
@click.pass_context
def bench(
    context: click.Context, names: tuple[str, ...], against: tuple[str, ...], threads: list[int], rounds: int,
    size: tuple[int, int] | None, scaling: str | None, starts: bool, plot: str | None, as_json: bool,
) -> None:  # fmt: skip
    """Measure frame times of workloads, or list them.

    With the name calls, single GL calls are measured.
    """
    from softshadow.bench.peers import peers_for
    from softshadow.bench.regression import time_changes
    from softshadow.bench.workloads import select_workloads

    if not names:
        _list(as_json)
        return
    if names == ("calls",):
        _calls(rounds, as_json)
        return
    if any(map(is_of_corpus, names)):
        if scaling or starts or plot:
            raise click.UsageError("the corpus has neither --scaling nor --starts nor --plot")
        bench_corpus(context, names, against, threads, rounds, size, as_json)
        return
    workloads = [each.resized(size) if size else each for each in select_workloads(list(names))]
    files = [each for each in against if each.endswith(".json")]
    earlier = [_earlier(file) for file in files]
    peers = peers_for([each for each in against if each not in files], threads)
    if plot:
        from softshadow.bench.plot import figure_class

        figure_class()  # report a missing matplotlib before measuring for minutes
    report, growths = _measure(workloads, peers, threads, rounds, scaling, starts)
    changes = [change for then in earlier for change in time_changes(report, then)]
    if plot:
        from softshadow.bench.plot import save_plot

        save_plot(plot, report, growths)
        say_written(plot)
    if as_json:
        _print_json(report, growths, changes)
    else:
        _print(report, growths, changes)
    if not all(each.equal for each in report.workloads) or any(each.verdict == "slower" for each in changes):
        context.exit(CHECK_FAILED)


def _list(as_json: bool) -> None:
    from softshadow.bench.corpus.programs import PROGRAMS
    from softshadow.bench.workloads import get, names

    workloads = [
        *(get(name) for name in names()),
        *(replace(program, name=f"corpus/{name}") for name, program in PROGRAMS.items()),
    ]
    if as_json:
        print_json("bench", workloads=[{"name": e.name, "title": e.title, "size": e.size} for e in workloads])
        return
    rows = [[each.name, f"{each.size[0]}x{each.size[1]}", each.title] for each in workloads]
    table("Workloads", ["name", "size", "description"], rows)


def _calls(rounds: int, as_json: bool) -> None:
    """Measure single GL calls, beside PyOpenGL on Mesa if that is installed."""
    from dataclasses import asdict

    from softshadow.bench.calls import measure_calls
    from softshadow.bench.tables import call_rows
    from softshadow.testing.mesa import mesa_available, mesa_reason

    with_mesa = mesa_available()
    if not with_mesa:
        say(f"without Mesa: {mesa_reason()}")
    say("measuring calls ...")
    times = measure_calls(with_mesa, rounds)
    if as_json:
        print_json("bench-calls", calls=[asdict(each) for each in times])
    else:
        table("Calls, microseconds", *call_rows(times))


def _earlier(file: str) -> Report:
    from softshadow.bench.results import from_json

    try:
        return from_json(json.loads(Path(file).read_text(encoding="utf-8")))
    except ValueError as error:
        raise SoftShadowError(f"{file}: {error}") from None


def _measure(
    workloads: list[Workload],
    peers: list[Peer],
    threads: list[int],
    rounds: int,
    scaling: str | None,
    starts: bool,
) -> tuple[Report, list[Growth]]:
    from softshadow.bench.growth import growth, series
    from softshadow.bench.limits import measure_limits
    from softshadow.bench.measuring import measure
    from softshadow.bench.results import Report
    from softshadow.bench.starts import measure_starts
    from softshadow.testing.machine import machine

    all_series = [(each, series(each, scaling)) for each in workloads] if scaling else []
    say("measuring the machine's limits ...")
    limits = tuple(measure_limits(number) for number in threads)
    results: list[WorkloadResult] = []
    growths = []
    with print_warnings_once():
        if not scaling:
            results = [measure(each, peers, rounds, say) for each in workloads]
        for workload, steps in all_series:
            measured = [measure(each, peers, rounds, say) for _, each in steps]
            growths.append(growth(workload.name, str(scaling), [amount for amount, _ in steps], measured))
            results += measured
    first_frames = {}
    for each in workloads if starts else []:
        say(f"{each.name}: measuring cold and warm start ...")
        first_frames[each.name] = measure_starts(each)
    with_mesa = any(peer.renderer != "softshadow" for peer in peers)
    return Report(machine(with_mesa), limits, tuple(results), first_frames), growths


def _print_json(report: Report, growths: list[Growth], changes: list[TimeChange]) -> None:
    from dataclasses import asdict

    from softshadow.bench.results import to_json

    contents = {key: value for key, value in to_json(report).items() if key != "schema"}
    growth = [
        {"workload": each.workload, "axis": each.axis, "amounts": each.amounts, "exponents": each.exponents}
        for each in growths
    ]
    print_json("bench", **contents, growth=growth, changes=[{**asdict(e), "verdict": e.verdict} for e in changes])


def _print(report: Report, growths: list[Growth], changes: list[TimeChange]) -> None:
    from softshadow.bench.tables import change_rows, growth_rows, limit_rows, result_rows, start_rows

    facts = ", ".join(f"{key} {value}" for key, value in report.machine.items())
    say(facts)
    table("Limits of this machine", *limit_rows(report))
    table("Times", *result_rows(report))
    for each in growths:
        click.echo()
        table(f"{each.workload} over {each.axis}", *growth_rows(each))
    if report.starts:
        click.echo()
        table("First frame of a new process, seconds", *start_rows(report))
    if changes:
        click.echo()
        table("Changes", *change_rows(changes))
