"""glDrawPixels and glCopyPixels: rectangles of pixels at the raster position, enlarged by glPixelZoom.

As in Mesa a rectangle is a textured quad, so all tests of fragments apply. Those of depths and stencil values are in
`depth_rectangles`.

References: GL 2.1, sec. 3.6.4 and 4.3.3; drawpix.c, st_cb_drawpixels.c of Mesa 22.3.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.color_values import color_as_float, to_float, to_unorm8
from softshadow.context import Context, current
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.conversions import singles
from softshadow.gl.depth_rectangles import copy_depths, draw_rectangle_of_depths, texture_of_depths
from softshadow.gl.errors import fail, outside_begin
from softshadow.gl.framebuffers import can_draw, framebuffer_status
from softshadow.gl.pixel_formats import kind_of, pixels_problem
from softshadow.gl.pixel_memory import image_source
from softshadow.gl.render_modes import is_rendered
from softshadow.gl.window_quads import copied_rectangle, textured_rectangle
from softshadow.image import Format, Image, storage_format
from softshadow.packed_colors import PACKED_COLORS
from softshadow.pipeline.buffers.copy import bottom_up, clipped
from softshadow.pipeline.plan import needs_order
from softshadow.pipeline.shade.color_writes import rounded_floats
from softshadow.pixels import pack_color, unpack_color
from softshadow.texel_codes import as_floats, resized
from softshadow.tokens import token_name

LARGEST_SHORT, LARGEST_USHORT, LARGEST_INT, LARGEST_UINT = (2**bits - 1 for bits in (15, 16, 31, 32))
IN_BYTES = [  # the packed types whose colours Mesa's texture has in 8 bits
    kind for kind, packed in PACKED_COLORS.items() if any(n_bits in (5, 6) for _, n_bits in packed.fields)
]
INDEXED = {  # type of colour indices: the bits for each channel in Mesa's texture of their colours, else 8
    gl.GL_BYTE: 7,
    gl.GL_UNSIGNED_SHORT: 16,
    gl.GL_SHORT: 15,
    gl.GL_INT: 15,
}
COPIED = {  # type of glCopyPixels: format of its pixels
    gl.GL_COLOR: gl.GL_RGBA,
    gl.GL_DEPTH: gl.GL_DEPTH_COMPONENT,
    gl.GL_STENCIL: gl.GL_STENCIL_INDEX,
    gl.GL_DEPTH_STENCIL: gl.GL_DEPTH_STENCIL,
}


@in_lists
def glPixelZoom(xfactor: float, yfactor: float) -> None:
    """Set how many pixels wide and high each pixel of glDrawPixels and glCopyPixels is; negative factors mirror."""
    context, zoom = outside_begin("glPixelZoom"), singles((xfactor, yfactor))
    if context is not None and context.pixel_zoom != zoom:
        context.flush_vertices()
        context.touched |= gl.GL_PIXEL_MODE_BIT
        context.pixel_zoom = zoom


def glDrawPixels(width: int, height: int, format: int, type: int, pixels: Any) -> None:
    """Draw a rectangle of colours, depths or stencil values at the raster position, first row = bottom row.

    Raises
    ------
    GLError
        GL_INVALID_VALUE for a negative size; GL_INVALID_ENUM or GL_INVALID_OPERATION for a wrong format or type;
        GL_INVALID_OPERATION without a buffer for the values.
    ValueError, TypeError
        The image has too few pixels, or pixels of another type.
    """
    operation, context = "glDrawPixels", current()
    image = None
    if not pixels_problem(format, type) and width > 0 and height > 0:  # read now, also for a list
        image = image_source(context, pixels, int(width), int(height), 0, format, type, operation)
        if image is None:
            return
    _draw_pixels(width, height, format, type, image)


@in_lists
def _draw_pixels(width: int, height: int, format: int, type: int, image: np.ndarray | None) -> None:
    operation = "glDrawPixels"
    if (context := outside_begin(operation)) is None:
        return
    context.flush_vertices()  # Mesa does so whatever follows
    if width < 0 or height < 0:
        fail(gl.GL_INVALID_VALUE, operation, f"width={width}, height={height}: expected 0 or more")
    elif problem := pixels_problem(format, type):
        fail(problem[0], operation, problem[1])
    elif missing := _missing_buffer(context, format):
        fail(gl.GL_INVALID_OPERATION, operation, missing)
    elif can_draw(context, operation) and context.current.raster.valid:
        if not is_rendered(context, gl.GL_DRAW_PIXEL_TOKEN) or image is None:
            return
        if kind_of(format) == "color":
            _draw(context, _colors(context, image, format, type))
        else:
            kind, cells = kind_of(format), texture_of_depths(context, image, format, type)
            draw_rectangle_of_depths(context, cells, "depth" in kind, "stencil" in kind)


def _missing_buffer(context: Context, format: int) -> str:
    """Return what is wrong if the draw framebuffer has no buffer for depths or stencil values, else ""."""
    target, kind = context.objects.framebuffers[context.state.draw_framebuffer], kind_of(format)
    if "depth" in kind and target.depth is None:
        return f"framebuffer {target.name} has no depth buffer"
    if "stencil" in kind and target.stencil is None:
        return f"framebuffer {target.name} has no stencil buffer"
    return ""


def _colors(context: Context, image: np.ndarray, format: int, type: int) -> np.ndarray:
    """Return client colours as the texture of the rectangle has them, after pixel transfer, in an array of its own."""
    transfer = context.pixel_transfer
    if format == gl.GL_COLOR_INDEX:
        colors = to_unorm8(transfer.indexed_color(image[..., 0].astype(np.int64)))
        n_bits = INDEXED.get(type, 8)
        return as_floats(resized(colors, 8, n_bits), n_bits)
    if type == gl.GL_UNSIGNED_INT:  # Mesa's texture has 16 bits, the nearest
        image = ((image.astype(np.uint64) * LARGEST_USHORT + LARGEST_INT) // LARGEST_UINT).astype(np.uint16)
    elif image.dtype == np.int32:  # or the upper ones of signed numbers
        image = (image >> 16).astype(np.float32) * (np.float32(1) / np.float32(LARGEST_SHORT))
    if transfer.changes_color:
        image = to_float(image) if image.dtype == np.int8 else image  # whose signs Mesa's texture keeps
    elif type not in PACKED_COLORS and image.dtype.itemsize > 1 and _writes_bytes(context):
        image = rounded_floats(to_float(image))
    stored = _stored(np.dtype(np.uint8) if type in IN_BYTES else image.dtype)[0]
    cells = unpack_color(image, format, stored, type)
    if transfer.changes_color:
        return transfer.drawn_color(color_as_float(cells))
    return cells.copy() if np.may_share_memory(cells, image) else cells


def _writes_bytes(context: Context) -> bool:
    """Return whether colours of rectangles are written as bytes, and nothing else is done with them."""
    state = context.state
    changes = needs_order(state) or state.fog.enabled or state.fog.color_sum
    return not changes and all(map(_is_plain, context.objects.framebuffers[state.draw_framebuffer].colors))


def _is_plain(image: Image) -> bool:
    """Return whether an image has bytes that stand for themselves."""
    return image.format.kind == "unorm8" and not image.format.encoding


@in_lists
def glCopyPixels(x: int, y: int, width: int, height: int, type: int) -> None:
    """Copy a rectangle of the read framebuffer, from pixel (x, y) on, to the raster position.

    `type` is GL_COLOR, GL_DEPTH, GL_STENCIL or GL_DEPTH_STENCIL. What lies outside the read framebuffer is left out; in
    GL it is undefined.

    Raises
    ------
    GLError
        GL_INVALID_VALUE for a negative size; GL_INVALID_ENUM for another type; GL_INVALID_OPERATION without a buffer to
        read from or to draw to.
    """
    operation = "glCopyPixels"
    if (context := outside_begin(operation)) is None:
        return
    context.flush_vertices()  # Mesa does so whatever follows
    if width < 0 or height < 0:
        fail(gl.GL_INVALID_VALUE, operation, f"width={width}, height={height}: expected 0 or more")
        return
    if type not in COPIED:
        fail(gl.GL_INVALID_ENUM, operation, f"type={token_name(type)}: expected GL_COLOR … GL_DEPTH_STENCIL")
        return
    source = context.objects.framebuffers[context.state.read_framebuffer]
    if not can_draw(context, operation):
        return
    if framebuffer_status(context, source.name) != gl.GL_FRAMEBUFFER_COMPLETE:
        fail(gl.GL_INVALID_FRAMEBUFFER_OPERATION, operation, f"framebuffer {source.name} is not complete")
        return
    if COPIED[type] != gl.GL_RGBA:
        copy_depths(context, source, (int(x), int(y), int(width), int(height)), type, operation)
        return
    image = source.read_color
    if image is None:
        fail(gl.GL_INVALID_OPERATION, operation, f"framebuffer {source.name} has no colour buffer to read")
        return
    if not context.current.raster.valid or not is_rendered(context, gl.GL_COPY_PIXEL_TOKEN):
        return
    if width == 0 or height == 0:
        return
    rows, columns, left, bottom = clipped(source, int(x), int(y), int(width), int(height))
    if rows.start == rows.stop or columns.start == columns.stop:
        return
    transfer, base = context.pixel_transfer, image.format.base
    if not transfer.changes_color and _is_plain(image) and base in (gl.GL_RGBA, gl.GL_RGB):
        rectangle = columns.start, rows.start, columns.stop - columns.start, rows.stop - rows.start
        context.execute(copied_rectangle(context, source.name, rectangle, left, bottom))
        return
    context.finish()
    kind = np.float32 if image.format.kind == "float" else np.uint8
    colors = pack_color(bottom_up(source, image)[rows, columns], image.format, gl.GL_RGBA, kind, True)
    if transfer.changes_color:
        order = -1 if source.flipped else 1  # rows of Mesa's texture
        colors = transfer.drawn_color(color_as_float(colors[::order]))[::order]
    _draw(context, colors if transfer.changes_color else colors.copy(), left, bottom)


def _draw(context: Context, cells: np.ndarray, left: int = 0, bottom: int = 0) -> None:
    """Draw colours (h, w, 4) so many pixels, before the zoom, from the raster position."""
    if context.current.raster.valid:
        stored, internal_format = _stored(cells.dtype)
        context.execute(textured_rectangle(context, cells, stored, internal_format, left, bottom))


def _stored(dtype: np.dtype) -> tuple[Format, int]:
    """Return the format in which the texture holds pixels of a type, and its internal format."""
    internal_format = gl.GL_RGBA8 if dtype.itemsize == 1 else gl.GL_RGBA32F
    return storage_format(internal_format, gl.GL_FLOAT), internal_format


__all__ = spelled_like_gl(globals())
