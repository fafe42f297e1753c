"""``softshadow bench``: how long workloads take here, on Mesa, and against an earlier report."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from softshadow.cli.arguments import Size, as_json
from softshadow.cli.console import named_warnings, print_json, say, table

if TYPE_CHECKING:
    from softshadow.bench.growth import Growth
    from softshadow.bench.peers import Peer
    from softshadow.bench.regression import Change
    from softshadow.bench.results import Report, WorkloadResult
    from softshadow.bench.workload import Workload

WORSE = 1  # the exit code where buffers differ or a workload has become slower


class Threads(click.ParamType):
    """Numbers of threads, with commas between them."""

    name = "N,N"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> list[int]:
        if isinstance(value, list):
            return value
        numbers = [int(part) for part in value.split(",") if part.strip().isdigit()]
        if len(numbers) != value.count(",") + 1 or min(numbers, default=0) < 1:
            self.fail(f"{value!r}: expected numbers of threads from 1 on, as in 1,2", param, ctx)
        return list(dict.fromkeys(numbers))


@click.command(
    epilog="Examples:  softshadow bench w4  |  softshadow bench volume-zfail/torus --scaling lights --threads 1"
)
@click.argument("names", metavar="[WORKLOAD]...", nargs=-1)
@click.option(
    "--against", metavar="mesa|softpipe|FILE.json", multiple=True,
    help="Draw in turns with Mesa's llvmpipe or softpipe, or compare with an earlier --json; several times.",
)  # fmt: skip
@click.option("--threads", type=Threads(), default="1", show_default=True, help="Numbers of threads, of all sides.")
@click.option("--rounds", type=click.IntRange(1), default=7, show_default=True, help="Frames that are timed, of each.")
@click.option("--size", type=Size(), help="Of the window, instead of the workload's own.")
@click.option("--scaling", metavar="AXIS", help="Measure growth over resolution, triangles, samples, lights or kind.")
@click.option("--starts", is_flag=True, help="Measure the first frame of a new process, too: cold and warm.")
@click.option("--plot", metavar="FILE", help="Write a picture (.png, .svg, .pdf); needs matplotlib.")
@as_json
@click.pass_context
def bench(
    context: click.Context, names: tuple[str, ...], against: tuple[str, ...], threads: list[int], rounds: int,
    size: tuple[int, int] | None, scaling: str | None, starts: bool, plot: str | None, as_json: bool,
) -> None:  # fmt: skip
    """Time workloads, alone, against Mesa, or against an earlier report; without names, list them."""
    from softshadow.bench.peers import peers
    from softshadow.bench.regression import changes
    from softshadow.bench.workloads import chosen

    if not names:
        _list(as_json)
        return
    workloads = [each.resized(size) if size else each for each in chosen(list(names))]
    files = [each for each in against if each.endswith(".json")]
    earlier = [_earlier(file) for file in files]
    takes_part = peers([each for each in against if each not in files], threads)
    if plot:
        from softshadow.bench.plot import figure_class

        figure_class()  # said before minutes have gone by
    report, grown = _measured(workloads, takes_part, threads, rounds, scaling, starts)
    changed = [change for then in earlier for change in changes(report, then)]
    if plot:
        from softshadow.bench.plot import save_plot

        save_plot(plot, report, grown)
    if as_json:
        _print_json(report, grown, changed)
    else:
        _print(report, grown, changed)
    if not all(each.equal for each in report.workloads) or any(each.verdict == "slower" for each in changed):
        context.exit(WORSE)


def _list(as_json: bool) -> None:
    from softshadow.bench.workloads import get, names

    found = [get(name) for name in names()]
    if as_json:
        print_json("bench", workloads=[{"name": e.name, "title": e.title, "size": e.size} for e in found])
        return
    rows = [[each.name, f"{each.size[0]}x{each.size[1]}", each.title] for each in found]
    table("Workloads", ["name", "size", "what it draws"], rows)


def _earlier(file: str) -> Report:
    from softshadow.bench.results import from_json

    try:
        return from_json(json.loads(Path(file).read_text(encoding="utf-8")))
    except ValueError as error:
        raise ValueError(f"{file}: {error}") from None


def _measured(
    workloads: list[Workload],
    takes_part: list[Peer],
    threads: list[int],
    rounds: int,
    scaling: str | None,
    starts: bool,
) -> tuple[Report, list[Growth]]:
    from softshadow.bench.growth import growth, series
    from softshadow.bench.limits import measure_limits
    from softshadow.bench.machine import machine
    from softshadow.bench.measuring import measure
    from softshadow.bench.results import Report
    from softshadow.bench.starts import measure_starts

    all_series = [(each, series(each, scaling)) for each in workloads] if scaling else []
    say("measuring the machine's limits ...")
    limits = tuple(measure_limits(number) for number in threads)
    results: list[WorkloadResult] = []
    grown = []
    with named_warnings():
        if not scaling:
            results = [measure(each, takes_part, rounds, say) for each in workloads]
        for workload, steps in all_series:
            measured = [measure(each, takes_part, rounds, say) for _, each in steps]
            grown.append(growth(workload.name, str(scaling), [amount for amount, _ in steps], measured))
            results += measured
    first_frames = {}
    for each in workloads if starts else []:
        say(f"{each.name}: cold and warm start ...")
        first_frames[each.name] = measure_starts(each)
    with_mesa = any(peer.renderer != "softshadow" for peer in takes_part)
    return Report(machine(with_mesa), limits, tuple(results), first_frames), grown


def _print_json(report: Report, grown: list[Growth], changed: list[Change]) -> None:
    from dataclasses import asdict

    from softshadow.bench.results import to_json

    found = {key: value for key, value in to_json(report).items() if key != "schema"}
    growths = [
        {"workload": each.workload, "axis": each.axis, "amounts": each.amounts, "exponents": each.exponents}
        for each in grown
    ]
    print_json("bench", **found, growth=growths, changes=[{**asdict(e), "verdict": e.verdict} for e in changed])


def _print(report: Report, grown: list[Growth], changed: list[Change]) -> None:
    from softshadow.bench.tables import change_rows, growth_rows, limit_rows, result_rows, start_rows

    facts = ", ".join(f"{key} {value}" for key, value in report.machine.items())
    say(facts)
    table("Limits of this machine", *limit_rows(report))
    table("Times", *result_rows(report))
    for each in grown:
        click.echo()
        table(f"{each.workload} over {each.axis}", *growth_rows(each))
    if report.starts:
        click.echo()
        table("First frame of a new process, seconds", *start_rows(report))
    if changed:
        click.echo()
        table("Changes", *change_rows(changed))
