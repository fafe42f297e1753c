"""glRasterPos and glWindowPos: where glBitmap draws, and in which colour.

References: GL 2.1, sec. 2.13 (current raster position); rastpos.c of Mesa 22.3.
"""

from __future__ import annotations

from array import array
from functools import lru_cache
from operator import is_
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, RasterPosition
from softshadow.frozen import evolve
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.conversions import vector
from softshadow.gl.errors import outside_begin
from softshadow.gl.raster_lighting import raster_colors, transformed
from softshadow.gl.render_modes import note_raster_position
from softshadow.pipeline.geometry.geometry import planes_in_clip_space
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
    context.separate()
    context.update_current()
    context.touched |= gl.GL_CURRENT_BIT
    with np.errstate(all="ignore"):
        _set(context, np.array([x, y, z, w]).astype(F32))


def _set(context: Context, point: np.ndarray) -> None:
    state, before = context.state, context.current.raster
    modelview, modelview_kind = context.modelview_stack.drawn()
    projection, projection_kind = context.projection_stack.drawn()
    modelview, projection = modelview.astype(F32, copy=False), projection.astype(F32, copy=False)
    eye = transformed(modelview, point)
    clip = transformed(projection, eye)
    planes = planes_in_clip_space(state.clip_planes, projection, projection_kind)
    w = float(clip[3])
    if not _is_inside(clip, state.depth.clamp, planes):
        context.current.raster = evolve(before, valid=False)
        return
    scale, shift, near, far = _window_of(state.viewport)
    over_w = F32(1) if w == 0 else F32(1) / clip[3]
    x, y, z = (clip[:3] * over_w * scale + shift).tolist()
    color, secondary = _current_colors(context)
    if state.lighting.enabled:
        color, secondary = raster_colors(context, point, modelview, modelview_kind)
    if state.depth.clamp:  # as in Mesa, which clamps w in place of z
        w = (far if w > far else w) if w > near else near
    context.current.raster = RasterPosition(
        window=(x, y, z, w),
        distance=_distance(context, eye),
        color=color,
        secondary=secondary,
        texcoords=_texcoords(context),
    )
    note_raster_position(context)


@lru_cache(maxsize=16)
def _window_of(view: Viewport) -> tuple[np.ndarray, np.ndarray, float, float]:
    """Return scale and shift (3,) from normalized device coordinates to the window, and the depth range."""
    near, far = F32(view.near), F32(view.far)
    scale = np.array([F32(0.5) * F32(view.width), F32(0.5) * F32(view.height), F32(0.5) * (far - near)])
    shift = np.array([scale[0] + F32(view.x), scale[1] + F32(view.y), F32(0.5) * (near + far)])
    return scale, shift, float(near), float(far)


def _is_inside(clip: np.ndarray, depth_clamp: bool, planes: np.ndarray) -> bool:
    """Return whether a point lies in the view volume; what is not a number is inside, as in Mesa."""
    x, y, z, w = clip.tolist()
    outside = x > w or x < -w or y > w or y < -w or (not depth_clamp and (z < -w or z > w))
    if outside or not len(planes):
        return not outside
    x, y, z, w = clip
    distances = [((x * a + y * b) + z * c) + w * d for a, b, c, d in planes]
    return not any(distance < 0 for distance in distances)


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


def _current_colors(context: Context) -> list[tuple[float, ...]]:
    """Return the current colour and secondary colour in single precision."""
    current = context.current
    return [tuple(array("f", color)) for color in (current.color, current.secondary)]


def _distance(context: Context, eye: np.ndarray) -> float:
    """Return the distance of the raster position: that of its place in eye space, or the current fog coordinate."""
    if context.state.fog.source == gl.GL_FOG_COORD:
        return float(F32(context.current.fog_coordinate))
    return float(np.sqrt((eye[0] * eye[0] + eye[1] * eye[1]) + eye[2] * eye[2]))


@in_lists
def glWindowPos3f(x: float, y: float, z: float) -> None:
    """Set the raster position in window coordinates, z from 0 to 1 within the depth range; it is always valid."""
    context = outside_begin("glWindowPos3f")
    if context is None:
        return
    context.separate()
    context.update_current()
    view = context.state.viewport
    near, far = F32(view.near), F32(view.far)
    with np.errstate(all="ignore"):
        depth = min(max(F32(z), F32(0)), F32(1)) * (far - near) + near
        window = (float(F32(x)), float(F32(y)), float(depth), 1.0)
    color, secondary = (tuple(min(max(each, 0.0), 1.0) for each in color) for color in _current_colors(context))
    coordinates = tuple(tuple(each) for each in context.current.texcoords)
    context.current.raster = RasterPosition(
        window=window,
        distance=_distance(context, np.zeros(3, F32)),
        color=color,
        secondary=secondary,
        texcoords=coordinates,
    )
    context.touched |= gl.GL_CURRENT_BIT
    note_raster_position(context)


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
