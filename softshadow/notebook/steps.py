"""The steps of a run as a grid: one row for each, with the window's buffers and the maps."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from softshadow.inspection import Step
from softshadow.notebook.arrays import show_image, show_map
from softshadow.notebook.buffers import show_depth, show_stencil
from softshadow.notebook.cells import Region, run_name
from softshadow.notebook.extra import needed
from softshadow.runs import Run

if TYPE_CHECKING:
    from collections.abc import Callable

COLUMN = 3.2  # inches
BUFFERS = ("colour", "depth", "stencil")


def show_steps(
    run: Run,
    steps: Sequence[int | str] | None = None,
    *,
    buffers: Sequence[str] = BUFFERS,
    maps: bool = True,
    region: Region | None = None,
    ax: Any = None,
) -> np.ndarray:
    """Show steps of a run, a row for each: colour, depth and stencil after it, and the maps that it stored.

    The buffers are left out of a step that drew into textures only.

    Parameters
    ----------
    run : Run
    steps : list                 numbers or titles; all by default
    buffers : list               some of "colour", "depth", "stencil"
    maps : bool                  whether to show maps beside the buffers
    region : (x, y, width, height)   the part of the window to show, in pixels; maps of other sizes are shown whole
    ax : array of Axes           a row for each step, at least as many columns as pictures; new ones by default

    Returns
    -------
    (steps, columns) array of Axes

    Raises
    ------
    ValueError                   an unknown buffer, or axes of too few rows or columns
    ImportError                  matplotlib is not installed
    """
    if unknown := [name for name in buffers if name not in BUFFERS]:
        raise ValueError(f"buffers={unknown}: expected some of {', '.join(BUFFERS)}")
    chosen = list(run) if steps is None else [run[key] for key in steps]
    rows = [_pictures(step, buffers, maps, region) for step in chosen]
    columns = max(len(row) for row in rows)
    if ax is None:
        width, height = run.size if region is None else region[2:]
        size = (COLUMN * columns, len(rows) * (COLUMN * height / width + 0.5))
        pyplot = needed("matplotlib.pyplot", "show_steps")
        figure, ax = pyplot.subplots(len(rows), columns, figsize=size, squeeze=False, layout="constrained")
        figure.suptitle(run_name(run))
    axes = np.atleast_2d(np.asarray(ax, dtype=object))
    if axes.shape[0] < len(rows) or axes.shape[1] < columns:
        raise ValueError(f"ax: expected axes of {len(rows)} rows and {columns} columns, got {axes.shape}")
    for step, row, places in zip(chosen, rows, axes, strict=False):
        for (name, show), place in zip(row.items(), places, strict=False):
            show(ax=place, title=name)
            place.set(xlabel="", ylabel="")
            place.label_outer()
        places[0].set_title(f"{step.index}  {step.title}\n{next(iter(row))}", loc="left", fontsize="medium")
        places[0].set_title("")
        for place in places[len(row) :]:
            place.set_axis_off()
    return axes


def _pictures(
    step: Step, buffers: Sequence[str], maps: bool, region: Region | None
) -> dict[str, Callable[..., object]]:
    """Return what draws each picture of a step, by name."""
    shows: dict[str, Callable[..., object]] = {
        "colour": partial(show_image, step, region=region),
        "depth": partial(show_depth, step, region=region, colorbar=False),
        "stencil": partial(show_stencil, step, region=region, legend=False),
    }
    stored = step.maps.stored if maps else {}
    draws_elsewhere = bool(stored) and all(draw.framebuffer for draw in step.draws)
    pictures = {} if draws_elsewhere else {name: shows[name] for name in buffers}
    for name, values in stored.items():
        of_window = values.shape[:2] == step.stencil.shape
        pictures[name] = partial(show_map, step, name, region=region if of_window else None, legend=False)
    return pictures
