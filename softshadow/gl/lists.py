"""Display lists: calls that are recorded and carried out later.

A list records the calls decorated by `in_lists`; arrays are read while the list is compiled. At its end, primitives
become arrays (`list_compiling`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from ctypes import c_uint
from functools import partial
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, DisplayList, current, thread
from softshadow.gl.calls import in_lists, record, spelled_like_gl
from softshadow.gl.errors import fail, is_one_of, outside_begin
from softshadow.gl.list_characters import Character, character_of, draw_text
from softshadow.gl.list_compiling import with_primitives
from softshadow.gl.list_primitives import ListPrimitive, carry_out
from softshadow.gl.names import has_memory_for, reserve
from softshadow.gl.refusals import CONVERTING, refusal

DEEPEST_LIST = 64
LARGEST_NAME = 2**32 - 1
NAME_TYPES = range(gl.GL_BYTE, gl.GL_FLOAT + 1)
MODES = (gl.GL_COMPILE, gl.GL_COMPILE_AND_EXECUTE)


def glGenLists(range: int) -> int | None:
    """Return the first of `range` consecutive names never used before, and create empty lists of these names."""
    context = outside_begin("glGenLists")
    if context is None:
        return None
    context.flush()
    if range < 0:
        fail(gl.GL_INVALID_VALUE, "glGenLists", f"range={range}: expected 0 or more")
        return None
    if not has_memory_for("glGenLists", "range", range):
        return None
    if range == 0:
        return 0
    first = context.names["list"] + 1
    if first + range > LARGEST_NAME:  # then Mesa looks for a gap
        first = 1
        while any(first + i in context.lists for i in np.arange(range)):
            first += 1
    reserve(context, "list", first + range - 1)
    for name in np.arange(first, first + range).tolist():
        context.lists[name] = DisplayList(name, gl.GL_COMPILE)
    return first


def glNewList(list: int, mode: int) -> None:
    """Begin a list: record the calls until glEndList; GL_COMPILE_AND_EXECUTE also carries them out."""
    context = outside_begin("glNewList")
    if context is None:
        return
    context.flush()
    context.update_current()
    name = c_uint(int(list)).value
    if context.compiled_list is not None:
        fail(gl.GL_INVALID_OPERATION, "glNewList", f"list {context.compiled_list.name} has not been ended")
    elif name == 0:
        fail(gl.GL_INVALID_VALUE, "glNewList", f"list={list}: expected 1 or more")
    elif is_one_of("glNewList", "mode", mode, MODES, "GL_COMPILE or GL_COMPILE_AND_EXECUTE"):
        context.compiled_list, context.ready = DisplayList(name, int(mode)), False


def glEndList() -> None:
    """End the list, which replaces an older one of its name. A missing glEnd is an error, but the list ends."""
    context = current()
    compiled, context.compiled_list, context.ready = context.compiled_list, None, False
    if compiled is not None:
        compiled.calls = with_primitives(context, compiled.calls)
        compiled.character = character_of(compiled.calls)
        context.lists[compiled.name] = compiled
        reserve(context, "list", compiled.name)
    if outside_begin("glEndList") is None:
        return
    context.flush()
    if compiled is None:
        fail(gl.GL_INVALID_OPERATION, "glEndList", "there was no glNewList before it")


def glCallList(list: int) -> None:
    """Carry out a list. A name without a list does nothing, nor does name 0 inside another list.

    Raises
    ------
    GLError
        GL_INVALID_VALUE for name 0; else the first error of the list, after all its calls have been carried out.
    """
    context = thread.context
    try:
        if context.compiled_list is not None:
            record(context, glCallList, list)
            return
        name = list if list in context.lists else c_uint(int(list)).value
        if name == 0 and context.list_depth == 0:
            fail(gl.GL_INVALID_VALUE, "glCallList", f"list={list}: expected 1 or more")
        else:
            _call(context, name)
    except CONVERTING as error:
        raise refusal(glCallList, error, list) from error


@in_lists
def glCallLists(*arguments: Any) -> None:
    """Carry out several lists: (lists), or (n, type, lists) as in C.

    The numbers of an array, or the characters of a string, are added to glListBase to get the names.
    """
    context, lists = current(), arguments[-1]
    if len(arguments) == 3:
        n, type, _ = arguments
        if n < 0:
            fail(gl.GL_INVALID_VALUE, "glCallLists", f"n={n}: expected 0 or more")
            return
        if not is_one_of("glCallLists", "type", type, NAME_TYPES, "an integer type or GL_FLOAT"):
            return
        lists = lists[:n]
    characters = lists.encode() if isinstance(lists, str) else lists
    names = list(characters) if isinstance(characters, bytes) else np.ravel(characters).tolist()
    carry_out(_calls_of(context, [context.list_base + int(name) for name in names]))


def _calls_of(context: Context, names: Sequence[int]) -> Iterator[Callable[[], None]]:
    """Yield what calls the lists of these names; characters in a row are called together."""
    text: list[int] = []
    key = None
    for name in names:
        compiled = context.lists.get(name)
        if compiled is None or not compiled.calls:
            continue
        character: Character | None = compiled.character
        if text and (character is None or (key and character.key not in (key, None))):
            yield partial(_call_text, context, text)
            text, key = [], None
        if character is None:
            yield partial(_call, context, name)
        else:
            text.append(name)
            key = key or character.key
    if text:
        yield partial(_call_text, context, text)


def _call_text(context: Context, names: Sequence[int]) -> None:
    characters = [context.lists[name].character for name in names]
    if len(names) == 1 or context.list_depth == DEEPEST_LIST or not draw_text(context, characters):
        carry_out(partial(_call, context, name) for name in names)


def _call(context: Context, name: int) -> None:
    compiled = context.lists.get(name)
    if compiled is None or not compiled.calls or context.list_depth == DEEPEST_LIST:
        return
    calls = compiled.calls
    if len(calls) == 1 and isinstance(calls[0], ListPrimitive) and calls[0].draws_again(context):
        return
    context.flush_vertices()
    context.list_depth += 1
    try:
        carry_out(calls)
    finally:
        context.list_depth -= 1
        if not context.ready:
            context.flush_vertices()


@in_lists
def glListBase(base: int) -> None:
    """Set the number that glCallLists adds to each name."""
    context = outside_begin("glListBase")
    if context is not None:
        context.flush_vertices()
        context.list_base = int(base)
        context.touched |= gl.GL_LIST_BIT


def glDeleteLists(list: int, range: int) -> None:
    """Delete `range` lists with consecutive names."""
    context = outside_begin("glDeleteLists")
    if context is None:
        return
    context.flush()
    if range < 0:
        fail(gl.GL_INVALID_VALUE, "glDeleteLists", f"range={range}: expected 0 or more")
        return
    for name in [known for known in context.lists if list <= known < list + range]:
        del context.lists[name]


def glIsList(list: int) -> bool | None:
    """Return whether a list of this name exists."""
    context = outside_begin("glIsList")
    return None if context is None else int(list) in context.lists


__all__ = spelled_like_gl(globals())
