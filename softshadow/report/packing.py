"""Arrays as text in a page: exact bytes, deflated; equal arrays are stored once, and their sum has a limit.

A browser inflates them with DecompressionStream. PNG would do for colours only, and a canvas may change its values.
"""

from __future__ import annotations

import base64
import zlib
from collections.abc import Sequence
from hashlib import blake2b
from typing import Any

import numpy as np

LIMIT = 5 << 20  # characters of all arrays of a page
LEVEL = 9  # of zlib
BEST_RATIO = 800  # deflated bytes are never much fewer than the 1000th part


class Packing:
    """The arrays of a page, by number.

    Attributes
    ----------
    arrays : list                of JSON objects: kind, shape, rows (whether rows are differences), data
    left_out : dict              by title of the parts that the page does not have: why
    """

    def __init__(self, limit: int = LIMIT) -> None:
        self.limit, self.used = limit, 0
        self.arrays: list[dict[str, Any]] = []
        self.left_out: dict[str, str] = {}
        self._numbers: dict[bytes, int] = {}

    def add(self, title: str, arrays: Sequence[np.ndarray]) -> list[int] | None:
        """Add the arrays of one part, all or none; return their numbers, or None if they had no room."""
        keys = [key_of(array) for array in arrays]
        new = {key: array for key, array in zip(keys, arrays, strict=True) if key not in self._numbers}
        packed: dict[bytes, dict[str, Any]] = {}
        size = self.used
        for key, array in new.items():
            if size + array.nbytes // BEST_RATIO <= self.limit:
                packed[key] = packed_array(array)
                size += len(packed[key]["data"])
            if key not in packed or size > self.limit:
                self.leave_out(title, f"the page would exceed {self.limit / 1e6:.2g} MB")
                return None
        for key, each in packed.items():
            self._numbers[key] = len(self.arrays)
            self.arrays.append(each)
        self.used = size
        return [self._numbers[key] for key in keys]

    def leave_out(self, title: str, reason: str) -> None:
        """Note that the page does not have a part."""
        self.left_out[title] = reason

    @property
    def notices(self) -> list[str]:
        """What the page has to say about the parts that it does not have."""
        return [f"This page does not have the {title}: {reason}." for title, reason in self.left_out.items()]


def key_of(array: np.ndarray) -> bytes:
    """Return a digest that equal arrays of one type share."""
    digest = blake2b(np.ascontiguousarray(array).tobytes(), digest_size=16)
    digest.update(f"{array.dtype} {array.shape}".encode())
    return digest.digest()


def packed_array(array: np.ndarray) -> dict[str, Any]:
    """Return an array as a JSON object with deflated data: as it is, or as differences of rows if that is smaller.

    The channels of (H, W, C) come one after the other. The bytes of larger numbers are grouped by place: all lowest
    bytes first. Differences of four bytes have their sign in the lowest bit, so that small ones have zeros above.
    """
    planar = np.moveaxis(array, 2, 0) if array.ndim == 3 else array
    grid = np.ascontiguousarray(planar).reshape(-1, planar.shape[-1] if planar.ndim > 1 else 1)
    if grid.dtype == np.bool_:
        grid = grid.view(np.uint8)
    choices = [(False, deflated(grid))]
    if grid.itemsize in (1, 4):
        choices.append((True, deflated(row_differences(grid))))
    rows, data = min(choices, key=lambda choice: len(choice[1]))
    return {
        "kind": str(array.dtype),
        "shape": list(array.shape),
        "rows": rows,
        "data": base64.b64encode(data).decode(),
    }


def deflated(grid: np.ndarray) -> bytes:
    """Return numbers with their bytes grouped by place, deflated."""
    by_place = grid.reshape(-1).view(np.uint8).reshape(-1, grid.itemsize).T
    return zlib.compress(by_place.tobytes(), LEVEL)


def row_differences(grid: np.ndarray) -> np.ndarray:
    """Return the differences of each row (N, W) from the row before it, as unsigned numbers of 1 or 4 bytes."""
    unsigned = grid.view(f"u{grid.itemsize}")
    differences = unsigned.copy()
    differences[1:] -= unsigned[:-1]
    if grid.itemsize == 1:
        return differences
    return (differences << np.uint32(1)) ^ (differences.view(np.int32) >> 31).view(np.uint32)
