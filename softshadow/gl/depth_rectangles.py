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
from softshadow.gl.window_quads import rounded, textured_rectangle
from softshadow.image import D24, D32F, FORMATS, Image, storage_format
from softshadow.pipeline.buffers.copy import bottom_up, clipped
from softshadow.pipeline.commands import BlitFramebuffer, DrawDepths
from softshadow.pixels import (
    quantized_depth,
    sampled_depth,
    unpack_depth,
    unpack_packed_depth,
    unpack_packed_stencil,
    unpack_stencil,
)
from softshadow.state import Scissor

Rectangle = tuple[int, int, int, int]  # x, y, width, height
FLOATS = storage_format(gl.GL_RGBA32F)
STORED = {  # type of depths: format of Mesa's texture, else 24 bits
    gl.GL_UNSIGNED_SHORT: FORMATS[gl.GL_DEPTH_COMPONENT16],
    gl.GL_UNSIGNED_INT: FORMATS[gl.GL_DEPTH_COMPONENT32],
    gl.GL_FLOAT: D32F,
    gl.GL_FLOAT_32_UNSIGNED_INT_24_8_REV: D32F,
}
MASKS = {
    gl.GL_DEPTH: gl.GL_DEPTH_BUFFER_BIT,
    gl.GL_STENCIL: gl.GL_STENCIL_BUFFER_BIT,
    gl.GL_DEPTH_STENCIL: gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT,
}


def texture_of_depths(context: Context, image: np.ndarray, format: int, type: int) -> np.ndarray:
    """Return client pixels (h, w, 1) as a texture (h, w, 4) float32: depth in red, stencil values in green.

    Shift and offset of indices do not apply, as in Mesa.
    """
    transfer, stored, elements = context.pixel_transfer, STORED.get(type, D24), image[..., 0]
    transfer = evolve(transfer, index_shift=0, index_offset=0)
    depth = stencil = None
    if format == gl.GL_DEPTH_COMPONENT:
        depth = sampled_depth(unpack_depth(elements, stored, transfer), stored)
    elif format == gl.GL_DEPTH_STENCIL:
        depth = sampled_depth(unpack_packed_depth(elements, stored, transfer), stored)
        stencil = unpack_packed_stencil(elements, transfer)
    else:
        stencil = unpack_stencil(elements, transfer)
    return _cells(elements.shape, depth, stencil)


def _cells(shape: tuple[int, ...], depth: np.ndarray | None, stencil: np.ndarray | None) -> np.ndarray:
    cells = np.zeros((*shape, 4), np.float32)
    if depth is not None:
        cells[..., 0] = depth
    if stencil is not None:
        cells[..., 1] = stencil
    return cells


def draw_rectangle_of_depths(
    context: Context, cells: np.ndarray, has_depth: bool, has_stencil: bool, left: int = 0, bottom: int = 0
) -> None:
    """Draw depths, stencil values or both of a texture (h, w, 4) so many pixels from the raster position."""
    raster = context.current.raster
    if raster.valid:
        draw = textured_rectangle(context, cells, FLOATS, gl.GL_RGBA32F, left, bottom)
        red, green, blue, alpha = raster.color
        context.execute(DrawDepths(draw, (red, green, blue, alpha), has_depth, has_stencil))


# -- glCopyPixels ------------------------------------------------------------------------------------------------------
def copy_depths(context: Context, source: Framebuffer, rectangle: Rectangle, type: int, operation: str) -> None:
    """Copy a rectangle of depths, stencil values or both of a framebuffer to the raster position.

    As in Mesa, pixels are copied without any test if nothing is zoomed, no query is active, and the rectangles are
    apart; else they are drawn.
    """
    target = context.objects.framebuffers[context.state.draw_framebuffer]
    has_depth, has_stencil = type != gl.GL_STENCIL, type != gl.GL_DEPTH
    for framebuffer in (source, target):
        if (has_depth and framebuffer.depth is None) or (has_stencil and framebuffer.stencil is None):
            kind = "depth" if has_depth and framebuffer.depth is None else "stencil"
            fail(gl.GL_INVALID_OPERATION, operation, f"framebuffer {framebuffer.name} has no {kind} buffer")
            return
    if not context.current.raster.valid or 0 in rectangle[2:]:
        return
    context.finish()
    if context.pixel_zoom == (1.0, 1.0) and not context.objects.active_query:
        pair = _clipped_pair(context, source, target, rectangle)
        if pair is None:
            return
        if source is not target or not _overlap(*pair):
            _blit(context, source, target, pair, MASKS[type])
            return
    rows, columns, left, bottom = clipped(source, *rectangle)
    depth, stencil = _read(source, source.depth, rows, columns), _read(source, source.stencil, rows, columns)
    assert source.depth is not None or not has_depth
    z = None
    if has_depth and depth is not None and source.depth is not None:
        stored = source.depth.format
        if not has_stencil:  # Mesa's copy into the texture goes through float32
            depth = quantized_depth(sampled_depth(depth, stored), stored)
        z = sampled_depth(depth, stored)
    shape = (rows.stop - rows.start, columns.stop - columns.start)
    if 0 not in shape:
        draw_rectangle_of_depths(
            context, _cells(shape, z, stencil if has_stencil else None), has_depth, has_stencil, left, bottom
        )


def _read(source: Framebuffer, image: Image | None, rows: slice, columns: slice) -> np.ndarray | None:
    return None if image is None else bottom_up(source, image)[rows, columns].copy()


def _clipped_pair(
    context: Context, source: Framebuffer, target: Framebuffer, rectangle: Rectangle
) -> tuple[Rectangle, Rectangle] | None:
    """Return the parts of both rectangles that are inside the framebuffers and the scissor box, None for nothing."""
    x, y, width, height = rectangle
    window = context.current.raster.window
    move = int(rounded(window[0])) - x, int(rounded(window[1])) - y
    scissor, (right, top) = context.state.scissor, target.size
    box = (0, 0, right, top)
    if scissor.enabled:
        box = (
            max(0, scissor.x),
            max(0, scissor.y),
            min(right, scissor.x + scissor.width),
            min(top, scissor.y + scissor.height),
        )
    x0, y0 = max(x, 0, box[0] - move[0]), max(y, 0, box[1] - move[1])
    x1 = min(x + width, source.size[0], box[2] - move[0])
    y1 = min(y + height, source.size[1], box[3] - move[1])
    if x0 >= x1 or y0 >= y1:
        return None
    return (x0, y0, x1 - x0, y1 - y0), (x0 + move[0], y0 + move[1], x1 - x0, y1 - y0)


def _overlap(one: Rectangle, other: Rectangle) -> bool:
    (ax, ay, width, height), (bx, by, *_) = one, other
    return abs(ax - bx) < width and abs(ay - by) < height


def _blit(
    context: Context, source: Framebuffer, target: Framebuffer, pair: tuple[Rectangle, Rectangle], mask: int
) -> None:
    read, drawn = ((x, y, x + width, y + height) for x, y, width, height in pair)
    context.execute(BlitFramebuffer(source.name, target.name, read, drawn, mask, gl.GL_NEAREST, Scissor()))


__all__ = ["copy_depths", "draw_rectangle_of_depths", "texture_of_depths"]
