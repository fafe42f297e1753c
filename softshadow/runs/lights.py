"""The visibility of the lights of a run, and its other maps."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from softshadow.errors import StateError
from softshadow.inspection.maps import summary
from softshadow.space.shadow_parts import DrawnRun, scene_of


@dataclass(frozen=True, eq=False)
class RunLight:
    """The name of a light, and its visibility (H, W) float32, row 0 on top."""

    name: str
    visibility: np.ndarray

    def __repr__(self) -> str:
        return f"RunLight({self.name!r}, visibility {summary(self.visibility)})"


def lights_of(run: DrawnRun) -> tuple[RunLight, ...]:
    """Return the visibility of each light of a run, in the order of the scene."""
    lights = scene_of(run).lights
    several = len(lights) > 1
    return tuple(
        RunLight(light.name, map_of(run, f"visibility of {light.name}" if several else "visibility"))
        for light in lights
    )


def map_of(run: DrawnRun, name: str) -> np.ndarray:
    """Return a map of a run.

    Raises
    ------
    StateError                   the technique has no such map, or the run draws no scene
    """
    maps = run.steps.maps
    if name not in maps:
        scene_of(run)  # a run without one has no maps at all
        raise StateError(f"technique {run.technique!r} has no map {name!r} (it has: {', '.join(maps)})")
    return maps[name]
