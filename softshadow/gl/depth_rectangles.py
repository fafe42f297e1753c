"""Rectangles of depths and stencil values: what glDrawPixels and glCopyPixels of them become.

References: GL 2.1, sec. 3.6.4, 4.3.3; st_cb_drawpixels.c of Mesa 22.3.
"""

from __future__ import annotations

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.framebuffer import Framebuffer
from softshadow.frozen import evolve
from softshadow.gl.errors import fail
from softshadow.gl.render_modes import is_rendered
from softshadow.gl.window_quads import textured_rectangle
from softshadow.image import D24, D32F, FORMATS, storage_format
from softshadow.pipeline.buffers.copy import bottom_up, clipped
from softshadow.pipeline.commands import DrawDepths
from softshadow.pixel_transfer import PixelTransfer
from softshadow.pixels import (
    quantized_depth,
    sampled_depth,
    unpack_depth,
    unpack_packed_depth,
    unpack_packed_stencil,
    unpack_stencil,
)

Rectangle = tuple[int, int, int, int]  # x, y, width, height
FLOATS = storage_format(gl.GL_RGBA32F)
STORED = {  # type of depths: format of Mesa's texture, else 24 bits
    gl.GL_UNSIGNED_SHORT: FORMATS[gl.GL_DEPTH_COMPONENT16],
    gl.GL_UNSIGNED_INT: FORMATS[gl.GL_DEPTH_COMPONENT32],
    gl.GL_FLOAT: D32F,
    gl.GL_FLOAT_32_UNSIGNED_INT_24_8_REV: D32F,
}


def texture_of_depths(context: Context, image: np.ndarray, format: int, type: int) -> np.ndarray:
    """Return client pixels (h, w, 1) as a texture float32: (h, w, 4), depth in red and stencil values in green.

    Either alone is (h, w), a depth texture, which a lookup reads as red and green.

    Shift and offset of indices do not apply, as in Mesa.
    """
    transfer, stored, elements = context.pixel_transfer, STORED.get(type, D24), image[..., 0]
    transfer = evolve(transfer, index_shift=0, index_offset=0)
    depth = stencil = None
    if format == gl.GL_DEPTH_COMPONENT:
        depth = sampled_depth(unpack_depth(elements, stored, transfer), stored)
    elif format == gl.GL_DEPTH_STENCIL:
        depth = sampled_depth(unpack_packed_depth(elements, stored, transfer), stored)
        maps = transfer.changes_depth or type != gl.GL_UNSIGNED_INT_24_8  # else Mesa copies the words
        stencil = unpack_packed_stencil(elements, transfer if maps else PixelTransfer())
    else:
        maps = type != gl.GL_UNSIGNED_BYTE  # else Mesa copies the bytes
        stencil = unpack_stencil(elements, transfer if maps else PixelTransfer())
    return _cells(elements.shape, depth, stencil)


def _cells(shape: tuple[int, ...], depth: np.ndarray | None, stencil: np.ndarray | None) -> np.ndarray:
    values = stencil if depth is None else depth
    if values is not None and (depth is None or stencil is None):
        return values.astype(np.float32, copy=False)
    cells = np.zeros((*shape, 4), np.float32)
    if depth is not None:
        cells[..., 0] = depth
    if stencil is not None:
        cells[..., 1] = stencil
    return cells


def draw_rectangle_of_depths(
    context: Context, cells: np.ndarray, has_depth: bool, has_stencil: bool, left: int = 0, bottom: int = 0
) -> None:
    """Draw a texture of `texture_of_depths` so many pixels from the raster position."""
    raster = context.current.raster
    if raster.valid:
        stored = (D32F, gl.GL_DEPTH_COMPONENT32F) if cells.ndim == 2 else (FLOATS, gl.GL_RGBA32F)
        draw = textured_rectangle(context, cells, *stored, left, bottom)
        red, green, blue, alpha = raster.color
        context.execute(DrawDepths(draw, (red, green, blue, alpha), has_depth, has_stencil))


# -- glCopyPixels ------------------------------------------------------------------------------------------------------
def copy_depths(context: Context, source: Framebuffer, rectangle: Rectangle, type: int, operation: str) -> None:
    """Copy a rectangle of depths, stencil values or both of a framebuffer to the raster position."""
    target = context.objects.framebuffers[context.state.draw_framebuffer]
    has_depth, has_stencil = type != gl.GL_STENCIL, type != gl.GL_DEPTH
    for framebuffer in (source, target):
        if (has_depth and framebuffer.depth is None) or (has_stencil and framebuffer.stencil is None):
            kind = "depth" if has_depth and framebuffer.depth is None else "stencil"
            fail(gl.GL_INVALID_OPERATION, operation, f"framebuffer {framebuffer.name} has no {kind} buffer")
            return
    if not context.current.raster.valid or not is_rendered(context, gl.GL_COPY_PIXEL_TOKEN) or 0 in rectangle[2:]:
        return
    context.finish()
    rows, columns, left, bottom = clipped(source, *rectangle)
    z = stencil = None
    if has_depth and source.depth is not None:
        stored, depth = source.depth.format, bottom_up(source, source.depth)[rows, columns]
        if not has_stencil:  # Mesa's copy into the texture goes through float32
            depth = quantized_depth(sampled_depth(depth, stored), stored)
        z = sampled_depth(depth, stored)
    if has_stencil and source.stencil is not None:
        stencil = bottom_up(source, source.stencil)[rows, columns]
    shape = (rows.stop - rows.start, columns.stop - columns.start)
    if 0 not in shape:
        draw_rectangle_of_depths(context, _cells(shape, z, stencil), has_depth, has_stencil, left, bottom)


__all__ = ["copy_depths", "draw_rectangle_of_depths", "texture_of_depths"]
