"""What each penumbra wedge of a light contributes at a pixel of a run of "volume-wedges"."""

from __future__ import annotations

import numpy as np

from softshadow.errors import StateError
from softshadow.inspection import WedgeContributions, wedge_contributions
from softshadow.runs.lights import map_of
from softshadow.space.shadow_parts import DrawnRun, scene_of


def contributions(run: DrawnRun, x: int, y: int, light: int) -> WedgeContributions:
    """Return the contributions for the point and the hard count that the run has stored; see `Run.contributions`."""
    scene, valid = scene_of(run), map_of(run, "valid")
    height, width = valid.shape
    if not (0 <= x < width and 0 <= y < height):
        raise ValueError(f"contributions({x}, {y}): outside the picture of {width} x {height} pixels")
    if not 0 <= light < len(scene.lights):
        raise ValueError(f"light={light}: expected 0 to {len(scene.lights) - 1}")
    source = scene.lights[light]
    of_light = "" if len(scene.lights) == 1 else f": {source.name}"
    positions, counts = map_of(run, f"positions{of_light}"), map_of(run, f"count{of_light}")
    if not valid[y, x]:
        raise StateError(f"contributions({x}, {y}): expected a pixel that shows a surface")
    point = positions[y, x].astype(np.float64) + source.position[:3] * source.position[3]
    return wedge_contributions(scene, source, point, float(counts[y, x]))
