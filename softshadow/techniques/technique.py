"""What the register says about a technique: its name, its steps, its options and where it comes from."""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from softshadow.errors import nearest


@dataclass(frozen=True)
class Option:
    """One option of a technique: its default, what it may be, and one sentence of help.

    `kind` is bool, int, float or str; `choices` lists what a str may be; `minimum` and `maximum` bound a number. With
    a default of None the value is chosen to fit the scene or the other options.
    """

    default: Any
    kind: type
    help: str
    choices: tuple[str, ...] = ()
    minimum: float = -math.inf
    maximum: float = math.inf

    def checked(self, name: str, value: Any) -> Any:
        """Return the value as this option takes it.

        Raises
        ------
        TypeError, ValueError        naming the option, what was given and what was expected
        """
        kind: Any = self.kind  # a type that mypy does not narrow to
        if value is None and self.default is None:
            return None
        if self.kind is float and isinstance(value, int) and not isinstance(value, bool):
            value = float(value)
        if not isinstance(value, kind) or (isinstance(value, bool) and self.kind is not bool):
            raise TypeError(f"option {name}={value!r}: expected {self.expected}, got {type(value).__name__}")
        if self.choices and value not in self.choices:
            raise ValueError(f"option {name}={value!r}: {nearest(value, self.choices)}")
        if self.kind is float and not math.isfinite(value):
            raise ValueError(f"option {name}={value!r}: expected a finite number")
        if self.kind in (int, float) and not self.minimum <= value <= self.maximum:
            raise ValueError(f"option {name}={value!r}: expected {self.expected}")
        return value

    @property
    def expected(self) -> str:
        """What the option may be, in words."""
        if self.choices:
            return "one of " + ", ".join(self.choices)
        words = {bool: "True or False", int: "a whole number", float: "a number", str: "a text"}[self.kind]
        if math.isfinite(self.maximum):
            return f"{words} from {self.minimum:g} to {self.maximum:g}"
        return f"{words} of at least {self.minimum:g}" if math.isfinite(self.minimum) else words


# what a generator of steps yields: the title of the step that has ended, or the title and named maps (arrays, first
# row = bottom)
Steps = Iterator[str | tuple[str, dict[str, Any]]]


@dataclass(frozen=True)
class Technique:
    """One entry of the register.

    ``steps(gl, scene, *, size, **options)`` draws the technique with the calls of `gl` and yields after each step.
    """

    name: str
    title: str
    family: str
    paper: str
    steps: Callable[..., Steps]
    options: Mapping[str, Option]

    def checked_options(self, given: Mapping[str, Any]) -> dict[str, Any]:
        """Return every option of the technique, from `given` or by default.

        Raises
        ------
        ValueError                   an unknown option (with the nearest name), or a value outside what it may be
        TypeError                    a value of the wrong type
        """
        for name in given:
            if name not in self.options:
                raise ValueError(f"technique {self.name!r} has no option {name!r}: {nearest(name, self.options)}")
        return {
            name: option.checked(name, given[name]) if name in given else option.default
            for name, option in self.options.items()
        }
