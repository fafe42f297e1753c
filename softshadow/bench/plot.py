"""Plots of a report: frame times as points, and growth as lines, on logarithmic axes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import Any

from softshadow.bench.growth import Growth
from softshadow.bench.results import Report
from softshadow.errors import SoftShadowError


def figure_class() -> Any:
    """Return matplotlib's Figure class.

    Raises
    ------
    SoftShadowError              matplotlib is not installed; the message says how to install it
    """
    try:
        from matplotlib.figure import Figure
    except ModuleNotFoundError:
        raise SoftShadowError("--plot needs matplotlib: pip install 'softshadow[notebook]'") from None
    return Figure


def save_plot(path: str, report: Report, growths: Sequence[Growth] = ()) -> None:
    """Write a plot of the report; the file name's suffix sets the format.

    Raises
    ------
    SoftShadowError              matplotlib is not installed
    """
    figure = figure_class()(figsize=(7, 3.2 * (1 + len(growths))), layout="constrained")
    panels = figure.subplots(1 + len(growths), squeeze=False)[:, 0]
    draw_times(panels[0], report)
    for panel, growth in zip(panels[1:], growths, strict=True):
        draw_growth(panel, growth)
    figure.savefig(path)


def draw_times(panel: Any, report: Report) -> None:
    """Draw a point for each workload and peer: milliseconds per frame, with the spread.

    Points and not bars, since a logarithmic axis has no zero that a bar could begin at.
    """
    peers = list(dict.fromkeys((peer.renderer, peer.threads) for each in report.workloads for peer in each.peers))
    names = workload_names(report)
    for number, (renderer, threads) in enumerate(peers):
        shift = 0.5 * (number + 0.5) / len(peers) - 0.25  # peers side by side, around the workload's line
        measured = [(row, each.times(renderer, threads)) for row, each in enumerate(report.workloads)]
        points = [(row + shift, 1e3 * times.wall.median, times.wall.spread) for row, times in measured if times]
        rows, medians, spreads = zip(*points, strict=True)
        errors = [median * spread for median, spread in zip(medians, spreads, strict=True)]
        panel.errorbar(medians, rows, xerr=errors, fmt="o", color=f"C{number}", label=f"{renderer}@{threads}")
    panel.set_yticks(range(len(names)), names)
    panel.invert_yaxis()
    logarithmic(panel, "x")
    panel.grid(axis="x", alpha=0.4)
    panel.set_xlabel("milliseconds per frame")
    panel.legend()


def workload_names(report: Report) -> list[str]:
    """Return a name for each workload: where several have the same name, with their sizes, else with their amounts."""

    def is_shared(names: Sequence[str]) -> list[bool]:
        count = Counter(names)
        return [count[name] > 1 for name in names]

    names = [each.name for each in report.workloads]
    for detail in (
        lambda each: f"{each.size[0]}x{each.size[1]}",
        lambda each: ", ".join(f"{key} {value}" for key, value in each.amounts.items()),
        lambda each: f"{each.triangles} triangles",
    ):
        shared = is_shared(names)
        names = [
            f"{name} {detail(each)}".rstrip() if repeated else name
            for name, each, repeated in zip(names, report.workloads, shared, strict=True)
        ]
    return names


def logarithmic(panel: Any, axis: str) -> None:
    """Make an axis logarithmic, with plain numbers such as 0.5, 20 and 3000 at its ticks."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    getattr(panel, f"set_{axis}scale")("log")
    ticks = getattr(panel, f"{axis}axis")
    ticks.set_major_locator(LogLocator(base=10, subs=(1, 2, 5)))
    ticks.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    ticks.set_minor_formatter(NullFormatter())


def draw_growth(panel: Any, growth: Growth) -> None:
    """Draw milliseconds per frame over the amount, a line for each peer; the legend shows the exponents."""
    for peer in growth.results[0].peers:
        times = [result.times(peer.renderer, peer.threads) for result in growth.results]
        name = f"{peer.renderer}@{peer.threads}"
        power = growth.exponents.get(name)
        label = name if power is None else f"{name}: exponent {power:.2f}"
        panel.plot(growth.amounts, [1e3 * each.wall.median for each in times if each], marker="o", label=label)
    if growth.exponents:
        logarithmic(panel, "x")
    logarithmic(panel, "y")
    panel.set_xlabel(f"{growth.axis} of {growth.workload}")
    panel.set_ylabel("milliseconds per frame")
    panel.legend()
