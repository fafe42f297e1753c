"""Values that were checked once: what the frozen parts of a scene are built with."""

from typing import Any

import numpy as np

from softshadow.errors import SceneError


def numbers(key: str, value: Any, count: int) -> np.ndarray:
    """Return `count` finite numbers as float64, or say which key has something else."""
    try:
        array = np.array(value, dtype=np.float64)
    except (TypeError, ValueError):
        array = np.zeros(0)
    if array.shape != (count,) or not np.isfinite(array).all():
        raise SceneError(f"{key}: expected {count} finite numbers, got {value!r}")
    return array


def number(key: str, value: Any) -> float:
    """Return one finite number, or say which key has something else."""
    return float(numbers(key, [value], 1)[0])


def keep(frozen: Any, **values: Any) -> None:
    """Set the fields of a frozen dataclass in its `__init__`; arrays become read-only."""
    for key, value in values.items():
        if isinstance(value, np.ndarray):
            value.flags.writeable = False
        object.__setattr__(frozen, key, value)
