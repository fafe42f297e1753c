"""Draws from vertex arrays and buffer objects.

`array_snapshots` and `index_snapshots` make the arrays that a recording stores.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from ctypes import c_uint
from functools import partial
from struct import Struct
from typing import Any, NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, current, thread
from softshadow.context.arrays import (
    EDGE,
    FOG_COORDINATE,
    POSITION,
    SECONDARY,
    SLOT_NAMES,
    SLOTS,
    ArrayLayout,
    BufferObject,
    RowSnapshot,
    VertexArray,
)
from softshadow.context.current_values import UNIT_OF
from softshadow.gl.array_snapshots import slice_of, snapshot_rows
from softshadow.gl.calls import execute_listed, in_lists, spelled_like_gl
from softshadow.gl.color_indices import set_index
from softshadow.gl.constant_attributes import constant_attributes
from softshadow.gl.conversions import (
    from_byte,
    from_int,
    from_short,
    from_unsigned_byte,
    from_unsigned_int,
    from_unsigned_short,
)
from softshadow.gl.errors import fail, is_one_of, outside_begin, wrong_enum
from softshadow.gl.fog import set_fog_coordinate
from softshadow.gl.immediate import (
    A_MODE,
    MODES,
    add_vertex,
    can_draw,
    consecutive_indices,
    glBegin,
    glEnd,
    glVertex2f,
    glVertex3f,
)
from softshadow.gl.index_snapshots import snapshot_indices
from softshadow.gl.list_compiling import shares_vertices, used_rows
from softshadow.gl.list_primitives import ListPrimitive
from softshadow.gl.refusals import CONVERTING, refusal
from softshadow.gl.secondary_colors import set_secondary
from softshadow.gl.texture_coordinates import glTexCoord2f, set_coordinate
from softshadow.gl.vertex_arrays import DTYPES, rows_of
from softshadow.gl.vertex_attributes import glColor3f, glColor4f, glEdgeFlag, glNormal3f, set_color, set_normal
from softshadow.pipeline.commands import Vertices

INDEX_TYPES = (gl.GL_UNSIGNED_BYTE, gl.GL_UNSIGNED_SHORT, gl.GL_UNSIGNED_INT)
AN_INDEX_TYPE = "GL_UNSIGNED_BYTE, GL_UNSIGNED_SHORT or GL_UNSIGNED_INT"
Rows = tuple[list[RowSnapshot], int, int]  # of each array, positions first, and which: [first, end)
OPTIONAL = {EDGE: "edges", SECONDARY: "secondary", FOG_COORDINATE: "fog_coordinates"}  # fields of `Vertices`
MOST_DRAWN = 4096  # ranges of one array with the vertices that were drawn
NO_MEMORY = memoryview(b"")
NOT_DRAWN = "index"  # the array that only glArrayElement reads
NORMALIZED = ("color", "normal", "secondary")  # integers represent 0 to 1 or -1 to 1
CONVERSIONS: dict[type[np.generic], Callable[[Any], float]] = {  # by glArrayElement, as in glColor and glNormal
    np.int8: from_byte, np.uint8: from_unsigned_byte, np.int16: from_short, np.uint16: from_unsigned_short,
    np.int32: from_int, np.uint32: from_unsigned_int,
}  # fmt: skip
# attributes, with their numbers of components, that have calls for floats which are quick between glBegin and glEnd
CALLS: dict[tuple[str, int], Callable[..., None]] = {
    ("position", 2): glVertex2f, ("position", 3): glVertex3f, ("normal", 3): glNormal3f, ("color", 3): glColor3f,
    ("color", 4): glColor4f, ("texcoord0", 2): glTexCoord2f,
}  # fmt: skip


# -- drawing -----------------------------------------------------------------------------------------------------------
def glDrawArrays(mode: int, first: int, count: int) -> None:
    """Draw `count` vertices of the enabled arrays, starting at `first`."""
    context = outside_begin("glDrawArrays")
    if context is not None:
        context.flush()
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
    context, operation = outside_begin("glMultiDrawArrays"), "glMultiDrawArrays"
    if context is None:
        return
    context.flush()
    firsts, counts = np.ravel(first)[:drawcount].tolist(), np.ravel(count)[: max(drawcount, 0)].tolist()
    if drawcount < 0 or min(counts, default=0) < 0:
        fail(gl.GL_INVALID_VALUE, operation, f"count={counts}, drawcount={drawcount}: expected 0 or more")
    elif is_one_of(operation, "mode", mode, MODES, A_MODE) and can_draw(context, operation):
        for begin, number in zip(firsts, counts, strict=True):
            start = int(begin)
            _draw(context, int(mode), _rows(context, operation, start, start + int(number)), None)


def glMultiDrawElements(mode: int, count: Any, type: int, indices: Any, drawcount: int) -> None:
    """Draw `drawcount` times as glDrawElements does, each with its number of indices and its array or offset."""
    context, operation = outside_begin("glMultiDrawElements"), "glMultiDrawElements"
    if context is None:
        return
    context.flush()
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
        for number, place in zip(counts, places, strict=True):
            if number:
                _draw_elements(operation, mode, number, type, place)


def _draw_elements(operation: str, mode: int, count: int, type: int, indices: Any) -> None:
    context = outside_begin(operation)
    if context is None:
        return
    context.flush()
    if _refused(operation, mode, count):
        return
    if not is_one_of(operation, "type", type, INDEX_TYPES, AN_INDEX_TYPE) or not can_draw(context, operation):
        return
    snapshot = snapshot_indices(context, operation, int(count), DTYPES[type], indices)
    if snapshot.lowest < 0:
        raise ValueError(f"{operation}: index {snapshot.lowest} is negative")
    rows = _rows(context, operation, snapshot.lowest, snapshot.highest + 1)
    _draw(context, int(mode), rows, snapshot.indices)


def _refused(operation: str, mode: int, count: int) -> bool:
    """Return whether the arguments are wrong; in a display list, the error is raised when the list is called."""
    if count < 0:
        in_lists(fail)(gl.GL_INVALID_VALUE, operation, f"count={count}: expected 0 or more")
    elif mode not in MODES:
        in_lists(wrong_enum)(operation, "mode", mode, A_MODE)
    else:
        return False
    return True


def glArrayElement(i: int) -> None:
    """Set the current attributes from one vertex of the enabled arrays; its position adds a vertex, as glVertex."""
    context = thread.context
    try:
        arrays = context.arrays
        known = arrays.readers
        if known is None or arrays.active is None or known[0] is not arrays.active:
            known = _find_readers(context)
        readers: tuple[_Reader, ...] = known[1]
        for key, rows, length, call, convert, unpack, memory, stride in readers:
            if not 0 <= i < length:
                raise ValueError(f"glArrayElement(i={i}): the array of {key}s has {length}")
            values = rows[i].tolist() if unpack is None else unpack(memory, i * stride)
            if convert is not None:
                values = [convert(number) for number in values]
            if call is not None:
                call(*values)
            elif context.compiled_list is None:
                _set_attribute(key, values)
            else:
                _record_attribute(key, values)
    except CONVERTING as error:
        raise refusal(glArrayElement, error, i) from error


class _Reader(NamedTuple):
    """How glArrayElement takes an attribute from an array.

    rows, length: the array; call: a quick call, where there is one; convert: what makes integers floats;
    unpack, memory, stride: what reads a row in half the time; unpack is None where there are gaps between rows.
    """

    key: str
    rows: np.ndarray
    length: int
    call: Callable[..., None] | None
    convert: Callable[[Any], float] | None
    unpack: Callable[[memoryview, int], tuple[Any, ...]] | None
    memory: memoryview
    stride: int


def _find_readers(context: Context) -> tuple[tuple[VertexArray, ...], tuple[_Reader, ...]]:
    """Return the enabled arrays that draws read, and the readers of all enabled ones, that of the positions last."""
    active = _arrays_in_use(context)
    index = _array(context, NOT_DRAWN) if NOT_DRAWN in context.arrays.enabled else None
    arrays = active if index is None else (*active, index)
    readers = tuple([_reader(array) for array in reversed(arrays)])
    context.arrays.readers = active, readers
    return active, readers


def _reader(array: VertexArray) -> _Reader:
    key, rows = SLOT_NAMES[array.slot], array.rows
    convert = CONVERSIONS.get(rows.dtype.type, float) if key in NORMALIZED else float
    call = CALLS.get((key, rows.shape[1]))
    unpack: Callable[..., tuple[Any, ...]] | None = None
    memory = NO_MEMORY
    if len(rows) and rows.flags.c_contiguous and rows.dtype.isnative:
        unpack, memory = Struct(f"{rows.shape[1]}{rows.dtype.char}").unpack_from, rows.data.cast("B")
    conversion = None if rows.dtype.kind == "f" else convert
    return _Reader(key, rows, len(rows), call, conversion, unpack, memory, rows.strides[0])


def _set_attribute(key: str, values: Sequence[float]) -> None:
    if key == "position":
        add_vertex(current(), *values)
    elif key == "color":
        set_color(*values)
    elif key == "normal":
        set_normal(*values)
    elif key == "edge":
        glEdgeFlag(bool(values[0]))
    elif key == "secondary":
        set_secondary(*values)
    elif key == "fog_coordinate":
        set_fog_coordinate(*values)
    elif key == "index":
        set_index(values[0])
    else:
        set_coordinate(UNIT_OF[key], *values)


_record_attribute = in_lists(_set_attribute)


def _draw(context: Context, mode: int, rows: Rows | None, indices: np.ndarray | None) -> None:
    """Draw now, or record the draw in the display list; its arrays are read now in either case."""
    if rows is None:
        return
    compiled = context.compiled_list
    if compiled is None:
        context.draw(mode, _vertices(context, rows), indices)
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
    sizes = {SLOT_NAMES[array.slot]: array.layout.size for array in _arrays_in_use(context)}
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
    """Return the rows [first, end) of the enabled arrays; None without any or without an array of positions.

    Raises
    ------
    ValueError
        An enabled array ends before `end`: GL would read memory outside the array.
    """
    if first < 0:
        raise ValueError(f"{operation}: first={first}: expected 0 or more")
    active = _arrays_in_use(context)
    if not active or active[0].slot != POSITION:
        return None
    for array in active:
        if len(array.rows) < end:
            name, n_rows = SLOT_NAMES[array.slot], len(array.rows)
            raise ValueError(f"{operation}: vertex {end - 1} is outside the array of {name}s, which has {n_rows}")
    if end <= first:
        return None
    return [snapshot_rows(array, first, end, context) for array in active], first, end


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


def _arrays_in_use(context: Context) -> tuple[VertexArray, ...]:
    """Return the enabled arrays that a draw reads, positions first."""
    active = context.arrays.active
    if active is None:
        arrays = (_array(context, key) for key in SLOT_NAMES if key in context.arrays.enabled and key != NOT_DRAWN)
        active = context.arrays.active = tuple(array for array in arrays if array is not None)
    return active


def _array(context: Context, key: str) -> VertexArray | None:
    """Return the array of an attribute: the user's array, or one in a buffer object; None without one."""
    arrays = context.arrays
    if key not in arrays.offsets:
        return arrays.pointers.get(key)
    name, offset = arrays.offsets[key]
    bound, layout = context.buffers[name], arrays.layout(key)
    array: VertexArray = bound.view((key, offset, layout), lambda: _array_in(bound, key, offset, layout))
    return array


def _array_in(bound: BufferObject, key: str, offset: int, layout: ArrayLayout) -> VertexArray:
    """Return an array in a buffer object; bytes after the last whole number are left out."""
    dtype, content = DTYPES[layout.type], bound.content[offset:]
    values = content[: len(content) // dtype.itemsize * dtype.itemsize].view(dtype)
    return VertexArray(SLOTS[key], rows_of(values, dtype, layout.size, layout.stride), layout, bound, is_fixed=True)


__all__ = spelled_like_gl(globals())
