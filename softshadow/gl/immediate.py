"""Immediate mode: glBegin, glVertex, glEnd, glRect."""

from __future__ import annotations

from math import hypot
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import current, thread
from softshadow.framebuffer import DEFAULT
from softshadow.gl.calls import in_lists, is_allowed, record, spelled_like_gl
from softshadow.gl.conversions import vector
from softshadow.gl.deferred_pairs import defer
from softshadow.gl.errors import fail, is_one_of, outside_begin
from softshadow.gl.framebuffers import can_draw
from softshadow.gl.materials import follow_color
from softshadow.gl.pair_numbers import add_resumed, collect_pair, counted_mode, is_collected, resume
from softshadow.gl.refusals import CONVERTING, refusal
from softshadow.gl.vertex_format import add_vertex, begin, end, store_vertices, vertices_of
from softshadow.pipeline.mesa.driver_draws import SEPARATE

MODES = frozenset(range(gl.GL_POINTS, gl.GL_POLYGON + 1))
A_MODE = "GL_POINTS … GL_POLYGON"


def glBegin(mode: int) -> None:
    """Start a primitive."""
    context = thread.context
    try:
        if resume(context, mode):
            return
        if not (context.ready or is_allowed(context, glBegin, mode)):
            return
        if not (mode in MODES or is_one_of("glBegin", "mode", mode, MODES, A_MODE)):
            return
        if context.groups[""].fields["draw_framebuffer"] == DEFAULT or can_draw(context, "glBegin"):
            number = int(mode)
            if not defer(context, number):
                begin(context, number)
    except CONVERTING as error:
        raise refusal(glBegin, error, mode) from error


def glEnd() -> None:
    """Draw the primitive, or collect it to be drawn together with others."""
    context = thread.context
    if context.compiled_list is not None:
        record(context, glEnd)
        return
    primitive = context.primitive
    if primitive is None:
        fail(gl.GL_INVALID_OPERATION, "glEnd", "there was no glBegin before it")
        return
    if context.deferred is not None and context.deferred.end():
        return
    context.primitive, context.ready = None, False
    if primitive.mode == gl.GL_LINE_LOOP and primitive.positions and context.executes_list:
        # while Mesa compiles a list, it closes a loop by its first vertex, whose attributes become current
        for name in primitive.changes:
            context.set_attribute(name, primitive.values(name, None)[0])
    if context.groups["lighting"].fields["color_material"]:
        follow_color(context)
    count = (len(primitive.positions) - primitive.start) // 4
    if not count:
        context.vertex_buffer.end_pair(primitive.mode, 0)
        return
    context.pending.reset_due = context.pending.has_vertices = True
    end(context, primitive)
    if primitive.from_list and context.list_depth > 0:
        context.draw(primitive.mode, vertices_of(context, primitive), consecutive_indices(count))
        return
    counted = counted_mode(primitive.mode, count)
    mode = counted if counted == gl.GL_TRIANGLES else primitive.mode
    if not (primitive.start and add_resumed(context, mode, primitive, count)):
        # a primitive with arrays is drawn again with the same ones
        if is_collected(context, mode) and not (primitive.arrays and mode not in SEPARATE):
            collect_pair(context, mode, primitive)
        else:
            context.draw_primitive(mode, vertices_of(context, primitive))
    context.vertex_buffer.end_pair(counted, count)


def consecutive_indices(count: int) -> np.ndarray:
    """Return the indices 0, 1, 2 ...: Mesa's display lists draw with indices, which cuts quads the other way."""
    indices = np.arange(count, dtype=np.int32)
    indices.setflags(write=False)
    return indices


def glVertex2f(x: float, y: float) -> None:
    """Add a vertex, z = 0, w = 1."""
    try:
        hypot(x, y)  # the quickest question whether these are numbers
    except CONVERTING as error:
        raise refusal(glVertex2f, error, x, y) from error
    context = thread.context
    primitive = context.primitive
    if primitive is None or primitive.position_size != 2:
        if context.compiled_list is None:
            add_vertex(context, x, y)
        else:
            record(context, glVertex2f, x, y)
        return
    positions = primitive.positions
    positions += (x, y, 0.0, 1.0)
    if len(positions) >= primitive.limit:
        store_vertices(context, primitive)


def glVertex3f(x: float, y: float, z: float) -> None:
    """Add a vertex, w = 1."""
    try:
        hypot(x, y, z)  # the quickest question whether these are numbers
    except CONVERTING as error:
        raise refusal(glVertex3f, error, x, y, z) from error
    context = thread.context
    primitive = context.primitive
    if primitive is None or primitive.position_size != 3:
        if context.compiled_list is None:
            add_vertex(context, x, y, z)
        else:
            record(context, glVertex3f, x, y, z)
        return
    positions = primitive.positions
    positions += (x, y, z, 1.0)
    if len(positions) >= primitive.limit:
        store_vertices(context, primitive)


def glVertex4f(x: float, y: float, z: float, w: float) -> None:
    """Add a vertex in homogeneous coordinates."""
    try:
        hypot(x, y, z, w)  # the quickest question whether these are numbers
    except CONVERTING as error:
        raise refusal(glVertex4f, error, x, y, z, w) from error
    context = thread.context
    primitive = context.primitive
    if primitive is None or primitive.position_size != 4:
        if context.compiled_list is None:
            add_vertex(context, x, y, z, w)
        else:
            record(context, glVertex4f, x, y, z, w)
        return
    positions = primitive.positions
    positions += (x, y, z, w)
    if len(positions) >= primitive.limit:
        store_vertices(context, primitive)


def glVertex2fv(v: Any) -> None:
    """Add a vertex from a vector."""
    try:
        glVertex2f(*(v if type(v) is tuple and len(v) == 2 else vector(v, 2)))
    except CONVERTING as error:
        raise refusal(glVertex2fv, error, v) from error


def glVertex3fv(v: Any) -> None:
    """Add a vertex from a vector."""
    try:
        glVertex3f(*(v if type(v) is tuple and len(v) == 3 else vector(v, 3)))
    except CONVERTING as error:
        raise refusal(glVertex3fv, error, v) from error


def glVertex4fv(v: Any) -> None:
    """Add a vertex from a vector."""
    try:
        glVertex4f(*(v if type(v) is tuple and len(v) == 4 else vector(v, 4)))
    except CONVERTING as error:
        raise refusal(glVertex4fv, error, v) from error


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
    hypot(x1, y1, x2, y2)  # the quickest question whether these are numbers
    if not (resume(context, gl.GL_QUADS) or defer(context, gl.GL_QUADS)):
        begin(context, gl.GL_QUADS)
    primitive = context.primitive
    assert primitive is not None
    rest: tuple[float, ...] = x1, y1, 0.0, 1.0, x2, y1, 0.0, 1.0, x2, y2, 0.0, 1.0, x1, y2, 0.0, 1.0
    if primitive.position_size != 2 or primitive.limit <= len(primitive.positions) + len(rest):
        glVertex2f(x1, y1)  # it may decide for how many more there is room
        rest = rest[4:]
    if primitive.position_size == 2 and primitive.limit > len(primitive.positions) + len(rest):
        primitive.positions += rest
    else:
        for first in range(0, len(rest), 4):
            add_vertex(context, rest[first], rest[first + 1])
    glEnd()


@in_lists
def glRectfv(v1: Any, v2: Any) -> None:
    """Draw a rectangle between two corners given as vectors."""
    glRectf(*vector(v1, 2), *vector(v2, 2))


glRectd = glRecti = glRects = glRectf
glRectdv = glRectiv = glRectsv = glRectfv

__all__ = spelled_like_gl(globals())
