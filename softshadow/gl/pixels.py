"""glReadPixels and glPixelStore: the framebuffer as arrays, row 0 at the bottom."""

from __future__ import annotations

from ctypes import c_int
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.framebuffer import Framebuffer
from softshadow.frozen import evolve
from softshadow.gl.calls import spelled_like_gl
from softshadow.gl.conversions import LARGEST_INT, nearest_int
from softshadow.gl.errors import fail, outside_begin
from softshadow.gl.framebuffers import framebuffer_status
from softshadow.gl.pixel_formats import format_problem, kind_of
from softshadow.gl.pixel_memory import image_destination
from softshadow.image import Image
from softshadow.pipeline.buffers.copy import bottom_up, clipped
from softshadow.pixel_store import TYPES
from softshadow.pixel_transfer import PixelTransfer
from softshadow.pixels import client_kind, pack_color_into, pack_depth, pack_depth_stencil, pack_stencil
from softshadow.tokens import token_name

PARAMETERS = {
    "ALIGNMENT": "alignment",
    "ROW_LENGTH": "row_length",
    "SKIP_ROWS": "skip_rows",
    "SKIP_PIXELS": "skip_pixels",
    "IMAGE_HEIGHT": "image_height",
    "SKIP_IMAGES": "skip_images",
    "SWAP_BYTES": "swap_bytes",
    "LSB_FIRST": "lsb_first",
}
STORES = {
    getattr(gl, f"GL_{direction}_{name}"): (f"{direction.lower()}_store", field)
    for direction in ("PACK", "UNPACK")
    for name, field in PARAMETERS.items()
}
SWITCHES = ("swap_bytes", "lsb_first")


def glPixelStorei(pname: int, param: int) -> None:
    """Set how the rows of client images are laid out in memory."""
    if (context := outside_begin("glPixelStorei")) is None:
        return None
    if pname not in STORES:
        return fail(gl.GL_INVALID_ENUM, "glPixelStorei", f"pname={token_name(pname)}: expected a pixel store parameter")
    direction, field = STORES[pname]
    if field == "alignment" and param not in (1, 2, 4, 8):
        return fail(gl.GL_INVALID_VALUE, "glPixelStorei", f"{token_name(pname)}={param}: expected 1, 2, 4 or 8")
    if param < 0 and field not in SWITCHES:
        return fail(gl.GL_INVALID_VALUE, "glPixelStorei", f"{token_name(pname)}={param}: expected 0 or more")
    value, store = bool(param) if field in SWITCHES else int(param), getattr(context, direction)
    if getattr(store, field) != value:
        setattr(context, direction, evolve(store, **{field: value}))
    return None


def glPixelStoref(pname: int, param: float) -> None:
    """Set how the rows of client images are laid out in memory; the value is rounded."""
    glPixelStorei(pname, nearest_int(param))


def glReadPixels(x: int, y: int, width: int, height: int, format: int, type: int, array: Any = None) -> Any:
    """Return a rectangle of the read framebuffer, (h, w) or (h, w, components), first row = bottom row.

    An `array` is filled and returned. Pixels outside the framebuffer are 0, or keep their values in `array`.

    Raises
    ------
    GLError
        GL_INVALID_ENUM or GL_INVALID_OPERATION for a wrong format or type; GL_INVALID_OPERATION without a buffer to
        read from; GL_INVALID_VALUE for a negative size.
    """
    operation = "glReadPixels"
    if (context := outside_begin(operation)) is None:
        return None
    width, height = int(width), int(height)
    if max(width, height) > LARGEST_INT:  # in C, most larger numbers are negative
        width, height = c_int(width).value, c_int(height).value
    if width < 0 or height < 0:
        return fail(gl.GL_INVALID_VALUE, operation, f"width={width}, height={height}: expected 0 or more")
    if problem := format_problem(format, type):
        return fail(problem[0], operation, problem[1])
    if format == gl.GL_COLOR_INDEX:
        return fail(gl.GL_INVALID_OPERATION, operation, "format=GL_COLOR_INDEX: no buffer has colour indices")
    source = context.objects.framebuffers[context.state.read_framebuffer]
    if framebuffer_status(context, source.name) != gl.GL_FRAMEBUFFER_COMPLETE:
        return fail(gl.GL_INVALID_FRAMEBUFFER_OPERATION, operation, f"framebuffer {source.name} is not complete")
    kind = kind_of(format)
    buffers = _buffers(source, kind)
    if buffers is None:
        missing = kind.replace("-", " or ").replace("color", "colour")
        return fail(gl.GL_INVALID_OPERATION, operation, f"framebuffer {source.name} has no {missing} buffer to read")
    where = image_destination(context, array, width, height, 0, format, type, operation)
    if where is None:
        return None
    answer, view = where
    context.finish()
    rows, columns, left, bottom = clipped(source, int(x), int(y), width, height)
    cells = [bottom_up(source, buffer)[rows, columns] for buffer in buffers]
    height, width = cells[0].shape[:2]
    _pack(view[bottom : bottom + height, left : left + width], cells, buffers, format, type, context.pixel_transfer)
    return answer


def _buffers(source: Framebuffer, kind: str) -> list[Image] | None:
    """Return what values of a kind are read from, or None if a buffer is missing."""
    if kind == "color":
        color = source.read_color
        return None if color is None else [color]
    depth, stencil = source.depth, source.stencil
    wanted = {"depth": (depth,), "stencil": (stencil,), "depth-stencil": (depth, stencil)}[kind]
    buffers = [buffer for buffer in wanted if buffer is not None]
    return buffers if len(buffers) == len(wanted) else None


def _pack(
    pixels: np.ndarray, cells: list[np.ndarray], buffers: list[Image], format: int, type: int, transfer: PixelTransfer
) -> None:
    """Write framebuffer cells to client pixels (h, w, components)."""
    kind, stored = kind_of(format), buffers[0].format
    if kind == "depth-stencil":
        pixels[..., 0] = pack_depth_stencil(cells[0], cells[1], stored, type, transfer)
    elif kind == "color":
        pack_color_into(pixels, cells[0], stored, format, client_kind(type), from_framebuffer=True, transfer=transfer)
    elif kind == "depth":
        pixels[..., 0] = pack_depth(cells[0], stored, TYPES[type], transfer=transfer)
    else:
        pixels[..., 0] = pack_stencil(cells[0], TYPES[type], transfer)


__all__ = spelled_like_gl(globals())
