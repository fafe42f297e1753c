"""Named surfaces and edges in world space."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

Color = tuple[float, float, float, float]


@dataclass(frozen=True, eq=False)
class Surface:
    """Triangles under one name.

    Attributes
    ----------
    name : str                   "volume/LIGHT/CASTER/sides": what it is, then whose it is
    positions : (V, 3) float32   world space
    triangles : (T, 3) int32     counter-clockwise from outside
    color : 4 floats             red, green, blue and opacity, 0 to 1
    notes : dict                 written to the file: numbers and texts
    """

    name: str
    positions: np.ndarray
    triangles: np.ndarray
    color: Color
    notes: Mapping[str, Any] = field(default_factory=dict)

    @property
    def faces(self) -> np.ndarray:
        """(T, 3, 3) float32: the corners of every triangle."""
        return self.positions[self.triangles]


@dataclass(frozen=True, eq=False)
class Edges:
    """Straight edges under one name: `ends` (E, 2, 3) float32 in world space; the rest as in `Surface`."""

    name: str
    ends: np.ndarray
    color: Color
    notes: Mapping[str, Any] = field(default_factory=dict)


def kind_of(piece: Surface | Edges) -> str:
    """Return what a piece is: the first part of its name."""
    return piece.name.partition("/")[0]


def surface(name: str, corners: np.ndarray, color: Color, **notes: Any) -> Surface:
    """Return triangles (T, 3, 3) as a surface: corners at the same position become one."""
    positions = corners.reshape(-1, 3).astype(np.float32) + np.float32(0)  # adding 0 turns -0 into 0
    different, indices = np.unique(positions, axis=0, return_inverse=True)
    return Surface(name, different, indices.reshape(-1, 3).astype(np.int32), color, notes)
