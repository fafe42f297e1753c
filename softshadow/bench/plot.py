"""A picture of a report: each workload's ratio to Mesa, and each growth as lines over doubly logarithmic axes."""

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
    SoftShadowError      matplotlib is not installed; the message says how to get it
    """
    try:
        from matplotlib.figure import Figure
    except ModuleNotFoundError:
        raise SoftShadowError("--plot needs matplotlib: pip install 'softshadow[notebook]'") from None
    return Figure


def save_plot(path: str, report: Report, grown: Sequence[Growth] = ()) -> None:
    """Write the picture, in the form that the ending of its name says.

    Raises
    ------
    SoftShadowError      matplotlib is not installed
    """
    figure = figure_class()(figsize=(7, 3.2 * (1 + len(grown))), layout="constrained")
    panels = figure.subplots(1 + len(grown), squeeze=False)[:, 0]
    draw_times(panels[0], report)
    for panel, each in zip(panels[1:], grown, strict=True):
        draw_growth(panel, each)
    figure.savefig(path)


def draw_times(panel: Any, report: Report) -> None:
    """Draw a bar per workload and peer: milliseconds a frame, with their spread."""
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
    panel.set_xlabel("milliseconds a frame")
    panel.legend()


def draw_growth(panel: Any, grown: Growth) -> None:
    """Draw milliseconds over the amount, a line per peer; the exponent stands in the legend."""
    for one in grown.results[0].peers:
        found = [result.times(one.renderer, one.threads) for result in grown.results]
        label = f"{one.renderer}@{one.threads}"
        power = grown.exponents.get(label)
        named = label if power is None else f"{label}: exponent {power:.2f}"
        panel.plot(grown.amounts, [1e3 * times.wall.median for times in found if times], marker="o", label=named)
    if grown.exponents:
        panel.set_xscale("log")
    panel.set_yscale("log")
    panel.set_xlabel(f"{grown.axis} of {grown.workload}")
    panel.set_ylabel("milliseconds a frame")
    panel.legend()
