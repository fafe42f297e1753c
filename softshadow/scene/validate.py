"""Checks of the values that define cameras, lights, materials and objects."""

from typing import Any

import numpy as np

from softshadow.errors import SceneError

LONGEST = 600  # characters of a message


def validate_numbers(key: str, value: Any, length: int) -> np.ndarray:
    """Return `length` finite numbers as float64.

    Raises
    ------
    SceneError      another length, or not finite numbers; names `key` and the value
    """
    try:
        array = np.array(value, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        array = np.zeros(0)
    if array.shape != (length,) or not np.isfinite(array).all():
        raise SceneError(f"{key}: expected {length} finite numbers, got {shortened(spelled(value))}")
    return array


def validate_number(key: str, value: Any) -> float:
    """Return one finite number.

    Raises
    ------
    SceneError      not a finite number; names `key` and the value
    """
    return float(validate_numbers(key, [value], 1)[0])


def spelled(value: Any) -> str:
    """Return how Python writes a value, also a whole number with more digits than Python writes."""
    try:
        return repr(value)
    except ValueError:
        return "a whole number of thousands of digits"


def shortened(text: str) -> str:
    """Return a text, without its middle if it is very long: messages may quote what files hold."""
    return text if len(text) <= LONGEST else f"{text[: LONGEST // 2]} … {text[-LONGEST // 2 :]}"


def set_fields(frozen: Any, **values: Any) -> None:
    """Set the fields of a frozen dataclass in its `__init__`, and make arrays read-only."""
    for key, value in values.items():
        if isinstance(value, np.ndarray):
            value.flags.writeable = False
        object.__setattr__(frozen, key, value)
