"""Hit records and feedback values as Python objects, as PyOpenGL returns them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from softshadow import tokens as gl

ONE_VERTEX = (gl.GL_POINT_TOKEN, gl.GL_BITMAP_TOKEN, gl.GL_DRAW_PIXEL_TOKEN, gl.GL_COPY_PIXEL_TOKEN)
TWO_VERTICES = (gl.GL_LINE_TOKEN, gl.GL_LINE_RESET_TOKEN)
LARGEST_DEPTH = float(0xFFFFFFFF)


@dataclass
class HitRecord:
    """A hit: nearest and farthest depth, 0 to 1, and the names, the topmost last. It unpacks like a tuple of three."""

    near: float
    far: float
    names: list[int]

    def __getitem__(self, key: int | str) -> Any:
        return getattr(self, key) if isinstance(key, str) else (self.near, self.far, self.names)[key]


@dataclass
class FeedbackVertex:
    """A vertex of the feedback buffer: float32 arrays, None for what its type leaves out."""

    vertex: np.ndarray
    color: np.ndarray | None = None
    texture: np.ndarray | None = None


def select_records(buffer: np.ndarray, hits: int) -> list[HitRecord]:
    """Return the records in a selection buffer."""
    records, place = [], 0
    for _ in range(hits):
        count, near, far = (int(number) for number in buffer[place : place + 3])
        names = [int(name) for name in buffer[place + 3 : place + 3 + count]]
        records.append(HitRecord(near / LARGEST_DEPTH, far / LARGEST_DEPTH, names))
        place += 3 + count
    return records


def feedback_tokens(buffer: np.ndarray, count: int, kind: int) -> list[tuple[Any, ...]]:
    """Return the values in a feedback buffer as tuples: a token, then its vertices or its number."""
    n_coordinates = {gl.GL_2D: 2, gl.GL_4D_COLOR_TEXTURE: 4}.get(kind, 3)
    has_color = kind not in (gl.GL_2D, gl.GL_3D)
    has_texture = kind in (gl.GL_3D_COLOR_TEXTURE, gl.GL_4D_COLOR_TEXTURE)
    size = n_coordinates + 4 * has_color + 4 * has_texture
    place = 0
    tokens: list[tuple[Any, ...]] = []

    def vertices(number: int) -> list[FeedbackVertex]:
        nonlocal place
        found = []
        for _ in range(number):
            row = buffer[place : place + size]
            color = row[n_coordinates : n_coordinates + 4] if has_color else None
            found.append(FeedbackVertex(row[:n_coordinates], color, row[n_coordinates + 4 :] if has_texture else None))
            place += size
        return found

    while place < count:
        token = int(buffer[place])
        place += 1
        if token == gl.GL_PASS_THROUGH_TOKEN:
            tokens.append((token, buffer[place]))
            place += 1
        elif token == gl.GL_POLYGON_TOKEN:
            place += 1
            tokens.append((token, *vertices(int(buffer[place - 1]))))
        else:
            tokens.append((token, *vertices(2 if token in TWO_VERTICES else 1)))
    return tokens
