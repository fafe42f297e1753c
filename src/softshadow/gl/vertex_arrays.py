"""Vertex arrays: pointers to a user's arrays, and the calls that draw from them.

A user's array is copied once per content, so that many draws of a recording share it; a read-only array that owns its
memory is taken as it is.
"""

from __future__ import annotations

import hashlib
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import ArrayLayout, Context, current
from softshadow.gl.calls import spelled_like_gl
from softshadow.gl.errors import fail, is_one_of, outside_begin
from softshadow.gl.immediate import A_MODE, MODES, can_draw, in_order
from softshadow.gl.texture_coordinates import A_UNIT, UNITS
from softshadow.gl.vertex_format import REST
from softshadow.pipeline.commands import Vertices
from softshadow.state import TEXTURE_UNITS

TYPES = {
    gl.GL_BYTE: np.int8, gl.GL_UNSIGNED_BYTE: np.uint8, gl.GL_SHORT: np.int16, gl.GL_UNSIGNED_SHORT: np.uint16,
    gl.GL_INT: np.int32, gl.GL_UNSIGNED_INT: np.uint32, gl.GL_FLOAT: np.float32, gl.GL_DOUBLE: np.float64,
}  # fmt: skip
POSITION_TYPES = (gl.GL_SHORT, gl.GL_INT, gl.GL_FLOAT, gl.GL_DOUBLE)
NORMAL_TYPES = (gl.GL_BYTE, *POSITION_TYPES)
LARGEST_STRIDE = 2048  # GL_MAX_VERTEX_ATTRIB_STRIDE of Mesa
INDEX_TYPES = (gl.GL_UNSIGNED_BYTE, gl.GL_UNSIGNED_SHORT, gl.GL_UNSIGNED_INT)
ARRAYS = {gl.GL_VERTEX_ARRAY: "position", gl.GL_NORMAL_ARRAY: "normal", gl.GL_COLOR_ARRAY: "color"}
NORMALISED = ("color", "normal")  # integers of these stand for 0 to 1 or -1 to 1


# -- which arrays ------------------------------------------------------------------------------------------------------
def glEnableClientState(array: int) -> None:
    """Take an attribute of each vertex from its array."""
    _client_state("glEnableClientState", array, True)


def glDisableClientState(array: int) -> None:
    """Take the current value of an attribute for all vertices."""
    _client_state("glDisableClientState", array, False)


def _client_state(operation: str, array: int, on: bool) -> None:
    context = outside_begin(operation)
    expected = "GL_VERTEX_ARRAY, GL_NORMAL_ARRAY, GL_COLOR_ARRAY or GL_TEXTURE_COORD_ARRAY"
    allowed = (*ARRAYS, gl.GL_TEXTURE_COORD_ARRAY)
    if context is not None and is_one_of(operation, "array", array, allowed, expected):
        key = ARRAYS.get(array, f"texcoord{context.arrays.active_unit}")
        (context.arrays.enabled.add if on else context.arrays.enabled.discard)(key)


def glClientActiveTexture(texture: int) -> None:
    """Choose the unit that glTexCoordPointer and GL_TEXTURE_COORD_ARRAY mean."""
    context = outside_begin("glClientActiveTexture")
    if context is not None and is_one_of("glClientActiveTexture", "texture", texture, UNITS, A_UNIT):
        context.arrays.active_unit = int(texture) - gl.GL_TEXTURE0


def glVertexPointer(size: int, type: int, stride: int, pointer: Any) -> None:
    """Set the array of positions: `size` 2, 3 or 4 numbers a vertex."""
    _pointer("glVertexPointer", "position", size, (2, 3, 4), type, POSITION_TYPES, stride, pointer)


def glNormalPointer(type: int, stride: int, pointer: Any) -> None:
    """Set the array of normals: 3 numbers a vertex; integers stand for -1 to 1."""
    _pointer("glNormalPointer", "normal", 3, (3,), type, NORMAL_TYPES, stride, pointer)


def glColorPointer(size: int, type: int, stride: int, pointer: Any) -> None:
    """Set the array of colours: `size` 3 or 4 numbers a vertex; unsigned integers stand for 0 to 1."""
    _pointer("glColorPointer", "color", size, (3, 4), type, tuple(TYPES), stride, pointer)


def glTexCoordPointer(size: int, type: int, stride: int, pointer: Any) -> None:
    """Set the array of texture coordinates of the client's active unit: `size` 1 to 4 numbers a vertex."""
    key = f"texcoord{current().arrays.active_unit}"
    _pointer("glTexCoordPointer", key, size, (1, 2, 3, 4), type, POSITION_TYPES, stride, pointer)


def _pointer(
    operation: str, key: str, size: int, sizes: tuple[int, ...], type: int, types: tuple[int, ...], stride: int,
    pointer: Any,
) -> None:  # fmt: skip
    context = outside_begin(operation)
    if context is None or not is_one_of(operation, "type", type, types, "GL_FLOAT, GL_DOUBLE or an integer type"):
        return
    if size not in sizes:
        fail(gl.GL_INVALID_VALUE, operation, f"size={size}: expected one of {', '.join(map(str, sizes))}")
    elif not 0 <= stride <= LARGEST_STRIDE:
        fail(gl.GL_INVALID_VALUE, operation, f"stride={stride}: expected 0 to {LARGEST_STRIDE}")
    else:
        context.arrays.layouts[key] = ArrayLayout(int(size), int(type), int(stride))
        context.arrays.pointers.pop(key, None)
        if pointer is not None:
            context.arrays.pointers[key] = _rows(pointer, np.dtype(TYPES[type]), size, stride)


def _rows(pointer: Any, dtype: np.dtype, size: int, stride: int) -> np.ndarray:
    """Return an array as rows of `size` numbers, without copying one that fits; `stride` in bytes, 0 for none."""
    if isinstance(pointer, bytes | bytearray | memoryview):
        values = np.frombuffer(pointer, dtype)
    else:
        values = np.ascontiguousarray(pointer, dtype)
    if stride and stride != size * dtype.itemsize:
        flat = values.reshape(-1).view(np.uint8)
        count = (len(flat) - size * dtype.itemsize) // stride + 1
        return np.ndarray((max(count, 0), size), dtype, flat, 0, (stride, dtype.itemsize))
    return values.reshape(-1)[: values.size // size * size].reshape(-1, size)


# -- drawing -----------------------------------------------------------------------------------------------------------
def glDrawArrays(mode: int, first: int, count: int) -> None:
    """Draw `count` vertices of the enabled arrays from `first` on."""
    context = outside_begin("glDrawArrays")
    if context is not None:
        context.settle()
    if context is None:
        return
    if count < 0:
        fail(gl.GL_INVALID_VALUE, "glDrawArrays", f"count={count}: expected 0 or more")
    elif is_one_of("glDrawArrays", "mode", mode, MODES, A_MODE) and can_draw(context, "glDrawArrays"):
        vertices = _vertices(context, "glDrawArrays", int(first), int(first) + int(count))
        _draw(context, int(mode), vertices, None)


def glDrawElements(mode: int, count: int, type: int, indices: Any) -> None:
    """Draw the vertices of the enabled arrays that `indices` name."""
    context = outside_begin("glDrawElements")
    if context is not None:
        context.settle()
    if context is None:
        return
    if count < 0:
        fail(gl.GL_INVALID_VALUE, "glDrawElements", f"count={count}: expected 0 or more")
        return
    if not is_one_of("glDrawElements", "mode", mode, MODES, A_MODE):
        return
    expected = "GL_UNSIGNED_BYTE, GL_UNSIGNED_SHORT or GL_UNSIGNED_INT"
    if not is_one_of("glDrawElements", "type", type, INDEX_TYPES, expected) or not can_draw(context, "glDrawElements"):
        return
    if isinstance(indices, bytes | bytearray | memoryview):
        indices = np.frombuffer(indices, TYPES[type])
    numbers = np.ravel(indices)[:count]
    if len(numbers) < count:
        raise ValueError(f"glDrawElements(count={count}): only {len(numbers)} indices are there")
    owned = np.array(numbers, np.int32)
    if count and owned.min() < 0:
        raise ValueError(f"glDrawElements: index {owned.min()} is negative")
    owned.setflags(write=False)
    vertices = _vertices(context, "glDrawElements", 0, int(owned.max()) + 1 if count else 0)
    _draw(context, int(mode), vertices, owned)


def _draw(context: Context, mode: int, vertices: Vertices | None, indices: np.ndarray | None) -> None:
    """Draw now, or from the display list: the arrays are read when the list is made."""
    if vertices is None or not len(vertices.position):
        return
    compiled = context.compiled_list
    if compiled is not None:
        kept = in_order(len(vertices.position)) if indices is None else indices
        compiled.calls.append(lambda: current().draw(mode, vertices, kept))
    if compiled is None or compiled.executes:
        context.draw(mode, vertices, indices)


def _vertices(context: Context, operation: str, first: int, end: int) -> Vertices | None:
    """Return the vertices [first, end) of the enabled arrays; None without an array of positions.

    Raises
    ------
    ValueError
        An enabled array ends before `end`: GL would read memory that is not the array's.
    """
    if first < 0:
        raise ValueError(f"{operation}: first={first}: expected 0 or more")
    arrays, standing = context.arrays, context.current
    if "position" not in arrays.enabled or "position" not in arrays.pointers:
        return None

    def attribute(key: str, constant: tuple[float, ...]) -> np.ndarray:
        rows = arrays.pointers.get(key)
        if key not in arrays.enabled or rows is None:
            return np.broadcast_to(np.array(constant, context.real), (end - first, len(constant)))
        if len(rows) < end:
            raise ValueError(f"{operation}: vertex {end - 1} is asked for, the array of {key}s has {len(rows)}")
        return _full(rows, len(constant), context, key in NORMALISED)[first:end]

    texcoords = tuple(attribute(f"texcoord{unit}", standing.texcoords[unit]) for unit in range(TEXTURE_UNITS))
    return Vertices(
        attribute("position", REST), attribute("color", standing.color), attribute("normal", standing.normal), texcoords
    )


# -- what a recording keeps --------------------------------------------------------------------------------------------
def _full(rows: np.ndarray, width: int, context: Context, normalised: bool) -> np.ndarray:
    """Return rows as read-only (V, width) of the context's precision; the same content is converted once."""
    root = _root(rows)
    if root.flags.writeable:
        content: Any = hashlib.blake2b(np.ascontiguousarray(rows).data, digest_size=16).digest()
    else:
        content = (id(root), rows.__array_interface__["data"][0], rows.strides)
    key = (content, rows.shape, rows.dtype, width, normalised)
    if key not in context.arrays.converted:
        # the root is kept beside the result, so that its id stays its own
        context.arrays.converted[key] = (_converted(rows, width, context, normalised), root)
    return context.arrays.converted[key][0]


def _root(rows: np.ndarray) -> np.ndarray:
    """Return the array that owns the memory, as far as NumPy tells."""
    while isinstance(rows.base, np.ndarray):
        rows = rows.base
    return rows


def _converted(rows: np.ndarray, width: int, context: Context, normalised: bool) -> np.ndarray:
    """Return rows with all their components: a missing fourth is 1, others 0."""
    fits = rows.shape[1] == width and rows.dtype == context.real and rows.flags.c_contiguous
    if fits and not _root(rows).flags.writeable:
        return rows
    full = np.empty((len(rows), width), context.real)
    full[:] = REST[:width]
    with np.errstate(over="ignore"):
        if rows.dtype.kind in "iu" and normalised:
            full[:, : rows.shape[1]] = rows / context.real(np.iinfo(rows.dtype).max)
        else:
            full[:, : rows.shape[1]] = rows
    full.setflags(write=False)
    return full


__all__ = spelled_like_gl(globals())
