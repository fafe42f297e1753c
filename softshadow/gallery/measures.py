"""Measures of failures: each takes a run and returns its wrong pixels, (H, W) bool, row 0 on top.

Shadow edges are left out: within a pixel of them, ray casting and rasterization may differ.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from softshadow.gallery.expected import expected
from softshadow.runs import Run
from softshadow.techniques.planar import DARKNESS

COUNTED = "pixels whose colour is not that of the lights they see"  # `wrong_colors` and its variants, in words
NEARLY = 8  # levels of 255: two roundings in each channel, and highlights that are clamped
SHARE = "pixels whose visibility is off by more than 0.1"  # `wrong_share`, in words
OFF = 0.1
Measure = Callable[[Run], np.ndarray]
ROUNDING = 2  # levels of 255: a sum of lights is rounded once, or once for each light and for the ambient light


def wrong_colors(run: Run) -> np.ndarray:
    """Return where the colour is not that of the lights that are visible by ray casting."""
    truth = expected(run.scene, run.size)
    return differ(run.image, truth.image) & differ(run.image, truth.added) & truth.sure


def wrong_share(run: Run) -> np.ndarray:
    """Return where the visibility is not the share of the light that is visible, off outlines."""
    comparison = run.compare(truth="soft")
    return (np.abs(comparison.error) > OFF) & ~comparison.band


def wrong_on_receivers(run: Run) -> np.ndarray:
    """Return `wrong_colors` on receivers: planar shadows fall nowhere else."""
    return wrong_colors(run) & expected(run.scene, run.size).receiver


def wrong_inside_faces(run: Run) -> np.ndarray:
    """Return `wrong_colors` off creases: there a texel of the map may see another face than the pixel."""
    return wrong_colors(run) & expected(run.scene, run.size).inside_faces


def wrong_flat_colors(run: Run) -> np.ndarray:
    """Return where the colour is neither the surface's own in light nor its ambient share in shadow, off creases."""
    return wrong_flat_colors_anywhere(run) & expected(run.scene, run.size, flat=True).inside_faces


def wrong_flat_light(run: Run) -> np.ndarray:
    """Return where a lit surface is darker than its own colour, or a shadowed one is not, off creases."""
    return wrong_flat_light_anywhere(run) & expected(run.scene, run.size, flat=True).inside_faces


def wrong_flat_light_anywhere(run: Run) -> np.ndarray:
    """Return where a lit surface is darker than its own colour, or a shadowed one is not."""
    truth = expected(run.scene, run.size, flat=True)
    return (differ(run.image, truth.lit) != truth.shadow) & truth.sure


def wrong_flat_colors_anywhere(run: Run) -> np.ndarray:
    """Return where the colour is neither the surface's own in light nor its ambient share in shadow."""
    truth = expected(run.scene, run.size, flat=True)
    return differ(run.image, truth.image) & truth.sure


def wrong_paint(run: Run) -> np.ndarray:
    """Return where shadow is painted and no receiver is in shadow, or the reverse."""
    truth = expected(run.scene, run.size)
    painted = differ(run.image, truth.lit)
    return (painted != (truth.shadow & truth.receiver)) & truth.on_receivers


def darkened_twice(run: Run) -> np.ndarray:
    """Return where a shadow on a receiver is darker than one layer of shadow."""
    truth = expected(run.scene, run.size)
    one_layer = truth.lit * (1 - DARKNESS)
    darker = (run.image < one_layer - ROUNDING).any(axis=-1)
    return darker & truth.receiver & truth.on_receivers


# measures that leave pixels out, and the same without leaving them out
STRICTER: dict[Measure, Measure] = {
    wrong_on_receivers: wrong_colors,
    wrong_inside_faces: wrong_colors,
    wrong_flat_colors: wrong_flat_colors_anywhere,
    wrong_flat_light: wrong_flat_light_anywhere,
    darkened_twice: wrong_paint,
}


def share_of_light(run: Run, x: int, y: int, flat: bool) -> float:
    """Return how much of the light a pixel shows, 0 to 1: its colour's place between those without and with light."""
    truth = expected(run.scene, run.size, flat)
    light = (truth.lit - truth.dark)[y, x].astype(float)
    shown = (run.image - truth.dark)[y, x].astype(float)
    if not light.any():
        return 1.0
    share = float(np.clip(shown @ light / (light @ light), 0, 1))
    return round(share, 1) if abs(share - round(share)) * np.linalg.norm(light) <= NEARLY else share


def differ(image: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Return where two pictures (H, W, 3) differ by more than rounding, (H, W) bool."""
    return (np.abs(image.astype(np.int16) - other) > ROUNDING).any(axis=-1)


def deepest(mask: np.ndarray) -> tuple[int, int]:
    """Return x, y of the pixel that is farthest from the edge of a mask (H, W) bool; of several, the first.

    Examples
    --------
    >>> mask = np.zeros((6, 8), bool)
    >>> mask[1:4, 2:7] = True
    >>> deepest(mask)
    (3, 2)
    """
    remaining = mask
    while True:
        framed = np.pad(remaining, 1)
        shifts = [framed[y : y + mask.shape[0], x : x + mask.shape[1]] for y in range(3) for x in range(3)]
        inner = np.logical_and.reduce(shifts)
        if not inner.any():
            y, x = np.unravel_index(np.argmax(remaining), remaining.shape)
            return int(x), int(y)
        remaining = inner
