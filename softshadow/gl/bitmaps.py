"""glBitmap: a pattern of pixels at the raster position, as the text of GLUT draws it.

A bitmap becomes a draw: a quad for each run of set bits in a row. So it goes through the same tests as any other
fragment, and the history of a pixel shows it.

References: GL 2.1, sec. 3.7; drawpix.c and st_cb_bitmap.c of Mesa 22.3.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import current
from softshadow.frozen import evolve
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.errors import fail, outside_begin
from softshadow.gl.framebuffers import framebuffer_status
from softshadow.gl.pixel_memory import source
from softshadow.gl.render_modes import is_rendered
from softshadow.gl.window_quads import draw_of_quads
from softshadow.pixel_store import bitmap_rows

KEPT_BYTES = 512  # of a bitmap up to which it may be a character, which is drawn again
ROUNDING = np.float32(0.0001)  # of Mesa: so much below a whole number is still that number


def glBitmap(
    width: int, height: int, xorig: float, yorig: float, xmove: float, ymove: float, bitmap: Any = None
) -> None:
    """Draw the set bits of a bitmap in the raster colour, then move the raster position.

    Parameters
    ----------
    width, height : int          in pixels
    xorig, yorig : float         the place of the raster position in the bitmap
    xmove, ymove : float         added to the raster position, in pixels
    bitmap : bytes or array      rows from bottom to top, eight pixels a byte, as glPixelStore says; None draws nothing

    Raises
    ------
    GLError
        GL_INVALID_VALUE for a negative size; GL_INVALID_FRAMEBUFFER_OPERATION without a complete framebuffer.
    ValueError
        The bitmap has too few bytes.
    """
    context, bits = current(), None
    store = context.unpack_store
    if (bitmap is not None or store.buffer) and width > 0 and height > 0:  # read now, also for a display list
        bytes_of_row = -(-(store.row_length or width) // (8 * store.alignment)) * store.alignment
        bitmap = source(context, bitmap, (store.skip_rows + int(height)) * bytes_of_row, 1, "glBitmap")
        if bitmap is None:
            return
        content = bitmap.tobytes() if isinstance(bitmap, np.ndarray) else bitmap
        rows = _kept_rows if isinstance(content, bytes) and len(content) <= KEPT_BYTES else bitmap_rows
        bits = rows(content, context.unpack_store, int(width), int(height), "glBitmap")
    _bitmap(width, height, xorig, yorig, xmove, ymove, bits)


@in_lists
def _bitmap(
    width: int, height: int, xorig: float, yorig: float, xmove: float, ymove: float, bits: np.ndarray | None
) -> None:
    context = outside_begin("glBitmap")
    if context is None:
        return
    if width < 0 or height < 0:
        fail(gl.GL_INVALID_VALUE, "glBitmap", f"width={width}, height={height}: expected 0 or more")
        return
    if not context.current.raster.valid:
        return
    name = context.state.draw_framebuffer
    if framebuffer_status(context, name) != gl.GL_FRAMEBUFFER_COMPLETE:
        fail(gl.GL_INVALID_FRAMEBUFFER_OPERATION, "glBitmap", f"framebuffer {name} is not complete")
        return
    x, y, *rest = context.current.raster.window  # the sums below are in float32
    if is_rendered(context, gl.GL_BITMAP_TOKEN) and bits is not None:
        quads = _kept_runs(bits.tobytes(), bits.shape) if bits.size <= 8 * KEPT_BYTES else runs(bits)
        if len(quads):
            left = math.floor(x + ROUNDING - np.float32(xorig))
            bottom = math.floor(y + ROUNDING - np.float32(yorig))
            context.execute(draw_of_quads(context, quads + np.array([left, bottom, left, bottom]), context.state))
    window = float(x + np.float32(xmove)), float(y + np.float32(ymove)), *rest
    context.current.raster = evolve(context.current.raster, window=window)


def runs(bits: np.ndarray) -> np.ndarray:
    """Return (left, bottom, right, top) of each run of set bits in a row, (N, 4) integers.

    Examples
    --------
    >>> runs(np.array([[True, True, False, True]])).tolist()
    [[0, 0, 2, 1], [3, 0, 4, 1]]
    """
    padded = np.zeros((len(bits), bits.shape[1] + 2), np.int8)
    padded[:, 1:-1] = bits
    steps = np.diff(padded, axis=1)
    row, begin = np.nonzero(steps == 1)
    end = np.nonzero(steps == -1)[1]
    return np.stack([begin, row, end, row + 1], axis=1)


# those of the characters of a text
_kept_rows = lru_cache(256)(bitmap_rows)


@lru_cache(256)
def _kept_runs(bits: bytes, shape: tuple[int, int]) -> np.ndarray:
    return runs(np.frombuffer(bits, bool).reshape(shape))


__all__ = spelled_like_gl(globals())
