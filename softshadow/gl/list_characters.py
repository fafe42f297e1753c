"""Characters of a font: lists that draw a primitive and move on, called in a row by glCallLists.

A text is hundreds of such calls, each of a few vertices. Their draws differ in vertices and matrix only, so what they
have in common is found once.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from functools import partial
from itertools import groupby
from operator import itemgetter
from typing import Any, NamedTuple

from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.gl.calls import NUMBERS
from softshadow.gl.list_primitives import ListPrimitive, SimilarPrimitives, is_between_primitives, similarity
from softshadow.gl.transforms import glTranslatef


class Shape(NamedTuple):
    """What is drawn of a character, and its `Draw.pairs_mode`."""

    primitive: ListPrimitive
    pairs_mode: int


class Character(NamedTuple):
    """A list that draws primitives, or none as for a space, and then moves on; `key`: what similar ones share."""

    primitives: ListPrimitive | SimilarPrimitives | None
    moves: tuple[tuple[float, float, float], ...]
    key: tuple[object, ...] | None


def character_of(calls: Sequence[Any]) -> Character | None:
    """Return the calls of a list as a character; None if there are others."""
    primitives = calls[0] if calls and isinstance(calls[0], ListPrimitive | SimilarPrimitives) else None
    key = None if primitives is None else similarity(_ends_of(primitives)[0])
    moves = calls if primitives is None else calls[1:]
    if (primitives is not None and key is None) or not all(map(_is_move, moves)):
        return None
    return Character(primitives, tuple([call.args for call in moves]), key)


def _ends_of(primitives: ListPrimitive | SimilarPrimitives) -> tuple[ListPrimitive, ListPrimitive]:
    """Return the first and the last primitive."""
    if isinstance(primitives, ListPrimitive):
        return primitives, primitives
    return primitives.primitives[0], primitives.primitives[-1]


def _is_move(call: Any) -> bool:
    is_translation = isinstance(call, partial) and call.func is glTranslatef
    return is_translation and len(call.args) == 3 and NUMBERS.issuperset(map(type, call.args))


def draw_text(context: Context, characters: Sequence[Character]) -> bool:
    """Draw characters whose keys are equal, and move on; return False, and do nothing, if it needs their calls."""
    if context.primitive is not None or context.matrix_stack is not context.modelview_stack:
        return False
    context.flush_vertices()
    context.list_depth += 1
    try:
        shapes = _shapes_of(context, characters) if is_between_primitives(context) else None
        if shapes is None:
            return False
        n_spaces = next((place for place, shape in enumerate(shapes) if shape is not None), len(shapes))
        for character in characters[:n_spaces]:
            context.modelview_stack.translate_in_turn(character.moves)
        if n_spaces < len(shapes):
            _draw(context, characters[n_spaces:], shapes[n_spaces:])
            context.flush()
    finally:
        context.list_depth -= 1
        context.flush_vertices()
    return True


def _shapes_of(context: Context, characters: Sequence[Character]) -> list[Shape | None] | None:
    """Return what is drawn of each character; None if one is drawn as several."""
    shapes: list[Shape | None] = []
    are_separate: dict[Hashable, bool] = {}  # by their modes
    for primitives, *_ in characters:
        if primitives is None or isinstance(primitives, ListPrimitive):
            shapes.append(None if primitives is None else Shape(primitives, 0))
            continue
        if primitives.modes not in are_separate:
            are_separate[primitives.modes] = primitives.are_separate_in(context)
        if primitives.separate is None or not are_separate[primitives.modes]:
            return None
        shapes.append(Shape(primitives.separate, primitives.pairs_mode))
    return shapes


def _draw(context: Context, characters: Sequence[Character], shapes: Sequence[Shape | None]) -> None:
    """Draw characters, the first of which is no space, and move on."""
    ends = [end for each in characters if each.primitives is not None for end in _ends_of(each.primitives)]
    constants = ends[0].begin_draw(context)
    before, others, n_moves = None, [], 0
    for shape, (_, moves, _) in zip(shapes, characters, strict=True):
        if shape is not None:
            primitive, pairs_mode = shape
            vertices = primitive.vertices(constants)
            if before is None:
                before = context.draw(primitive.mode, vertices, primitive.indices, pairs_mode)
            else:
                others.append((primitive.mode, pairs_mode, vertices, primitive.indices, n_moves))
        n_moves += len(moves)
    assert before is not None
    matrices = context.modelview_stack.translate_in_turn([move for each in characters for move in each.moves])
    places = [(before.modelview, before.modelview_kind)]
    places += [(matrix, context.modelview_stack.kind) for matrix in matrices]
    for (mode, pairs_mode), same in groupby(others, itemgetter(0, 1)):
        like = before._replace(mode=mode, pairs_mode=pairs_mode)
        context.draw_moved(like, [(vertices, indices, *places[n]) for _, _, vertices, indices, n in same])
    ends[-1].make_current(context)
    if any(end.last != ends[0].last for end in ends):
        context.touched |= gl.GL_CURRENT_BIT  # even if the last values are those before the text


__all__ = ["Character", "character_of", "draw_text"]
