"""Which texture a named map of a run was read from, so that the history of its texels can be told."""

from __future__ import annotations

import numpy as np

from softshadow.errors import StateError, nearest
from softshadow.image import Image
from softshadow.inspection import Step, Steps
from softshadow.inspection.timeline import timeline_of
from softshadow.pixels import depth_as_float

RED, ALPHA = 0, 3


def image_of_map(steps: Steps, name: str) -> tuple[Image, int]:
    """Return what stands for the image of a map in the frame's timeline, and the number of commands until its step.

    The image is found by its texels: a map holds those of its texture unchanged. Of several equal ones it is the one at
    the same place among the maps of the step.

    Raises
    ------
    StateError                   no step has a map of this name, or the map was not read from a texture
    """
    step = next((each for each in reversed(list(steps)) if name in each.maps), None)
    if step is None:
        raise StateError(f"map {name!r}: {nearest(name, list(steps.maps))}")
    places = equal_images(step, step.maps[name])
    if not places:
        textures = [other for other, values in step.maps.items() if equal_images(step, values)]
        raise StateError(
            f"map {name!r} does not have the texels of a texture; expected one of {', '.join(textures) or 'none'}"
        )
    twins = [other for other, values in step.maps.items() if np.array_equal(values, step.maps[name])]
    place = places[min(twins.index(name), len(places) - 1)]
    return timeline_of(step.frame).images[step.index][place], step.frame.steps[step.index][1]


def equal_images(step: Step, values: np.ndarray) -> list[tuple[int, int, int]]:
    """Return the images of textures, by (texture, face, level), whose texels at the end of a step equal a map."""
    textures = step.replay.storage_after(step.frame.steps[step.index][1]).textures
    return [
        (name, *place)
        for name, texture in sorted(textures.items())
        for place, image in sorted(texture.images.items())
        if any(np.array_equal(texels, values) for texels in texels_like(image, values))
    ]


def texels_like(image: Image, values: np.ndarray) -> list[np.ndarray]:
    """Return the texels of an image, row 0 on top, in each form that a map may have; none if the sizes differ.

    A map without channels is the depth, or else alpha or red.
    """
    if values.shape[:2] != (image.height, image.width):
        return []
    cells = image.read_cells[::-1, : image.width]
    if image.format.kind == "depth":
        return [depth_as_float(np.ascontiguousarray(cells), image.format)]
    forms = [cells[..., : values.shape[2]]] if values.ndim > 2 else [cells[..., ALPHA], cells[..., RED]]
    return forms if image.format.kind == "float" else [each.astype(np.float32) / np.float32(255) for each in forms]
