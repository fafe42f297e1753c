"""Characters of a font: lists that draw a primitive and move on, called in a row by glCallLists.

A text is hundreds of such calls, each of a few vertices. Their draws differ in vertices and matrix only, so what they
have in common is found once.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any, NamedTuple

from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.context.matrix_stacks import MatrixStack
from softshadow.gl.calls import NUMBERS
from softshadow.gl.list_primitives import ListPrimitive, is_between_primitives, similarity
from softshadow.gl.transforms import glTranslatef


class Character(NamedTuple):
    """A list that draws a primitive, or none as for a space, and then moves on; `key`: what similar ones share."""

    primitive: ListPrimitive | None
    moves: tuple[tuple[float, float, float], ...]
    key: tuple[object, ...] | None


def character_of(calls: Sequence[Any]) -> Character | None:
    """Return the calls of a list as a character; None if there are others."""
    primitive = calls[0] if calls and isinstance(calls[0], ListPrimitive) else None
    key = None if primitive is None else similarity(primitive)
    moves = calls if primitive is None else calls[1:]
    if (primitive is not None and key is None) or not all(map(_is_move, moves)):
        return None
    return Character(
        primitive, tuple([call.args for call in moves]), None if primitive is None else (primitive.mode, key)
    )


def _is_move(call: Any) -> bool:
    is_translation = isinstance(call, partial) and call.func is glTranslatef
    return is_translation and len(call.args) == 3 and NUMBERS.issuperset(map(type, call.args))


def draw_text(context: Context, characters: Sequence[Character]) -> bool:
    """Draw characters whose keys are equal, and move on; return False, and do nothing, if it needs their calls."""
    stack = context.modelview_stack
    if context.primitive is not None or context.matrix_stack is not stack:
        return False
    context.flush_vertices()
    context.list_depth += 1
    try:
        if not is_between_primitives(context):
            return False
        drawn = [place for place, each in enumerate(characters) if each.primitive is not None]
        first = drawn[0] if drawn else len(characters)
        for character in characters[:first]:
            stack.translate_in_turn(character.moves)
        if drawn:
            _draw(context, stack, characters[first:])
    finally:
        context.list_depth -= 1
        context.flush_vertices()
    return True


def _draw(context: Context, stack: MatrixStack, characters: Sequence[Character]) -> None:
    """Draw characters, the first of which has a primitive, and move on."""
    primitives = [character.primitive for character in characters if character.primitive is not None]
    first, last = primitives[0], primitives[-1]
    constants = first.begin_draw(context)
    before = context.draw(first.mode, first.vertices(constants), first.indices)
    matrices = [before.modelview, *stack.translate_in_turn([move for each in characters for move in each.moves])]
    kind, kind_behind = before.modelview_kind, stack.kind
    others, n_moves = [], len(characters[0].moves)
    for primitive, moves, _ in characters[1:]:
        if primitive is not None:
            kind = kind_behind if n_moves else kind
            others.append((primitive.vertices(constants), primitive.indices, matrices[n_moves], kind))
        n_moves += len(moves)
    if others:
        context.draw_moved(before, others)
        last.make_current(context)
        if any(primitive.last != first.last for primitive in primitives):
            context.touched |= gl.GL_CURRENT_BIT  # even if the last values are those before the text


__all__ = ["Character", "character_of", "draw_text"]
