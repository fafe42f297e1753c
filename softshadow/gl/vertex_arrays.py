"""Vertex arrays: pointers to users' arrays or into buffer objects, and which are enabled."""

from __future__ import annotations

from collections.abc import Container
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import ArrayLayout, ClientArrays, Context, current
from softshadow.context.arrays import SLOT_NAMES, SLOTS, BufferObject, VertexArray
from softshadow.frozen import evolve
from softshadow.gl.array_snapshots import unset_array, vertex_array
from softshadow.gl.buffers import offset_of
from softshadow.gl.calls import spelled_like_gl
from softshadow.gl.errors import fail, is_one_of, outside_begin
from softshadow.gl.texture_coordinates import A_UNIT, UNITS

TYPES = {
    gl.GL_BYTE: np.int8, gl.GL_UNSIGNED_BYTE: np.uint8, gl.GL_SHORT: np.int16, gl.GL_UNSIGNED_SHORT: np.uint16,
    gl.GL_INT: np.int32, gl.GL_UNSIGNED_INT: np.uint32, gl.GL_FLOAT: np.float32, gl.GL_DOUBLE: np.float64,
}  # fmt: skip
DTYPES = {type: np.dtype(dtype) for type, dtype in TYPES.items()}
POSITION_TYPES = (gl.GL_SHORT, gl.GL_INT, gl.GL_FLOAT, gl.GL_DOUBLE)
NORMAL_TYPES = (gl.GL_BYTE, *POSITION_TYPES)
COLOR_INDEX_TYPES = (gl.GL_UNSIGNED_BYTE, *POSITION_TYPES)
LARGEST_STRIDE = 2048  # Mesa's GL_MAX_VERTEX_ATTRIB_STRIDE
ARRAYS = {
    gl.GL_VERTEX_ARRAY: "position",
    gl.GL_NORMAL_ARRAY: "normal",
    gl.GL_COLOR_ARRAY: "color",
    gl.GL_EDGE_FLAG_ARRAY: "edge",
    gl.GL_SECONDARY_COLOR_ARRAY: "secondary",
    gl.GL_FOG_COORD_ARRAY: "fog_coordinate",
    gl.GL_INDEX_ARRAY: "index",
}
CLIENT_STATES = (*ARRAYS, gl.GL_TEXTURE_COORD_ARRAY)
# glInterleavedArrays: components of texture coordinate, colour (key of `COLORS`), normal and position
INTERLEAVED = {
    gl.GL_V2F: (0, "", 0, 2), gl.GL_V3F: (0, "", 0, 3), gl.GL_C4UB_V2F: (0, "4ub", 0, 2),
    gl.GL_C4UB_V3F: (0, "4ub", 0, 3), gl.GL_C3F_V3F: (0, "3f", 0, 3), gl.GL_N3F_V3F: (0, "", 3, 3),
    gl.GL_C4F_N3F_V3F: (0, "4f", 3, 3), gl.GL_T2F_V3F: (2, "", 0, 3), gl.GL_T4F_V4F: (4, "", 0, 4),
    gl.GL_T2F_C4UB_V3F: (2, "4ub", 0, 3), gl.GL_T2F_C3F_V3F: (2, "3f", 0, 3), gl.GL_T2F_N3F_V3F: (2, "", 3, 3),
    gl.GL_T2F_C4F_N3F_V3F: (2, "4f", 3, 3), gl.GL_T4F_C4F_N3F_V4F: (4, "4f", 3, 4),
}  # fmt: skip
COLORS = {"": (0, 0), "3f": (3, 12), "4f": (4, 16), "4ub": (4, 4)}  # (components, bytes)
DEEPEST_CLIENT_ATTRIBUTES = 16
NOT_DRAWN = "index"  # the array that only glArrayElement reads


# -- single arrays -----------------------------------------------------------------------------------------------------
def glEnableClientState(array: int) -> None:
    """Enable the array of an attribute."""
    _client_state("glEnableClientState", array, True)


def glDisableClientState(array: int) -> None:
    """Disable the array of an attribute: all vertices get its current value."""
    _client_state("glDisableClientState", array, False)


def _client_state(operation: str, array: int, on: bool) -> None:
    context = outside_begin(operation)
    if context is None:
        return
    if is_one_of(operation, "array", array, CLIENT_STATES, "GL_VERTEX_ARRAY, GL_NORMAL_ARRAY … GL_FOG_COORD_ARRAY"):
        switch_array(context.arrays, array, on)


def switch_array(arrays: ClientArrays, array: int, on: bool) -> None:
    """Enable or disable an array; that of texture coordinates is the array of the active unit."""
    key = array_name(arrays, array)
    if (key in arrays.enabled) != on:
        (arrays.enabled.add if on else arrays.enabled.discard)(key)
        arrays.active = None


def is_array_enabled(arrays: ClientArrays, array: int) -> bool:
    """Return whether an array is enabled."""
    return array_name(arrays, array) in arrays.enabled


def array_name(arrays: ClientArrays, array: int) -> str:
    """Return the name of an array in `ClientArrays`; of texture coordinates it is that of the active unit."""
    return ARRAYS.get(array) or f"texcoord{arrays.active_unit}"


def glClientActiveTexture(texture: int) -> None:
    """Select the unit that glTexCoordPointer and GL_TEXTURE_COORD_ARRAY apply to."""
    context = outside_begin("glClientActiveTexture")
    if context is not None and is_one_of("glClientActiveTexture", "texture", texture, UNITS, A_UNIT):
        context.arrays.active_unit = int(texture) - gl.GL_TEXTURE0


def glVertexPointer(size: int, type: int, stride: int, pointer: Any) -> None:
    """Set the array of positions: `size` 2, 3 or 4 components per vertex."""
    _pointer("glVertexPointer", "position", size, (2, 3, 4), type, POSITION_TYPES, stride, pointer)


def glNormalPointer(type: int, stride: int, pointer: Any) -> None:
    """Set the array of normals: 3 components per vertex; integers represent -1 to 1."""
    _pointer("glNormalPointer", "normal", 3, (3,), type, NORMAL_TYPES, stride, pointer)


def glColorPointer(size: int, type: int, stride: int, pointer: Any) -> None:
    """Set the array of colours: `size` 3 or 4 components per vertex; unsigned integers represent 0 to 1."""
    _pointer("glColorPointer", "color", size, (3, 4), type, TYPES, stride, pointer)


def glTexCoordPointer(size: int, type: int, stride: int, pointer: Any) -> None:
    """Set the array of texture coordinates of the client's active unit: `size` 1 to 4 components per vertex."""
    key = f"texcoord{current().arrays.active_unit}"
    _pointer("glTexCoordPointer", key, size, (1, 2, 3, 4), type, POSITION_TYPES, stride, pointer)


def glSecondaryColorPointer(size: int, type: int, stride: int, pointer: Any) -> None:
    """Set the array of secondary colours: `size` 3 (or 4, as in Mesa); unsigned integers represent 0 to 1."""
    _pointer("glSecondaryColorPointer", "secondary", size, (3, 4), type, TYPES, stride, pointer)


def glFogCoordPointer(type: int, stride: int, pointer: Any) -> None:
    """Set the array of fog coordinates: one number per vertex."""
    _pointer("glFogCoordPointer", "fog_coordinate", 1, (1,), type, (gl.GL_FLOAT, gl.GL_DOUBLE), stride, pointer)


def glEdgeFlagPointer(stride: int, pointer: Any) -> None:
    """Set the array of edge flags: one byte per vertex."""
    _pointer("glEdgeFlagPointer", "edge", 1, (1,), gl.GL_UNSIGNED_BYTE, TYPES, stride, pointer)


def glIndexPointer(type: int, stride: int, pointer: Any) -> None:
    """Set the array of colour indices, which only glArrayElement reads: one number per vertex."""
    _pointer("glIndexPointer", "index", 1, (1,), type, COLOR_INDEX_TYPES, stride, pointer)


def _pointer(
    operation: str, key: str, size: int, sizes: tuple[int, ...], type: int, types: Container[int], stride: int,
    pointer: Any,
) -> None:  # fmt: skip
    context = outside_begin(operation)
    if context is None:
        return
    if not 0 <= stride <= LARGEST_STRIDE:
        fail(gl.GL_INVALID_VALUE, operation, f"stride={stride}: expected 0 to {LARGEST_STRIDE}")
    elif not is_one_of(operation, "type", type, types, "GL_FLOAT, GL_DOUBLE or an integer type"):
        return
    elif size not in sizes:
        fail(gl.GL_INVALID_VALUE, operation, f"size={size}: expected one of {', '.join(map(str, sizes))}")
    else:
        arrays = context.arrays
        if not arrays.array_buffer and pointer is not None:
            array = _array_of(arrays, key, pointer, size, type, stride)
            if arrays.pointers.get(key) is not array:
                arrays.pointers[key], arrays.layouts[key] = array, array.layout
                arrays.offsets.pop(key, None)
                arrays.active = None
            return
        layout = ArrayLayout(int(size), int(type), int(stride))
        place = (arrays.array_buffer, offset_of(pointer)) if arrays.array_buffer else None
        if place is not None and arrays.offsets.get(key) == place and arrays.layouts.get(key) == layout:
            return
        arrays.layouts[key], arrays.active = layout, None
        arrays.pointers.pop(key, None)
        arrays.offsets.pop(key, None)
        if place is not None:
            arrays.offsets[key] = place


def _array_of(arrays: ClientArrays, key: str, pointer: Any, size: int, type: int, stride: int) -> VertexArray:
    """Return the user's array, or a copy as it is now if GL could not read it in place."""
    source = key, id(pointer), size, type, stride
    known: VertexArray | None = arrays.sources.get(source)
    if known is not None and known.owner is pointer and known.rows.dtype == getattr(pointer, "dtype", None):
        return known
    layout = ArrayLayout(int(size), int(type), int(stride))
    array = vertex_array(SLOTS[key], rows_of(pointer, DTYPES[type], size, stride), layout, pointer)
    if isinstance(pointer, np.ndarray) and pointer.dtype == array.rows.dtype and pointer.flags.c_contiguous:
        arrays.sources.put(source, array, 3 * pointer.nbytes)  # with copy and conversion
    return array


def rows_of(pointer: Any, dtype: np.dtype, size: int, stride: int) -> np.ndarray:
    """Return an array as rows of `size` numbers, without a copy if possible; `stride` in bytes, 0 if contiguous."""
    if isinstance(pointer, bytes | bytearray | memoryview):
        values = np.frombuffer(pointer, dtype)
    else:
        values = np.ascontiguousarray(pointer, dtype)
    if stride and stride != size * dtype.itemsize:
        flat = values.reshape(-1).view(np.uint8)
        n_rows = (len(flat) - size * dtype.itemsize) // stride + 1
        return np.ndarray((max(n_rows, 0), size), dtype, flat, 0, (stride, dtype.itemsize))
    return values.reshape(-1)[: values.size // size * size].reshape(-1, size)


def arrays_in_use(context: Context) -> tuple[VertexArray, ...]:
    """Return the enabled arrays that a draw reads, positions first."""
    active = context.arrays.active
    if active is None:
        keys = [key for key in SLOT_NAMES if key in context.arrays.enabled and key != NOT_DRAWN]
        arrays = [array_of(context, key) or _array_without_pointer(context, key) for key in keys]
        active = context.arrays.active = tuple([array for array in arrays if array is not None])
        context.arrays.active_slots = tuple([array.slot for array in active])
    return active


def _array_without_pointer(context: Context, key: str) -> VertexArray | None:
    """Return an array of zeros; None for positions, without which nothing is drawn, and for edge flags."""
    if key in ("position", "edge"):
        return None
    return unset_array(SLOTS[key], context.arrays.layout(key).size)


def array_of(context: Context, key: str) -> VertexArray | None:
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


# -- several at once ---------------------------------------------------------------------------------------------------
def glInterleavedArrays(format: int, stride: int, pointer: Any) -> None:
    """Set all arrays from one interleaved array in one of fourteen layouts."""
    context, operation = outside_begin("glInterleavedArrays"), "glInterleavedArrays"
    if context is None:
        return
    if stride < 0:
        fail(gl.GL_INVALID_VALUE, operation, f"stride={stride}: expected 0 or more")
        return
    if not is_one_of(operation, "format", format, INTERLEAVED, "GL_V2F … GL_T4F_C4F_N3F_V4F"):
        return
    texcoord, color, normal, position = INTERLEAVED[format]
    numbers, bytes_of_color = COLORS[color]
    ends = np.cumsum([0, 4 * texcoord, bytes_of_color, 4 * normal, 4 * position]).tolist()
    step = stride or ends[-1]
    if context.arrays.array_buffer:
        places = [offset_of(pointer) + end for end in ends[:4]]
    else:
        memory = _memory(pointer)
        places = [memory[end:] for end in ends[:4]]
    color_type = gl.GL_UNSIGNED_BYTE if color == "4ub" else gl.GL_FLOAT
    for array in (gl.GL_EDGE_FLAG_ARRAY, gl.GL_INDEX_ARRAY):
        glDisableClientState(array)
    for array, size, point in (
        (gl.GL_TEXTURE_COORD_ARRAY, texcoord, lambda: glTexCoordPointer(texcoord, gl.GL_FLOAT, step, places[0])),
        (gl.GL_COLOR_ARRAY, numbers, lambda: glColorPointer(numbers, color_type, step, places[1])),
        (gl.GL_NORMAL_ARRAY, normal, lambda: glNormalPointer(gl.GL_FLOAT, step, places[2])),
        (gl.GL_VERTEX_ARRAY, position, lambda: glVertexPointer(position, gl.GL_FLOAT, step, places[3])),
    ):
        (glEnableClientState if size else glDisableClientState)(array)
        if size:
            point()


def _memory(pointer: Any) -> memoryview:
    """Return the bytes of an array, without conversion of its type: a layout may mix types."""
    values = np.array(pointer, np.float32) if isinstance(pointer, list | tuple) else pointer
    if isinstance(values, bytes):
        return memoryview(values)
    return np.ascontiguousarray(values).reshape(-1).view(np.uint8).data


def glPushClientAttrib(mask: int) -> None:
    """Save vertex arrays and pixel store until the matching pop."""
    context = outside_begin("glPushClientAttrib")
    if context is None:
        return
    if len(context.client_stack) == DEEPEST_CLIENT_ATTRIBUTES:
        fail(gl.GL_STACK_OVERFLOW, "glPushClientAttrib", f"this stack holds {DEEPEST_CLIENT_ATTRIBUTES} entries")
        return
    arrays, mask = context.arrays, int(mask)
    if mask & gl.GL_CLIENT_VERTEX_ARRAY_BIT:
        arrays = evolve(
            arrays,
            enabled=set(arrays.enabled),
            pointers=dict(arrays.pointers),
            layouts=dict(arrays.layouts),
            offsets=dict(arrays.offsets),
            active=None,  # buffer objects may change until it is restored
        )
    context.client_stack.append((mask, arrays, context.pack_store, context.unpack_store))


def glPopClientAttrib() -> None:
    """Restore what the last push has saved."""
    context = outside_begin("glPopClientAttrib")
    if context is None:
        return
    if not context.client_stack:
        fail(gl.GL_STACK_UNDERFLOW, "glPopClientAttrib", "there was no glPushClientAttrib before it")
        return
    mask, arrays, pack_store, unpack_store = context.client_stack.pop()
    if mask & gl.GL_CLIENT_VERTEX_ARRAY_BIT:
        context.arrays = arrays
    if mask & gl.GL_CLIENT_PIXEL_STORE_BIT:
        context.pack_store, context.unpack_store = pack_store, unpack_store


__all__ = spelled_like_gl(globals())
