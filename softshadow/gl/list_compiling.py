"""Compiling a display list: primitives become arrays where nothing but vertices and attributes is between their calls.

The result is that of the calls (see tests/gl/test_list_primitives.py), which remain for the cases that depend on what
came before.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from itertools import groupby
from typing import Any

import numpy as np

from softshadow.context import Context
from softshadow.context.arrays import COLOR, NORMAL, POSITION, SLOT_NAMES
from softshadow.gl.calls import NUMBERS
from softshadow.gl.immediate import MODES, consecutive_indices
from softshadow.gl.list_calls import BEGIN, CALLS, END, Values, value_of
from softshadow.gl.list_joining import joined
from softshadow.gl.list_primitives import ListPrimitive, with_similar_joined
from softshadow.gl.list_vertices import MixedPrimitive
from softshadow.gl.textures import glBindTexture
from softshadow.gl.vertex_format import REST
from softshadow.pipeline.mesa.driver_draws import CORNERS


def with_primitives(context: Context, calls: list[Callable[[], Any]]) -> list[Callable[[], Any]]:
    """Return the calls of a list, with primitives as arrays, or as one call each where these cannot replace them."""
    compiled: list[Callable[[], Any]] = []
    begin, is_plain = -1, True  # place of the last glBegin in `compiled`, and whether nothing else follows it
    for call in calls:
        compiled.append(call)
        function = getattr(call, "func", None)
        if function is BEGIN:
            begin, is_plain = len(compiled) - 1, True
        elif function is END and begin >= 0:
            pair = compiled[begin:]
            primitive = _primitive(context, pair) if is_plain else None
            compiled[begin:] = [primitive or MixedPrimitive(context, pair)]
            begin = -1
        elif function not in CALLS:
            is_plain = False
    return with_similar_joined(_without_repeats(_with_joined(compiled)))


def _without_repeats(calls: list[Any]) -> list[Callable[[], Any]]:
    """Return the calls of a list without those that set the colour, or bind the texture, of the call before.

    Programs that read models from files set the material of each face.
    """
    result: list[Callable[[], Any]] = []
    color: Any = None  # the latest calls whose effect lasts
    texture: Any = None
    for call in calls:
        function = getattr(call, "func", None)
        if function is glBindTexture:
            if texture is not None and _is_same(texture, call):
                continue
            texture = call
        elif function in CALLS and CALLS[function].slot == COLOR:
            if color is not None and _is_same(color, call):
                continue
            color = call
        elif isinstance(call, ListPrimitive):
            color = None if COLOR in call.starts else color
        elif function not in CALLS:
            color = texture = None
        result.append(call)
    return result


def _is_same(one: partial[Any], other: partial[Any]) -> bool:
    """Return whether two calls have the same numbers, bit for bit."""
    if one.func is not other.func or one.keywords or other.keywords:
        return False
    return NUMBERS.issuperset(map(type, one.args + other.args)) and repr(one.args) == repr(other.args)


def is_open(calls: Sequence[Callable[[], Any]]) -> bool:
    """Return whether the calls recorded until now may have begun a primitive that has not ended."""
    for call in reversed(calls):
        function = getattr(call, "func", None)
        if function is BEGIN:
            return True
        if function not in CALLS:  # glEnd, or a call that may not stand between glBegin and glEnd
            return False
    return False


def _with_joined(calls: list[Callable[[], Any]]) -> list[Callable[[], Any]]:
    """Return the calls of a list with consecutive primitives joined."""
    result: list[Callable[[], Any]] = []
    for is_attribute_or_primitive, part in groupby(calls, _stays_between):
        stretch = list(part)
        if not is_attribute_or_primitive:
            result += stretch
            continue
        runs: list[list[Any]] = []
        for call in stretch:
            if runs and isinstance(call, ListPrimitive) and _has_same_attributes(runs[-1][-1], call):
                runs[-1].append(call)
            else:
                runs.append([call])
        places = [number for number, run in enumerate(runs) if isinstance(run[0], ListPrimitive)]
        for number, run in enumerate(runs):
            if number in places:
                run = joined(run, is_opening=number == places[0], is_closing=number == places[-1])
                if not run[-1].leaves_values:  # the last one decides for all
                    for primitive in run:
                        primitive.leaves_values = False
            result += run
    return result


def _stays_between(call: Callable[[], Any]) -> bool:
    """Return whether Mesa may join the primitives before a call with those after it."""
    return isinstance(call, ListPrimitive) or getattr(call, "func", None) in CALLS


def _has_same_attributes(first: Any, second: ListPrimitive) -> bool:
    return isinstance(first, ListPrimitive) and first.sizes == second.sizes and not any(second.starts.values())


def _primitive(context: Context, calls: list[Any]) -> ListPrimitive | None:
    """Return a pair of a list as arrays; None if it is empty, or has arguments that may be wrong."""
    begin, *inner, end = calls
    if len(begin.args) != 1 or begin.keywords or end.args or end.keywords or begin.args[0] not in MODES:
        return None
    columns: dict[int, list[Values]] = {POSITION: []}
    starts: dict[int, int] = {}
    last: dict[int, Values] = {}
    sizes: dict[str, int] = {}
    positions = columns[POSITION]
    for call in inner:
        slot_and_values = value_of(call)
        if slot_and_values is None:
            return None
        slot, values = slot_and_values
        sizes[SLOT_NAMES[slot]] = len(values)
        if slot != NORMAL:
            values = (*values, *REST[len(values) :])
        if slot == POSITION:
            positions.append(values)
            for other, value in last.items():
                columns[other].append(value)
        else:
            if slot not in last:
                starts[slot] = len(positions)
                columns[slot] = [values] * len(positions)  # replaced by the current value of the call
            last[slot] = values
    if not positions:
        return None
    rows = {slot: context.frozen(column) for slot, column in columns.items()}
    mode, indices = int(begin.args[0]), consecutive_indices(len(positions))
    if shares_vertices(mode, len(positions)) and not any(starts.values()):
        rows, indices = _with_equal_vertices_joined(rows, indices)
    return ListPrimitive(calls, mode, rows, starts, last, sizes, indices)


def shares_vertices(mode: int, count: int) -> bool:
    """Return whether a primitive of so many vertices may name a vertex several times.

    With vertices left over, the range of the indices would decide how quads are cut (`mesa.segments`).
    """
    return mode in CORNERS and count % CORNERS[mode] == 0


def _with_equal_vertices_joined(
    rows: dict[int, np.ndarray], indices: np.ndarray
) -> tuple[dict[int, np.ndarray], np.ndarray]:
    """Return rows without repetitions, and indices into them: corners of a mesh are shared by several triangles."""
    bits = np.hstack(list(rows.values()))
    keys = bits.view(np.dtype((np.void, bits.strides[0])))[:, 0]
    _, first, inverse = np.unique(keys, return_index=True, return_inverse=True)
    if len(first) == len(keys):
        return rows, indices
    return used_rows({slot: array[first] for slot, array in rows.items()}, inverse)


def used_rows(rows: dict[int, np.ndarray], indices: np.ndarray) -> tuple[dict[int, np.ndarray], np.ndarray]:
    """Return the rows that indices name, in the order of their first use, and indices into these."""
    names, first, inverse = np.unique(indices, return_index=True, return_inverse=True)
    order = np.argsort(first)
    places = np.empty(len(order), np.int32)
    places[order] = np.arange(len(order))
    used, indices = {slot: array[names[order]] for slot, array in rows.items()}, places[inverse]
    for array in (*used.values(), indices):
        array.setflags(write=False)
    return used, indices


__all__ = ["is_open", "shares_vertices", "used_rows", "with_primitives"]
