"""glBegin ... glEnd pairs that are drawn together: their numbers become arrays when they are drawn.

A program that draws each tile or face between a glBegin and a glEnd of its own makes many pairs of a few vertices. The
vertices of such pairs are those of one `Primitive`: its pair pauses at glEnd, and is resumed by the next glBegin.
"""

from __future__ import annotations

from softshadow import tokens as gl
from softshadow.context import Context, Primitive
from softshadow.context.joined_pairs import Told
from softshadow.context.late_draws import NO_VERTICES, LateDraw
from softshadow.framebuffer import DEFAULT
from softshadow.gl.constant_attributes import carried_of, kept_constants
from softshadow.gl.vertex_format import vertices_of
from softshadow.pipeline.commands import Draw, Vertices
from softshadow.pipeline.mesa.driver_draws import offset_depends_on_mode

FEW = 64  # vertices of a pair whose numbers wait; arrays for more cost little in comparison


class PairNumbers:
    """The vertices of pairs that are not drawn yet.

    Which attributes they carry, and the current values of the others, stay as they are until then: a change of these
    draws what is collected first.
    """

    __slots__ = ("_context", "primitive")

    def __init__(self, context: Context, primitive: Primitive) -> None:
        self._context, self.primitive = context, primitive

    def vertices(self) -> Vertices:
        """Return the vertices of all pairs."""
        return vertices_of(self._context, self.primitive)


def can_be_joined(context: Context) -> bool:
    """Return whether strips, fans, loops or polygons in a row may become one draw of separate triangles or lines.

    Feedback, selection and origins tell them apart.
    """
    return context.origin is None and context.render_mode.mode == gl.GL_RENDER


def collect_pair(context: Context, mode: int, primitive: Primitive) -> None:
    """Collect a pair, to draw it together with pairs that follow."""
    buffer, count = context.vertex_buffer, len(primitive.positions) // 4
    if buffer.can_join(mode):
        joined = buffer.joined_pairs
        assert joined is not None
        joined.add(_told(context), vertices_of(context, primitive), count)
    else:
        first = _late_draw(context, mode, primitive) if count <= FEW else None
        buffer.begin_joined_pairs(first or context.draw_command(mode, vertices_of(context, primitive)), count)
    is_listed = primitive.from_list or context.executes_list
    can_pause = count <= FEW and mode == primitive.mode and not (is_listed or primitive.arrays)
    buffer.paused = primitive if can_pause else None


def _late_draw(context: Context, mode: int, primitive: Primitive) -> LateDraw | None:
    """Return the draw of a pair whose arrays can be made later; None if they must be made now."""
    current, carried = context.current, carried_of(tuple(context.vertex_buffer.sizes))
    if primitive.arrays or primitive.materials or carried.optional or not current.is_plain:
        return None
    like = _like(context, mode)
    if like is None:
        return None
    for name in carried.columns:
        if name not in primitive.changes:  # then all its vertices have the same value
            primitive.changes[name] = [(0, context.attribute(name))]
    return LateDraw(
        like,
        PairNumbers(context, primitive),
        carried.columns,
        current.color,
        current.normal,
        kept_constants(context).find_texcoords(context, carried.units),
        *context.modelview_stack.drawn(),
    )


def _like(context: Context, mode: int) -> Draw | None:
    """Return a draw under the current state for `LateDraw`; None where draws are not late.

    They are not where they may fail, where someone is told about them, or where they depend on what a later call may
    change.
    """
    state = context.drawn_state
    if context.labels or context.origin is not None or context.gate is not None or not context.has_followed(state):
        return None
    late, projection, matrices = context.late, context.projection_stack.current, context.texture_matrices()
    like = late.likes.get((mode, id(state)))  # which keeps its state
    if like is None or like.projection is not projection or like.texture_matrices is not matrices:
        if state.program or state.draw_framebuffer != DEFAULT or offset_depends_on_mode(state):
            return None
        like = context.draw_command(mode, NO_VERTICES)
        late.keep_like(like)
    return like


def resume(context: Context, mode: int) -> bool:
    """Begin a pair with the vertices of the paused one; return False, and do nothing, if it has its own."""
    paused = context.vertex_buffer.paused
    if paused is None or paused.mode != mode or context.primitive is not None:
        return False
    if not paused.start and not _let_wait(context, paused):
        return False
    place, current = len(paused.positions), context.current.__dict__
    for name, changes in paused.changes.items():
        value = current[name] if name in current else context.attribute(name)
        if value is not changes[-1][1]:
            changes.append((place, value))
    paused.start = place
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
    joined.replace_last(PairNumbers(context, paused))
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
