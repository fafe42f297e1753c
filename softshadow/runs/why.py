"""Why a pixel of a run is lit or in shadow: one sentence, and for soft shadows a second one with numbers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from softshadow.context import Frame
from softshadow.inspection import PixelHistory
from softshadow.inspection.causes import Cause
from softshadow.inspection.explanation import LIT, causes_of, explain
from softshadow.inspection.soft_reasons import soft_reasons
from softshadow.scene import Scene


def visibility_of_lights(scene: Scene, maps: Mapping[str, np.ndarray], x: int, y: int) -> dict[str, float]:
    """Return the visibility of each light at a pixel, by name, as far as the maps have it."""
    several = len(scene.lights) > 1
    names = {light.name: f"visibility of {light.name}" if several else "visibility" for light in scene.lights}
    return {light: float(maps[name][y, x]) for light, name in names.items() if name in maps}


def causes_at(frame: Frame, history: PixelHistory, scene: Scene, maps: Mapping[str, np.ndarray]) -> tuple[Cause, ...]:
    """Return why each hidden light does not reach what the pixel of a history shows, or only in part."""
    if "valid" not in maps or not maps["valid"][history.y, history.x]:
        return ()
    shares = visibility_of_lights(scene, maps, history.x, history.y)
    return causes_of(frame, history, scene, {name: share for name, share in shares.items() if share < LIT})


def explained(
    frame: Frame, history: PixelHistory, scene: Scene | None, maps: Mapping[str, np.ndarray], options: Mapping[str, Any]
) -> str:
    """Return the sentence for a pixel, with the numbers of points and blockers of soft techniques."""
    if scene is None:  # a recorded program
        return explain(history, None, False)
    x, y = history.x, history.y
    has_visibility = "visibility" in maps and "valid" in maps
    valid = has_visibility and bool(maps["valid"][y, x])
    visibility = float(maps["visibility"][y, x]) if has_visibility else None
    shares = visibility_of_lights(scene, maps, x, y)
    text = explain(history, visibility, valid, shares, causes_at(frame, history, scene, maps))
    if not valid or visibility is None or visibility >= 1:
        return text
    return " ".join([text, *soft_reasons(scene, maps, options, x, y)])
