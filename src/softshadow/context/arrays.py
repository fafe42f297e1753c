"""Vertex arrays and buffer objects: what pointer calls gave."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from softshadow import tokens as gl


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
    converted: dict[Any, tuple[np.ndarray, np.ndarray]] = field(default_factory=dict)
    active_unit: int = 0

    def layout(self, name: str) -> ArrayLayout:
        """Return the layout of an array, GL's initial one where there was no pointer call."""
        return self.layouts.get(name, ArrayLayout())
