"""One counting card: a pixel, its line of sight and the section that it is drawn in."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from softshadow.report.cross_sections import CrossSection
from softshadow.space import LineOfSight

RULES = {
    "volume-zpass": "Count from the eye to P: +1 where the line enters a volume, −1 where it leaves one.",
    "volume-zfail": "Count behind P, from infinity to P: +1 where the line, seen from the eye, leaves a volume, "
    "−1 where it enters one.",
    "volume-parity": "Go from the eye to P: every face turns 0 into 1 and 1 into 0.",
}
RULES["volume-zpass-plus"] = RULES["volume-zpass"]


@dataclass(frozen=True, eq=False)
class CountingCard:
    """One card.

    Attributes
    ----------
    number : int                 from 1
    technique : str              name
    line : LineOfSight           of the pixel
    section : CrossSection       through the eye, the light and the pixel
    """

    number: int
    technique: str
    line: LineOfSight
    section: CrossSection

    @property
    def x(self) -> int:
        """The pixel's column."""
        return self.line.x

    @property
    def y(self) -> int:
        """The pixel's row, from the top."""
        return self.line.y

    @property
    def rule(self) -> str:
        """How to count, in one sentence."""
        return RULES[self.technique]

    @property
    def places(self) -> np.ndarray:
        """(C, 2) float64: the crossings in the section, in the order of the count."""
        places = [each.place for each in self.line.crossings if each.place is not None]
        return (np.reshape(places, (-1, 3)) - self.section.origin) @ self.section.axes.T

    @property
    def answers(self) -> list[str]:
        """What happens at each crossing, in words."""
        inverted = self.line.inverts
        return [
            f"{number}: {'enters' if each.front_facing else 'leaves'} the volume of {each.caster}: "
            f"{'inverted' if inverted else format(each.change, '+d').replace('-', '−')}, count {each.count}"
            for number, each in enumerate(self.line.crossings, 1)
        ]

    @property
    def result(self) -> str:
        """The stencil value, and what follows from it."""
        lit = "lit" if self.line.end == 0 else "in shadow"
        return f"Stencil value {self.line.end}: P is drawn {lit}."
