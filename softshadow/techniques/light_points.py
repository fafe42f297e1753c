"""What techniques share that draw a hard shadow for each of several points of an area light.

Each point is a point light with the light's full colour. A surface sees as much of the light as the share of points
that it sees: with n points, one of the values 0, 1/n ... 1.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import Annotated, Any

import numpy as np

from softshadow.scene import Light, Scene, sample_lights
from softshadow.scene.light_samples import Pattern
from softshadow.techniques import drawing
from softshadow.techniques.technique import Range
from softshadow.techniques.visibility_buffer import add_light_times, upload_visibility

Samples = Annotated[int, "points of each light, which have a hard shadow each", Range(1, 4096)]
LightPattern = Annotated[Pattern, "how the points lie in the light"]
Seed = Annotated[int, "of the patterns jittered, sobol and random", Range(0, 2**32 - 1)]


def points_of(light: Light, samples: int, pattern: Pattern, seed: int) -> list[Light]:
    """Return the points of a light as point lights of its name; a light without a shape has one, itself."""
    return [replace(point, name=light.name) for point in sample_lights(light, samples, pattern, seed)]


def lit_from_points(
    scene: Scene, light: Light, samples: int, pattern: Pattern, seed: int
) -> Iterator[tuple[Scene, Light, str]]:
    """Yield for each point of a light the scene with it in place of the light, the point, and words for titles."""
    points = points_of(light, samples, pattern, seed)
    for number, point in enumerate(points):
        words = words_for(number, number + 1, len(points))
        yield replace(scene, lights=tuple(point if other is light else other for other in scene.lights)), point, words


def words_for(first: int, end: int, n_points: int) -> str:
    """Return words for the title of a step with the points [first, end) of so many."""
    if n_points == 1:
        return "the light"
    return f"point {end} of {n_points}" if end - first == 1 else f"points {first + 1} to {end} of {n_points}"


def add_mean(
    gl: Any,
    scene: Scene,
    size: tuple[int, int],
    light: Light,
    seen: np.ndarray,
    n_points: int,
    far: str = "finite",
) -> np.ndarray:
    """Add a light times the share of its points that each pixel sees, and return the share (h, w) float32.

    Parameters
    ----------
    seen : (h, w) number         how many of its points each pixel sees, first row = bottom
    far : str                    as given to `drawing.set_camera`
    """
    share = (seen / n_points).astype(np.float32)
    add_share(gl, scene, size, light, share, far)
    return share


def add_share(
    gl: Any, scene: Scene, size: tuple[int, int], light: Light, share: np.ndarray, far: str = "finite"
) -> None:
    """Add a light times its share (h, w) float32 at each pixel, which is 0 outside the cone of a spot light."""
    texture = upload_visibility(gl, share)
    add_light_times(gl, scene, size, light, texture, far)
    gl.glDeleteTextures([texture])


def finish_title(scene: Scene, light: Light) -> str:
    """Return the title of the step that adds the mean."""
    return drawing.title("add the share of the light", scene, light)
