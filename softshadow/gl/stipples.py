"""glLineStipple and glPolygonStipple: patterns of bits that leave out fragments of lines and polygons."""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow.context import current, thread
from softshadow.gl.calls import in_lists, is_allowed, spelled_like_gl
from softshadow.gl.errors import outside_begin
from softshadow.gl.pixel_memory import source
from softshadow.pixel_store import bitmap_rows

SIDE = 32  # rows and columns of a polygon stipple
LARGEST_FACTOR = 256


def glLineStipple(factor: int, pattern: int) -> None:
    """Set the pattern of stippled lines: 16 bits, the lowest one first; each stands for `factor` pixels, 1 to 256."""
    context = thread.context
    if context.ready or is_allowed(context, glLineStipple, factor, pattern):
        fields = {"factor": max(1, min(int(factor), LARGEST_FACTOR)), "pattern": int(pattern) & 0xFFFF}
        context.change_fields("lines", fields)


def glPolygonStipple(mask: Any) -> None:
    """Set the pattern of stippled polygons.

    Parameters
    ----------
    mask : bytes or array        32 rows of 32 bits from bottom to top, as glPixelStore says; the highest bit is left;
        with a bound pixel buffer object, an offset into it

    Raises
    ------
    ValueError
        The pattern has too few bytes.
    """
    # read now, also when a display list is compiled
    context = current()
    if context.unpack_store.buffer:
        mask = source(context, mask, SIDE * SIDE // 8, 1, "glPolygonStipple")
        if mask is None:
            return
    bits = bitmap_rows(mask, context.unpack_store, SIDE, SIDE, "glPolygonStipple")
    _polygon_stipple(np.packbits(bits).tobytes())


@in_lists
def _polygon_stipple(stipple: bytes) -> None:
    context = outside_begin("glPolygonStipple")
    if context is not None:
        context.change("polygon", stipple=stipple)


def glGetPolygonStipple(mask: np.ndarray | None = None) -> np.ndarray | None:
    """Return the pattern of stippled polygons, (128,) uint8: 32 rows of four bytes from bottom to top.

    Parameters
    ----------
    mask : array of 128 bytes, optional; it is filled and returned
    """
    context = outside_begin("glGetPolygonStipple")
    if context is None:
        return None
    pattern = np.frombuffer(context.state.polygon.stipple, np.uint8)
    if mask is None:
        return pattern.copy()
    mask.reshape(-1).view(np.uint8)[: len(pattern)] = pattern
    return mask


glGetPolygonStippleub = glGetPolygonStipple

__all__ = spelled_like_gl(globals())
