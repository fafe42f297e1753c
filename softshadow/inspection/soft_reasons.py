"""What the maps of a soft technique say about a pixel, in one sentence for each light."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from softshadow.scene import Scene


def soft_reasons(
    scene: Scene, maps: Mapping[str, np.ndarray], options: Mapping[str, object], x: int, y: int
) -> list[str]:
    """Return how many points of each light a pixel sees, or what blockers its search found; empty for other techniques.

    Parameters
    ----------
    maps, options                of the run; maps (H, W), row 0 on top
    x, y : int                   the pixel
    """
    sentences = []
    for light in scene.lights:
        suffix = f": {light.name}" if len(scene.lights) > 1 else ""
        if f"points seen{suffix}" in maps:
            n_points = number_of_points(scene, light.name, options)
            seen = round(float(maps[f"points seen{suffix}"][y, x]))
            sentences.append(f"{seen} of {n_points} points of {light.name} are seen.")
        if f"blocker distance{suffix}" in maps and maps[f"blockers{suffix}"][y, x] > 0:
            distance, width = maps[f"blocker distance{suffix}"][y, x], maps[f"penumbra width{suffix}"][y, x]
            sentences.append(
                f"The blockers are {distance:.3g} from {light.name} on the mean, so the penumbra is taken to be "
                f"{width:.3g} wide."
            )
    return sentences


def number_of_points(scene: Scene, name: str, options: Mapping[str, object]) -> int:
    """Return how many points stand for a light: 1 for a light without a shape."""
    light = next(light for light in scene.lights if light.name == name)
    return 1 if light.shape is None else int(str(options["samples"]))
