"""GL programs as data: a list of calls that can be replayed on any GL namespace, printed as Python code, and shrunk."""

import re
import time
from collections.abc import Callable
from functools import reduce
from operator import or_
from typing import Any

import numpy as np

# (name of the function, arguments): numbers, arrays, tokens by name ("GL_LESS", "GL_COLOR_BUFFER_BIT | GL_..."),
# objects by kind and number ("query 0")
Call = tuple[str, tuple[Any, ...]]

OBJECT = re.compile(r"(texture|framebuffer|renderbuffer|query|buffer) (\d+)")
GENERATORS = {
    "texture": "glGenTextures",
    "framebuffer": "glGenFramebuffers",
    "renderbuffer": "glGenRenderbuffers",
    "query": "glGenQueries",
    "buffer": "glGenBuffers",
}
BITS = " | "  # between the tokens of a bit mask
READS = ("glReadPixels", "glGet", "glIsEnabled", "glCheck")


def replay(gl: Any, calls: list[Call]) -> list[Any]:
    """Make the calls on the namespace `gl` and return what the reading ones answered, in order."""
    objects: dict[str, int] = {}

    def value(argument: Any) -> Any:
        if isinstance(argument, np.ndarray):
            return argument.copy()  # reads may fill it
        if not isinstance(argument, str):
            return argument
        if OBJECT.fullmatch(argument) is None:
            return reduce(or_, (getattr(gl, token) for token in argument.split(BITS)))
        if argument not in objects:
            objects[argument] = getattr(gl, GENERATORS[argument.split()[0]])(1)
        return objects[argument]

    answers = []
    for name, arguments in calls:
        answer = getattr(gl, name)(*map(value, arguments))
        if name.startswith(READS):
            answers.append(np.array(answer))
    return answers


def as_program(calls: list[Call]) -> Callable[[Any], list[Any]]:
    """Return ``program(gl)`` that makes the calls."""

    def program(gl: Any) -> list[Any]:
        return replay(gl, calls)

    return program


def as_code(calls: list[Call]) -> str:
    """Return the calls as a Python function that can be pasted into a test."""
    objects = sorted({argument for _, arguments in calls for argument in arguments if _is_object(argument)})
    lines = [f"{_spelled(name)} = gl.{GENERATORS[name.split()[0]]}(1)" for name in objects]
    lines += [f"gl.{name}({', '.join(map(_spelled, arguments))})" for name, arguments in calls]
    return "def program(gl):\n" + "".join(f"    {line}\n" for line in lines or ["pass"])


def _is_object(argument: Any) -> bool:
    return isinstance(argument, str) and OBJECT.fullmatch(argument) is not None


def _spelled(argument: Any) -> str:
    if _is_object(argument):
        return argument.replace(" ", "_")
    if isinstance(argument, str):
        return BITS.join(f"gl.{token}" for token in argument.split(BITS))
    if isinstance(argument, np.ndarray):
        shortest = np.array([str(number) for number in argument.ravel()]).reshape(argument.shape).tolist()
        return f"np.array({shortest}, np.{argument.dtype})".replace("'", "")
    return repr(argument)


def shrink(
    calls: list[Call], fails: Callable[[list[Call]], bool], attempts: int = 500, seconds: float = 120
) -> list[Call]:
    """Return a shorter list of calls that still fails: ever smaller runs are left out as long as any can go.

    A program may take Mesa half a minute; then there is time for few attempts.
    """
    length, end = max(1, len(calls) // 2), time.monotonic() + seconds
    while True:
        position, shortened = 0, False
        while position < len(calls):
            candidate = calls[:position] + calls[position + length :]
            if attempts == 0 or time.monotonic() > end:
                return calls
            attempts -= 1
            if fails(candidate):
                calls, shortened = candidate, True
            else:
                position += length
        if length > 1:
            length = max(1, min(length // 2, len(calls) // 2))
        elif not shortened:
            return calls
