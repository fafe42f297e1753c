"""A GL namespace that records every call, and that can replace or omit calls.

A technique that draws through it is the correct program with one call altered, so it fails for this reason alone.
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

LONGEST_SPELLED = 16  # elements of an array: matrices are spelled out, vertices and indices are not


class Token(int):
    """A GL token that knows its name: GL_ONE and GL_LINES are both 1."""

    name: str

    def __new__(cls, value: int, name: str) -> Token:
        """Return the value with the name of its token."""
        token = super().__new__(cls, value)
        token.name = name
        return token

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
    """A recorded GL call: its step, its name, and its text; `key` also depends on the contents of arrays."""

    step: str
    name: str
    text: str
    key: str


@dataclass(frozen=True)
class AlteredCall:
    """A GL call and its replacement.

    Attributes
    ----------
    call : str                   a call with its arguments, or a name alone for every call of that name
    replacement : str, function or None
                                 a call, written with tokens and whole numbers; or a function from the original to the
                                 new arguments; None omits the call
    """

    call: str
    replacement: str | Callable[..., tuple[Any, ...]] | None

    def arguments(self, gl: Any, original: tuple[Any, ...]) -> tuple[Any, ...]:
        """Return the arguments of the replacement, with the tokens of `gl`."""
        if callable(self.replacement):
            return self.replacement(*original)
        assert self.replacement is not None
        words = self.replacement.removesuffix(")").partition("(")[2].split(", ")
        return tuple(getattr(gl, word) if word.startswith("GL_") else int(word) for word in words)

    def name(self, original: str) -> str:
        """Return the name of the replacement."""
        return self.replacement.partition("(")[0] if isinstance(self.replacement, str) else original


class RecordedNames:
    """A GL namespace that wraps another one: it alters calls, records them, and carries them out.

    Parameters
    ----------
    gl : any namespace with GL's names
    altered_calls : the calls to alter; the program must make each of them (`check`)
    """

    def __init__(self, gl: Any, altered_calls: Sequence[AlteredCall]) -> None:
        self._gl = gl
        self._altered = {altered.call: altered for altered in altered_calls}
        self._used: set[str] = set()
        self.calls: list[Call] = []

    def __getattr__(self, name: str) -> Any:
        value = getattr(self._gl, name)
        if name.startswith("GL_") and isinstance(value, int):
            return Token(value, name)
        return self._recorded(name) if name.startswith("gl") and callable(value) else value

    def _recorded(self, name: str) -> Callable[..., Any]:
        def call(*arguments: Any) -> Any:
            function, text = name, spelled_call(name, arguments)
            altered = self._altered.get(text) or self._altered.get(name)
            if altered is not None:
                self._used.add(altered.call)
                if altered.replacement is None:
                    return None
                function, arguments = altered.name(name), altered.arguments(self, arguments)
                text = spelled_call(function, arguments)
            self.calls.append(Call("", function, text, text + content_hash(arguments)))
            return getattr(self._gl, function)(*map(without_name, arguments))

        return call

    def end_step(self, title: str) -> None:
        """Assign the calls since the previous step to this one."""
        self.calls[:] = [call if call.step else call._replace(step=title) for call in self.calls]

    def check(self) -> None:
        """Raise an error unless the program made every call that was to be altered.

        Raises
        ------
        StateError                   the program never made one of them
        """
        missing = [text for text in self._altered if text not in self._used]
        if missing:
            raise StateError(f"the program never calls {missing[0]}; expected a call with this name and arguments")


def spelled_call(name: str, arguments: Iterable[Any]) -> str:
    """Return a call as source text."""
    return f"{name}({', '.join(map(spelled, arguments))})"


def spelled(argument: Any) -> str:
    """Return an argument of a GL call as source text; a large array as its type and shape.

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


def content_hash(arguments: Iterable[Any]) -> str:
    """Return a hash of the arrays among the arguments."""
    digest = hashlib.blake2b(digest_size=8)
    for argument in arguments:
        if isinstance(argument, np.ndarray):
            digest.update(np.ascontiguousarray(argument).tobytes())
    return digest.hexdigest()


def without_name(argument: Any) -> Any:
    """Return a token as a plain number, as the wrapped namespace expects it, and any other argument as it is."""
    return int(argument) if isinstance(argument, Token) else argument


def recorded(technique: Technique, altered_calls: Sequence[AlteredCall], calls: list[Call]) -> Technique:
    """Return a technique that draws with altered calls, and stores the calls that it made in `calls`."""

    def steps(gl: Any, scene: Scene, **options: Any) -> Steps:
        names = RecordedNames(gl, altered_calls)
        for item in technique.steps(names, scene, **options):
            names.end_step(item if isinstance(item, str) else item[0])
            yield item
        names.check()
        calls[:] = names.calls

    return replace(technique, steps=steps)
