"""A plot of a sweep: one column over another, in colours by a third; repeated points as mean and spread."""

from __future__ import annotations

import os
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from softshadow.errors import SoftShadowError
from softshadow.inspection.files import MARK, write_whole

if TYPE_CHECKING:
    from softshadow.sweeps.table import SweepTable

METADATA = {".png": "Software", ".svg": "Creator", ".pdf": "Creator"}  # where our mark stands in each format
LOGARITHMIC = 8  # the ratio of largest to smallest value from which an axis is logarithmic
MARKERS = "os^Dv<>pX*"  # lines differ by marker, too, for eyes that do not tell the colours apart
COLORS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")  # Okabe and Ito


@dataclass(frozen=True)
class PlotRequest:
    """Names of columns: what the axes show, and what is told apart by colour."""

    x: str
    y: str
    color: str | None = None

    @classmethod
    def parse(cls, text: str) -> PlotRequest:
        """Return the request of a text such as "x=map_size,y=rms,color=technique".

        Raises
        ------
        ValueError                   another text
        """
        parts = dict(part.strip().split("=", 1) for part in text.split(",") if "=" in part)
        if not {"x", "y"} <= parts.keys() <= {"x", "y", "color"} or len(parts) != len(text.split(",")):
            raise ValueError(f"--plot {text!r}: expected x=COLUMN,y=COLUMN or x=COLUMN,y=COLUMN,color=COLUMN")
        return cls(**parts)


def save_plot(table: SweepTable, path: str | os.PathLike[str], request: PlotRequest, force: bool = False) -> Path:
    """Draw a column over another into a file (.png, .svg, .pdf), and return its path.

    Rows with the same x and the same colour are drawn at their mean, with an error bar of a standard deviation to both
    sides. Axes are logarithmic where the values are positive and span a factor of 8. Rows with errors are left out.

    Raises
    ------
    SoftShadowError              an unknown column, one without numbers, or matplotlib is missing
    """
    try:
        from matplotlib.figure import Figure
    except ModuleNotFoundError:
        raise SoftShadowError("--plot needs matplotlib: pip install 'softshadow[sweep]'") from None
    target = Path(path)
    if target.suffix not in METADATA:
        raise SoftShadowError(f"{path}: expected a plot, one of {', '.join(METADATA)}")
    x, y, color = request.x, request.y, request.color
    names = table.column(x), table.column(y)
    lines = grouped(table, names[0], names[1], table.column(color) if color else None)
    figure = Figure(figsize=(7, 4.5), layout="constrained")
    panel: Any = figure.subplots()
    for number, (label, places) in enumerate(lines.items()):
        means = [float(np.mean(values)) for values in places.values()]
        spread = [float(np.std(values, ddof=1)) if len(values) > 1 else 0.0 for values in places.values()]
        panel.errorbar(
            list(places), means, yerr=spread if any(spread) else None, label=label or None, capsize=3, markersize=5,
            color=COLORS[number % len(COLORS)], marker=MARKERS[number % len(MARKERS)],
        )  # fmt: skip
    points = [(at, value) for places in lines.values() for at, values in places.items() for value in values]
    for axis, name, values in zip("xy", names, zip(*points, strict=True), strict=True):
        if min(values) > 0 and max(values) >= LOGARITHMIC * min(values):
            getattr(panel, f"set_{axis}scale")("log")
        getattr(panel, f"set_{axis}label")(name)
    panel.grid(alpha=0.4)
    if color:
        panel.legend(title=table.column(color))
    metadata = {METADATA[target.suffix]: MARK}
    return write_whole(target, lambda half: figure.savefig(half, metadata=metadata), force)


def grouped(table: SweepTable, x: str, y: str, color: str | None) -> dict[str, dict[float, list[float]]]:
    """Return for each colour, and each x in ascending order, all y of the rows that have both.

    Raises
    ------
    SoftShadowError              no row has numbers in both columns
    """
    lines: dict[str, dict[float, list[float]]] = defaultdict(lambda: defaultdict(list))
    for row in table.rows:
        at, value = row.get(x), row.get(y)
        if row["status"] == "ok" and isinstance(at, int | float) and isinstance(value, int | float):
            lines[str(row.get(color, "")) if color else ""][float(at)].append(float(value))
    if not lines:
        raise SoftShadowError(f"--plot x={x},y={y}: no row has numbers in both columns")
    return {label: dict(sorted(places.items())) for label, places in lines.items()}
