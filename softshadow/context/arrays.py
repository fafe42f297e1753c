"""Vertex arrays and buffer objects: what pointer calls gave."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from softshadow import tokens as gl

KEPT_BYTES = 256 << 20  # of converted arrays and those they were made from: some meshes of a million triangles


@dataclass(frozen=True)
class ArrayLayout:
    """What a pointer call said besides the array: numbers per vertex, GL's type, bytes from vertex to vertex."""

    size: int = 4
    type: int = gl.GL_FLOAT
    stride: int = 0


@dataclass
class BufferObject:
    """The bytes of a buffer object, and the usage it was given."""

    content: np.ndarray = field(default_factory=lambda: np.zeros(0, np.uint8))
    usage: int = gl.GL_STATIC_DRAW


class ConvertedArrays:
    """What drawn arrays were converted to; beyond `KEPT_BYTES` those drawn longest ago are forgotten."""

    def __init__(self) -> None:
        self._kept: dict[Any, tuple[np.ndarray, np.ndarray]] = {}  # in the order of their last use
        self._bytes = 0

    def get(self, key: Hashable, root: np.ndarray, convert: Callable[[], np.ndarray]) -> np.ndarray:
        """Return the converted array of a key, made where it is not known.

        `root` owns the memory that the key names; it is kept beside the result, so that its id stays its own.
        """
        if key in self._kept:
            self._kept[key] = self._kept.pop(key)
            return self._kept[key][0]
        made = convert()
        self._kept[key] = made, root
        self._bytes += _bytes_of(made, root)
        while self._bytes > KEPT_BYTES and len(self._kept) > 1:
            self._bytes -= _bytes_of(*self._kept.pop(next(iter(self._kept))))
        return made


def _bytes_of(made: np.ndarray, root: np.ndarray) -> int:
    return int(made.nbytes + root.nbytes)


@dataclass
class ClientArrays:
    """Vertex arrays: which are enabled, the array each pointer call gave, and what drawn arrays were converted to.

    Names are "position", "color", "normal", "texcoord0" ...
    """

    enabled: set[str] = field(default_factory=set)
    pointers: dict[str, np.ndarray] = field(default_factory=dict)
    offsets: dict[str, tuple[int, int]] = field(default_factory=dict)  # (buffer object, byte) instead of an array
    array_buffer: int = 0
    element_buffer: int = 0
    layouts: dict[str, ArrayLayout] = field(default_factory=dict)
    converted: ConvertedArrays = field(default_factory=ConvertedArrays)
    active_unit: int = 0

    def layout(self, name: str) -> ArrayLayout:
        """Return the layout of an array, GL's initial one where there was no pointer call."""
        return self.layouts.get(name, ArrayLayout())
