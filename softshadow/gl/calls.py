"""What GL calls have in common: display lists record them, and a module exports only what is spelled like GL."""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping
from typing import Any, TypeVar

import numpy as np

from softshadow.context import current

Call = TypeVar("Call", bound=Callable[..., Any])


def in_lists(call: Call) -> Call:
    """Make a call one that a display list keeps: between glNewList and glEndList it is recorded.

    With GL_COMPILE_AND_EXECUTE it is carried out, too. Calls without this decorator are carried out at once, as GL has
    it for queries, client state and the making of objects (GL 2.1, sec. 5.4).
    """

    @functools.wraps(call)
    def recorded(*arguments: Any, **named: Any) -> Any:
        context = current()
        compiled = context.compiled_list
        if compiled is None:
            return call(*arguments, **named)
        compiled.calls.append(functools.partial(call, *map(_owned, arguments), **named))
        if not compiled.executes:
            return None
        context.compiled_list, context.executes_list = None, True  # what the call itself calls is part of it
        try:
            return call(*arguments, **named)
        finally:
            context.compiled_list, context.executes_list = compiled, False

    return recorded  # type: ignore[return-value]


def _owned(argument: Any) -> Any:
    """Return an argument that its caller cannot change any more."""
    return np.array(argument) if isinstance(argument, np.ndarray | list) else argument


def spelled_like_gl(namespace: Mapping[str, Any]) -> list[str]:
    """Return the names of GL and GLU calls in a module's namespace, for its ``__all__``."""
    return [name for name in namespace if name.startswith("gl") and callable(namespace[name])]
