"""What a listing is: the calls of a slide, divided into its steps, with a switch for each correction."""

from collections.abc import Callable, Generator, Iterable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np

from softshadow.errors import nearest

# at the end of a step its title, or (title, {name: map}) as techniques do; at the end of a program what it returns
Steps = Generator[str | tuple[str, dict[str, np.ndarray]], None, Any]
Calls = Callable[..., Steps]  # calls(gl, corrected): `corrected` are the numbers of the corrections to apply
Program = Callable[[Any], Any]


@dataclass(frozen=True, eq=False)
class Listing:
    """A listing of the register.

    Attributes
    ----------
    name, title, family : str    family is tools, planar, volumes or maps
    slide : str                  text and lines, as in "CA:75-96"; the texts are listed in `softshadow.listings`
    calls : calls(gl, corrected) a generator function: it draws, and yields the title of each step at its end
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
        return partial(carried_out, self.calls, corrected=self._known(numbers))

    def without(self, *numbers: str) -> Program:
        """Return the program with all corrections but these, which shows what they are for.

        Raises
        ------
        ValueError                   see `with_only`
        """
        return partial(carried_out, self.calls, corrected=frozenset(self.corrections) - self._known(numbers))

    def steps(self, gl: Any, corrected: Iterable[str] | None = None, **arguments: Any) -> Steps:
        """Return the program step by step, with some corrections or, by default, all of them.

        Parameters
        ----------
        arguments                    of the listing's function, like its stage

        Raises
        ------
        ValueError                   see `with_only`
        """
        numbers = self._known(tuple(self.corrections if corrected is None else corrected))
        return self.calls(gl, numbers, **arguments)

    def _known(self, numbers: tuple[str, ...]) -> frozenset[str]:
        for number in numbers:
            if number not in self.corrections:
                has = nearest(str(number), self.corrections) if self.corrections else "it has none"
                raise ValueError(f"listing {self.name}: unknown correction {number!r}: {has}")
        return frozenset(numbers)


def carried_out(calls: Calls, gl: Any, **arguments: Any) -> Any:
    """Carry out all steps of a listing, and return what its program returns."""
    steps = calls(gl, **arguments)
    while True:
        try:
            next(steps)
        except StopIteration as end:
            return end.value
