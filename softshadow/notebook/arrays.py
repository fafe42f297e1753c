"""Colour buffers, and the named maps of a technique: shadow maps, visibilities, counts, masks."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from softshadow.inspection import Step
from softshadow.inspection.pictures import UNDEFINED, colors_of, is_visibility, map_picture
from softshadow.inspection.words import DEPTH_MAP, colors_in_words, map_in_words, visibility_in_words
from softshadow.notebook.buffers import show_counts, show_range
from softshadow.notebook.cells import Region, add_colorbar, cells, draw_cells, heading_of, new_axes, step_of
from softshadow.notebook.descriptions import describe_axes
from softshadow.notebook.extra import needed
from softshadow.runs import Run

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def show_image(
    source: Run | Step | np.ndarray,
    *,
    region: Region | None = None,
    title: str | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Show colours.

    Parameters
    ----------
    source : Run, Step or (H, W, 3) uint8    of a run, the last step
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
    image = np.asarray(source) if step is None else step.image
    part = cells(image, title or heading_of("Colour", source), region)
    axes = new_axes(ax, "show_image", image.shape[0] / image.shape[1])
    draw_cells(axes, part, part.values, lambda color: "#" + "".join(f"{channel:02x}" for channel in color))
    words = colors_in_words(part.values)
    if step is not None and region is None and "visibility" in step.maps:
        words += f"; {visibility_in_words(step.maps['visibility'], step.maps.get('valid'))}"
    describe_axes(axes, words)
    return axes


def show_map(
    source: Run | Step | np.ndarray,
    name: str | None = None,
    *,
    region: Region | None = None,
    clear: float | None = None,
    legend: bool = True,
    title: str | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Show a map: depths and other numbers as greys, counts in the palette, masks black and white.

    Parameters
    ----------
    source : Run, Step or array  (H, W) or (H, W, 3)
    name : str                   of the map; by default the first that a texture or a step holds, such as "ZS"
    region : (x, y, width, height)   the part to show, in texels; all by default
    clear : float                the value of texels that nothing was drawn to, left out of the range; by default 1 for
                                 maps whose names begin with ZS
    legend : bool                with a legend or a colour bar
    ax : Axes                    matplotlib axes to draw in; new ones by default

    Returns
    -------
    Axes

    Raises
    ------
    KeyError                     there is no map of this name; the message has the nearest one
    ValueError                   there is no map to show, or the region is not inside it
    ImportError                  matplotlib is not installed
    """
    values, name, valid = _map(source, name)
    height, width = values.shape[:2]
    part = cells(values, title or f"Map {name}, {width} x {height}".replace("  ", " "), region)
    axes = new_axes(ax, "show_map", height / width)
    if values.ndim == 3:
        picture = cells(map_picture(values), "", region).values
        draw_cells(axes, part, picture, lambda texel: ", ".join(f"{value:.6g}" for value in texel))
        describe_axes(axes, map_in_words(name, part.values))
        return axes
    if values.dtype == np.uint8:
        return show_counts(part, axes, legend)
    if values.dtype == np.bool_:
        draw_cells(axes, part, colors_of(map_picture(part.values)), str)
        axes.set_title(f"{part.heading}: {np.count_nonzero(part.values)} of {part.values.size} true (white)")
        describe_axes(axes, map_in_words(name, part.values))
        return axes
    if is_visibility(name):
        undefined = np.zeros_like(part.values, bool) if valid is None else ~cells(valid, "", region).values
        shown = np.ma.masked_array(part.values, undefined)
        greys = needed("matplotlib", "show_map").colormaps["gray"]
        greys = greys.with_extremes(bad=[channel / 255 for channel in UNDEFINED])
        image = draw_cells(axes, part, shown, lambda value: f"{float(value):.4f}", cmap=greys, vmin=0, vmax=1)
        describe_axes(axes, visibility_in_words(part.values, ~undefined))
        if legend:
            label = "share of the light" + (", blue: not defined" if undefined.any() else "")
            add_colorbar(axes, image, label)
        return axes
    is_depth = name.startswith(DEPTH_MAP)
    return show_range(part, axes, 1.0 if clear is None and is_depth else clear, "depth" if is_depth else name, legend)


def _map(source: Run | Step | np.ndarray, name: str | None) -> tuple[np.ndarray, str, np.ndarray | None]:
    """Return a map, its name, and the map of where a visibility is defined."""
    if not isinstance(source, Run | Step):
        return np.asarray(source), name or "", None
    if name is None:
        name = next(iter(source.maps.stored or source.maps), None)
    if name is None:
        raise ValueError(f"{source!r} has no map; show_stencil, show_depth and show_image show its buffers")
    return source.maps[name], name, source.maps.get("valid")
