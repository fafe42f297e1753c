"""The current raster position: where glBitmap draws."""

from __future__ import annotations

from typing import NamedTuple

from softshadow.state import TEXTURE_UNITS


class RasterPosition(NamedTuple):
    """Window x, y, z and clip w, with the colours and texture coordinates that were current; in GL's initial state.

    Nothing is drawn while it is not valid, because it was set outside the view volume.
    """

    window: tuple[float, ...] = (0.0, 0.0, 0.0, 1.0)
    valid: bool = True
    distance: float = 0.0
    color: tuple[float, ...] = (1.0, 1.0, 1.0, 1.0)
    secondary: tuple[float, ...] = (0.0, 0.0, 0.0, 1.0)
    texcoords: tuple[tuple[float, ...], ...] = ((0.0, 0.0, 0.0, 1.0),) * TEXTURE_UNITS


INITIAL_RASTER_POSITION = RasterPosition()
