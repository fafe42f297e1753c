"""Errors of arguments that no C program could pass: a text for a number, None for an array, a number too large.

PyOpenGL refuses them before GL is called, and so does this package: with a TypeError or ValueError that names the call
and the argument. The arguments are not checked before the call, which would take longer than many a call; they are
looked at when it has failed.
"""

from __future__ import annotations

import functools
import inspect
import math
import struct
import sys
from collections.abc import Callable, Container, Iterator, Mapping
from numbers import Real
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from softshadow.errors import SoftShadowError
from softshadow.gl.wrapping import Wrapping

Call = TypeVar("Call", bound=Callable[..., Any])
CONVERTING = (
    TypeError, ValueError, OverflowError, AttributeError, IndexError, KeyError, RecursionError, struct.error,
)  # fmt: skip
PACKAGE = Path(__file__).parents[1]
# where arguments are converted; an error from elsewhere is none of an argument
FACADE = (
    PACKAGE / "gl",
    PACKAGE / "context",
    PACKAGE / "matrices.py",
    PACKAGE / "tokens.py",
    PACKAGE / "pixel_store.py",
)
LARGEST = 2**64  # whole numbers up to it lose their upper bits, as in C
AN_INTEGER, A_NUMBER = "an integer", "a number"
LONGEST_VALUE = 60  # characters of a value in a message


def names_arguments(call: Call) -> Call:
    """Let the errors of a call name it and its argument (decorator). `in_lists` does this, too."""
    return NAMING.around(call)  # type: ignore[return-value]


def all_naming_arguments(namespace: Mapping[str, Any], but: Container[str]) -> dict[str, Any]:
    """Return the GL calls of a namespace by name, those decorated by `names_arguments` that nothing decorates yet.

    Calls named in `but` stay as they are. Names of one function are names of one function afterwards, too.
    """
    calls = {
        name: call
        for name, call in namespace.items()
        if name.startswith("gl") and inspect.isfunction(call) and not hasattr(call, "__wrapped__")
    }
    decorated = {call: names_arguments(call) for call in set(calls.values()) if call.__name__ not in but}
    return {name: decorated[call] for name, call in calls.items() if call in decorated}


def refusal(call: Callable[..., Any], error: Exception, *arguments: Any, **by_name: Any) -> Exception:
    """Return the error that a failed call ends with: one that names the wrong argument, or the same error."""
    name = spelled(call)
    if not name.startswith("gl"):  # a part of a call, which names it
        return error
    if isinstance(error, SoftShadowError) or str(error).startswith((f"{name}(", f"{name}:")):
        return error
    try:
        bound = _signature(call).bind(*arguments, **by_name)
    except TypeError as mismatch:
        return TypeError(f"{name}: {mismatch}")
    for parameter, value, expected in _expectations(bound):
        if (expected == A_NUMBER and not _is_number(value)) or (expected == AN_INTEGER and not _is_integer(value)):
            kind = ValueError if isinstance(value, Real) else TypeError
            return kind(f"{name}({parameter}={_short(value)}): expected {expected}")
    if not _of_facade(error):
        return error
    given = ", ".join(f"{parameter}={_short(value)}" for parameter, value in bound.arguments.items())
    kind = TypeError if isinstance(error, TypeError | AttributeError) else ValueError
    return kind(f"{name}({given}): {error}")


def refuse_text(call: Callable[..., Any], *arguments: Any, **by_name: Any) -> None:
    """Raise a TypeError if a number is given as text: PyOpenGL refuses '3', which Python would convert."""
    if not any(isinstance(value, str) for value in (*arguments, *by_name.values())):
        return
    bound = _signature(call).bind(*arguments, **by_name)
    for parameter, value, expected in _expectations(bound):
        if isinstance(value, str):
            raise TypeError(f"{spelled(call)}({parameter}={_short(value)}): expected {expected}")


@functools.cache
def _signature(call: Callable[..., Any]) -> inspect.Signature:
    return inspect.signature(call, eval_str=False)


def spelled(call: Callable[..., Any]) -> str:
    """Return the name that the package gives a call; several share functions without a name of their own."""
    name = call.__name__
    names = vars(sys.modules["softshadow.gl"])
    if name in names:
        return name
    return next((key for key, value in names.items() if value is call), name)


def _expectations(bound: inspect.BoundArguments) -> Iterator[tuple[str, Any, str]]:
    """Yield (parameter, value, what its annotation expects) of the arguments that are numbers."""
    for parameter in bound.signature.parameters.values():
        expected = {"int": AN_INTEGER, "float": A_NUMBER}.get(str(parameter.annotation))
        if expected is None or parameter.name not in bound.arguments:
            continue
        value = bound.arguments[parameter.name]
        for item in value if parameter.kind is inspect.Parameter.VAR_POSITIONAL else (value,):
            yield parameter.name, item, expected


def _short(value: Any) -> str:
    """Return what a value looks like, in one short line."""
    if isinstance(value, int) and abs(value) >= LARGEST:
        return f"a whole number of {value.bit_length()} bits"
    if isinstance(value, np.ndarray) and value.ndim:
        return f"array of {' x '.join(map(str, value.shape))} {value.dtype}"
    text = " ".join(repr(value).split())
    return text if len(text) <= LONGEST_VALUE else f"{text[:LONGEST_VALUE]}…"


def _is_number(value: Any) -> bool:
    """Return whether a value is a number that a float can hold."""
    is_scalar = isinstance(value, np.ndarray) and value.ndim == 0 and value.dtype.kind in "biuf"
    if not isinstance(value, Real) and not is_scalar:
        return False
    try:
        float(value)
    except (OverflowError, TypeError, ValueError):
        return False
    return True


def _is_integer(value: Any) -> bool:
    """Return whether a value is a number that C converts to an integer: a fraction is cut off."""
    return _is_number(value) and math.isfinite(value) and -LARGEST < value < LARGEST


def _of_facade(error: Exception) -> bool:
    """Return whether an error was raised where arguments are converted, and not while something was drawn."""
    last, trace = PACKAGE, error.__traceback__
    while trace is not None:
        file = Path(trace.tb_frame.f_code.co_filename)
        last = file if file.is_relative_to(PACKAGE) else last
        trace = trace.tb_next
    return any(last.is_relative_to(place) for place in FACADE)


NAMING = Wrapping(
    "naming of wrong arguments",
    """
try:
    if {has_text}:
        refuse_text(function, {parameters})
    return call({parameters})
except CONVERTING as error:
    raise refusal(function, error, {parameters}) from error
""",
    CONVERTING=CONVERTING,
    refusal=refusal,
    refuse_text=refuse_text,
)
