"""The named maps of a step or a run: arrays by name, which print and display as a summary."""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow.errors import nearest
from softshadow.inspection.pictures import Shown, contact_sheet, is_visibility, map_pictures, notebook_display
from softshadow.inspection.words import maps_in_words


class Maps(dict[str, np.ndarray]):
    """Maps by name, row 0 on top. A name that is not there is answered with the nearest one."""

    def __missing__(self, name: str) -> np.ndarray:
        raise KeyError(f"there is no map {name!r}: {nearest(str(name), self)}" if self else "there are no maps")

    def __repr__(self) -> str:
        return "\n".join(f"{name}  {summary(values)}" for name, values in self.items()) or "no maps"

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> Shown:
        """Return what a notebook displays: the maps as pictures."""
        if not self:
            return {"text/plain": repr(self)}, {}
        return notebook_display(repr(self), contact_sheet([("", map_pictures(self))]), self.describe())

    def describe(self) -> str:
        """Return what the pictures of the maps show, in words: sizes, counts and ranges."""
        return maps_in_words(self) or "no maps"

    @property
    def stored(self) -> dict[str, np.ndarray]:
        """The maps that a technique has drawn into textures or computed on the way, without those of the result."""
        return {name: values for name, values in self.items() if not is_result(name)}


def is_result(name: str) -> bool:
    """Return whether a map says what came out at each pixel: the visibility, and where it is defined or unknown."""
    return is_visibility(name) or name == "valid" or name.partition(":")[0] == "unknown"


def summary(values: np.ndarray) -> str:
    """Return the size, type and range of an array.

    Examples
    --------
    >>> summary(np.array([[0.25, 1.0]], np.float32))
    '2 x 1 float32, 0.25 to 1'
    >>> summary(np.array([[True, False, True]]))
    '3 x 1 bool, 2 true'
    """
    height, width, *channels = values.shape
    kind = f"{width} x {height} {''.join(f'x {n} ' for n in channels)}{values.dtype}"
    if values.dtype == np.bool_:
        return f"{kind}, {np.count_nonzero(values)} true"
    finite = values[np.isfinite(values)]
    return f"{kind}, {finite.min():.4g} to {finite.max():.4g}" if finite.size else kind
