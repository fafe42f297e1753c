"""Numbers as GL takes them: integers that stand for colours, vectors of a given length.

References: GL 2.1, table 2.9; the order of operations and roundings is that of Mesa's main/macros.h.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

LARGEST_INT = 2**31 - 1
ONE, TWO = np.float32(1), np.float32(2)
BYTE_STEP, SHORT_STEP = ONE / np.float32(255), ONE / np.float32(65535)
INT_STEP, UNSIGNED_INT_STEP = 1 / 4294967294.0, 1 / 4294967295.0


def from_byte(b: int) -> float:
    return float((TWO * np.float32(b) + ONE) * BYTE_STEP)


def from_unsigned_byte(b: int) -> float:
    return float(np.float32(b) / np.float32(255))


def from_short(s: int) -> float:
    return float((TWO * np.float32(s) + ONE) * SHORT_STEP)


def from_unsigned_short(s: int) -> float:
    return float(np.float32(s) * SHORT_STEP)


def from_int(i: int) -> float:
    """Return the float that an integer stands for: -(2**31) is -1, 2**31 - 1 is 1."""
    return float(np.float32(float(TWO * np.float32(i) + ONE) * INT_STEP))


def from_unsigned_int(i: int) -> float:
    return float(np.float32(i * UNSIGNED_INT_STEP))


def to_int(value: float) -> int:
    """Return the integer that stands for a float in -1 to 1: what glGetIntegerv answers for colours and depths."""
    scaled = 2147483647.0 * value
    return int(scaled) if -2147483648.0 <= scaled <= 2147483647.0 else -2147483648


def nearest_int(value: float) -> int:
    """Return the nearest int that there is, halves away from zero, as C's lround: what glGetIntegerv answers else."""
    return min(int(math.copysign(math.floor(abs(value) + 0.5), value)), LARGEST_INT)


def vector(params: Any, length: int, convert: Callable[[Any], float] = float) -> Sequence[float]:
    """Return the first `length` numbers of a vector argument.

    Raises
    ------
    ValueError
        There are fewer.
    """
    values = np.ravel(params)
    if len(values) < length:
        raise ValueError(f"params={params!r}: expected {length} numbers")
    return [convert(value) for value in values[:length].tolist()]


def first(params: Any) -> Any:
    """Return the first number of a vector argument."""
    return np.ravel(params)[0].item()


def as_floats(value: Any) -> Any:
    """Return what a query answers: a float, or an array float32; None after an error."""
    if isinstance(value, tuple):
        return np.array(value, np.float32)
    return None if value is None else float(np.float32(value))


def as_ints(value: Any, convert: Callable[[float], int]) -> Any:
    """Return what an integer query answers: an int, or an array int32; None after an error."""
    if isinstance(value, tuple):
        return np.array([convert(float(np.float32(v))) for v in value], np.int32)
    return None if value is None else convert(value)
