"""Conversion of arguments and answers: integers that represent colours, vectors of a fixed length.

References: GL 2.1, table 2.9; operations and roundings in the order of Mesa's main/macros.h.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Sequence
from ctypes import c_int, c_short, c_uint, c_ushort
from typing import Any

import numpy as np

SMALLEST_INT, LARGEST_INT = -(2**31), 2**31 - 1
ONE, TWO = np.float32(1), np.float32(2)
# functions that pack and unpack so many numbers in single precision; too large ones become infinite
SINGLES = tuple((each.pack, each.unpack) for each in (struct.Struct(f"{count}f") for count in range(5)))
PACK_SINGLE, UNPACK_SINGLE = SINGLES[1]
PACK_PAIR, UNPACK_PAIR = SINGLES[2]
BYTE_STEP, SHORT_STEP = ONE / np.float32(255), ONE / np.float32(65535)
INT_STEP, UNSIGNED_INT_STEP = 1 / 4294967294.0, 1 / 4294967295.0
# what bytes represent, by their bits
OF_UNSIGNED_BYTES: list[float] = (np.arange(256, dtype=np.float32) / np.float32(255)).tolist()
OF_BYTES: list[float] = (
    (TWO * np.arange(256, dtype=np.uint8).view(np.int8).astype(np.float32) + ONE) * BYTE_STEP
).tolist()


def single(value: float) -> float:
    """Return a number rounded to single precision."""
    number: float = UNPACK_SINGLE(PACK_SINGLE(value))[0]
    return number


def singles(values: Sequence[float]) -> Any:
    """Return up to four numbers rounded to single precision."""
    pack, unpack = SINGLES[len(values)]
    return unpack(pack(*values))


def from_byte(b: int) -> float:
    """Return the float that a byte represents: -128 is -1, 127 is 1."""
    return OF_BYTES[int(b) & 255]


def from_unsigned_byte(b: int) -> float:
    """Return the float that an unsigned byte represents: 255 is 1."""
    return OF_UNSIGNED_BYTES[int(b) & 255]


def from_short(s: int) -> float:
    """Return the float that a short represents: -32768 is -1, 32767 is 1."""
    return float((TWO * np.float32(c_short(int(s)).value) + ONE) * SHORT_STEP)


def from_unsigned_short(s: int) -> float:
    """Return the float that an unsigned short represents: 65535 is 1."""
    return float(np.float32(c_ushort(int(s)).value) * SHORT_STEP)


def from_int(i: int) -> float:
    """Return the float that an int represents: -(2**31) is -1, 2**31 - 1 is 1."""
    return float(np.float32(float(TWO * np.float32(c_int(int(i)).value) + ONE) * INT_STEP))


def from_unsigned_int(i: int) -> float:
    """Return the float that an unsigned int represents: 2**32 - 1 is 1."""
    return float(np.float32(c_uint(int(i)).value * UNSIGNED_INT_STEP))


def to_int(value: float) -> int:
    """Return the int that represents a float in [-1, 1]: glGetIntegerv of colours, normals and depths."""
    scaled = 2147483647.0 * value
    return int(scaled) if -2147483648.0 <= scaled <= 2147483647.0 else -2147483648


def nearest_int(value: float) -> int:
    """Return the nearest int, halves away from zero, as C's lround: glGetIntegerv of other floats.

    As in Mesa on x86, too large floats lose their upper bits, and what has no place in 64 bits becomes 0; too large
    ints, which are masks, become the largest one.
    """
    if isinstance(value, int):
        return min(value, LARGEST_INT)
    if not abs(value) < 2.0**63:  # NaN, too
        return 0
    return c_int(int(math.copysign(math.floor(abs(value) + 0.5), value))).value


def clamped_int(value: float) -> int:
    """Return the nearest int of those that there are, halves away from zero; -(2**31) for NaN."""
    return nearest_int(min(max(float(SMALLEST_INT), value), float(LARGEST_INT)))


def truncated_int(value: float) -> int:
    """Return a float without its fraction, -(2**31) where it has no place in 32 bits: C's cast on x86."""
    return int(value) if SMALLEST_INT <= value <= LARGEST_INT else SMALLEST_INT


def enum(value: float) -> int:
    """Return the enum that a number stands for, -1 where it stands for none."""
    return int(value) if math.isfinite(value) else -1


# dtype that an array is converted to: PyOpenGL passes GL the type in the call's name
ELEMENTS: dict[Callable[[Any], Any], type[np.generic]] = {
    from_byte: np.int8,
    from_unsigned_byte: np.uint8,
    from_short: np.int16,
    from_unsigned_short: np.uint16,
    from_int: np.int32,
    from_unsigned_int: np.uint32,
    int: np.int32,
}


SEQUENCES, NUMBERS = (list, tuple), (int, float)


def numbers(params: Any, convert: Callable[[Any], Any] = float) -> np.ndarray:
    """Return a vector argument (array, sequence, bytes, or one number) as a flat array of the call's type.

    For a call with integers, floats are truncated, and too large numbers lose their upper bits.
    """
    element = ELEMENTS.get(convert)
    if isinstance(params, bytes | bytearray | memoryview):
        return np.frombuffer(params, element or np.float32)
    values = np.ravel(params)
    if element is None or values.dtype == element:
        return values
    with np.errstate(invalid="ignore"):
        return values.astype(np.int64).astype(element)


def vector(params: Any, length: int, convert: Callable[[Any], float] = float) -> Sequence[float]:
    """Return the first `length` numbers of a vector argument.

    Raises
    ------
    ValueError
        The argument has fewer numbers.
    """
    if convert is float:
        kind = type(params)
        if kind in SEQUENCES and len(params) >= length:
            try:
                return list(map(float, params[:length]))
            except TypeError:  # nested sequences
                pass
        elif kind is np.ndarray and params.ndim == 1 and params.dtype.char in "fd" and len(params) >= length:
            return params[:length].tolist()
    values = numbers(params, convert)
    if len(values) < length:
        raise ValueError(f"params={params!r}: expected {length} numbers")
    return [convert(value) for value in values[:length].tolist()]


def first(params: Any, convert: Callable[[Any], Any] = float) -> Any:
    """Return the first number of a vector argument.

    Raises
    ------
    ValueError
        The argument is empty.
    """
    if convert is float and type(params) in NUMBERS:
        return params
    values = numbers(params, convert)
    if not len(values):
        raise ValueError(f"params={params!r}: expected a number")
    return values[0].item()


def as_floats(value: Any) -> Any:
    """Return the answer of a float query: a float, or an array float32; None after an error."""
    if isinstance(value, tuple):
        return np.array(value, np.float32)
    return None if value is None else float(np.float32(value))


def as_ints(value: Any, convert: Callable[[float], int]) -> Any:
    """Return the answer of an integer query: an int, or an array int32; None after an error."""
    if isinstance(value, tuple):
        return np.array([convert(float(np.float32(v))) for v in value], np.int32)
    return None if value is None else convert(value)
