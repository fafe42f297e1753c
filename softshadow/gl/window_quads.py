"""Draws of rectangles in window coordinates at the raster position: what glBitmap and glDrawPixels become."""

from __future__ import annotations

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.framebuffer import DEFAULT
from softshadow.frozen import evolve
from softshadow.pipeline.commands import Draw, Vertices
from softshadow.state import ClipPlanes, Cull, Fog, Polygon, State, Viewport

# the unit square in the order of Mesa's vertices; for images in framebuffer objects it counts rows from the top
CORNERS = np.array([[0, 1], [1, 1], [1, 0], [0, 0]])
CORNERS_FROM_TOP = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
TRIANGLES = np.array([0, 1, 2, 0, 2, 3])  # a fan, as in Mesa


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
    position[:, 2] = real(raster.window[2]) * real(2) - real(1)
    values = (raster.color, (0, 0, 1), *raster.texcoords)
    rows = [np.tile(np.array(value, real), (len(position), 1)) for value in values]
    if textured:
        rows[2][:, :2] = np.tile(corners, (len(quads), 1))
    indices = (np.arange(0, len(position), 4)[:, np.newaxis] + TRIANGLES).reshape(-1).astype(np.int32)
    for array in (position, indices, *rows):
        array.setflags(write=False)
    identity = context.frozen(np.eye(4))
    return Draw(
        state=_without_vertex_stages(state, size, in_window),
        mode=gl.GL_TRIANGLES,
        vertices=Vertices(position, rows[0], rows[1], tuple(rows[2:])),
        indices=indices,
        modelview=identity,
        projection=identity,
        texture_matrices=(identity,) * len(raster.texcoords),
        label="/".join(context.labels),
    )


def _without_vertex_stages(state: State, size: tuple[int, int], in_window: bool) -> State:
    """Return the state with all that concerns vertices and triangles as in the initial state."""
    return evolve(
        state,
        viewport=Viewport(0, 0, *size),
        cull=Cull(front_face=gl.GL_CW if in_window else gl.GL_CCW),  # as in Mesa, for the stencil test of two sides
        polygon=Polygon(),
        lighting=evolve(state.lighting, enabled=False),
        fog=Fog(),
        clip_planes=ClipPlanes(),
        depth=evolve(state.depth, clamp=False),
        units=tuple(evolve(unit, gen=tuple(evolve(each, enabled=False) for each in unit.gen)) for unit in state.units),
        program=0,
    )
