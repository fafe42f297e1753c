"""The pixels that changed between two steps."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from softshadow.inspection.replay import Buffers


@dataclass(frozen=True, eq=False, repr=False)
class Difference:
    """Where the buffers after two steps differ: bool (H, W) per buffer, row 0 on top."""

    image: np.ndarray
    depth: np.ndarray
    stencil: np.ndarray

    @property
    def any(self) -> np.ndarray:
        """(H, W) bool: where at least one buffer differs."""
        return self.image | self.depth | self.stencil

    @property
    def counts(self) -> dict[str, int]:
        """The number of pixels that differ, per buffer."""
        return {name: int(np.count_nonzero(getattr(self, name))) for name in ("image", "depth", "stencil")}

    def __repr__(self) -> str:
        return f"Difference({self})"

    def __str__(self) -> str:
        return ", ".join(f"{name}: {pixels} pixels" for name, pixels in self.counts.items())


def difference(before: Buffers, after: Buffers) -> Difference:
    """Return where buffers differ: depth and stencil in any bit, colours in red, green or blue (alpha is ignored)."""
    return Difference(
        (before.color[..., :3] != after.color[..., :3]).any(axis=-1),
        before.depth != after.depth,
        before.stencil != after.stencil,
    )
