"""Emulates registers that Mesa's back lighting reads uninitialised.

If a back material changes between vertices, Mesa 22.3 multiplies it by the light in red only, and then reads green and
blue from the same register, where an earlier value is left (ffvertex_prog.c, build_lighting: a write mask of 1). This
module allocates registers in Mesa's order to find that value: a front product, a direction or an attenuation. A
register that was never written holds NaN, which becomes a colour of 0.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence, Set
from dataclasses import dataclass, field

import numpy as np

PRODUCTS = ("ambient", "diffuse", "specular")
GREEN_BLUE = slice(1, 3)
UNWRITTEN = np.full((1, 2), np.nan, np.float32)


@dataclass(frozen=True)
class LightRegisters:
    """Values that one light writes to registers, in Mesa's order of allocation; None for a register it does not use.

    direction (V, 3) of a positional light; half (V, 3) if it is computed per vertex; distance, spot, inside and
    attenuation (V,): the attenuation and its factors; front: the varying products (V, 3) of the front side.
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
    """Temporary registers, allocated from the lowest free one; a released register keeps its green and blue (V, 2)."""

    in_use: set[int] = field(default_factory=set)
    contents: dict[int, np.ndarray] = field(default_factory=dict)

    def allocate(self, values: np.ndarray | None = None) -> int:
        """Allocate a register, and write a vector (V, 3) or a scalar (V,) per vertex into it, if there is one."""
        index = next(i for i in range(len(self.in_use) + 1) if i not in self.in_use)
        self.in_use.add(index)
        if values is not None:
            vectors = values.ndim == 2
            self.contents[index] = values[:, GREEN_BLUE] if vectors else np.stack([values, values], axis=1)
        return index

    def release(self, indices: Iterable[int]) -> None:
        """Free registers; they keep their contents."""
        self.in_use.difference_update(indices)

    def read(self, index: int) -> np.ndarray:
        """Return green and blue (V, 2) of a register; NaN where it was never written."""
        return self.contents.get(index, UNWRITTEN)


def stale_values(
    lights: Sequence[LightRegisters], varying: Set[str], local_viewer: bool
) -> list[dict[str, np.ndarray]]:
    """Return for each light the stale green and blue (V, 2) of its varying back products, by name."""
    registers, products = Registers(), []
    eye_position = eye_direction = False
    for light in lights:
        if light.direction is not None and not eye_position:
            registers.allocate()
            eye_position = True
        until_next_light = [registers.allocate(light.direction)] if light.direction is not None else []
        temporary = [registers.allocate(light.distance)] if light.distance is not None else []
        if light.spot is not None:
            temporary += [registers.allocate(light.spot), registers.allocate(light.inside)]
        if light.attenuation is not None:
            until_next_light.append(registers.allocate(light.attenuation))
        registers.release(temporary)
        if light.half is not None:
            if local_viewer:
                for allocated in (eye_position, eye_direction):
                    if not allocated:
                        registers.allocate()
                eye_position = eye_direction = True
            until_next_light.append(registers.allocate(light.half))
        registers.release([registers.allocate(light.front[name]) for name in PRODUCTS if name in light.front])
        back = {name: registers.allocate() for name in PRODUCTS if name in varying}
        products.append({name: registers.read(index) for name, index in back.items()})
        registers.release([*back.values(), *until_next_light])
    return products
