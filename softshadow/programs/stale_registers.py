"""What stands in green and blue of the products of lights and back materials in Mesa's vertex program.

Where a back material changes from vertex to vertex, Mesa 22.3 multiplies it with the light in red alone and reads green
and blue of a register that it did not write (ffvertex_prog.c, build_lighting: a write mask of 1). Registers are handed
out here in the same order, so that they hold the same: the product of the front, a direction, an attenuation; or
nothing, which becomes NaN and then a colour of 0.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence, Set
from dataclasses import dataclass, field

import numpy as np

NAMES = ("ambient", "diffuse", "specular")
GREEN_BLUE = slice(1, 3)
UNWRITTEN = np.full((1, 2), np.nan, np.float32)


@dataclass(frozen=True)
class Scratch:
    """What one light leaves in registers, in the order in which Mesa takes them; None where it takes none.

    direction (V, 3) of a positional light, `half` (V, 3) where it is computed per vertex; distance, spot, inside and
    attenuation (V,): what the two attenuations are made of; front: the products of the front side (V, 3) that vary.
    """

    direction: np.ndarray | None
    distance: np.ndarray | None
    spot: np.ndarray | None
    inside: np.ndarray | None
    attenuation: np.ndarray | None
    half: np.ndarray | None
    front: Mapping[str, np.ndarray]


@dataclass
class Registers:
    """Temporary registers: the lowest free one is taken; green and blue (V, 2) stay when it is released."""

    taken: set[int] = field(default_factory=set)
    contents: dict[int, np.ndarray] = field(default_factory=dict)

    def take(self, written: np.ndarray | None = None) -> int:
        """Take a register and write a vector (V, 3) or a number per vertex (V,) into it, or nothing."""
        index = next(i for i in range(len(self.taken) + 1) if i not in self.taken)
        self.taken.add(index)
        if written is not None:
            vectors = written.ndim == 2
            self.contents[index] = written[:, GREEN_BLUE] if vectors else np.stack([written, written], axis=1)
        return index

    def read(self, index: int) -> np.ndarray:
        return self.contents.get(index, UNWRITTEN)


def leftovers(lights: Sequence[Scratch], varying: Set[str], local_viewer: bool) -> list[dict[str, np.ndarray]]:
    """Return green and blue (V, 2) of the back products of each light, by the names of the materials that vary."""
    registers, found = Registers(), []
    eye_position = eye_direction = False
    for light in lights:
        if light.direction is not None and not eye_position:
            registers.take()
            eye_position = True
        held = [registers.take(light.direction)] if light.direction is not None else []
        freed = [registers.take(light.distance)] if light.distance is not None else []
        if light.spot is not None:
            freed += [registers.take(light.spot), registers.take(light.inside)]
        if light.attenuation is not None:
            held.append(registers.take(light.attenuation))
        registers.taken.difference_update(freed)
        if light.half is not None:
            if local_viewer:
                for known in (eye_position, eye_direction):
                    if not known:
                        registers.take()
                eye_position = eye_direction = True
            held.append(registers.take(light.half))
        registers.taken.difference_update([registers.take(light.front[name]) for name in NAMES if name in light.front])
        products = {name: registers.take() for name in NAMES if name in varying}
        found.append({name: registers.read(index) for name, index in products.items()})
        registers.taken.difference_update([*products.values(), *held])
    return found
