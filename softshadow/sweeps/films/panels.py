"""The panels of a frame: the buffers and maps of a run that a film shows, with a title each.

A panel keeps the values, not colours: greys of depths are chosen over the whole film, so that they do not flicker.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from softshadow.errors import nearest
from softshadow.inspection.buffer_files import buffer_names
from softshadow.inspection.pictures import colors_of, depth_picture, is_visibility, map_picture, visibility_picture
from softshadow.inspection.step import Step
from softshadow.runs import Run

CLEAR = 1.0  # depth of the far plane: where nothing was drawn
Limits = dict[str, tuple[float, float]]


@dataclass(frozen=True, eq=False)
class Panel:
    """One picture of a frame.

    `values` are colours (H, W, 3) uint8, counts (H, W) uint8, or depths (H, W) of floats, row 0 on top.
    """

    title: str
    buffer: str
    values: np.ndarray

    @property
    def has_depths(self) -> bool:
        """Whether the greys of the panel depend on the range of the film."""
        return self.values.ndim == 2 and self.values.dtype != np.uint8


def panels_of(run: Run, shown: Sequence[str], by_step: bool) -> list[Panel]:
    """Return the shown buffers of a run: of its end, or after every step that has them.

    Raises
    ------
    ValueError                   no such buffer or map; the message has the nearest name
    """
    known = buffer_names(run.steps)
    for name in shown:
        if name not in known:
            raise ValueError(f"show {name!r}: {nearest(name, known)}")
    if not by_step:
        return [Panel(name, name, _last_values(run, name)) for name in shown]
    return [
        Panel(f"{step.index} {step.title}" if len(shown) == 1 else f"{step.index} {name}: {step.title}", name, values)
        for step in run.steps
        for name in shown
        if (values := values_of(step, name)) is not None
    ]


def _last_values(run: Run, name: str) -> np.ndarray:
    every = (values_of(step, name) for step in reversed(tuple(run.steps)))
    return next(values for values in every if values is not None)


def values_of(step: Step, name: str) -> np.ndarray | None:
    """Return what a panel keeps of a buffer or map after a step; None if the step has no such map."""
    if name == "color":
        return step.image
    if name in ("depth", "stencil"):
        buffer: np.ndarray = getattr(step, name)
        return buffer
    if name not in step.maps:
        return None
    values = step.maps[name]
    if is_visibility(name):
        return visibility_picture(values, step.maps.get("valid"))
    return values if values.ndim == 2 and values.dtype != np.bool_ else map_picture(values)


def depth_limits(panels: Iterable[Panel]) -> Limits:
    """Return the smallest and largest depth of each buffer over all panels; depths of empty pixels do not count."""
    limits: Limits = {}
    for panel in panels:
        if not panel.has_depths:
            continue
        drawn = panel.values[(panel.values != CLEAR) & np.isfinite(panel.values)]
        if drawn.size:
            low, high = limits.get(panel.buffer, (np.inf, -np.inf))
            limits[panel.buffer] = min(low, float(drawn.min())), max(high, float(drawn.max()))
    return limits


def panel_picture(panel: Panel, limits: Limits) -> np.ndarray:
    """Return a panel as colours (H, W, 3) uint8."""
    if panel.has_depths:
        return depth_picture(panel.values, CLEAR, limits.get(panel.buffer))
    return colors_of(panel.values)
