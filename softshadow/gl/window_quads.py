"""Draws of rectangles in window coordinates at the raster position: what glBitmap and glDrawPixels become."""

from __future__ import annotations

import struct
from collections.abc import Sequence
from functools import lru_cache
from typing import Any, NamedTuple, cast

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.framebuffer import DEFAULT, LARGEST_SIDE
from softshadow.frozen import evolve
from softshadow.image import FORMATS, Format
from softshadow.pipeline.commands import (
    CopyToTexture,
    CreateTexture,
    DefineImage,
    Draw,
    SetSampler,
    UpdateImage,
    Vertices,
)
from softshadow.state import ClipPlanes, Cull, Polygon, State, TextureUnit, Viewport
from softshadow.state.texturing import SWITCHES
from softshadow.texture import DEFAULTS, Sampler

# the unit square in the order of Mesa's vertices; for images in framebuffer objects it counts rows from the top
CORNERS = np.array([[0, 1], [1, 1], [1, 0], [0, 0]])
CORNERS_FROM_TOP = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
TRIANGLES = np.array([0, 1, 2, 0, 2, 3])  # a fan, as in Mesa
# of left, bottom, right, top: x and y of each corner
EDGES, EDGES_FROM_TOP = (2 * corners + [0, 1] for corners in (CORNERS, CORNERS_FROM_TOP))

LARGEST_ZOOM = 16
KEPT_VERTICES = 1024  # of a draw; a character has some hundred
TEXTURE = min(DEFAULTS.values()) - 1  # key in the storage of the texture that holds the rectangle
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
    if _has_texture(context, stored, width, height):
        context.execute(UpdateImage(TEXTURE, 0, 0, 0, 0, cells))
    else:
        context.execute(DefineImage(TEXTURE, 0, 0, stored, internal_format, width, height, cells))
    return _draw_of_texture(context, width, height, left, bottom)


def copied_rectangle(
    context: Context, framebuffer: int, rectangle: tuple[int, int, int, int], left: int, bottom: int
) -> Draw:
    """Return the draw of `textured_rectangle` for bytes of a framebuffer: its rectangle (x, y, width, height)."""
    width, height = rectangle[2:]
    if not _has_texture(context, FORMATS[gl.GL_RGBA8], width, height):
        context.execute(DefineImage(TEXTURE, 0, 0, FORMATS[gl.GL_RGBA8], gl.GL_RGBA8, width, height))
    context.execute(CopyToTexture(framebuffer, TEXTURE, 0, 0, 0, 0, *rectangle))
    return _draw_of_texture(context, width, height, left, bottom)


def _has_texture(context: Context, stored: Format, width: int, height: int) -> bool:
    """Return whether the texture of the last rectangle has this format and size; create one if there was none."""
    texture = context.objects.textures.get(TEXTURE)
    if texture is None:
        context.execute(CreateTexture(TEXTURE, gl.GL_TEXTURE_2D))
        context.execute(SetSampler(TEXTURE, SAMPLER))
        return False
    before = texture.images.get((0, 0))
    return before is not None and (before.format, before.width, before.height) == (stored, width, height)


def _draw_of_texture(context: Context, width: int, height: int, left: int, bottom: int) -> Draw:
    """Return the draw that shows the texture of the rectangle so many pixels from the raster position."""
    zoom_x, zoom_y = np.array(context.pixel_zoom, np.float32)
    x, y, *_ = context.current.raster.window
    x0, y0 = rounded(x) + np.float32(left) * zoom_x, rounded(y) + np.float32(bottom) * zoom_y
    x1, y1 = x0 + np.float32(width) * zoom_x, y0 + np.float32(height) * zoom_y
    if context.state.draw_framebuffer != DEFAULT:  # Mesa takes the whole part of the top row
        y1 = np.trunc(y1)
        y0 = y1 - np.float32(height) * zoom_y
    quad = np.array([[x0, y0, x1, y1]], np.float32)
    draw = draw_of_quads(context, quad, _textured(context.state), textured=True)
    return evolve(draw, shown_at=_shown_at(context, float(x0), float(y0), width, height))


def _shown_at(context: Context, x: float, y: float, width: int, height: int) -> tuple[int, int, int, int] | None:
    """Return corner and zoom of a rectangle where each texel is a whole number of pixels, else None.

    In these bounds, rounding errors of texture coordinates cannot reach the next texel.
    """
    are_near = all(abs(number) <= LARGEST_SIDE for number in (x, y, width, height))
    are_whole = all(zoom.is_integer() and 1 <= abs(zoom) <= LARGEST_ZOOM for zoom in context.pixel_zoom)
    if not are_near or not are_whole or not 0 <= context.current.raster.window[2] <= 1:
        return None
    zoom_x, zoom_y = context.pixel_zoom
    return int(x), int(y), int(zoom_x), int(zoom_y)


def rounded(coordinate: float) -> np.float32:
    """Return the nearest whole number; halves are rounded away from 0."""
    return np.float32(np.trunc(coordinate + np.copysign(0.5, coordinate)))


def _textured(state: State) -> State:
    """Return the state with the rectangle as its only texture."""
    first = TextureUnit(enabled_2d=True, bound_2d=TEXTURE, env_mode=gl.GL_REPLACE)
    others = tuple(evolve(unit, **dict.fromkeys(SWITCHES.values(), False)) for unit in state.units[1:])
    return evolve(state, units=(first, *others))


def draw_of_quads(context: Context, quads: np.ndarray, state: State, textured: bool = False) -> Draw:
    """Return a draw of quads in the colour and at the depth of the raster position.

    Parameters
    ----------
    quads : (N, 4)               left, bottom, right, top in pixels of the draw framebuffer
    state : State                that of fragments applies; that of vertices and triangles is replaced
    textured : bool              whether each quad shows the whole texture of unit 0; else all vertices have the texture
        coordinates of the raster position
    """
    raster, real = context.current.raster, cast(Any, context.real)
    size = context.objects.framebuffers[context.state.draw_framebuffer].size
    in_window = state.draw_framebuffer == DEFAULT
    corners = CORNERS_FROM_TOP if textured and not in_window else CORNERS
    n, edges = 4 * len(quads), quads.astype(real)
    edges /= np.array(size * 2, real)
    edges *= real(2)
    edges -= real(1)
    position = np.ones((len(quads), 4, 4), real)
    position[:, :, :2] = edges[:, EDGES_FROM_TOP if corners is CORNERS_FROM_TOP else EDGES]
    position[:, :, 2] = 0  # the projection adds the depth: in Mesa, fog is that of the distance 0
    color, texcoords = _for(n, _attributes)(_packed(raster.color, *raster.texcoords), n, real)
    if textured:
        of_quads = texcoords[0].copy()
        of_quads[:, :2] = np.tile(corners, (len(quads), 1))
        texcoords = of_quads, *texcoords[1:]
    position = position.reshape(n, 4)
    for array in (position, texcoords[0]):
        array.setflags(write=False)
    return evolve(
        _blank_draw(real, len(texcoords)),
        state=_prepared(state, size, in_window, state.depth.clamp and textured),
        vertices=Vertices(position, color, _for(n, _normals)(n, real), texcoords),
        indices=_for(n, _indices)(len(quads)),
        projection=_projection(raster.window[2], real),
        label="/".join(context.labels),
    )


# what draws have in common, kept: text is made of many small ones
def _for(n: int, kept: Any) -> Any:
    """Return a function that keeps its results; for more than so many vertices, one that does not."""
    return kept if n <= KEPT_VERTICES else kept.__wrapped__


def _packed(*values: Sequence[float]) -> bytes:
    """Return numbers as a key that tells -0 from 0."""
    return b"".join([struct.pack(f"{len(value)}d", *value) for value in values])


@lru_cache(256)
def _attributes(packed: bytes, n: int, real: Any) -> tuple[np.ndarray, tuple[np.ndarray, ...]]:
    """Return n equal colours and n equal texture coordinates of each unit; arrays, since Mesa interpolates them."""
    values = np.frombuffer(packed).reshape(-1, 4)
    arrays = {row.tobytes(): _repeated(row, n, real) for row in values}
    color, *texcoords = (arrays[row.tobytes()] for row in values)
    return color, tuple(texcoords)


@lru_cache(256)
def _normals(n: int, real: Any) -> np.ndarray:
    return _repeated((0, 0, 1), n, real)


def _repeated(value: Any, n: int, real: Any) -> np.ndarray:
    rows = np.empty((n, len(value)), real)
    rows[:] = value
    rows.setflags(write=False)
    return rows


@lru_cache(256)
def _indices(n_quads: int) -> np.ndarray:
    indices = (np.arange(0, 4 * n_quads, 4)[:, np.newaxis] + TRIANGLES).reshape(-1).astype(np.int32)
    indices.setflags(write=False)
    return indices


@lru_cache(16)
def _blank_draw(real: Any, n_units: int) -> Draw:
    """Return a draw of triangles under identity matrices, with one texture matrix per unit."""
    nothing, identity = np.empty((0, 4), real), np.eye(4, dtype=real)
    identity.setflags(write=False)
    vertices = Vertices(nothing, nothing, nothing[:, :3], (nothing,) * n_units)
    return Draw(State(), gl.GL_TRIANGLES, vertices, None, identity, identity, (identity,) * n_units, modelview_kind=0)


@lru_cache(256)
def _projection(depth: float, real: Any) -> np.ndarray:
    """Return the matrix that moves z = 0 to a depth of the window."""
    projection = np.eye(4)
    projection[2, 3] = real(depth) * real(2) - real(1)
    projection = projection.astype(real)
    projection.setflags(write=False)
    return projection


class _Prepared(NamedTuple):
    """A state without its vertex stages, and what it was made from."""

    made_from: tuple[State, tuple[int, int], bool, bool]
    state: State


_latest: list[_Prepared] = []  # at most one


def _prepared(state: State, size: tuple[int, int], in_window: bool, clamps: bool) -> State:
    """Return what `_without_vertex_stages` returns, the same object while its arguments are the same."""
    made_from = state, size, in_window, clamps
    latest = _latest[:]
    if latest and latest[0].made_from[0] is state and latest[0].made_from[1:] == made_from[1:]:
        return latest[0].state
    prepared = _without_vertex_stages(*made_from)
    _latest[:] = [_Prepared(made_from, prepared)]
    return prepared


def _without_vertex_stages(state: State, size: tuple[int, int], in_window: bool, clamps: bool) -> State:
    """Return the state with all that concerns vertices and triangles as in the initial state, except depth clamping."""
    return evolve(
        state,
        viewport=Viewport(0, 0, *size),
        cull=Cull(front_face=gl.GL_CW if in_window else gl.GL_CCW),  # as in Mesa, for the stencil test of two sides
        polygon=Polygon(),
        lighting=evolve(state.lighting, enabled=False),
        clip_planes=ClipPlanes(),
        depth=evolve(state.depth, clamp=clamps),
        units=tuple(evolve(unit, gen=tuple(evolve(each, enabled=False) for each in unit.gen)) for unit in state.units),
        program=0,
    )
