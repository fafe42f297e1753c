"""Names of objects: what glGen* gives out and glDelete* takes back."""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.gl.errors import fail, outside_begin


def generate(operation: str, kind: str, n: int, names: Any = None) -> Any:
    """Answer a glGen* call: names that were never used before, counting up as Mesa does.

    One name is an int, several are an array, as in PyOpenGL; they are written into `names` where it is given.
    """
    if (context := outside_begin(operation)) is None:
        return None
    if n < 0:
        return fail(gl.GL_INVALID_VALUE, operation, f"n={n}: expected 0 or more")
    first = context.names[kind] + 1
    context.names[kind] += n
    made = np.arange(first, first + n, dtype=np.uint32)
    if names is not None:
        np.asarray(names)[:n] = made
    return first if n == 1 else made


def take(context: Context, kind: str, name: int) -> None:
    """Remember a name that a program has chosen itself."""
    context.names[kind] = max(context.names[kind], name)


def listed(operation: str, arguments: tuple[Any, ...]) -> list[int]:
    """Return the names in the arguments of a glDelete* call: (name), (names) or (n, names); [] after an error."""
    count, given = (arguments[0], arguments[1]) if len(arguments) == 2 else (None, arguments[0])
    names = [int(name) for name in np.ravel(np.asarray(given))]
    if count is not None and count < 0:
        fail(gl.GL_INVALID_VALUE, operation, f"n={count}: expected 0 or more")
        return []
    return names if count is None else names[:count]
