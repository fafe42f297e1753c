"""glBegin ... glEnd pairs that are drawn together: their numbers become arrays when they are drawn.

A program that draws each tile or face between a glBegin and a glEnd of its own makes many pairs of a few vertices. The
vertices of such pairs are those of one `Primitive`: its pair pauses at glEnd, and is resumed by the next glBegin.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import partial
from operator import is_

from softshadow import tokens as gl
from softshadow.context import Context, Primitive
from softshadow.context.joined_pairs import LateVertices, Told
from softshadow.context.late_forms import NO_VERTICES, LateDraw, LateForm
from softshadow.gl.constant_attributes import Carried, carried_of, kept_constants
from softshadow.gl.moved_draws import is_unmarked
from softshadow.gl.vertex_format import vertices_of
from softshadow.pipeline.commands import Draw, Vertices
from softshadow.pipeline.geometry.separate import SEPARABLE
from softshadow.pipeline.mesa.driver_draws import SEPARATE, offset_depends_on_mode

FEW = 64  # vertices of a pair whose numbers wait; arrays for more cost little in comparison


def can_be_joined(context: Context) -> bool:
    """Return whether strips, fans, loops or polygons in a row may become one draw of separate triangles or lines.

    Feedback, selection and origins tell them apart.
    """
    return context.origin is None and context.render_mode.mode == gl.GL_RENDER


def counted_mode(mode: int, count: int) -> int:
    """Return the mode as which Mesa counts a pair of so many vertices (vbo_try_prim_conversion)."""
    if count == 3 and mode in (gl.GL_TRIANGLE_STRIP, gl.GL_TRIANGLE_FAN):
        return gl.GL_TRIANGLES
    return gl.GL_LINES if count == 2 and mode == gl.GL_LINE_STRIP else mode


def is_collected(context: Context, mode: int) -> bool:
    """Return whether a pair of a mode is collected, to be drawn together with pairs that follow."""
    return mode in SEPARATE or (mode in SEPARABLE and can_be_joined(context))


def collect_pair(context: Context, mode: int, primitive: Primitive) -> None:
    """Collect a pair, to draw it together with pairs that follow."""
    buffer, count = context.vertex_buffer, len(primitive.positions) // 4
    joined = buffer.pairs_to_join(mode)
    if joined is not None:
        joined.add(_told(context), vertices_of(context, primitive), count)
    else:
        first = _late_draw(context, mode, primitive) if count <= FEW else None
        buffer.begin_joined_pairs(first or context.draw_command(mode, vertices_of(context, primitive)), count)
    is_listed = primitive.from_list or context.executes_list
    can_pause = count <= FEW and mode == primitive.mode and not (is_listed or primitive.arrays)
    buffer.paused = primitive if can_pause else None


def _late_draw(context: Context, mode: int, primitive: Primitive) -> LateDraw | None:
    """Return the draw of a pair whose arrays can be made later; None if they must be made now."""
    if primitive.arrays or primitive.materials:
        return None
    form = form_of(context, mode, context.vertex_buffer.sizes)
    if form is None:
        return None
    for name in form.columns:
        if name not in primitive.changes:  # then all its vertices have the same value
            primitive.changes[name] = [(0, context.attribute(name))]
    return LateDraw(
        form, primitive, context.current.color, context.current.normal, *context.modelview_stack.drawn_bytes()
    )


def form_of(context: Context, mode: int, carried: Iterable[str]) -> LateForm | None:
    """Return what draws of pairs under the current state have in common; None where draws are not late.

    They are not where they may fail, where someone is told about them, where they depend on what a later call may
    change, or where their vertices have attributes that not all `Vertices` have. `carried` are those they carry.
    """
    state, current, late = context.drawn_state, context.current, context.stream.late
    if not is_unmarked(context):
        return None
    key = mode, id(state), *carried
    form = late.forms.get(key)
    like = None
    if form is not None:
        if form.follows and not context.has_followed(state):
            return None
        like, projection = form.like, context.projection_stack.current
        if like.projection is not projection or like.texture_matrices is not context.texture_matrices():
            like = None
        elif not current.is_plain:
            return None
        elif all(map(is_, form.current, _texcoords(current.texcoords, form))):
            return form
    form = _new_form(context, mode, carried_of(key[2:]), like)
    if form is not None:
        late.keep_form(key, form)
    return form


def _texcoords(current: Sequence[tuple[float, ...]], form: LateForm) -> Sequence[tuple[float, ...]]:
    """Return the current texture coordinates, but for those that the vertices carry."""
    if not form.units:
        return current
    compared = list(current)
    for unit in form.units:
        compared[unit] = form.current[unit]
    return compared


def _new_form(context: Context, mode: int, carried: Carried, like: Draw | None) -> LateForm | None:
    """Return a form; `like` is that of an earlier one, under the same state and matrices."""
    state, current = context.drawn_state, context.current
    if carried.optional or not current.is_plain or not context.has_followed(state):
        return None
    if like is None:
        if state.program or offset_depends_on_mode(state):
            return None
        like = context.draw_command(mode, NO_VERTICES)
    texcoords = kept_constants(context).find_texcoords(context, carried.units)
    units, follows = tuple([unit for unit, _ in carried.units]), state.lighting.color_material
    return LateForm(
        like, carried.columns, texcoords, tuple(current.texcoords), units, follows, partial(vertices_of, context)
    )


def resume(context: Context, mode: int) -> bool:
    """Begin a pair with the vertices of the paused one; return False, and do nothing, if it has its own."""
    paused = context.vertex_buffer.paused
    if paused is None or context.primitive is not None:
        return False
    if paused.mode != mode:
        joined = context.vertex_buffer.joined_pairs
        if joined is None or not joined.turn(mode, context.drawn_state):
            return False
        paused.mode = joined.like.mode
    if not paused.start and not _let_wait(context, paused):
        return False
    place, current = len(paused.positions), context.current.__dict__
    for name, changes in paused.changes.items():
        value = current[name] if name in current else context.attribute(name)
        if value is not changes[-1][1]:
            changes.append((place, value))
    paused.start, paused.continued = place, False
    context.primitive, context.ready = paused, False
    return True


def _let_wait(context: Context, paused: Primitive) -> bool:
    """Replace the arrays of a pair by its numbers, so that others can follow; return whether it can be done.

    It can if the vertices carry no more attributes than all `Vertices` have.
    """
    buffer = context.vertex_buffer
    joined, carried = buffer.joined_pairs, carried_of(tuple(buffer.sizes))
    assert joined is not None
    if carried.optional or paused.materials or not joined.takes_more:
        buffer.paused = None
        return False
    vertices = joined.parts[-1][1]
    if not isinstance(vertices, Vertices):
        return True
    rows = {name: vertices.texcoords[unit] for unit, name in carried.units}
    rows.update(color=vertices.color, normal=vertices.normal)
    for name in carried.columns:
        if name not in paused.changes:  # then all its vertices have the same value
            paused.changes[name] = [(0, tuple(rows[name][0].tolist()))]
    joined.replace_last(LateVertices(paused, partial(vertices_of, context)))
    return True


def add_resumed(context: Context, mode: int, primitive: Primitive, count: int) -> bool:
    """Add a resumed pair to those before it; return False, with a primitive of its own, if it is not like them."""
    buffer = context.vertex_buffer
    joined = buffer.joined_pairs
    assert joined is not None
    if mode != primitive.mode or joined.last(_told(context)) is None:
        buffer.split(primitive)
        return False
    joined.count(count)
    if not joined.takes_more:
        buffer.paused = None
    return True


def _told(context: Context) -> Told:
    """Return the debug groups and the origin of the next draw."""
    return "/".join(context.labels) if context.labels else "", context.origin
