"""The state of evaluators: their maps, and what glPushAttrib(GL_EVAL_BIT) saves."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from softshadow import tokens as gl

INITIAL_POINTS: dict[str, tuple[float, ...]] = {
    "VERTEX_3": (0, 0, 0), "VERTEX_4": (0, 0, 0, 1), "INDEX": (1,), "COLOR_4": (1, 1, 1, 1), "NORMAL": (0, 0, 1),
    "TEXTURE_COORD_1": (0,), "TEXTURE_COORD_2": (0, 0), "TEXTURE_COORD_3": (0, 0, 0), "TEXTURE_COORD_4": (0, 0, 0, 1),
}  # fmt: skip
DIMENSIONS = {getattr(gl, f"GL_MAP{n}_{name}"): n for n in (1, 2) for name in INITIAL_POINTS}  # by target
COMPONENTS = {getattr(gl, f"GL_MAP{n}_{name}"): len(point) for n in (1, 2) for name, point in INITIAL_POINTS.items()}


@dataclass(frozen=True, eq=False)
class Map:
    """A Bézier curve or surface: control points (order, k) or (u order, v order, k) float32; u1, u2 (v1, v2)."""

    points: np.ndarray
    domain: tuple[float, ...]

    @cached_property
    def content(self) -> tuple[object, ...]:
        """What is equal for maps with the same bits; -0.0 equals 0.0, but is another number."""
        return self.points.shape, self.points.tobytes(), repr(self.domain)


@dataclass(frozen=True)
class EvaluatorSettings:
    """The enabled maps and GL_AUTO_NORMAL; the grids of glMapGrid1 (n, u1, u2) and glMapGrid2 (two of these)."""

    enabled: frozenset[int] = frozenset()
    grid1: tuple[int, float, float] = (1, 0.0, 1.0)
    grid2: tuple[tuple[int, float, float], tuple[int, float, float]] = ((1, 0.0, 1.0), (1, 0.0, 1.0))


def initial_maps() -> dict[int, Map]:
    """Return the maps of a new context, by target: one control point each."""
    return {
        getattr(gl, f"GL_MAP{n}_{name}"): Map(np.array(point, np.float32).reshape((1,) * n + (-1,)), (0.0, 1.0) * n)
        for n in (1, 2)
        for name, point in INITIAL_POINTS.items()
    }
