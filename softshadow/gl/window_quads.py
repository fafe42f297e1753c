"""Draws of rectangles at the raster position that show a texture: what glDrawPixels and glCopyPixels become."""

from __future__ import annotations

import math
from typing import Any, cast

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.framebuffer import DEFAULT, LARGEST_SIDE
from softshadow.frozen import evolve, remembered
from softshadow.gl.conversions import single, singles
from softshadow.gl.raster_draws import colors_of, corners, draw_at, raster_vertices, texcoords_of_quad
from softshadow.image import FORMATS, Format
from softshadow.pipeline.commands import CopyToTexture, CreateTexture, DefineImage, Draw, SetSampler, UpdateImage
from softshadow.state import State, TextureUnit
from softshadow.state.texturing import SWITCHES
from softshadow.texture import DEFAULTS, Sampler

LARGEST_ZOOM = 16
# keys in the storage of the textures that hold rectangles: a program may draw some of different sizes in each frame
TEXTURES = tuple(min(DEFAULTS.values()) - n for n in range(1, 5))
SAMPLER = Sampler(
    min_filter=gl.GL_NEAREST, mag_filter=gl.GL_NEAREST, wrap_s=gl.GL_CLAMP_TO_EDGE, wrap_t=gl.GL_CLAMP_TO_EDGE
)


def textured_rectangle(
    context: Context, cells: np.ndarray, stored: Format, internal_format: int, left: int = 0, bottom: int = 0
) -> Draw:
    """Define a texture of cells (h, w, 4), and return the draw that shows it so many pixels from the raster position.

    `left` and `bottom` are counted before the zoom.
    """
    height, width = cells.shape[:2]
    texture, is_defined = _find_texture(context, stored, width, height)
    if is_defined:
        context.execute(UpdateImage(texture, 0, 0, 0, 0, cells))
    else:
        context.execute(DefineImage(texture, 0, 0, stored, internal_format, width, height, cells))
    return _draw_of_texture(context, texture, width, height, left, bottom)


def copied_rectangle(
    context: Context, framebuffer: int, rectangle: tuple[int, int, int, int], left: int, bottom: int
) -> Draw:
    """Return the draw of `textured_rectangle` for bytes of a framebuffer: its rectangle (x, y, width, height)."""
    width, height = rectangle[2:]
    texture, is_defined = _find_texture(context, FORMATS[gl.GL_RGBA8], width, height)
    if not is_defined:
        context.execute(DefineImage(texture, 0, 0, FORMATS[gl.GL_RGBA8], gl.GL_RGBA8, width, height))
    context.execute(CopyToTexture(framebuffer, texture, 0, 0, 0, 0, *rectangle))
    return _draw_of_texture(context, texture, width, height, left, bottom)


def _find_texture(context: Context, stored: Format, width: int, height: int) -> tuple[int, bool]:
    """Return the texture for a rectangle, and whether it has this format and size; else it is the oldest one."""
    recent, layout = context.rectangle_textures, (stored, width, height)
    texture = recent.pop(layout, None)
    is_defined = texture is not None
    if texture is None:
        texture = TEXTURES[len(recent)] if len(recent) < len(TEXTURES) else recent.pop(next(iter(recent)))
    recent[layout] = texture
    if texture not in context.objects.textures:
        context.execute(CreateTexture(texture, gl.GL_TEXTURE_2D))
        context.execute(SetSampler(texture, SAMPLER))
    return texture, is_defined


def _draw_of_texture(context: Context, texture: int, width: int, height: int, left: int, bottom: int) -> Draw:
    """Return the draw that shows the texture of a rectangle so many pixels from the raster position."""
    (zoom_x, zoom_y), (x, y, *_) = context.pixel_zoom, context.current.raster.window
    shift_x, shift_y, side_x, side_y = singles((left * zoom_x, bottom * zoom_y, width * zoom_x, height * zoom_y))
    x0, y0 = singles((rounded(x) + shift_x, rounded(y) + shift_y))
    x1, y1 = singles((x0 + side_x, y0 + side_y))
    shown_at = _shown_at(context, x0, y0, width, height)
    size = context.objects.framebuffers[context.state.draw_framebuffer].size
    in_object = context.state.draw_framebuffer != DEFAULT
    if in_object:  # where Mesa counts rows from the top, and takes the whole part of the rectangle's upper end
        y0 = single(size[1] - math.modf(y1)[1])
        y1 = single(y0 + side_y)
    state = _textured(context.state, FIRST_UNITS[texture], in_object and shown_at is None)
    real = cast(Any, context.real)
    position = corners(x0, y0, x1, y1, size, real)
    if in_object:
        position[:, 1] = -position[:, 1]
    raster = context.current.raster
    vertices = raster_vertices(position, colors_of(raster, 4, real), texcoords_of_quad(raster, not in_object, real))
    return draw_at(context, state, size, vertices, clamps=state.depth.clamp, shown_at=shown_at)


def _shown_at(context: Context, x: float, y: float, width: int, height: int) -> tuple[int, int, int, int] | None:
    """Return corner and zoom of a rectangle where each texel is a whole number of pixels, else None.

    In these bounds, rounding errors of texture coordinates cannot reach the next texel.
    """
    zoom_x, zoom_y = context.pixel_zoom
    if not (zoom_x.is_integer() and zoom_y.is_integer() and 0 <= context.current.raster.window[2] <= 1):
        return None
    if not (1 <= abs(zoom_x) <= LARGEST_ZOOM and 1 <= abs(zoom_y) <= LARGEST_ZOOM):
        return None
    if not (abs(x) <= LARGEST_SIDE and abs(y) <= LARGEST_SIDE and max(width, height) <= LARGEST_SIDE):
        return None
    return int(x), int(y), int(zoom_x), int(zoom_y)


def rounded(coordinate: float) -> float:
    """Return the nearest whole number; halves are rounded away from 0."""
    return math.modf(coordinate + math.copysign(0.5, coordinate))[1]


FIRST_UNITS = {name: TextureUnit(enabled_2d=True, bound_2d=name, env_mode=gl.GL_REPLACE) for name in TEXTURES}


@remembered
def _textured(state: State, first: TextureUnit, upper_edges: bool) -> State:
    """Return the state with the rectangle of the first unit as its only texture; see `Polygon.upper_edges`."""
    others = tuple(evolve(unit, **dict.fromkeys(SWITCHES.values(), False)) for unit in state.units[1:])
    polygon = evolve(state.polygon, upper_edges=True) if upper_edges else state.polygon
    return evolve(state, units=(first, *others), polygon=polygon)
