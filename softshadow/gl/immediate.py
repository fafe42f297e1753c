"""Immediate mode: glBegin, glVertex, glEnd, glRect."""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, current
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.conversions import vector
from softshadow.gl.errors import fail, is_one_of, outside_begin
from softshadow.gl.framebuffers import framebuffer_status
from softshadow.gl.materials import follow_color, material_field
from softshadow.gl.vertex_format import REST, begin, carry_attribute, end_continued_loop, store_vertex, vertices_of
from softshadow.pipeline.mesa.driver_draws import CORNERS

MODES = range(gl.GL_POINTS, gl.GL_POLYGON + 1)
A_MODE = "GL_POINTS … GL_POLYGON"


def can_draw(context: Context, operation: str) -> bool:
    """Return whether the draw framebuffer is complete; otherwise the call fails."""
    name = context.state.draw_framebuffer
    if framebuffer_status(context, name) == gl.GL_FRAMEBUFFER_COMPLETE:
        return True
    fail(gl.GL_INVALID_FRAMEBUFFER_OPERATION, operation, f"framebuffer {name} is not complete")
    return False


@in_lists
def glBegin(mode: int) -> None:
    """Start a primitive."""
    context = outside_begin("glBegin")
    if context is not None and is_one_of("glBegin", "mode", mode, MODES, A_MODE) and can_draw(context, "glBegin"):
        begin(context, int(mode))


@in_lists
def glEnd() -> None:
    """Draw the primitive, or collect it to be drawn together with others."""
    context = current()
    primitive = context.primitive
    if primitive is None:
        fail(gl.GL_INVALID_OPERATION, "glEnd", "there was no glBegin before it")
        return
    context.primitive, context.ready = None, False
    follow_color(context)
    context.pending.reset_due |= bool(primitive.positions)
    if not primitive.positions:
        context.vertex_buffer.end_pair(primitive.mode, 0)
        return
    if primitive.continued and primitive.mode == gl.GL_LINE_LOOP:
        end_continued_loop(context, primitive)
    vertices = vertices_of(context, primitive)
    if primitive.from_list and context.list_depth > 0:
        context.draw(primitive.mode, vertices, consecutive_indices(len(vertices.position)))
        return
    one_triangle = primitive.mode in (gl.GL_TRIANGLE_STRIP, gl.GL_TRIANGLE_FAN) and len(vertices.position) == 3
    mode = gl.GL_TRIANGLES if one_triangle else primitive.mode  # as in Mesa (vbo_try_prim_conversion)
    if mode in CORNERS:
        context.collect(mode, vertices)
    else:
        context.draw_primitive(mode, vertices)
    one_line = mode == gl.GL_LINE_STRIP and len(vertices.position) == 2
    context.vertex_buffer.end_pair(gl.GL_LINES if one_line else mode, len(vertices.position))


def consecutive_indices(count: int) -> np.ndarray:
    """Return the indices 0, 1, 2 ...: Mesa's display lists draw with indices, which cuts quads the other way."""
    indices = np.arange(count, dtype=np.int32)
    indices.setflags(write=False)
    return indices


def add_vertex(context: Context, *coordinates: float) -> None:
    """Add a vertex with the current attributes to the primitive; missing coordinates are z = 0, w = 1."""
    primitive = context.primitive
    if primitive is None:  # undefined in GL; here it adds nothing
        context.flush()
        return
    carry_attribute(context, "position", len(coordinates))
    attributes = context.current
    primitive.positions.append((*coordinates, *REST[len(coordinates) :]))  # type: ignore[arg-type]
    primitive.colors.append(attributes.color)
    primitive.normals.append(attributes.normal)
    primitive.texcoords.append(tuple(attributes.texcoords))
    for name, rows in primitive.materials.items():
        rows.append(material_field(context, name))
    store_vertex(context, primitive)


@in_lists
def glVertex2f(x: float, y: float) -> None:
    """Add a vertex, z = 0, w = 1."""
    add_vertex(current(), x, y)


@in_lists
def glVertex3f(x: float, y: float, z: float) -> None:
    """Add a vertex, w = 1."""
    add_vertex(current(), x, y, z)


@in_lists
def glVertex4f(x: float, y: float, z: float, w: float) -> None:
    """Add a vertex in homogeneous coordinates."""
    add_vertex(current(), x, y, z, w)


@in_lists
def glVertex2fv(v: Any) -> None:
    """Add a vertex from a vector."""
    add_vertex(current(), *vector(v, 2))


@in_lists
def glVertex3fv(v: Any) -> None:
    """Add a vertex from a vector."""
    add_vertex(current(), *vector(v, 3))


@in_lists
def glVertex4fv(v: Any) -> None:
    """Add a vertex from a vector."""
    add_vertex(current(), *vector(v, 4))


@in_lists
def glVertex2iv(v: Any) -> None:
    """Add a vertex from a vector of integers."""
    add_vertex(current(), *vector(v, 2, int))


@in_lists
def glVertex3iv(v: Any) -> None:
    """Add a vertex from a vector of integers."""
    add_vertex(current(), *vector(v, 3, int))


@in_lists
def glVertex4iv(v: Any) -> None:
    """Add a vertex from a vector of integers."""
    add_vertex(current(), *vector(v, 4, int))


# GL converts all coordinates to single precision
glVertex2d = glVertex2i = glVertex2s = glVertex2f
glVertex3d = glVertex3i = glVertex3s = glVertex3f
glVertex4d = glVertex4i = glVertex4s = glVertex4f
glVertex2dv, glVertex3dv, glVertex4dv = glVertex2fv, glVertex3fv, glVertex4fv
glVertex2sv, glVertex3sv, glVertex4sv = glVertex2iv, glVertex3iv, glVertex4iv


@in_lists
def glRectf(x1: float, y1: float, x2: float, y2: float) -> None:
    """Draw a rectangle in the plane z = 0, as a quad."""
    context = outside_begin("glRectf")
    if context is None or not can_draw(context, "glRectf"):
        return
    glBegin(gl.GL_QUADS)
    for x, y in ((x1, y1), (x2, y1), (x2, y2), (x1, y2)):
        add_vertex(context, x, y)
    glEnd()


@in_lists
def glRectfv(v1: Any, v2: Any) -> None:
    """Draw a rectangle between two corners given as vectors."""
    glRectf(*vector(v1, 2), *vector(v2, 2))


glRectd = glRecti = glRects = glRectf
glRectdv = glRectiv = glRectsv = glRectfv

__all__ = spelled_like_gl(globals())
