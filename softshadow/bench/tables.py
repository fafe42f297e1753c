"""Text tables of a report: (columns, rows)."""

from __future__ import annotations

from collections.abc import Sequence

from softshadow.bench.calls import CallTime
from softshadow.bench.growth import Growth
from softshadow.bench.peers import OWN
from softshadow.bench.regression import TimeChange
from softshadow.bench.results import PeerTimes, Report, Summary, WorkloadResult

Table = tuple[list[str], list[list[str]]]
NOTHING = "-"


def limit_rows(report: Report) -> Table:
    """Return a row for each number of threads: the limits of the machine."""
    rows = [
        [str(each.threads), f"{each.triad / 1e9:.1f} GB/s", f"{each.stencil / 1e9:.2f} Gfrag/s"]
        for each in report.limits
    ]
    return ["threads", "triad", "cache-resident stencil loop"], rows


def result_rows(report: Report) -> Table:
    """Return a row for each workload and peer."""
    columns = [
        "workload", "size", "renderer", "threads", "wall ms", "CPU ms", "first ms", "Mfrag/s", "of limit", "x wall",
        "x CPU", "aim", "equal",
    ]  # fmt: skip
    return columns, [_row(report, each, times) for each in report.workloads for times in each.peers]


def _row(report: Report, workload: WorkloadResult, times: PeerTimes) -> list[str]:
    ratio = next((r for r in workload.ratios if (r.renderer, r.threads) == (times.renderer, times.threads)), None)
    own = times.renderer == OWN
    share = report.share(workload, times.threads) if own else None
    differing = workload.differing[times.renderer]
    equal = "yes" if not any(differing.values()) else ", ".join(f"{k}: {n} differ" for k, n in differing.items() if n)
    return [
        workload.name,
        f"{workload.size[0]}x{workload.size[1]}",
        times.renderer,
        str(times.threads),
        milliseconds(times.wall),
        milliseconds(times.cpu),
        f"{1e3 * times.first:.1f}",
        f"{workload.fragments / times.wall.median / 1e6:.1f}",
        NOTHING if share is None else f"{share:.2%}",
        NOTHING if ratio is None else f"{ratio.wall.median:.2f}",
        NOTHING if ratio is None else f"{ratio.cpu.median:.2f}",
        NOTHING if ratio is None or workload.aim is None else f"{workload.aim:g}",
        NOTHING if own else equal,
    ]


def milliseconds(summary: Summary) -> str:
    """Return a median with its spread.

    Examples
    --------
    >>> milliseconds(Summary(0.0123, 0.051))
    '12.3 ±5%'
    """
    return f"{1e3 * summary.median:.1f} ±{summary.spread:.0%}"


def growth_rows(growth: Growth) -> Table:
    """Return a row for each peer: milliseconds at each amount, and the exponent."""
    rows = []
    for peer in growth.results[0].peers:
        times = [result.times(peer.renderer, peer.threads) for result in growth.results]
        power = growth.exponents.get(f"{peer.renderer}@{peer.threads}")
        cells = [milliseconds(each.wall) if each else NOTHING for each in times]
        rows.append([peer.renderer, str(peer.threads), *cells, NOTHING if power is None else f"{power:.2f}"])
    return ["renderer", "threads", *map(str, growth.amounts), "exponent"], rows


def start_rows(report: Report) -> Table:
    """Return a row for each workload: the times of the parts of a cold and a warm start."""
    columns = list(next(iter(report.starts.values())))
    return ["workload", *columns], [
        [name, *(f"{seconds[column]:.2f}" for column in columns)] for name, seconds in report.starts.items()
    ]


def call_rows(times: Sequence[CallTime]) -> Table:
    """Return a row for each GL call: microseconds here and on Mesa, and their ratio.

    Examples
    --------
    >>> call_rows([CallTime("glDepthMask", 0.5, 0.4, 1.25), CallTime("glClear", 12.0)])[1]
    [['glDepthMask', '0.50', '0.40', '1.25'], ['glClear', '12.00', '-', '-']]
    """
    columns = ["call", "softshadow", "PyOpenGL + Mesa", "times"]
    return columns, [[each.name, *map(_number, (each.softshadow, each.mesa, each.ratio))] for each in times]


def _number(value: float | None) -> str:
    return NOTHING if value is None else f"{value:.2f}"


def change_rows(changes: Sequence[TimeChange]) -> Table:
    """Return a row for each time change since an earlier report."""
    rows = [[e.workload, str(e.threads), f"{e.factor:.2f}", f"{e.allowed:.2f}", e.verdict] for e in changes]
    return ["workload", "threads", "time now / then", "allowed", "verdict"], rows
