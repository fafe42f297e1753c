"""What authors of random programs have in common."""

from typing import Any

import numpy as np


class RandomAuthor:
    """Draws choices and numbers at random, the same ones for the same seed."""

    def __init__(self, seed: int) -> None:
        self.rng = np.random.default_rng(seed)
        self.depth = 0

    def chance(self, p: float) -> bool:
        return bool(self.rng.random() < p)

    def one_of(self, values: Any) -> Any:
        values = list(values)
        return values[int(self.rng.integers(len(values)))]

    def numbers(self, n: int) -> list[float]:
        return [float(x) for x in self.rng.choice([-0.5, 0.0, -0.0, 0.25, 0.3, 1.0], n)]
