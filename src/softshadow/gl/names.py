"""Names of objects: what glGen* gives out and glDelete* takes back."""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow.context import Context


def generate(context: Context, kind: str, n: int) -> Any:
    """Return the `n` lowest unused names: an int for one, an array for several, as PyOpenGL does."""
    used = context.names[kind]
    free: list[int] = []
    name = 1
    while len(free) < n:
        if name not in used:
            free.append(name)
        name += 1
    used.update(free)
    return free[0] if n == 1 else np.array(free, np.uint32)


def listed(arguments: tuple[Any, ...]) -> list[int]:
    """Return the names in the arguments of a glDelete* call: (name), (names) or (n, names)."""
    count, given = (arguments[0], arguments[1]) if len(arguments) == 2 else (None, arguments[0])
    names = [int(name) for name in np.ravel(np.asarray(given))]
    return names if count is None else names[:count]
