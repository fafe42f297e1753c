"""Shared by all calls: how display lists record them, and which names a module exports."""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping
from typing import Any, TypeVar

import numpy as np

from softshadow.context import current

Call = TypeVar("Call", bound=Callable[..., Any])


def in_lists(call: Call) -> Call:
    """Record a call in the display list between glNewList and glEndList (decorator).

    With GL_COMPILE_AND_EXECUTE the call is carried out, too. Calls without this decorator are never recorded: in GL
    these are queries, client state and the creation of objects (GL 2.1, sec. 5.4).
    """

    @functools.wraps(call)
    def recorded(*arguments: Any, **named: Any) -> Any:
        context = current()
        compiled = context.compiled_list
        if compiled is None:
            return call(*arguments, **named)
        compiled.calls.append(functools.partial(call, *map(_snapshot, arguments), **named))
        if not compiled.executes:
            return None
        context.compiled_list, context.executes_list = None, True  # calls made by this call are part of it
        try:
            return call(*arguments, **named)
        finally:
            context.compiled_list, context.executes_list = compiled, False

    return recorded  # type: ignore[return-value]


def _snapshot(argument: Any) -> Any:
    """Return an argument as it is now: a copy of an array or list."""
    return np.array(argument) if isinstance(argument, np.ndarray | list) else argument


def spelled_like_gl(namespace: Mapping[str, Any]) -> list[str]:
    """Return the names of GL and GLU calls in a module's namespace, for its ``__all__``."""
    return [name for name in namespace if name.startswith("gl") and callable(namespace[name])]
