"""What a listing is: the calls of a slide, with a switch for each correction."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from softshadow.errors import nearest

Calls = Callable[..., Any]  # calls(gl, corrected): `corrected` are the numbers of the corrections to apply
Program = Callable[[Any], Any]


@dataclass(frozen=True, eq=False)
class Listing:
    """A listing of the register.

    Attributes
    ----------
    name, title, family : str    family is tools, planar, volumes or maps
    slide : str                  text and lines, as in "CA:75-96"; the texts are listed in `softshadow.listings`
    calls : calls(gl, corrected)
    corrections : number -> what it corrects, as in {"E2": "the second drawing has equal depth: GL_LEQUAL"}
    """

    name: str
    title: str
    family: str
    slide: str
    calls: Calls
    corrections: Mapping[str, str] = field(default_factory=dict)

    @property
    def printed(self) -> Program:
        """The program as the slide prints it."""
        return self.with_only()

    @property
    def corrected(self) -> Program:
        """The program with all corrections."""
        return self.with_only(*self.corrections)

    def with_only(self, *numbers: str) -> Program:
        """Return the program with these corrections and no others.

        Raises
        ------
        ValueError                   a number that the listing has no correction for; the message has the nearest
        """
        return partial(self.calls, corrected=self._known(numbers))

    def without(self, *numbers: str) -> Program:
        """Return the program with all corrections but these, which shows what they are for.

        Raises
        ------
        ValueError                   see `with_only`
        """
        return partial(self.calls, corrected=frozenset(self.corrections) - self._known(numbers))

    def _known(self, numbers: tuple[str, ...]) -> frozenset[str]:
        for number in numbers:
            if number not in self.corrections:
                has = nearest(str(number), self.corrections) if self.corrections else "it has none"
                raise ValueError(f"listing {self.name}: unknown correction {number!r}: {has}")
        return frozenset(numbers)
