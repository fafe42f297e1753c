"""glArrayElement: the current attributes and a vertex from one row of the enabled arrays."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from struct import Struct
from typing import Any, NamedTuple

import numpy as np

from softshadow.context import Context, current, thread
from softshadow.context.arrays import COLOR, NORMAL, POSITION, SLOT_NAMES, TEXCOORD, VertexArray
from softshadow.context.current_values import UNIT_OF
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.color_indices import set_index
from softshadow.gl.conversions import (
    from_byte,
    from_int,
    from_short,
    from_unsigned_byte,
    from_unsigned_int,
    from_unsigned_short,
)
from softshadow.gl.fog import set_fog_coordinate
from softshadow.gl.immediate import glVertex2f, glVertex3f
from softshadow.gl.refusals import CONVERTING, refusal
from softshadow.gl.secondary_colors import set_secondary
from softshadow.gl.texture_coordinates import glTexCoord2f, set_coordinate
from softshadow.gl.vertex_arrays import NOT_DRAWN, array_of, arrays_in_use
from softshadow.gl.vertex_attributes import glColor3f, glColor4f, glEdgeFlag, glNormal3f, set_color, set_normal
from softshadow.gl.vertex_format import REST, add_vertex, store_vertices

NO_MEMORY = memoryview(b"")
NORMALIZED = ("color", "normal", "secondary")  # integers represent 0 to 1 or -1 to 1
CONVERSIONS: dict[type[np.generic], Callable[[Any], float]] = {  # as in glColor and glNormal
    np.int8: from_byte, np.uint8: from_unsigned_byte, np.int16: from_short, np.uint16: from_unsigned_short,
    np.int32: from_int, np.uint32: from_unsigned_int,
}  # fmt: skip
# attributes, with their numbers of components, that have calls for floats, which lists know
CALLS: dict[tuple[str, int], Callable[..., None]] = {
    ("position", 2): glVertex2f, ("position", 3): glVertex3f, ("normal", 3): glNormal3f, ("color", 3): glColor3f,
    ("color", 4): glColor4f, ("texcoord0", 2): glTexCoord2f,
}  # fmt: skip


def glArrayElement(i: int) -> None:
    """Set the current attributes from one vertex of the enabled arrays; its position adds a vertex, as glVertex."""
    context = thread.context
    try:
        arrays, primitive = context.arrays, context.primitive
        known = arrays.readers
        if known is None or arrays.active is None or known[0] is not arrays.active:
            known = _find_readers(context)
        readers: tuple[_Reader, ...] = known[1]
        for slot, key, size, rest, rows, length, call, convert, unpack, memory, stride in readers:
            if not 0 <= i < length:
                raise ValueError(f"glArrayElement(i={i}): the array of {key}s has {length}")
            values = tuple(rows[i].tolist()) if unpack is None else unpack(memory, i * stride)
            if convert is not None:
                values = tuple([convert(number) for number in values])
            # the first two change no vertex format: they do what glVertex, glColor ... do then, in half the time
            if primitive is not None and slot == POSITION and primitive.position_size == size:
                positions = primitive.positions
                positions += values + rest
                if len(positions) >= primitive.limit:
                    store_vertices(context, primitive)
            elif primitive is not None and primitive.steady.get(key) == size:
                value: Any = values + rest
                primitive.changes[key].append((len(primitive.positions), value))
                if slot == NORMAL:
                    context.current.normal = value
                elif slot == COLOR:
                    context.current.color = value
                else:
                    context.current.texcoords[slot - TEXCOORD] = value
            elif call is not None:
                call(*values)
            elif context.compiled_list is None:
                _set_attribute(key, values)
            else:
                _record_attribute(key, values)
    except CONVERTING as error:
        raise refusal(glArrayElement, error, i) from error


class _Reader(NamedTuple):
    """How glArrayElement takes an attribute from an array.

    size: components that the array has; a call that is `steady` with so many sets `rest`, too. It is 0 for attributes
    that always go the long way: by `call`, if there is one. rows, length: the array; convert: what makes integers
    floats; unpack, memory, stride: what reads a row in half the time; unpack is None where there are gaps between rows.
    """

    slot: int
    key: str
    size: int
    rest: tuple[float, ...]
    rows: np.ndarray
    length: int
    call: Callable[..., None] | None
    convert: Callable[[Any], float] | None
    unpack: Callable[[memoryview, int], tuple[Any, ...]] | None
    memory: memoryview
    stride: int


def _find_readers(context: Context) -> tuple[tuple[VertexArray, ...], tuple[_Reader, ...]]:
    """Return the enabled arrays that draws read, and the readers of all enabled ones, that of the positions last."""
    active = arrays_in_use(context)
    index = array_of(context, NOT_DRAWN) if NOT_DRAWN in context.arrays.enabled else None
    arrays = active if index is None else (*active, index)
    readers = tuple([_reader(array) for array in reversed(arrays)])
    context.arrays.readers = active, readers
    return active, readers


def _reader(array: VertexArray) -> _Reader:
    slot, key, rows = array.slot, SLOT_NAMES[array.slot], array.rows
    convert = CONVERSIONS.get(rows.dtype.type, float) if key in NORMALIZED else float
    has_quick_way = slot in (POSITION, COLOR, NORMAL) or key in UNIT_OF
    size = rows.shape[1] if has_quick_way else 0
    rest = () if slot == NORMAL else REST[size:]
    unpack: Callable[..., tuple[Any, ...]] | None = None
    memory = NO_MEMORY
    if len(rows) and rows.flags.c_contiguous and rows.dtype.isnative:
        unpack, memory = Struct(f"{rows.shape[1]}{rows.dtype.char}").unpack_from, rows.data.cast("B")
    conversion = None if rows.dtype.kind == "f" else convert
    call = CALLS.get((key, rows.shape[1]))
    return _Reader(slot, key, size, rest, rows, len(rows), call, conversion, unpack, memory, rows.strides[0])


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


__all__ = spelled_like_gl(globals())
