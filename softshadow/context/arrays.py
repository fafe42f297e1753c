"""Vertex arrays and buffer objects: what the pointer calls have set."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from softshadow import tokens as gl

CACHE_BYTES = 256 << 20  # converted arrays with their sources: a few meshes of a million triangles


@dataclass(frozen=True)
class ArrayLayout:
    """The layout of a vertex array: components per vertex, GL's type, bytes from vertex to vertex."""

    size: int = 4
    type: int = gl.GL_FLOAT
    stride: int = 0


@dataclass
class BufferObject:
    """The bytes of a buffer object, and its usage hint."""

    content: np.ndarray = field(default_factory=lambda: np.zeros(0, np.uint8))
    usage: int = gl.GL_STATIC_DRAW


class ConvertedArrays:
    """A cache of converted vertex arrays; beyond `CACHE_BYTES` the least recently drawn ones are evicted."""

    def __init__(self) -> None:
        self._cached: dict[Any, tuple[np.ndarray, np.ndarray]] = {}  # least recently used first
        self._bytes = 0

    def get(self, key: Hashable, root: np.ndarray, convert: Callable[[], np.ndarray]) -> np.ndarray:
        """Return the converted array of a key; convert it if it is not cached.

        `root` owns the memory that the key identifies. It is cached too, so that no other array can get its id.
        """
        if key in self._cached:
            self._cached[key] = self._cached.pop(key)
            return self._cached[key][0]
        converted = convert()
        self._cached[key] = converted, root
        self._bytes += _bytes_of(converted, root)
        while self._bytes > CACHE_BYTES and len(self._cached) > 1:
            self._bytes -= _bytes_of(*self._cached.pop(next(iter(self._cached))))
        return converted


def _bytes_of(converted: np.ndarray, root: np.ndarray) -> int:
    return int(converted.nbytes + root.nbytes)


@dataclass
class ClientArrays:
    """Vertex arrays: which are enabled, the array or buffer of each, and the cache of converted arrays.

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
        """Return the layout of an array; before its first pointer call, GL's initial one."""
        return self.layouts.get(name, ArrayLayout())
