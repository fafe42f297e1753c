"""Shared by all calls: how display lists record them, and which names a module exports."""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping
from typing import Any, TypeVar

import numpy as np

from softshadow.context import Context, thread
from softshadow.gl.errors import outside_begin
from softshadow.gl.refusals import CONVERTING, refusal, refuse_text
from softshadow.gl.wrapping import Wrapping

NUMBERS = frozenset((float, int, bool))  # types of which nobody can change a value
Call = TypeVar("Call", bound=Callable[..., Any])


def in_lists(call: Call) -> Call:
    """Record a call in the display list between glNewList and glEndList (decorator).

    With GL_COMPILE_AND_EXECUTE the call is carried out, too. Calls without this decorator are never recorded: in GL
    these are queries, client state and the creation of objects (GL 2.1, sec. 5.4).
    """
    return LISTED.around(call)  # type: ignore[return-value]


def record(context: Context, call: Callable[..., Any], *arguments: Any, **named: Any) -> Any:
    """Record a call in the display list that is being compiled; with GL_COMPILE_AND_EXECUTE, also carry it out."""
    compiled = context.compiled_list
    assert compiled is not None
    kept = arguments if NUMBERS.issuperset(map(type, arguments)) else map(_snapshot, arguments)
    compiled.calls.append(functools.partial(call, *kept, **named))
    return execute_listed(context, call, *arguments, **named) if compiled.executes else None


def execute_listed(context: Context, call: Callable[..., Any], *arguments: Any, **named: Any) -> Any:
    """Carry out a call of a list that is compiled with GL_COMPILE_AND_EXECUTE; calls made by it are not recorded."""
    compiled = context.compiled_list
    context.compiled_list, context.executes_list, context.ready = None, True, False
    try:
        return call(*arguments, **named)
    finally:
        context.compiled_list, context.executes_list, context.ready = compiled, False, False


LISTED = Wrapping(
    "calls in display lists",
    """
context = thread.context
try:
    if {has_text}:
        refuse_text(function, {parameters})
    if context.compiled_list is None:
        return call({parameters})
    return record(context, call, {parameters})
except CONVERTING as error:
    raise refusal(function, error, {parameters}) from error
""",
    CONVERTING=CONVERTING,
    record=record,
    refusal=refusal,
    refuse_text=refuse_text,
    thread=thread,
)


# Calls that programs make most have neither `in_lists` nor `outside_begin` nor `names_arguments`. They begin with
#     context = thread.context
#     if context.ready or is_ready(context, glCall, ...):
def is_allowed(context: Context, call: Callable[..., Any], *arguments: Any) -> bool:
    """Return whether a call can be carried out now.

    While a display list is compiled, it is recorded instead; between glBegin and glEnd it fails.
    """
    if context.compiled_list is not None:
        record(context, call, *arguments)
        return False
    if context.primitive is not None:
        return outside_begin(call.__name__) is not None
    context.ready = not context.has_collected
    return True


def is_ready(context: Context, call: Callable[..., Any], *arguments: Any) -> bool:
    """Return whether a call can be carried out now; before a call that can, draw the collected vertices."""
    if not is_allowed(context, call, *arguments):
        return False
    context.separate()
    context.ready = True
    return True


def _snapshot(argument: Any) -> Any:
    """Return an argument as it is now: a copy of an array or list."""
    return np.array(argument) if isinstance(argument, np.ndarray | list) else argument


def spelled_like_gl(namespace: Mapping[str, Any]) -> list[str]:
    """Return the names of GL and GLU calls in a module's namespace, for its ``__all__``."""
    return [name for name in namespace if name.startswith("gl") and callable(namespace[name])]
