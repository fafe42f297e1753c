"""Draws from vertex arrays and buffer objects.

`array_snapshots` and `index_snapshots` make the arrays that a recording stores.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from ctypes import c_uint
from functools import partial
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, current, thread
from softshadow.context.arrays import EDGE, FOG_COORDINATE, POSITION, SECONDARY, SLOT_NAMES
from softshadow.gl.array_elements import glArrayElement
from softshadow.gl.array_snapshots import is_current, origins, slice_of, snapshot_rows
from softshadow.gl.calls import execute_listed, in_lists, spelled_like_gl
from softshadow.gl.constant_attributes import constant_attributes
from softshadow.gl.errors import fail, is_one_of, outside_begin, wrong_enum
from softshadow.gl.framebuffers import can_draw
from softshadow.gl.immediate import A_MODE, MODES, consecutive_indices, glBegin, glEnd
from softshadow.gl.index_snapshots import IndexSnapshot, Rows, snapshot_indices
from softshadow.gl.joined_draws import joined_indices, joined_ranges, joins
from softshadow.gl.list_compiling import shares_vertices, used_rows
from softshadow.gl.list_primitives import ListPrimitive
from softshadow.gl.moved_draws import draw_maybe_later
from softshadow.gl.pair_numbers import can_be_joined
from softshadow.gl.vertex_arrays import DTYPES, arrays_in_use
from softshadow.pipeline.commands import Vertices
from softshadow.pipeline.geometry.separate import SEPARABLE

INDEX_TYPES = (gl.GL_UNSIGNED_BYTE, gl.GL_UNSIGNED_SHORT, gl.GL_UNSIGNED_INT)
AN_INDEX_TYPE = "GL_UNSIGNED_BYTE, GL_UNSIGNED_SHORT or GL_UNSIGNED_INT"
OPTIONAL = {EDGE: "edges", SECONDARY: "secondary", FOG_COORDINATE: "fog_coordinates"}  # fields of `Vertices`
MOST_UNUSED = 2  # vertices between those of primitives that are drawn at once, for each index
MOST_WITHOUT_ARRAYS = 1 << 20  # vertices that are all the same
MOST_DRAWN = 4096  # ranges of one array with the vertices that were drawn


# -- drawing -----------------------------------------------------------------------------------------------------------
def glDrawArrays(mode: int, first: int, count: int) -> None:
    """Draw `count` vertices of the enabled arrays, starting at `first`."""
    context = _flushed("glDrawArrays")
    if context is None:
        return
    if not _refused("glDrawArrays", mode, count) and can_draw(context, "glDrawArrays"):
        begin = int(first)
        _draw(context, int(mode), _rows(context, "glDrawArrays", begin, begin + int(count)), None)


def glDrawElements(mode: int, count: int, type: int, indices: Any) -> None:
    """Draw vertices of the enabled arrays by indices: an array, or an offset into the bound buffer object."""
    _draw_elements("glDrawElements", mode, count, type, indices)


def glDrawRangeElements(mode: int, start: int, end: int, count: int, type: int, indices: Any) -> None:
    """Draw as glDrawElements does, with indices promised in [start, end]."""
    if outside_begin("glDrawRangeElements") is None:
        return
    if c_uint(int(end)).value < c_uint(int(start)).value:
        fail(gl.GL_INVALID_VALUE, "glDrawRangeElements", f"end={end}: expected {start} or more")
    else:
        _draw_elements("glDrawRangeElements", mode, count, type, indices)


def glMultiDrawArrays(mode: int, first: Any, count: Any, drawcount: int) -> None:
    """Draw `drawcount` ranges of the enabled arrays, each with its first vertex and number of vertices."""
    operation = "glMultiDrawArrays"
    context = _flushed(operation)
    if context is None:
        return
    firsts, counts = np.ravel(first)[:drawcount].tolist(), np.ravel(count)[: max(drawcount, 0)].tolist()
    if drawcount < 0 or min(counts, default=0) < 0:
        fail(gl.GL_INVALID_VALUE, operation, f"count={counts}, drawcount={drawcount}: expected 0 or more")
    elif is_one_of(operation, "mode", mode, MODES, A_MODE) and can_draw(context, operation):
        starts = [int(each) for each in firsts]
        may_be_one = len(starts) == len(counts) > 1 and min(starts) >= 0 and _may_be_one(context, operation, mode)
        joined = joined_ranges(context, int(mode), starts, counts) if may_be_one else None
        if joined is not None and _draw_as_one(context, operation, int(mode), joined):
            return
        for start, number in zip(starts, counts, strict=True):
            _draw(context, int(mode), _rows(context, operation, start, start + int(number)), None)


def glMultiDrawElements(mode: int, count: Any, type: int, indices: Any, drawcount: int) -> None:
    """Draw `drawcount` times as glDrawElements does, each with its number of indices and its array or offset."""
    operation = "glMultiDrawElements"
    context = _flushed(operation)
    if context is None:
        return
    counts = np.ravel(count)[: max(drawcount, 0)].tolist()
    places = list(indices)[: len(counts)]
    if drawcount < 0:
        fail(gl.GL_INVALID_VALUE, operation, f"drawcount={drawcount}: expected 0 or more")
    elif not is_one_of(operation, "mode", mode, MODES, A_MODE) or not is_one_of(
        operation, "type", type, INDEX_TYPES, AN_INDEX_TYPE
    ):
        return
    elif min(counts, default=0) < 0:
        fail(gl.GL_INVALID_VALUE, operation, f"count={counts}: expected 0 or more")
    elif context.arrays.element_buffer or all(place is not None for place in places):  # else Mesa draws nothing
        drawn = [(number, place) for number, place in zip(counts, places, strict=True) if number]
        if len(drawn) == len(places) > 1 and _may_be_one(context, operation, mode):
            joined = joined_indices(context, operation, int(mode), DTYPES[type], counts, indices)
            if _draw_as_one(context, operation, int(mode), joined):
                return
        for number, place in drawn:
            _draw_elements(operation, mode, number, type, place)


def _may_be_one(context: Context, operation: str, mode: int) -> bool:
    """Return whether several primitives of a mode have the pixels of separate triangles or lines now."""
    if context.compiled_list is not None or not can_be_joined(context) or not joins(context.drawn_state, mode):
        return False
    return can_draw(context, operation)


def _draw_as_one(context: Context, operation: str, mode: int, joined: IndexSnapshot) -> bool:
    """Draw primitives of a mode by the indices of separate ones; return False if that reads too many vertices."""
    if joined.highest - joined.lowest > MOST_UNUSED * len(joined.indices):
        return False
    rows = _named_rows(context, operation, joined)
    if rows is not None:
        context.draw(SEPARABLE[mode], _vertices(context, rows), joined.indices, mode)
    return True


def _draw_elements(operation: str, mode: int, count: int, type: int, indices: Any) -> None:
    context = _flushed(operation)
    if context is None or _refused(operation, mode, count):
        return
    if not is_one_of(operation, "type", type, INDEX_TYPES, AN_INDEX_TYPE) or not can_draw(context, operation):
        return
    snapshot = snapshot_indices(context, operation, int(count), DTYPES[type], indices)
    _draw(context, int(mode), _named_rows(context, operation, snapshot), snapshot.indices)


def _named_rows(context: Context, operation: str, snapshot: IndexSnapshot) -> Rows | None:
    """Return the rows that indices name, as `_rows` does."""
    arrays, rows, latest = arrays_in_use(context), snapshot.rows, context.arrays.latest_rows
    if rows is not None and snapshot.arrays == arrays:
        return rows
    if latest is not None and latest[0] is snapshot and latest[1] == arrays:
        known: Rows = latest[2]
        taken, first, end = known
        if all(is_current(*each, first, end) for each in zip(arrays, taken, strict=True)):
            return known
    if snapshot.lowest < 0:
        raise ValueError(f"{operation}: index {snapshot.lowest} is negative")
    rows = _rows(context, operation, snapshot.lowest, snapshot.highest + 1)
    if rows is not None and arrays and arrays[0].slot == POSITION:  # other rows also depend on what is enabled
        snapshot.keep(arrays, rows)
        context.arrays.latest_rows = snapshot, arrays, rows
    return rows


def _flushed(operation: str) -> Context | None:
    """Return the current context, of which nothing is collected any more; None between glBegin and glEnd."""
    context = thread.context
    if not context.ready:
        if outside_begin(operation) is None:
            return None
        context.separate()
        context.ready = context.compiled_list is None
    return context


def _refused(operation: str, mode: int, count: int) -> bool:
    """Return whether the arguments are wrong; in a display list, the error is raised when the list is called."""
    if count < 0:
        in_lists(fail)(gl.GL_INVALID_VALUE, operation, f"count={count}: expected 0 or more")
    elif mode not in MODES:
        in_lists(wrong_enum)(operation, "mode", mode, A_MODE)
    else:
        return False
    return True


def _draw(context: Context, mode: int, rows: Rows | None, indices: np.ndarray | None) -> None:
    """Draw now, or record the draw in the display list; its arrays are read now in either case."""
    if rows is None:
        return
    compiled = context.compiled_list
    if compiled is None:
        draw_maybe_later(context, mode, _vertices(context, rows), indices, context.arrays.active_slots)
        return
    _, first, end = rows
    listed = consecutive_indices(end - first) if indices is None else indices
    compiled.calls.append(_listed(context, mode, rows, listed))
    if compiled.executes:
        execute_listed(context, _draw_one_by_one, mode, (first + listed).tolist())


def _listed(context: Context, mode: int, rows: Rows, indices: np.ndarray) -> Callable[[], Any]:
    """Return a draw as a display list keeps it: like the vertices of a pair, if glBegin ... glEnd could give them."""
    snapshots, first, end = rows
    call = partial(_draw_rows, mode, rows, indices)
    if any(snapshot.slot in OPTIONAL for snapshot in snapshots):
        return call
    sizes = {SLOT_NAMES[array.slot]: array.layout.size for array in arrays_in_use(context)}
    columns = {snapshot.slot: slice_of(snapshot, first, end) for snapshot in snapshots}
    if shares_vertices(mode, len(indices)):
        columns, indices = used_rows(columns, indices)
    else:
        columns = {slot: column[indices] for slot, column in columns.items()}
        indices = consecutive_indices(len(indices))
        for column in columns.values():
            column.setflags(write=False)
    starts = dict.fromkeys(list(columns)[1:], 0)
    return ListPrimitive([call], mode, columns, starts, {}, sizes, indices, leaves_values=False)


def _draw_one_by_one(mode: int, vertices: Sequence[int]) -> None:
    """Draw vertices of the enabled arrays as Mesa draws them while it compiles a list: with glArrayElement.

    So the attributes of the last one become current.
    """
    glBegin(mode)
    for vertex in vertices:
        glArrayElement(vertex)
    glEnd()


def _draw_rows(mode: int, rows: Rows, indices: np.ndarray) -> None:
    """Draw arrays of a display list; attributes without an array have the values that are current now."""
    context = current()
    context.flush()
    context.draw(mode, _vertices(context, rows), indices)


def _rows(context: Context, operation: str, first: int, end: int) -> Rows | None:
    """Return the rows [first, end) of the enabled arrays; None without any.

    If the array of positions is not enabled, all vertices are at the origin, as on Mesa. (In the specification there
    are none, which is what Mesa's display lists do.) If it is enabled but was never set, there are none.

    Raises
    ------
    ValueError
        An enabled array ends before `end`: GL would read memory outside the array. Or there is none, and more vertices
        at the origin than are worth their memory.
    """
    if first < 0:
        raise ValueError(f"{operation}: first={first}: expected 0 or more")
    active = arrays_in_use(context)
    has_positions = bool(active) and active[0].slot == POSITION
    if not has_positions and ("position" in context.arrays.enabled or context.compiled_list is not None):
        return None
    for array in active:
        if len(array.rows) < end:
            name, n_rows = SLOT_NAMES[array.slot], len(array.rows)
            raise ValueError(f"{operation}: vertex {end - 1} is outside the array of {name}s, which has {n_rows}")
    if end <= first:
        return None
    if not active and end - first > MOST_WITHOUT_ARRAYS:
        raise ValueError(
            f"{operation}: {end - first} vertices, but no array is enabled (glEnableClientState): expected at most "
            f"{MOST_WITHOUT_ARRAYS}"
        )
    snapshots = [snapshot_rows(array, first, end, context) for array in active]
    return (snapshots if has_positions else [origins(first, end, context), *snapshots]), first, end


def _vertices(context: Context, rows: Rows) -> Vertices:
    """Return vertices from rows and current values; the same object for the same ones."""
    (position, *others), first, end = rows
    constants = constant_attributes(context)
    key = first, end, constants, *others
    vertices: Vertices | None = position.drawn.get(key)
    if vertices is None:
        own = {snapshot.slot: slice_of(snapshot, first, end) for snapshot in others}
        optional: dict[str, Any] = {name: own.pop(slot) for slot, name in OPTIONAL.items() if slot in own}
        if len(position.drawn) >= MOST_DRAWN:
            position.drawn.clear()
        vertices = Vertices(slice_of(position, first, end), *constants.columns(end - first, own), **optional)
        position.drawn[key] = vertices
    return vertices


__all__ = spelled_like_gl(globals())
