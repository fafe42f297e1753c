"""Memory that glMapBuffer returns: an address, as in PyOpenGL, that can also be used like an array."""

from __future__ import annotations

from typing import Any

import numpy as np


class MappedMemory(int):
    """The address of mapped bytes, with the bytes as `array` (n,) uint8.

    As an int it fits where PyOpenGL's programs pass a pointer: ``ctypes.memmove``, ``ctypes.cast``,
    ``(GLfloat * n).from_address``. Reading and writing items, and `view`, are those of the array.

    Examples
    --------
    >>> memory = MappedMemory.of(np.zeros(8, np.uint8))
    >>> memory.view(np.float32)[1] = 1
    >>> memory[:].tolist(), len(memory), memory == memory.array.ctypes.data
    ([0, 0, 0, 0, 0, 0, 128, 63], 8, True)
    """

    array: np.ndarray

    @classmethod
    def of(cls, array: np.ndarray) -> MappedMemory:
        """Return the memory of contiguous bytes."""
        memory = cls(array.ctypes.data)
        memory.array = array
        return memory

    def __len__(self) -> int:
        return len(self.array)

    def __getitem__(self, key: Any) -> Any:
        return self.array[key]

    def __setitem__(self, key: Any, values: Any) -> None:
        self.array[key] = values

    def view(self, dtype: Any) -> np.ndarray:
        """Return the bytes as an array of another type, writeable."""
        return self.array.view(dtype)
