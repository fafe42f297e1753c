"""glDrawPixels and glCopyPixels: rectangles of colours at the raster position, enlarged by glPixelZoom.

As in Mesa a rectangle is a textured quad, so all tests of fragments apply. Depth and stencil values cannot be drawn in
this subset.

References: GL 2.1, sec. 3.6.4 and 4.3.3; drawpix.c, st_cb_drawpixels.c of Mesa 22.3.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, current
from softshadow.framebuffer import DEFAULT
from softshadow.frozen import evolve
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.errors import fail, outside_begin
from softshadow.gl.framebuffers import framebuffer_status
from softshadow.gl.pixel_formats import format_problem, kind_of
from softshadow.gl.render_modes import is_rendered
from softshadow.gl.window_quads import draw_of_quads
from softshadow.image import Format, storage_format
from softshadow.pipeline.buffers.copy import bottom_up, clipped
from softshadow.pipeline.commands import CreateTexture, DefineImage, SetSampler
from softshadow.pixel_store import client_image
from softshadow.pixels import pack_color, unpack_color
from softshadow.state import State, TextureUnit
from softshadow.texture import Sampler
from softshadow.tokens import token_name

TEXTURE = -2  # key in the storage of the texture that holds the rectangle
SAMPLER = Sampler(
    min_filter=gl.GL_NEAREST, mag_filter=gl.GL_NEAREST, wrap_s=gl.GL_CLAMP_TO_EDGE, wrap_t=gl.GL_CLAMP_TO_EDGE
)
LARGEST_SHORT = 2**15 - 1
NOT_COLORS = (gl.GL_DEPTH, gl.GL_STENCIL, gl.GL_DEPTH_STENCIL)


@in_lists
def glPixelZoom(xfactor: float, yfactor: float) -> None:
    """Set how many pixels wide and high each pixel of glDrawPixels and glCopyPixels is; negative factors mirror."""
    context = outside_begin("glPixelZoom")
    if context is not None:
        context.touched |= gl.GL_PIXEL_MODE_BIT
        context.pixel_zoom = float(np.float32(xfactor)), float(np.float32(yfactor))


def glDrawPixels(width: int, height: int, format: int, type: int, pixels: Any) -> None:
    """Draw a rectangle of colours at the raster position, first row = bottom row.

    Raises
    ------
    GLError
        GL_INVALID_VALUE for a negative size; GL_INVALID_ENUM or GL_INVALID_OPERATION for a wrong format or type, and
        for depth and stencil values.
    ValueError, TypeError
        The image has too few pixels, or pixels of another type.
    """
    operation, context = "glDrawPixels", current()
    problem = format_problem(format, type)
    cells = None
    if not problem and kind_of(format) == "color" and width > 0 and height > 0:  # read now, also for a list
        image = client_image(pixels, context.unpack_store, int(width), int(height), format, type, operation)
        if image.dtype == np.int32:  # Mesa's texture has the upper 16 bits of it
            image = (image >> 16).astype(np.float32) * (np.float32(1) / np.float32(LARGEST_SHORT))
        cells = unpack_color(image, format, _stored(image.dtype)[0]).copy()
    _draw_pixels(width, height, format, type, cells)


@in_lists
def _draw_pixels(width: int, height: int, format: int, type: int, cells: np.ndarray | None) -> None:
    operation = "glDrawPixels"
    if (context := outside_begin(operation)) is None:
        return
    if width < 0 or height < 0:
        fail(gl.GL_INVALID_VALUE, operation, f"width={width}, height={height}: expected 0 or more")
    elif problem := format_problem(format, type):
        fail(problem[0], operation, problem[1])
    elif kind_of(format) != "color":
        fail(gl.GL_INVALID_ENUM, operation, f"format={token_name(format)}: this subset draws colours only")
    elif (
        _is_complete(context, operation)
        and context.current.raster.valid
        and is_rendered(context, gl.GL_DRAW_PIXEL_TOKEN)
        and cells is not None
    ):
        _draw(context, cells)


@in_lists
def glCopyPixels(x: int, y: int, width: int, height: int, type: int) -> None:
    """Copy colours of the read framebuffer, from pixel (x, y) on, to the raster position; `type` is GL_COLOR.

    What lies outside the read framebuffer is left out; in GL it is undefined.

    Raises
    ------
    GLError
        GL_INVALID_VALUE for a negative size; GL_INVALID_ENUM for another type; GL_INVALID_OPERATION without a buffer to
        read from.
    """
    operation = "glCopyPixels"
    if (context := outside_begin(operation)) is None:
        return
    if width < 0 or height < 0:
        fail(gl.GL_INVALID_VALUE, operation, f"width={width}, height={height}: expected 0 or more")
        return
    if type != gl.GL_COLOR:
        reason = "this subset copies colours only" if type in NOT_COLORS else "expected GL_COLOR"
        fail(gl.GL_INVALID_ENUM, operation, f"type={token_name(type)}: {reason}")
        return
    source = context.objects.framebuffers[context.state.read_framebuffer]
    if not _is_complete(context, operation):
        return
    if framebuffer_status(context, source.name) != gl.GL_FRAMEBUFFER_COMPLETE:
        fail(gl.GL_INVALID_FRAMEBUFFER_OPERATION, operation, f"framebuffer {source.name} is not complete")
        return
    image = source.read_color
    if image is None:
        fail(gl.GL_INVALID_OPERATION, operation, f"framebuffer {source.name} has no colour buffer to read")
        return
    if not context.current.raster.valid or not is_rendered(context, gl.GL_COPY_PIXEL_TOKEN):
        return
    if width == 0 or height == 0:
        return
    context.finish()
    rows, columns, left, bottom = clipped(source, int(x), int(y), int(width), int(height))
    colors = pack_color(bottom_up(source, image)[rows, columns], image.format, gl.GL_RGBA, np.uint8, True)
    if colors.size:
        _draw(context, np.ascontiguousarray(colors), left, bottom)


def _is_complete(context: Context, operation: str) -> bool:
    name = context.state.draw_framebuffer
    if framebuffer_status(context, name) == gl.GL_FRAMEBUFFER_COMPLETE:
        return True
    fail(gl.GL_INVALID_FRAMEBUFFER_OPERATION, operation, f"framebuffer {name} is not complete")
    return False


def _draw(context: Context, cells: np.ndarray, left: int = 0, bottom: int = 0) -> None:
    """Draw colours (h, w, 4) so many pixels, before the zoom, from the raster position."""
    if not context.current.raster.valid:
        return
    height, width = cells.shape[:2]
    stored, internal_format = _stored(cells.dtype)
    if TEXTURE not in context.objects.textures:
        context.execute(CreateTexture(TEXTURE, gl.GL_TEXTURE_2D))
        context.execute(SetSampler(TEXTURE, SAMPLER))
    context.execute(DefineImage(TEXTURE, 0, 0, stored, internal_format, width, height, cells))
    zoom_x, zoom_y = np.array(context.pixel_zoom, np.float32)
    x, y, *_ = context.current.raster.window
    x0, y0 = _rounded(x) + np.float32(left) * zoom_x, _rounded(y) + np.float32(bottom) * zoom_y
    x1, y1 = x0 + np.float32(width) * zoom_x, y0 + np.float32(height) * zoom_y
    if context.state.draw_framebuffer != DEFAULT:  # Mesa takes the whole part of the top row
        y1 = np.trunc(y1)
        y0 = y1 - np.float32(height) * zoom_y
    quad = np.array([[x0, y0, x1, y1]], np.float32)
    context.execute(draw_of_quads(context, quad, _textured(context.state), textured=True))


def _stored(dtype: np.dtype) -> tuple[Format, int]:
    """Return the format in which the texture holds pixels of a type, and its internal format."""
    internal_format = gl.GL_RGBA8 if dtype.itemsize == 1 else gl.GL_RGBA32F
    return storage_format(internal_format, gl.GL_FLOAT), internal_format


def _rounded(coordinate: float) -> np.float32:
    """Return the nearest whole number; halves are rounded away from 0."""
    return np.float32(np.trunc(coordinate + np.copysign(0.5, coordinate)))


def _textured(state: State) -> State:
    """Return the state with the rectangle as its only texture."""
    first = TextureUnit(enabled_2d=True, bound_2d=TEXTURE, env_mode=gl.GL_REPLACE)
    others = tuple(evolve(unit, enabled_2d=False, enabled_cube=False) for unit in state.units[1:])
    return evolve(state, units=(first, *others))


__all__ = spelled_like_gl(globals())
