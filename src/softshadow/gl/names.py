"""Names of objects: what glGen* gives out and glDelete* takes back."""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow.context import Context


def generate(context: Context, kind: str, n: int) -> Any:
    """Return `n` names that were never used before, counting up as Mesa does: an int for one, an array for several."""
    first = context.names[kind] + 1
    context.names[kind] += n
    return first if n == 1 else np.arange(first, first + n, dtype=np.uint32)


def take(context: Context, kind: str, name: int) -> None:
    """Remember a name that a program has chosen itself."""
    context.names[kind] = max(context.names[kind], name)


def listed(arguments: tuple[Any, ...]) -> list[int]:
    """Return the names in the arguments of a glDelete* call: (name), (names) or (n, names)."""
    count, given = (arguments[0], arguments[1]) if len(arguments) == 2 else (None, arguments[0])
    names = [int(name) for name in np.ravel(np.asarray(given))]
    return names if count is None else names[:count]
