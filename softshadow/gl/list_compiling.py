"""Compiling a display list: primitives become arrays where nothing but vertices and attributes is between their calls.

The result is that of the calls (see tests/gl/test_list_primitives.py), which remain for the cases that depend on what
came before.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.gl.array_snapshots import NORMAL, POSITION, TEXCOORD
from softshadow.gl.immediate import MODES, consecutive_indices
from softshadow.gl.list_calls import BEGIN, CALLS, END, Values
from softshadow.gl.list_primitives import NAMES, ListPrimitive
from softshadow.gl.vertex_format import REST
from softshadow.pipeline.mesa.driver_draws import CORNERS
from softshadow.state import TEXTURE_UNITS


def with_primitives(context: Context, calls: list[Callable[[], Any]]) -> list[Callable[[], Any]]:
    """Return the calls of a list, with primitives as arrays."""
    compiled: list[Callable[[], Any]] = []
    begin = -1  # place of the last glBegin in `compiled`
    opening: ListPrimitive | None = None  # the first primitive of a run without other calls between
    for call in calls:
        compiled.append(call)
        function = getattr(call, "func", None)
        if function is BEGIN:
            begin = len(compiled) - 1
        elif function is END and begin >= 0:
            primitive = _primitive(context, compiled[begin:])
            if primitive is not None:
                compiled[begin:] = [primitive]
                before = compiled[begin - 1] if begin else None
                if isinstance(before, ListPrimitive) and _can_be_joined(before, primitive, before is opening):
                    compiled[-2:] = [_joined_strips(before, primitive)]
                opening = opening or primitive
            begin = -1
        elif function not in CALLS:
            begin, opening = -1, None
    return compiled


def _primitive(context: Context, calls: list[Any]) -> ListPrimitive | None:
    """Return a pair of a list as arrays; None if it is empty, or has arguments that may be wrong."""
    begin, *inner, end = calls
    if len(begin.args) != 1 or any(map(_has_names, calls)) or end.args or begin.args[0] not in MODES:
        return None
    columns: dict[int, list[Values]] = {POSITION: []}
    starts: dict[int, int] = {}
    last: dict[int, Values] = {}
    sizes: dict[str, int] = {}
    positions = columns[POSITION]
    for call in inner:
        kind, arguments = CALLS[call.func], call.args
        slot = kind.slot
        try:
            if slot is None:
                slot, arguments = TEXCOORD + int(arguments[0]) % TEXTURE_UNITS, arguments[1:]
            values = kind.values(arguments)
        except Exception:  # the call itself raises the same when the list is called
            return None
        if values is None:
            return None
        sizes[NAMES[slot]] = len(values)
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
    # with vertices left over, the range of the indices would decide how quads are cut (`mesa.quad_cuts`)
    if mode in CORNERS and len(positions) % CORNERS[mode] == 0 and not any(starts.values()):
        rows, indices = _with_equal_vertices_joined(rows, indices)
    return ListPrimitive(calls, mode, rows, starts, last, sizes, indices)


def _can_be_joined(first: ListPrimitive, second: ListPrimitive, is_opening: bool) -> bool:
    """Return whether Mesa joins two consecutive primitives with triangles between."""
    shortest = 3 if is_opening else 4  # of a strip with one triangle it makes GL_TRIANGLES, but not where a run begins
    return (
        first.mode == second.mode == gl.GL_TRIANGLE_STRIP
        and first.sizes == second.sizes
        and not any(second.starts.values())
        and len(first.indices) >= shortest
        and len(second.indices) >= 4
    )


def _joined_strips(first: ListPrimitive, second: ListPrimitive) -> ListPrimitive:
    """Return two consecutive strips as one, with triangles of no area between them, as in Mesa.

    They are seen where polygons are not filled. Three or four repeated indices keep the facing of the second strip.
    """
    rows = {slot: np.concatenate([first.rows[slot], second.rows[slot]]) for slot in first.rows}
    later = second.indices + np.int32(len(first.rows[POSITION]))
    repeated = [first.indices[-1], *later[:1].repeat(2 if len(first.indices) % 2 else 1)]
    indices = np.concatenate([first.indices, np.array(repeated, np.int32), later])
    for array in (*rows.values(), indices):
        array.setflags(write=False)
    return ListPrimitive(first.calls + second.calls, first.mode, rows, first.starts, second.last, second.sizes, indices)


def _with_equal_vertices_joined(
    rows: dict[int, np.ndarray], indices: np.ndarray
) -> tuple[dict[int, np.ndarray], np.ndarray]:
    """Return rows without repetitions, and indices into them: corners of a mesh are shared by several triangles."""
    bits = np.hstack(list(rows.values()))
    keys = bits.view(np.dtype((np.void, bits.strides[0])))[:, 0]
    _, first, inverse = np.unique(keys, return_index=True, return_inverse=True)
    if len(first) == len(keys):
        return rows, indices
    order = np.argsort(first)  # of their first use
    places = np.empty(len(order), np.int32)
    places[order] = np.arange(len(order))
    joined = {slot: array[first[order]] for slot, array in rows.items()}
    indices = places[inverse]
    for array in (*joined.values(), indices):
        array.setflags(write=False)
    return joined, indices


def _has_names(call: partial[Any]) -> bool:
    return bool(call.keywords)


__all__ = ["with_primitives"]
