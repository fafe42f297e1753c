"""The part of a context that makes arrays of numbers in its precision."""

from __future__ import annotations

import struct
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

import numpy as np


class Precision:
    """The precision of a context.

    Attributes
    ----------
    real : type                  float32 for "mesa", float64 for "exact"
    """

    real: type[np.floating]

    def set_precision(self, precision: str) -> None:
        """Set the precision, "mesa" or "exact"."""
        self.real = np.float64 if precision == "exact" else np.float32
        self._dtype = np.dtype(self.real)

    def frozen(self, values: Any) -> np.ndarray:
        """Return the values as a read-only array in the context's precision; too large ones become infinite."""
        with np.errstate(over="ignore"):
            array = np.array(values, self.real)
        array.setflags(write=False)
        return array

    def packed(self, numbers: Sequence[float], *shape: int) -> np.ndarray:
        """Return what `frozen` returns of plain numbers, one dimension by default, in a third of the time.

        The array must belong to one draw: the recording counts its bytes without looking for others that share it.
        """
        dtype, n = self._dtype, len(numbers)
        return np.ndarray(shape or n, dtype, _packer(n, dtype.char)(*numbers))

    def repeated(self, row: Sequence[float], count: int) -> np.ndarray:
        """Return what `packed` returns of `count` equal rows."""
        dtype, width = self._dtype, len(row)
        return np.ndarray((count, width), dtype, _packer(width, dtype.char)(*row) * count)

    def rows(self, numbers: Sequence[float], width: int) -> np.ndarray:
        """Return what `packed` returns, as rows of so many numbers."""
        return self.packed(numbers, len(numbers) // width, width)

    def constant(self, row: Sequence[float], count: int) -> np.ndarray:
        """Return a read-only view of `count` equal rows."""
        dtype, width = self._dtype, len(row)
        return np.ndarray((count, width), dtype, _packer(width, dtype.char)(*row), 0, (0, dtype.itemsize))


@dataclass(eq=False, slots=True)
class LatestRows:
    """The rows of the latest value of an attribute; nothing is kept of earlier ones: programs set many colours."""

    value: tuple[float, ...] | None = None
    rows: np.ndarray = field(default_factory=lambda: np.empty((0, 0)))

    def of(self, precision: Precision, value: tuple[float, ...], count: int) -> np.ndarray:
        """Return a read-only view of `count` equal rows."""
        if value is not self.value or count != len(self.rows):
            self.value, self.rows = value, precision.constant(value, count)
        return self.rows


@lru_cache(maxsize=256)
def _packer(count: int, kind: str) -> Callable[..., bytes]:
    return struct.Struct(f"{count}{kind}").pack
