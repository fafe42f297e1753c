"""Writes shapes of strips call by call."""

from typing import Any

import numpy as np

from softshadow import gl
from softshadow.gl.shape_calls import Calls
from softshadow.gl.shape_strips import Changes, Strip, make_all


class ShapeWriter:
    """A shape of `Calls`, made by the calls that it stands for."""

    def __init__(self) -> None:
        self.calls = Calls()
        self._mode: int | None = None

    def begin(self, mode: int) -> None:
        self._mode, self._positions = mode, list[tuple[float, ...]]()
        self._changes: dict[str, list[tuple[int, tuple[float, ...]]]] = {}

    def vertex(self, *position: float) -> None:
        self._positions.append(position)

    def normal(self, *value: float) -> None:
        self._set("normal", value)

    def coordinates(self, *value: float) -> None:
        self._set("texcoord0", value)

    def end(self) -> None:
        assert self._mode is not None
        changes = {name: Changes(*map(np.array, zip(*each, strict=True))) for name, each in self._changes.items()}
        self.calls.strip(self._mode, np.array(self._positions, np.float64).reshape(-1, 3), **changes)
        self._mode = None

    def _set(self, name: str, value: Any) -> None:
        if self._mode is None:
            self.calls.set(name, *value)
        else:
            self._changes.setdefault(name, []).append((len(self._positions), value))


def call_by_call(shape: Calls) -> None:
    """Make the calls of a shape one by one."""
    for part in shape._parts:
        if isinstance(part, Strip):
            gl.glBegin(part.mode)
            make_all(part.calls())
            gl.glEnd()
        else:
            make_all([part])
