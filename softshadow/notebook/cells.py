"""Arrays on matplotlib axes: one cell per pixel at the position that `Run.pixel` takes, row 0 on top."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from textwrap import fill
from typing import TYPE_CHECKING, Any

import numpy as np

from softshadow.inspection import Step
from softshadow.notebook.extra import needed
from softshadow.runs import Run

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Region = tuple[int, int, int, int]  # x and y of the first pixel, width, height
WIDTH = 6.0  # inches of a picture
TITLE_LETTERS = 60  # in a line
MOST_DIGITS = (32, 24)  # cells across and down, up to which there is room to write the values
DARK = 140  # luminance below which digits are white


@dataclass(frozen=True)
class Cells:
    """A part of an array, and the pixel that it begins with."""

    values: np.ndarray
    left: int
    top: int
    heading: str

    @property
    def extent(self) -> tuple[float, float, float, float]:
        """Left, right, bottom and top end of the cells; centres of pixels are whole numbers."""
        height, width = self.values.shape[:2]
        return self.left - 0.5, self.left + width - 0.5, self.top + height - 0.5, self.top - 0.5

    @property
    def fits_digits(self) -> bool:
        """Whether there is room for a number in every cell."""
        height, width = self.values.shape[:2]
        return width <= MOST_DIGITS[0] and height <= MOST_DIGITS[1]


def cells(values: np.ndarray, heading: str, region: Region | None) -> Cells:
    """Return the part of an array (H, W, ...) that a region names, or all of it.

    Raises
    ------
    ValueError                   the region is not inside the picture, or has no pixel
    """
    height, width = values.shape[:2]
    if region is None:
        return Cells(values, 0, 0, heading)
    left, top, across, down = (int(number) for number in region)
    if not (0 <= left < left + across <= width and 0 <= top < top + down <= height):
        raise ValueError(
            f"region={region!r}: expected (x, y, width, height) inside the picture of {width} x {height} pixels"
        )
    part = values[top : top + down, left : left + across]
    return Cells(part, left, top, f"{heading}, x {left} to {left + across - 1}, y {top} to {top + down - 1}")


def step_of(source: Run | Step | np.ndarray) -> Step | None:
    """Return the step whose buffers to show: the last one of a run; None for an array."""
    return source[-1] if isinstance(source, Run) else source if isinstance(source, Step) else None


def heading_of(what: str, source: Any) -> str:
    """Return the heading of a picture: what it shows, and after which step."""
    step = step_of(source)
    if step is None:
        return what
    run = f"{run_name(source)}, " if isinstance(source, Run) else ""
    return f"{what}: {run}after step {step.index}, {step.title}"


def run_name(run: Run) -> str:
    """Return what a run is called in headings."""
    return f"{run.technique} on {run.scene.name}" if run.scene is not None else run.technique


def new_axes(ax: Axes | None, by: str, height_by_width: float = 0.75) -> Axes:
    """Return the axes to draw in: those of the caller, or new ones."""
    if ax is not None:
        return ax
    pyplot = needed("matplotlib.pyplot", by)
    return pyplot.subplots(figsize=(WIDTH, 0.6 + WIDTH * height_by_width), layout="constrained")[1]


def draw_cells(ax: Axes, part: Cells, picture: np.ndarray, text: Callable[[Any], str], **how: Any) -> Any:
    """Draw cells in colours, write in small crops the values, and tell the value at the pointer; return the image."""
    image = ax.imshow(picture, extent=part.extent, interpolation="nearest", **how)
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_locator(needed("matplotlib.ticker", "show_stencil").MaxNLocator(integer=True))
    ax.set(xlabel="x", ylabel="y")
    ax.set_title(fill(part.heading, TITLE_LETTERS), fontsize="medium")
    height, width = part.values.shape[:2]

    def at_pointer(x: float, y: float) -> str:
        column, row = round(x) - part.left, round(y) - part.top
        inside = 0 <= column < width and 0 <= row < height
        return f"x={round(x)} y={round(y)}: {text(part.values[row, column])}" if inside else ""

    ax.format_coord = at_pointer  # type: ignore[method-assign]
    return image


def add_colorbar(ax: Axes, image: Any, label: str) -> None:
    """Add a bar of the colours beside a picture, as high as the picture."""
    ax.get_figure().colorbar(image, cax=ax.inset_axes((1.03, 0, 0.04, 1)), label=label)  # type: ignore[union-attr]


def write_digits(ax: Axes, part: Cells, picture: np.ndarray) -> None:
    """Write the value of every cell in black or white, as large as the cells allow."""
    height, width = part.values.shape
    points = 72 * ax.get_figure().get_size_inches()[0] * ax.get_position().width / width  # type: ignore[union-attr]
    size = points / (0.62 * len(str(part.values.max())) + 0.8)
    luminance = picture[..., :3] @ np.array([0.299, 0.587, 0.114])
    for row in range(height):
        for column in range(width):
            ax.text(
                part.left + column, part.top + row, str(int(part.values[row, column])), ha="center", va="center",
                fontsize=min(12.0, size), color="white" if luminance[row, column] < DARK else "black",
            )  # fmt: skip
