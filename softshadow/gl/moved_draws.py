"""Draws of lists and of small arrays that differ from an earlier one in vertices and modelview matrix only.

A program that draws many objects, each under a matrix of its own, by a list or from arrays makes such draws. They wait
(`softshadow.context.late_draws`), and are made together.
"""

from __future__ import annotations

import numpy as np

from softshadow.context import Context
from softshadow.context.late_forms import MovedDraw
from softshadow.pipeline.commands import Draw, Vertices

MOST_VERTICES = 256  # of a draw that waits: of more, its own work is most of the time
MOST_EARLIER = 256  # draws that are kept: each keeps its vertices


def draw_maybe_later(
    context: Context,
    mode: int,
    vertices: Vertices,
    indices: np.ndarray | None,
    slots: tuple[int, ...],
    pairs_mode: int = 0,
) -> Draw | None:
    """Draw primitives under the current state; nobody may change the arrays afterwards.

    `slots` are those of the attributes that have an array; the others have one value. `pairs_mode`: see `Draw`. Return
    the earlier draw that this one continues, if it waits.
    """
    if not context.ready:
        context.separate()
        context.ready = context.compiled_list is None
    context.update_current()
    if len(vertices.position) > MOST_VERTICES:
        context.draw_prepared(mode, vertices, indices, pairs_mode)
        return None
    earlier = context.stream.late.earlier
    key = mode, pairs_mode, id(context.drawn_state), slots
    before = earlier.get(key)
    if before is not None and continue_draw(context, before, vertices, indices):
        return before
    command = context.draw_prepared(mode, vertices, indices, pairs_mode)
    if _may_be_continued(context, command):
        if len(earlier) >= MOST_EARLIER:
            earlier.clear()
        earlier[key] = command  # which keeps the state, so that no other one gets its id
    return None


def continue_draw(context: Context, before: Draw, vertices: Vertices, indices: np.ndarray | None) -> bool:
    """Let primitives wait that continue an earlier draw; return False, and do nothing, if they do not.

    Nothing is collected, and the vertices have arrays of the same attributes.
    """
    if context.drawn_state is not before.state or not _is_continued(context, before):
        return False
    context.stream.add_late(MovedDraw(before, vertices, indices, *context.modelview_stack.drawn_bytes()))
    return True


def _is_continued(context: Context, before: Draw) -> bool:
    """Return whether nothing has changed since a draw under the same state but the modelview matrix and attributes."""
    return (
        context.projection_stack.current is before.projection
        and context.texture_matrices() is before.texture_matrices
        and context.current.is_plain
        and context.has_followed(before.state)
        and is_unmarked(context)
    )


def _may_be_continued(context: Context, command: Draw) -> bool:
    """Return whether draws that continue a draw may be late: they cannot fail, and nobody is told about them."""
    state, is_plain = command.state, context.current.is_plain
    if state.program or state.lines.stippled:
        return False
    return is_plain and context.has_followed(state) and is_unmarked(context)


def is_unmarked(context: Context) -> bool:
    """Return whether draws belong to no debug group, have no origin, and nobody is asked whether to make them."""
    return not context.labels and context.origin is None and context.stream.gate is None


__all__ = ["continue_draw", "draw_maybe_later", "is_unmarked"]
