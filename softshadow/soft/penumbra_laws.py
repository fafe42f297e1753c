"""The laws of the penumbra, measured: how wide it is while the light grows, the occluder moves and the light moves.

A square light of side s, a square slab of side o at the distance d_b under it and a floor at d_r, all parallel: the
penumbra is ``w = s (d_r - d_b) / d_b`` wide, and the umbra ``u = (o d_r - s (d_r - d_b)) / d_b``. On a line across the
middle of an edge, the visibility V rises linearly over w, and the integral of V (1 - V) is w / 6. So that is measured:
for a ramp in n steps, as sampled techniques draw it, it differs from that of the ramp by a part of 1 / n² only.
"""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from softshadow import techniques
from softshadow.errors import Warning as SoftShadowWarning
from softshadow.inspection.hard_truth import seen_faces
from softshadow.runs import run
from softshadow.scene import Camera, Light, Material, Rectangle, Scene, SceneObject, shapes
from softshadow.scene.placement import placement
from softshadow.soft.technique_errors import soft_candidates

THICKNESS = 0.01  # of the slab
FLOOR, SLAB = 20.0, 1.6  # sides
SIZE = (480, 64)  # a strip of the picture from above is enough
WIDTH_SEEN = 8.0  # of the floor, over the width of the picture
EYE_HEIGHT = 200.0  # far above, so that the slab hides hardly more than lies under it
TOLERANCE = 0.05  # of a width, besides two pixels: a technique that is off by more does not follow the law


@dataclass(frozen=True)
class Arrangement:
    """Side of the light, and the distances of slab and floor from it, in world units."""

    light: float = 0.5
    blocker: float = 2.0
    receiver: float = 4.0

    @property
    def penumbra(self) -> float:
        """The width of the penumbra, by the law."""
        return self.light * (self.receiver - self.blocker) / self.blocker

    @property
    def umbra(self) -> float:
        """The width of the umbra, by the law."""
        return (SLAB * self.receiver - self.light * (self.receiver - self.blocker)) / self.blocker

    def scene(self) -> Scene:
        """Return the scene, seen from far above."""
        fov = float(np.degrees(2 * np.arctan(WIDTH_SEEN * SIZE[1] / SIZE[0] / 2 / EYE_HEIGHT)))
        camera = Camera((0, EYE_HEIGHT, 0), (0, 0, 0), (0, 0, -1), fov, EYE_HEIGHT / 2, 2 * EYE_HEIGHT)
        lamp = Light((0, self.receiver, 0), shape=Rectangle((self.light, 0, 0), (0, 0, self.light)))
        grey = Material((0.8, 0.8, 0.8))
        height = self.receiver - self.blocker
        return Scene(
            "penumbra",
            camera,
            (lamp,),
            (
                SceneObject(shapes.floor(FLOOR), None, grey, casts=False, receives=True, name="floor"),
                SceneObject(shapes.box(SLAB, THICKNESS, SLAB), placement((0, height, 0)), grey, name="slab"),
            ),
        )


@dataclass(frozen=True)
class Law:
    """One change, and what it does to the penumbra."""

    name: str
    before: Arrangement
    after: Arrangement


LAWS = (
    Law("the light grows: penumbra in proportion", Arrangement(), Arrangement(light=1.0)),
    Law("the occluder moves to the receiver: penumbra narrower", Arrangement(), Arrangement(blocker=3.0)),
    Law("the light moves away: penumbra narrower", Arrangement(), Arrangement(blocker=4.0, receiver=6.0)),
    Law("the receiver moves away: penumbra wider", Arrangement(), Arrangement(receiver=5.0)),
)


@dataclass(frozen=True)
class LawResult:
    """A technique under a law: the widths of the penumbra before and after the change, and of the umbra after it."""

    technique: str
    law: Law
    before: float
    after: float
    umbra: float

    @property
    def direction_holds(self) -> bool:
        """Whether the penumbra changes in the right direction, by more than two pixels."""
        change, expected = self.after - self.before, self.law.after.penumbra - self.law.before.penumbra
        return change * expected > 0 and abs(change) > 2 * WIDTH_SEEN / SIZE[0]

    @property
    def holds(self) -> bool:
        """Whether both widths are right, to `TOLERANCE` and two pixels."""
        pairs = ((self.before, self.law.before.penumbra), (self.after, self.law.after.penumbra))
        return all(abs(got - law) <= TOLERANCE * law + 2 * WIDTH_SEEN / SIZE[0] for got, law in pairs)


def law_table(
    names: Sequence[str] | None = None, options: Mapping[str, Mapping[str, Any]] | None = None
) -> list[LawResult]:
    """Return what each technique does under each law.

    Parameters
    ----------
    names : sequence of str      techniques; all that draw soft edges by default
    options : dict               by technique; 64 samples by default where there are samples
    """
    results = []
    for name in soft_candidates() if names is None else names:
        own = dict((options or {}).get(name, {"samples": 64} if "samples" in techniques.get(name).options else {}))
        widths = {}
        for law in LAWS:
            for arrangement in (law.before, law.after):
                if arrangement not in widths:
                    widths[arrangement] = measured_widths(name, arrangement, **own)
            before, _ = widths[law.before]
            after, umbra = widths[law.after]
            results.append(LawResult(name, law, before, after, umbra))
    return results


def measured_widths(technique: str, arrangement: Arrangement, **options: Any) -> tuple[float, float]:
    """Return the widths of penumbra and umbra that a technique draws, in world units."""
    scene = arrangement.scene()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SoftShadowWarning)
        visibility = run(technique, scene, SIZE, **options).visibility
    objects, _, points = seen_faces(scene, SIZE)
    row = SIZE[1] // 2
    at = slice(row * SIZE[0], (row + 1) * SIZE[0])
    on_floor = (objects[at] == 0) & (points[at, 0] > 0)  # one half, beside the slab, which begins in the umbra
    x, share = points[at, 0][on_floor], visibility[row][on_floor].astype(np.float64)
    pixel = WIDTH_SEEN / SIZE[0]
    penumbra = 6 * float((share * (1 - share)).sum()) * pixel
    middle = float(x[0]) - pixel / 2 + float((1 - share).sum()) * pixel
    return penumbra, max(0.0, 2 * (middle - penumbra / 2))
