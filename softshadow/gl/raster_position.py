"""glRasterPos and glWindowPos: where glBitmap draws, and in which colour.

References: GL 2.1, sec. 2.13 (current raster position); rastpos.c of Mesa 22.3.
"""

from __future__ import annotations

from functools import lru_cache
from operator import is_
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, RasterPosition
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.conversions import single, singles, vector
from softshadow.gl.errors import outside_begin
from softshadow.gl.raster_lighting import raster_colors, transformed
from softshadow.gl.render_modes import note_raster_position
from softshadow.jit import read_only
from softshadow.pipeline.geometry.clip_planes import planes_in_clip_space
from softshadow.pipeline.geometry.raster_position import raster_place
from softshadow.state import Viewport

F32 = np.float32


@in_lists
def glRasterPos4f(x: float, y: float, z: float, w: float) -> None:
    """Set the raster position to a point, transformed and lit like a vertex; it is not valid outside the view volume.

    Generated texture coordinates do not apply.
    """
    context = outside_begin("glRasterPos4f")
    if context is None:
        return
    context.flush_vertices()
    context.update_current()
    context.touched |= gl.GL_CURRENT_BIT
    state = context.state
    modelview, modelview_kind = context.modelview_stack.drawn()
    projection, projection_kind = context.projection_stack.drawn()
    modelview, projection = _single(modelview), _single(projection)
    planes = planes_in_clip_space(state.clip_planes, projection, projection_kind)
    with np.errstate(all="ignore"):  # numbers may be too large; interpreted kernels would warn
        x_window, y_window, z_window, w_clip, distance, is_inside = raster_place(
            modelview, projection, planes, float(x), float(y), float(z), float(w), *_window_of(state.viewport),
            state.depth.clamp,
        )  # fmt: skip
        if not is_inside:
            context.current.raster = context.current.raster._replace(valid=False)
            return
        if state.lighting.enabled:
            point = np.array([x, y, z, w]).astype(F32)
            color, secondary = raster_colors(context, point, modelview, modelview_kind)
        else:
            color, secondary = _current_colors(context)
        texcoords = _texcoords(context)
    window = float(x_window), float(y_window), float(z_window), float(w_clip)  # also where kernels are not compiled
    _set(context, window, float(distance), color, secondary, texcoords)


def _set(
    context: Context,
    window: tuple[float, ...],
    distance: float,
    color: tuple[float, ...],
    secondary: tuple[float, ...],
    texcoords: tuple[tuple[float, ...], ...],
) -> None:
    """Set a valid raster position; `distance` is that from the eye."""
    if context.state.fog.source == gl.GL_FOG_COORD:
        distance = float(F32(context.current.fog_coordinate))
    context.current.raster = RasterPosition(window, True, distance, color, secondary, texcoords)
    note_raster_position(context)


def _single(matrix: np.ndarray) -> np.ndarray:
    """Return a matrix in single precision, which contexts with exact precision do not have."""
    return matrix if matrix.dtype == F32 else read_only(matrix.astype(F32))


@lru_cache(maxsize=16)
def _window_of(view: Viewport) -> tuple[np.ndarray, np.ndarray, np.float32, np.float32]:
    """Return scale and shift (3,) from normalized device coordinates to the window, and the depth range."""
    near, far = F32(view.near), F32(view.far)
    scale = np.array([F32(0.5) * F32(view.width), F32(0.5) * F32(view.height), F32(0.5) * (far - near)])
    shift = np.array([scale[0] + F32(view.x), scale[1] + F32(view.y), F32(0.5) * (near + far)])
    return scale, shift, near, far


def _texcoords(context: Context) -> tuple[tuple[float, ...], ...]:
    """Return the current texture coordinates times the texture matrices; texts have the same ones for each line."""
    matrices, coordinates = context.texture_matrices(), context.current.texcoords
    known = context.raster_texcoords
    if known is None or known[0] is not matrices or not all(map(is_, known[1], coordinates)):
        products = tuple(
            tuple(transformed(matrix.astype(F32), np.array(each, F32)).tolist())
            for matrix, each in zip(matrices, coordinates, strict=True)
        )
        known = context.raster_texcoords = matrices, tuple(coordinates), products
    return known[2]


def _current_colors(context: Context) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Return the current colour and secondary colour in single precision."""
    current = context.current
    return singles(current.color), singles(current.secondary)


def _clamped(color: tuple[float, ...]) -> tuple[float, ...]:
    if min(color) >= 0.0 and max(color) <= 1.0:  # in a fifth of the time
        return color
    return tuple([min(max(each, 0.0), 1.0) for each in color])


@in_lists
def glWindowPos3f(x: float, y: float, z: float) -> None:
    """Set the raster position in window coordinates, z from 0 to 1 within the depth range; it is always valid."""
    context = outside_begin("glWindowPos3f")
    if context is None:
        return
    context.flush_vertices()
    context.update_current()
    view = context.state.viewport
    x, y, z, near = singles((x, y, z, view.near))
    depths = single(single(view.far) - near)  # each operation on two numbers in single precision is rounded once
    z = single(single(min(max(z, 0.0), 1.0) * depths) + near)
    color, secondary = _current_colors(context)
    context.touched |= gl.GL_CURRENT_BIT
    texcoords = tuple(map(tuple, context.current.texcoords))
    _set(context, (x, y, z, 1.0), 0.0, _clamped(color), _clamped(secondary), texcoords)


def glRasterPos2f(x: float, y: float) -> None:
    """Set the raster position to a point, z = 0, w = 1."""
    glRasterPos4f(x, y, 0.0, 1.0)


def glRasterPos3f(x: float, y: float, z: float) -> None:
    """Set the raster position to a point, w = 1."""
    glRasterPos4f(x, y, z, 1.0)


def glRasterPos2fv(v: Any) -> None:
    """Set the raster position to a point given as a vector."""
    glRasterPos2f(*vector(v, 2))


def glRasterPos3fv(v: Any) -> None:
    """Set the raster position to a point given as a vector."""
    glRasterPos3f(*vector(v, 3))


def glRasterPos4fv(v: Any) -> None:
    """Set the raster position to a point given as a vector."""
    glRasterPos4f(*vector(v, 4))


def glWindowPos2f(x: float, y: float) -> None:
    """Set the raster position in window coordinates, z = 0."""
    glWindowPos3f(x, y, 0.0)


def glWindowPos2fv(v: Any) -> None:
    """Set the raster position in window coordinates given as a vector."""
    glWindowPos2f(*vector(v, 2))


def glWindowPos3fv(v: Any) -> None:
    """Set the raster position in window coordinates given as a vector."""
    glWindowPos3f(*vector(v, 3))


# GL converts all coordinates to single precision
glRasterPos2d = glRasterPos2i = glRasterPos2s = glRasterPos2f
glRasterPos3d = glRasterPos3i = glRasterPos3s = glRasterPos3f
glRasterPos4d = glRasterPos4i = glRasterPos4s = glRasterPos4f
glRasterPos2dv = glRasterPos2iv = glRasterPos2sv = glRasterPos2fv
glRasterPos3dv = glRasterPos3iv = glRasterPos3sv = glRasterPos3fv
glRasterPos4dv = glRasterPos4iv = glRasterPos4sv = glRasterPos4fv
glWindowPos2d = glWindowPos2i = glWindowPos2s = glWindowPos2f
glWindowPos3d = glWindowPos3i = glWindowPos3s = glWindowPos3f
glWindowPos2dv = glWindowPos2iv = glWindowPos2sv = glWindowPos2fv
glWindowPos3dv = glWindowPos3iv = glWindowPos3sv = glWindowPos3fv

__all__ = spelled_like_gl(globals())
