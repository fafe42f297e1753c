"""Functions around a call that have the call's own parameters.

A function with ``*arguments`` around a call takes 250 ns, which is more than most calls do; one with the same
parameters takes 70 ns. Therefore its source is written at run time, once for each number of parameters.
"""

from __future__ import annotations

import functools
import inspect
import linecache
from collections.abc import Callable
from pathlib import Path
from textwrap import indent
from typing import Any

PACKED = inspect.CO_VARARGS | inspect.CO_VARKEYWORDS
SOURCE = """
def make(call):
    def function({parameters}):
{body}
    return function
"""


class Wrapping:
    """A way to wrap calls.

    Parameters
    ----------
    name : what tracebacks call the source
    body : source of the functions, in which ``call`` is the call, ``function`` the function itself, ``{parameters}``
        what it was called with, and ``{has_text}`` whether one of them is a str; False for a part of a call, as the
        call has looked at its arguments
    names : what else the source uses
    """

    def __init__(self, name: str, body: str, **names: Any) -> None:
        self._name, self._body, self._names = name, body.strip("\n"), names
        self._makers: dict[tuple[int | None, bool], Callable[..., Any]] = {}

    def around(self, call: Callable[..., Any]) -> Callable[..., Any]:
        """Return a function around a call.

        A call with optional or packed parameters gets ``*arguments``, as does one that several names share: Python's
        error of a wrong number of arguments names the function.
        """
        names = _plain_parameters(call)
        kind = None if names is None else len(names), not getattr(call, "__name__", "").startswith("_")
        if kind not in self._makers:
            self._makers[kind] = self._maker(*kind)
        function: Any = self._makers[kind](call)
        if names is not None:
            code = function.__code__
            local = names + code.co_varnames[len(names) :]
            function.__code__ = code.replace(co_varnames=local, co_name=call.__name__)
        wrapper: Callable[..., Any] = functools.wraps(call)(function)
        return wrapper

    def _maker(self, count: int | None, looks_for_text: bool) -> Callable[..., Any]:
        """Return a function that makes the functions with so many parameters, still without their names."""
        if count is None:
            parameters, has_text = "*arguments, **by_name", "str in map(type, arguments)"
        else:
            numbered = [f"_{number}" for number in range(count)]
            parameters = ", ".join(numbered)
            has_text = " or ".join(f"type({name}) is str" for name in numbered) or "False"
        body = self._body.format(parameters=parameters, has_text=has_text if looks_for_text else "False")
        source = SOURCE.format(parameters=parameters, body=indent(body, " " * 8))
        file = str(Path(__file__).with_name(f"<{self._name}, parameters: {'any' if count is None else count}>"))
        linecache.cache[file] = len(source), None, source.splitlines(keepends=True), file  # tracebacks show the lines
        namespace = dict(self._names)
        exec(compile(source, file, "exec"), namespace)
        maker: Callable[..., Any] = namespace["make"]
        return maker


def _plain_parameters(call: Any) -> tuple[str, ...] | None:
    """Return the names of a call's parameters, None unless all are plain and required, and the call has a name."""
    code = getattr(call, "__code__", None)
    if (
        code is None
        or not call.__name__.startswith("gl")
        or call.__defaults__
        or code.co_kwonlyargcount
        or code.co_flags & PACKED
    ):
        return None
    names: tuple[str, ...] = code.co_varnames[: code.co_argcount]
    return names
