"""Draws of rectangles in window coordinates at the raster position: what glBitmap and glDrawPixels become."""

from __future__ import annotations

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.framebuffer import DEFAULT
from softshadow.frozen import evolve
from softshadow.image import Format
from softshadow.pipeline.commands import CreateTexture, DefineImage, Draw, SetSampler, Vertices
from softshadow.state import ClipPlanes, Cull, Polygon, State, TextureUnit, Viewport
from softshadow.state.texturing import SWITCHES
from softshadow.texture import DEFAULTS, Sampler

# the unit square in the order of Mesa's vertices; for images in framebuffer objects it counts rows from the top
CORNERS = np.array([[0, 1], [1, 1], [1, 0], [0, 0]])
CORNERS_FROM_TOP = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
TRIANGLES = np.array([0, 1, 2, 0, 2, 3])  # a fan, as in Mesa


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
    if TEXTURE not in context.objects.textures:
        context.execute(CreateTexture(TEXTURE, gl.GL_TEXTURE_2D))
        context.execute(SetSampler(TEXTURE, SAMPLER))
    context.execute(DefineImage(TEXTURE, 0, 0, stored, internal_format, width, height, cells))
    zoom_x, zoom_y = np.array(context.pixel_zoom, np.float32)
    x, y, *_ = context.current.raster.window
    x0, y0 = rounded(x) + np.float32(left) * zoom_x, rounded(y) + np.float32(bottom) * zoom_y
    x1, y1 = x0 + np.float32(width) * zoom_x, y0 + np.float32(height) * zoom_y
    if context.state.draw_framebuffer != DEFAULT:  # Mesa takes the whole part of the top row
        y1 = np.trunc(y1)
        y0 = y1 - np.float32(height) * zoom_y
    quad = np.array([[x0, y0, x1, y1]], np.float32)
    return draw_of_quads(context, quad, _textured(context.state), textured=True)


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
    raster, real = context.current.raster, context.real
    size = context.objects.framebuffers[context.state.draw_framebuffer].size
    in_window = state.draw_framebuffer == DEFAULT
    corners = CORNERS_FROM_TOP if textured and not in_window else CORNERS
    position = np.ones((4 * len(quads), 4), real)
    position[:, 0] = quads[:, 2 * corners[:, 0]].reshape(-1).astype(real) / real(size[0]) * real(2) - real(1)
    position[:, 1] = quads[:, 1 + 2 * corners[:, 1]].reshape(-1).astype(real) / real(size[1]) * real(2) - real(1)
    position[:, 2] = 0  # the projection adds the depth: in Mesa, fog is that of the distance 0
    projection = np.eye(4)
    projection[2, 3] = real(raster.window[2]) * real(2) - real(1)
    values = (raster.color, (0, 0, 1), *raster.texcoords)
    rows = [np.tile(np.array(value, real), (len(position), 1)) for value in values]
    if textured:
        rows[2][:, :2] = np.tile(corners, (len(quads), 1))
    indices = (np.arange(0, len(position), 4)[:, np.newaxis] + TRIANGLES).reshape(-1).astype(np.int32)
    for array in (position, indices, *rows):
        array.setflags(write=False)
    identity = context.frozen(np.eye(4))
    return Draw(
        state=_without_vertex_stages(state, size, in_window, clamps=state.depth.clamp and textured),
        mode=gl.GL_TRIANGLES,
        vertices=Vertices(position, rows[0], rows[1], tuple(rows[2:])),
        indices=indices,
        modelview=identity,
        projection=context.frozen(projection),
        texture_matrices=(identity,) * len(raster.texcoords),
        label="/".join(context.labels),
    )


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
