"""The words of a pixel history as templates with blanks, so that a page can say them with the numbers of any pixel.

They are written by `inspection.reasons`, which is given blanks in place of numbers.
"""

from __future__ import annotations

from softshadow.inspection.reasons import culled_reason, fragment_reason
from softshadow.pipeline.raster.fragment_ops import FragmentOps
from softshadow.pipeline.records import VERDICTS
from softshadow.state import State


class Blank(float):
    """A number that prints as a name in braces, however it is formatted; two blanks are equal if they are the same."""

    name: str

    def __new__(cls, name: str) -> Blank:
        """Return the blank of a name."""
        blank = super().__new__(cls)
        blank.name = name
        return blank

    def __format__(self, form: str) -> str:
        return f"{{{self.name}}}"

    def __str__(self) -> str:
        return f"{{{self.name}}}"

    def __truediv__(self, other: float) -> Blank:
        return self

    def __eq__(self, other: object) -> bool:
        return self is other

    def __ne__(self, other: object) -> bool:
        return self is not other

    def __hash__(self) -> int:
        return hash(self.name)


Z, STORED_Z, ALPHA = Blank("z"), Blank("stored"), Blank("alpha")
BEFORE, AFTER = Blank("before"), Blank("after")


def reason_templates(state: State, ops: FragmentOps, front: bool | None, colored: bool) -> dict[str, str]:
    """Return the reasons of a draw's fragments of one facing.

    The keys are "culled", and each verdict, with " changed" behind it where the stencil value changes. The blanks are
    {z}, {stored}, {alpha}, {before} and {after}.
    """
    templates = {} if front is None else {"culled": culled_reason(front, state)}
    for number, verdict in enumerate(VERDICTS):
        for suffix, after in (("", BEFORE), (" changed", AFTER)):
            pairs = (Z, STORED_Z), (BEFORE, after)
            templates[verdict + suffix] = fragment_reason(state, ops, number, *pairs, ALPHA, colored)  # type: ignore[arg-type]
    return templates
