"""Warn of counts that the stencil buffer cannot hold: rays from some of the pixels to the lights find them.

Counters that wrap read 0 where as many volumes overlap as they have values, and one bit, the parity, where two do. The
picture shows light there, and nothing in it says that it is wrong.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Any

import numpy as np

from softshadow.errors import CounterSaturated
from softshadow.inspection.hard_truth import hard_counts, seen_faces
from softshadow.scene import Scene

GRID = 96  # pixels on the longer side that rays are cast from
KEPT = 8  # scenes whose counts are kept
FEW = 16  # counters of so few values are always checked: one body that folds over itself can exceed them


def lost_counts(
    technique: str, scene: Scene, size: tuple[int, int], options: Mapping[str, Any], stencil_bits: int
) -> list[CounterSaturated]:
    """Return a warning for each light whose shadow volumes overlap so often that pixels in shadow look lit."""
    if technique != "volume-parity" and options.get("ops") != "wrap":
        return []
    values = 2 if technique == "volume-parity" else 1 << stencil_bits
    if values > FEW and most_overlaps(scene) < values:
        return []
    found = []
    for light, counts in zip(scene.lights, sampled_counts(scene, size), strict=True):
        lost = (counts > 0) & (counts % values == 0)
        if lost.any():
            share = float(lost.sum() / max(1, (counts > 0).sum()))
            counter = "the parity" if values == 2 else f"a counter of {values} values"
            found.append(
                CounterSaturated(
                    f"light {light.name!r}: up to {int(counts.max())} volumes overlap, and {counter} is 0 at "
                    f"{share:.0%} of the pixels in shadow, which look lit; "
                    + ("volume-zfail counts them" if values == 2 else "a shadow map has no such limit")
                )
            )
    return found


@lru_cache(maxsize=KEPT)
def sampled_counts(scene: Scene, size: tuple[int, int]) -> list[np.ndarray]:
    """Return for each light the counts (N,) at some of the pixels; scenes do not change, and are often drawn again."""
    shrunk = -(-max(size) // GRID)
    objects, triangles, points = seen_faces(scene, (max(1, size[0] // shrunk), max(1, size[1] // shrunk)))
    return [hard_counts(scene, light, objects, triangles, points) for light in scene.lights]


@lru_cache(maxsize=KEPT)
def most_overlaps(scene: Scene) -> int:
    """Return how many volumes can overlap if no closed body folds over itself: bodies, and faces of open ones."""
    total = 0
    for caster in scene.casters:
        topology = caster.mesh.topology
        closed = topology.closed_faces
        total += len(np.unique(topology.face_bodies[closed])) + int((~closed).sum())
    return total
