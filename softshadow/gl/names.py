"""Object names: shared by the glGen* and glDelete* calls."""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.gl.errors import fail, outside_begin


MOST_NAMES = 1 << 22  # that one call returns: more would fill the memory


def has_memory_for(operation: str, argument: str, n: int) -> bool:
    """Return whether a call may return so many names; record GL_OUT_OF_MEMORY otherwise."""
    if n > MOST_NAMES:
        fail(gl.GL_OUT_OF_MEMORY, operation, f"{argument}={n}: a call returns {MOST_NAMES} names at most")
    return n <= MOST_NAMES


def generate(operation: str, kind: str, n: int, names: Any = None) -> Any:
    """Return the names of a glGen* call: never used before, counting up as in Mesa.

    As in PyOpenGL, one name is an int, several are an array; an array `names` is filled, too.
    """
    if (context := outside_begin(operation)) is None:
        return None
    if n < 0:
        return fail(gl.GL_INVALID_VALUE, operation, f"n={n}: expected 0 or more")
    if not has_memory_for(operation, "n", n):
        return None
    first = context.names[kind] + 1
    context.names[kind] += n
    generated = np.arange(first, first + n, dtype=np.uint32)
    if names is not None:
        np.asarray(names)[:n] = generated
    return first if n == 1 else generated


def reserve(context: Context, kind: str, name: int) -> None:
    """Mark a name as used: programs may choose names that glGen* has not returned."""
    context.names[kind] = max(context.names[kind], name)


def names_argument(operation: str, arguments: tuple[Any, ...]) -> list[int]:
    """Return the names in the arguments of a glDelete* call: (name), (names) or (n, names); [] after an error."""
    n, array = (arguments[0], arguments[1]) if len(arguments) == 2 else (None, arguments[0])
    names = [int(name) for name in np.ravel(np.asarray(array))]
    if n is not None and n < 0:
        fail(gl.GL_INVALID_VALUE, operation, f"n={n}: expected 0 or more")
        return []
    return names if n is None else names[:n]
