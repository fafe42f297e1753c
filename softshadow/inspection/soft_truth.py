"""Soft shadows by looking from the visible points at the lights: the reference for all techniques with penumbra."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from softshadow.inspection.hard_truth import own_faces, seen_faces
from softshadow.pipeline.memory.threads import share
from softshadow.scene import Scene
from softshadow.truth import LightVisibility, light_classes, light_visibility
from softshadow.truth.light_visibility import Method


@dataclass(frozen=True, eq=False, repr=False)
class SoftTruth:
    """How much of each light is visible at the pixel centres; read-only arrays (H, W), row 0 on top.

    Attributes
    ----------
    scene : Scene
    valid : (H, W) bool              where a surface is seen between the near and the far plane
    visibilities : tuple of (H, W) float64       for each light, 0 to 1; 1 where no surface is seen
    standard_errors : tuple of (H, W) float64    of the visibilities; 0 where they are exact
    methods : tuple of str           for each light: "exact", "rays", "exact and rays" or "embree"
    samples : int                    per pixel, where rays decided
    """

    scene: Scene
    valid: np.ndarray
    visibilities: tuple[np.ndarray, ...]
    standard_errors: tuple[np.ndarray, ...]
    methods: tuple[str, ...]
    samples: int

    @property
    def size(self) -> tuple[int, int]:
        """(width, height)."""
        height, width = self.valid.shape
        return width, height

    @property
    def visibility(self) -> np.ndarray:
        """(H, W) float64: the mean over the lights."""
        mean: np.ndarray = np.mean(self.visibilities, axis=0)
        return mean

    @property
    def classes(self) -> np.ndarray:
        """(H, W) uint8: 0 umbra, where no light is visible; 2 lit, where all are in full; 1 penumbra, in between."""
        return light_classes(self.visibility)

    def __repr__(self) -> str:
        width, height = self.size
        return f"SoftTruth(scene {self.scene.name!r}, {width} x {height}, {', '.join(self.methods)})"

    def __str__(self) -> str:
        answers = sorted(set(self.methods))
        rays = f", {self.samples} rays per pixel" if answers != ["exact"] else ""
        return f"soft shadows ({', '.join(answers)}{rays})"


def soft_truth(
    scene: Scene, size: tuple[int, int], *, samples: int = 256, method: Method = "auto", seed: int = 0
) -> SoftTruth:
    """Return the visibility of every light at every pixel centre of an image of (width, height) pixels.

    A light without a shape is visible or not. Outside the cone of a spot light, its visibility is 0.

    Parameters
    ----------
    samples, method, seed            as for `truth.light_visibility`
    """
    width, height = size
    objects, triangles, points = seen_faces(scene, size)
    seen = objects >= 0
    exclude = own_faces(scene, objects[seen], triangles[seen])
    results: list[LightVisibility] = [
        light_visibility(
            points[seen], light, scene.casters, exclude=exclude, viewer=scene.camera.eye, samples=samples,
            method=method, seed=seed, share=share,
        )
        for light in scene.lights
    ]  # fmt: skip

    def image(values: np.ndarray, elsewhere: float) -> np.ndarray:
        pixels = np.full(len(seen), elsewhere, np.float64)
        pixels[seen] = values
        pixels.setflags(write=False)
        return pixels.reshape(height, width)

    valid = seen.reshape(height, width)
    valid.setflags(write=False)
    return SoftTruth(
        scene,
        valid,
        tuple(image(each.visible, 1) for each in results),
        tuple(image(each.standard_error, 0) for each in results),
        tuple(each.method for each in results),
        samples,
    )
