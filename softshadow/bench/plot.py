"""Plots of a report: a bar chart of frame times, and growth as lines on logarithmic axes."""

from __future__ import annotations

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
    """Draw a bar for each workload and peer: milliseconds per frame, with the spread."""
    labels = list(dict.fromkeys(f"{peer.renderer}@{peer.threads}" for each in report.workloads for peer in each.peers))
    height = 0.8 / max(1, len(labels))
    for number, label in enumerate(labels):
        renderer, _, threads = label.partition("@")
        for row, workload in enumerate(report.workloads):
            times = workload.times(renderer, int(threads))
            if times is not None:
                median = 1e3 * times.wall.median
                panel.barh(
                    row + number * height, median, height, xerr=median * times.wall.spread, color=f"C{number}",
                    label=label if row == 0 else None,
                )  # fmt: skip
    panel.set_yticks(range(len(report.workloads)), [each.name for each in report.workloads])
    panel.invert_yaxis()
    panel.set_xscale("log")
    panel.set_xlabel("milliseconds per frame")
    panel.legend()


def draw_growth(panel: Any, growth: Growth) -> None:
    """Draw milliseconds per frame over the amount, a line for each peer; the legend shows the exponents."""
    for peer in growth.results[0].peers:
        times = [result.times(peer.renderer, peer.threads) for result in growth.results]
        name = f"{peer.renderer}@{peer.threads}"
        power = growth.exponents.get(name)
        label = name if power is None else f"{name}: exponent {power:.2f}"
        panel.plot(growth.amounts, [1e3 * each.wall.median for each in times if each], marker="o", label=label)
    if growth.exponents:
        panel.set_xscale("log")
    panel.set_yscale("log")
    panel.set_xlabel(f"{growth.axis} of {growth.workload}")
    panel.set_ylabel("milliseconds per frame")
    panel.legend()
