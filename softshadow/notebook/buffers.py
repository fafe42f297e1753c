"""Stencil and depth buffers: counts in the palette of the reports, and depths over the range that was drawn."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from softshadow.inspection import Step
from softshadow.inspection.pictures import CLEAR_DEPTH, WRAPPED, colors_of, stencil_palette
from softshadow.inspection.words import counts_in_words, depths_in_words
from softshadow.notebook.cells import (
    Cells,
    Region,
    add_colorbar,
    cells,
    draw_cells,
    heading_of,
    new_axes,
    step_of,
    write_digits,
)
from softshadow.notebook.descriptions import describe_axes
from softshadow.notebook.extra import needed
from softshadow.runs import Run

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LEGEND_ROWS = 9


def show_stencil(
    source: Run | Step | np.ndarray,
    *,
    region: Region | None = None,
    legend: bool = True,
    title: str | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Show stencil counts in colours that colour-blind people can tell apart, and in small crops as digits.

    255 and 254, which stand for -1 and -2 in a counter that wraps, have a hue of their own. The legend has the number
    of pixels of each count.

    Parameters
    ----------
    source : Run, Step or (H, W) uint8   of a run, the last step
    region : (x, y, width, height)   the part to show, in pixels; all by default
    ax : Axes                    matplotlib axes to draw in; new ones by default

    Returns
    -------
    Axes

    Raises
    ------
    ValueError                   the region is not inside the picture
    ImportError                  matplotlib is not installed
    """
    step = step_of(source)
    counts = np.asarray(source) if step is None else step.stencil
    part = cells(counts, title or heading_of("Stencil", source), region)
    return show_counts(part, new_axes(ax, "show_stencil", counts.shape[0] / counts.shape[1]), legend)


def show_counts(part: Cells, ax: Axes, legend: bool) -> Axes:
    """Draw counts (H, W) uint8 in the palette, with digits where there is room, and a legend."""
    picture = colors_of(part.values)
    draw_cells(ax, part, picture, lambda count: str(int(count)))
    describe_axes(ax, counts_in_words(part.values))
    if part.fits_digits:
        write_digits(ax, part, picture)
    if legend:
        patches, palette = needed("matplotlib.patches", "show_stencil"), stencil_palette() / 255
        counts, pixels = np.unique(part.values, return_counts=True)
        rows = [(palette[c], f"{spelled(int(c))}: {p}") for c, p in zip(counts, pixels, strict=True)]
        if len(rows) > LEGEND_ROWS:
            rows = [*rows[: LEGEND_ROWS - 1], ((1, 1, 1), f"other: {pixels[LEGEND_ROWS - 1 :].sum()}")]
        handles = [patches.Patch(facecolor=color, edgecolor="gray", label=label) for color, label in rows]
        ax.legend(handles=handles, title="count: pixels", loc="upper left", bbox_to_anchor=(1.01, 1), frameon=False)
    return ax


def spelled(count: int) -> str:
    """Return a count, and what it stands for in a counter that wraps.

    Examples
    --------
    >>> spelled(2), spelled(255)
    ('2', '255 (−1)')
    """
    return f"{count} (−{256 - count})" if count >= 256 - len(WRAPPED) else str(count)


def show_depth(
    source: Run | Step | np.ndarray,
    *,
    region: Region | None = None,
    clear: float | None = 1.0,
    colorbar: bool = True,
    title: str | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Show depths from near (light) to far (dark) over the range of those that were drawn.

    Parameters
    ----------
    source : Run, Step or (H, W) float   of a run, the last step
    region : (x, y, width, height)   the part to show, in pixels; all by default
    clear : float                the value of cells that nothing was drawn to: blue, and left out of the range; None if
                                 there is none
    ax : Axes                    matplotlib axes to draw in; new ones by default

    Returns
    -------
    Axes

    Raises
    ------
    ValueError                   the region is not inside the picture
    ImportError                  matplotlib is not installed
    """
    step = step_of(source)
    depth = np.asarray(source) if step is None else step.depth
    part = cells(depth, title or heading_of("Depth", source), region)
    axes = new_axes(ax, "show_depth", depth.shape[0] / depth.shape[1])
    return show_range(part, axes, clear, "window z" if step is not None else "depth", colorbar)


def show_range(part: Cells, ax: Axes, clear: float | None, unit: str, colorbar: bool, **how: Any) -> Axes:
    """Draw numbers (H, W) as greys from small (light) to large (dark); `clear` and what is not finite is blue."""
    colormaps = needed("matplotlib", "show_depth").colormaps
    left_out = ~np.isfinite(part.values) | (False if clear is None else part.values == clear)
    shown = np.ma.masked_array(part.values, left_out)
    greys = colormaps["gray_r"].with_extremes(bad=[channel / 255 for channel in CLEAR_DEPTH])
    image = draw_cells(ax, part, shown, lambda value: f"{float(value):.6f}", cmap=greys, **how)
    describe_axes(ax, f"{unit} {depths_in_words(part.values, clear)}")
    if left_out.all():
        ax.set_title(f"{part.heading} (nothing drawn)")
    elif colorbar:
        note = f", {clear:g} (blue) left out" if left_out.any() and clear is not None else ""
        add_colorbar(ax, image, unit + note)
    return ax
