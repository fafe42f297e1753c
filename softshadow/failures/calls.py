"""GL names that write down every call made through them, and that can make a named call another one, or leave it out.

A technique drawn through them is the right program with one call altered, so it fails for that reason and no other.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from softshadow.errors import StateError
from softshadow.scene import Scene
from softshadow.techniques import Steps, Technique

LONGEST_SPELLED = 16  # numbers of an array: a matrix is spelled out, vertices and indices are not


class Token(int):
    """A GL token that prints as it is written: GL_ONE is not GL_LINES, though both are 1."""

    name: str

    def __new__(cls, value: int, name: str) -> Token:
        made = super().__new__(cls, value)
        made.name = name
        return made

    def __or__(self, other: int) -> Token:
        return Token(int(self) | int(other), f"{self.name} | {spelled(other)}")

    def __add__(self, other: int) -> Token:
        stem = self.name.rstrip("0123456789")
        if stem != self.name:  # GL_LIGHT0 and the like are numbered
            return Token(int(self) + int(other), f"{stem}{int(self.name[len(stem) :]) + other}")
        return Token(int(self) + int(other), f"{self.name} + {other}") if other else self

    def __repr__(self) -> str:
        return self.name


class Call(NamedTuple):
    """A GL call as it was made: the step it belongs to, its name and text; `key` also tells arrays apart by content."""

    step: str
    name: str
    text: str
    key: str


@dataclass(frozen=True)
class Change:
    """A call, and what stands in its place.

    Attributes
    ----------
    call : str                   as it is spelled with its arguments, or a name alone: every call of it
    instead : str, function or None
                                 a call, spelled with tokens and whole numbers; what makes other arguments of those
                                 that were given; None leaves the call out
    """

    call: str
    instead: str | Callable[..., tuple[Any, ...]] | None

    def arguments(self, gl: Any, given: tuple[Any, ...]) -> tuple[Any, ...]:
        """Return the arguments of the call that stands instead, with the tokens of `gl`."""
        if callable(self.instead):
            return self.instead(*given)
        assert self.instead is not None
        words = self.instead.removesuffix(")").partition("(")[2].split(", ")
        return tuple(getattr(gl, word) if word.startswith("GL_") else int(word) for word in words)

    def name(self, given: str) -> str:
        """Return the name of the call that stands instead."""
        return self.instead.partition("(")[0] if isinstance(self.instead, str) else given


class RecordedNames:
    """A GL namespace over another one: calls are altered, written down, and made.

    Parameters
    ----------
    gl : any namespace with GL's names
    changes : what to alter; each has to meet a call (`check`)
    """

    def __init__(self, gl: Any, changes: Sequence[Change]) -> None:
        self._gl = gl
        self._changes = {change.call: change for change in changes}
        self._met: set[str] = set()
        self.calls: list[Call] = []

    def __getattr__(self, name: str) -> Any:
        value = getattr(self._gl, name)
        if name.startswith("GL_") and isinstance(value, int):
            return Token(value, name)
        return self._recorded(name) if name.startswith("gl") and callable(value) else value

    def _recorded(self, name: str) -> Callable[..., Any]:
        def call(*arguments: Any) -> Any:
            made, given = name, arguments
            text = spelled_call(name, arguments)
            change = self._changes.get(text) or self._changes.get(name)
            if change is not None:
                self._met.add(change.call)
                if change.instead is None:
                    return None
                made, given = change.name(name), change.arguments(self, arguments)
                text = spelled_call(made, given)
            self.calls.append(Call("", made, text, text + content(given)))
            return getattr(self._gl, made)(*map(plain, given))

        return call

    def end_step(self, title: str) -> None:
        """Say which step the calls since the last one belong to."""
        self.calls[:] = [call if call.step else call._replace(step=title) for call in self.calls]

    def check(self) -> None:
        """Make sure that every change has met its call.

        Raises
        ------
        StateError                   the program never made a call that should have been altered
        """
        missed = [text for text in self._changes if text not in self._met]
        if missed:
            raise StateError(f"the program never calls {missed[0]}; expected a call of it, spelled like that")


def spelled_call(name: str, arguments: Iterable[Any]) -> str:
    """Return a call as it is written."""
    return f"{name}({', '.join(map(spelled, arguments))})"


def spelled(argument: Any) -> str:
    """Return an argument of a GL call as it is written.

    Examples
    --------
    >>> spelled(0.25), spelled((1.0, 0)), spelled(np.zeros((24, 3), np.float32))
    ('0.25', '(1, 0)', 'float32 (24, 3)')
    """
    if isinstance(argument, Token):
        return argument.name
    if isinstance(argument, tuple | list):
        return f"({', '.join(map(spelled, argument))})"
    if isinstance(argument, np.ndarray) and argument.ndim:
        if argument.size > LONGEST_SPELLED or argument.dtype.kind != "f":
            return f"{argument.dtype.name} {argument.shape}"
        return f"[{', '.join(map(spelled, argument.ravel().tolist()))}]"
    return f"{float(argument):.5g}" if isinstance(argument, float | np.floating) else str(argument)


def content(arguments: Iterable[Any]) -> str:
    """Return a short name of the arrays among the arguments."""
    digest = hashlib.blake2b(digest_size=8)
    for argument in arguments:
        if isinstance(argument, np.ndarray):
            digest.update(np.ascontiguousarray(argument).tobytes())
    return digest.hexdigest()


def plain(argument: Any) -> Any:
    """Return an argument without names of tokens: below this namespace a token is a number."""
    return int(argument) if isinstance(argument, Token) else argument


def recorded(technique: Technique, changes: Sequence[Change], calls: list[Call]) -> Technique:
    """Return a technique that draws through altered names, and leaves the calls it made in `calls`."""

    def steps(gl: Any, scene: Scene, **given: Any) -> Steps:
        names = RecordedNames(gl, changes)
        for item in technique.steps(names, scene, **given):
            names.end_step(item if isinstance(item, str) else item[0])
            yield item
        names.check()
        calls[:] = names.calls

    return replace(technique, steps=steps)
