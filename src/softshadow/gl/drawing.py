"""Drawing: immediate mode, vertex arrays, and the debug groups that name what is drawn."""

from __future__ import annotations

import hashlib
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, Primitive, current
from softshadow.gl.errors import fail, is_one_of, outside_begin
from softshadow.pipeline.commands import Vertices
from softshadow.state import TEXTURE_UNITS

MODES = range(gl.GL_POINTS, gl.GL_POLYGON + 1)
A_MODE = "GL_POINTS … GL_POLYGON"
TYPES = {
    gl.GL_BYTE: np.int8, gl.GL_UNSIGNED_BYTE: np.uint8, gl.GL_SHORT: np.int16, gl.GL_UNSIGNED_SHORT: np.uint16,
    gl.GL_INT: np.int32, gl.GL_UNSIGNED_INT: np.uint32, gl.GL_FLOAT: np.float32, gl.GL_DOUBLE: np.float64,
}  # fmt: skip
INDEX_TYPES = (gl.GL_UNSIGNED_BYTE, gl.GL_UNSIGNED_SHORT, gl.GL_UNSIGNED_INT)
REST = (0.0, 0.0, 0.0, 1.0)  # what a vector gets where the call gives fewer than four numbers
ARRAYS = {gl.GL_VERTEX_ARRAY: "position", gl.GL_NORMAL_ARRAY: "normal", gl.GL_COLOR_ARRAY: "color"}


# -- glBegin ... glEnd -------------------------------------------------------------------------------------------------
def glBegin(mode: int) -> None:
    """Start a primitive."""
    context = outside_begin("glBegin")
    if context is not None and is_one_of("glBegin", "mode", mode, MODES, A_MODE):
        context.primitive = Primitive(mode)


def glEnd() -> None:
    """Draw the primitive that has been collected."""
    context = current()
    primitive = context.primitive
    if primitive is None:
        fail(gl.GL_INVALID_OPERATION, "glEnd", "there was no glBegin before it")
        return
    context.primitive = None
    if primitive.positions:
        texcoords = tuple(context.frozen(unit) for unit in zip(*primitive.texcoords, strict=True))
        position, color, normal = (
            context.frozen(rows) for rows in (primitive.positions, primitive.colors, primitive.normals)
        )
        context.draw(primitive.mode, Vertices(position, color, normal, texcoords))


def _vertex(x: float, y: float, z: float = 0.0, w: float = 1.0) -> None:
    context = current()
    primitive = context.primitive
    if primitive is not None:  # outside glBegin and glEnd a vertex is undefined in GL; here it does nothing
        standing = context.current
        primitive.positions.append((x, y, z, w))
        primitive.colors.append(standing.color)
        primitive.normals.append(standing.normal)
        primitive.texcoords.append(tuple(standing.texcoords))


def _set_color(red: float, green: float, blue: float, alpha: float = 1.0) -> None:
    context = current()
    context.current.color = (float(red), float(green), float(blue), float(alpha))
    if context.state.lighting.color_material:
        from softshadow.gl.lighting import follow_color

        follow_color(context)


def _unsigned_byte_color(*channels: int) -> None:
    _set_color(*(channel / 255 for channel in channels))


def _set_normal(x: float, y: float, z: float) -> None:
    current().current.normal = (float(x), float(y), float(z))


def _set_texcoord(unit: int, *coordinates: float) -> None:
    given = tuple(float(c) for c in coordinates)
    current().current.texcoords[unit] = given + REST[len(given) :]  # type: ignore[assignment]


def glVertex2f(x: float, y: float) -> None:
    """Add a vertex, z = 0, w = 1."""
    _vertex(x, y)


def glVertex3f(x: float, y: float, z: float) -> None:
    """Add a vertex, w = 1."""
    _vertex(x, y, z)


def glVertex4f(x: float, y: float, z: float, w: float) -> None:
    """Add a vertex in homogeneous coordinates."""
    _vertex(x, y, z, w)


def glVertex2fv(v: Any) -> None:
    """Add a vertex from a vector."""
    _vertex(*v[:2])


def glVertex3fv(v: Any) -> None:
    """Add a vertex from a vector."""
    _vertex(*v[:3])


def glVertex4fv(v: Any) -> None:
    """Add a vertex from a vector."""
    _vertex(*v[:4])


glVertex2d = glVertex2i = glVertex2f
glVertex3d = glVertex3i = glVertex3f
glVertex4d = glVertex4i = glVertex4f
glVertex2dv = glVertex2iv = glVertex2fv
glVertex3dv = glVertex3iv = glVertex3fv
glVertex4dv = glVertex4iv = glVertex4fv


def glColor3f(red: float, green: float, blue: float) -> None:
    """Set the current colour, alpha 1."""
    _set_color(red, green, blue)


def glColor4f(red: float, green: float, blue: float, alpha: float) -> None:
    """Set the current colour."""
    _set_color(red, green, blue, alpha)


def glColor3fv(v: Any) -> None:
    """Set the current colour from a vector, alpha 1."""
    _set_color(*v[:3])


def glColor4fv(v: Any) -> None:
    """Set the current colour from a vector."""
    _set_color(*v[:4])


def glColor3ub(red: int, green: int, blue: int) -> None:
    """Set the current colour from bytes, alpha 255."""
    _unsigned_byte_color(red, green, blue, 255)


def glColor4ub(red: int, green: int, blue: int, alpha: int) -> None:
    """Set the current colour from bytes."""
    _unsigned_byte_color(red, green, blue, alpha)


def glColor3ubv(v: Any) -> None:
    """Set the current colour from a vector of bytes, alpha 255."""
    _unsigned_byte_color(*v[:3], 255)


def glColor4ubv(v: Any) -> None:
    """Set the current colour from a vector of bytes."""
    _unsigned_byte_color(*v[:4])


glColor3d, glColor4d, glColor3dv, glColor4dv = glColor3f, glColor4f, glColor3fv, glColor4fv


def glNormal3f(nx: float, ny: float, nz: float) -> None:
    """Set the current normal."""
    _set_normal(nx, ny, nz)


def glNormal3fv(v: Any) -> None:
    """Set the current normal from a vector."""
    _set_normal(*v[:3])


glNormal3d, glNormal3dv = glNormal3f, glNormal3fv


def glTexCoord1f(s: float) -> None:
    """Set the current texture coordinate of unit 0; t = r = 0, q = 1."""
    _set_texcoord(0, s)


def glTexCoord2f(s: float, t: float) -> None:
    """Set the current texture coordinate of unit 0; r = 0, q = 1."""
    _set_texcoord(0, s, t)


def glTexCoord3f(s: float, t: float, r: float) -> None:
    """Set the current texture coordinate of unit 0; q = 1."""
    _set_texcoord(0, s, t, r)


def glTexCoord4f(s: float, t: float, r: float, q: float) -> None:
    """Set the current texture coordinate of unit 0."""
    _set_texcoord(0, s, t, r, q)


def glTexCoord2fv(v: Any) -> None:
    """Set the current texture coordinate of unit 0 from a vector."""
    _set_texcoord(0, *v[:2])


def glTexCoord3fv(v: Any) -> None:
    """Set the current texture coordinate of unit 0 from a vector."""
    _set_texcoord(0, *v[:3])


def glTexCoord4fv(v: Any) -> None:
    """Set the current texture coordinate of unit 0 from a vector."""
    _set_texcoord(0, *v[:4])


glTexCoord1d, glTexCoord2d, glTexCoord3d, glTexCoord4d = glTexCoord1f, glTexCoord2f, glTexCoord3f, glTexCoord4f


def _multi_texcoord(operation: str, target: int, *coordinates: float) -> None:
    units = range(gl.GL_TEXTURE0, gl.GL_TEXTURE0 + TEXTURE_UNITS)
    if is_one_of(operation, "target", target, units, f"GL_TEXTURE0 … GL_TEXTURE{TEXTURE_UNITS - 1}"):
        _set_texcoord(target - gl.GL_TEXTURE0, *coordinates)


def glMultiTexCoord2f(target: int, s: float, t: float) -> None:
    """Set the current texture coordinate of a unit; r = 0, q = 1."""
    _multi_texcoord("glMultiTexCoord2f", target, s, t)


def glMultiTexCoord3f(target: int, s: float, t: float, r: float) -> None:
    """Set the current texture coordinate of a unit; q = 1."""
    _multi_texcoord("glMultiTexCoord3f", target, s, t, r)


def glMultiTexCoord4f(target: int, s: float, t: float, r: float, q: float) -> None:
    """Set the current texture coordinate of a unit."""
    _multi_texcoord("glMultiTexCoord4f", target, s, t, r, q)


def glRectf(x1: float, y1: float, x2: float, y2: float) -> None:
    """Draw a rectangle in the plane z = 0."""
    if outside_begin("glRectf") is not None:
        glBegin(gl.GL_POLYGON)
        for x, y in ((x1, y1), (x2, y1), (x2, y2), (x1, y2)):
            _vertex(x, y)
        glEnd()


glRectd = glRecti = glRectf


# -- vertex arrays -----------------------------------------------------------------------------------------------------
def glEnableClientState(array: int) -> None:
    """Take an attribute of each vertex from its array."""
    _client_state("glEnableClientState", array, True)


def glDisableClientState(array: int) -> None:
    """Take the current value of an attribute for all vertices."""
    _client_state("glDisableClientState", array, False)


def _client_state(operation: str, array: int, on: bool) -> None:
    context = current()
    allowed = (*ARRAYS, gl.GL_TEXTURE_COORD_ARRAY)
    expected = "GL_VERTEX_ARRAY, GL_NORMAL_ARRAY, GL_COLOR_ARRAY or GL_TEXTURE_COORD_ARRAY"
    if is_one_of(operation, "array", array, allowed, expected):
        key = ARRAYS.get(array, f"texcoord{context.arrays.active_unit}")
        (context.arrays.enabled.add if on else context.arrays.enabled.discard)(key)


def glClientActiveTexture(texture: int) -> None:
    """Choose the unit that glTexCoordPointer and GL_TEXTURE_COORD_ARRAY mean."""
    units = range(gl.GL_TEXTURE0, gl.GL_TEXTURE0 + TEXTURE_UNITS)
    expected = f"GL_TEXTURE0 … GL_TEXTURE{TEXTURE_UNITS - 1}"
    if is_one_of("glClientActiveTexture", "texture", texture, units, expected):
        current().arrays.active_unit = texture - gl.GL_TEXTURE0


def glVertexPointer(size: int, type: int, stride: int, pointer: Any) -> None:
    """Set the array of positions: `size` 2, 3 or 4 numbers a vertex."""
    _pointer("glVertexPointer", "position", size, (2, 3, 4), type, stride, pointer)


def glNormalPointer(type: int, stride: int, pointer: Any) -> None:
    """Set the array of normals: 3 numbers a vertex."""
    _pointer("glNormalPointer", "normal", 3, (3,), type, stride, pointer)


def glColorPointer(size: int, type: int, stride: int, pointer: Any) -> None:
    """Set the array of colours: `size` 3 or 4 numbers a vertex; integers stand for 0 to 1."""
    _pointer("glColorPointer", "color", size, (3, 4), type, stride, pointer)


def glTexCoordPointer(size: int, type: int, stride: int, pointer: Any) -> None:
    """Set the array of texture coordinates of the client's active unit: `size` 1 to 4 numbers a vertex."""
    unit = current().arrays.active_unit
    _pointer("glTexCoordPointer", f"texcoord{unit}", size, (1, 2, 3, 4), type, stride, pointer)


def _pointer(operation: str, key: str, size: int, sizes: tuple[int, ...], type: int, stride: int, pointer: Any) -> None:
    context = current()
    if size not in sizes:
        fail(gl.GL_INVALID_VALUE, operation, f"size={size}: expected one of {', '.join(map(str, sizes))}")
        return
    if not is_one_of(operation, "type", type, TYPES, "GL_FLOAT, GL_DOUBLE or an integer type"):
        return
    if stride < 0:
        fail(gl.GL_INVALID_VALUE, operation, f"stride={stride}: expected 0 or more")
        return
    if pointer is None:
        context.arrays.pointers.pop(key, None)
        return
    context.arrays.pointers[key] = _rows(pointer, np.dtype(TYPES[type]), size, stride)


def _rows(pointer: Any, dtype: np.dtype, size: int, stride: int) -> np.ndarray:
    """Return an array as rows of `size` numbers, without copying one that fits; `stride` in bytes, 0 for none."""
    values = np.asarray(pointer)
    if values.dtype != dtype or not values.flags.c_contiguous:
        values = np.ascontiguousarray(values, dtype)
    if stride and stride != size * dtype.itemsize:
        flat = values.reshape(-1).view(np.uint8)
        count = (len(flat) - size * dtype.itemsize) // stride + 1
        strided = np.lib.stride_tricks.as_strided(flat, (count, size * dtype.itemsize), (stride, 1))
        return np.ascontiguousarray(strided).view(dtype)
    return values.reshape(-1)[: values.size // size * size].reshape(-1, size)


def glDrawArrays(mode: int, first: int, count: int) -> None:
    """Draw `count` vertices of the enabled arrays from `first` on."""
    context = outside_begin("glDrawArrays")
    if context is None or not is_one_of("glDrawArrays", "mode", mode, MODES, A_MODE):
        return
    if count < 0 or first < 0:
        fail(gl.GL_INVALID_VALUE, "glDrawArrays", f"first={first}, count={count}: expected 0 or more")
        return
    vertices = _array_vertices(context, "glDrawArrays", first, first + count)
    if vertices is not None and count:
        context.draw(mode, vertices)


def glDrawElements(mode: int, count: int, type: int, indices: Any) -> None:
    """Draw the vertices of the enabled arrays that `indices` name."""
    context = outside_begin("glDrawElements")
    if context is None or not is_one_of("glDrawElements", "mode", mode, MODES, A_MODE):
        return
    expected = "GL_UNSIGNED_BYTE, GL_UNSIGNED_SHORT or GL_UNSIGNED_INT"
    if not is_one_of("glDrawElements", "type", type, INDEX_TYPES, expected):
        return
    if count < 0:
        fail(gl.GL_INVALID_VALUE, "glDrawElements", f"count={count}: expected 0 or more")
        return
    numbers = np.asarray(indices).reshape(-1)[:count]
    if len(numbers) < count:
        raise ValueError(f"glDrawElements(count={count}): only {len(numbers)} indices are there")
    last = int(numbers.max()) if count else -1
    vertices = _array_vertices(context, "glDrawElements", 0, last + 1)
    if vertices is not None and count:
        owned = np.array(numbers, np.int32)
        owned.setflags(write=False)
        context.draw(mode, vertices, owned)


def _array_vertices(context: Context, operation: str, first: int, end: int) -> Vertices | None:
    """Return the vertices [first, end) of the enabled arrays; None without an array of positions.

    Raises
    ------
    ValueError
        An enabled array ends before `end`: GL would read memory that is not the array's.
    """
    arrays = context.arrays
    if "position" not in arrays.enabled:
        return None

    def attribute(key: str, standing: tuple[float, ...]) -> np.ndarray:
        rows = arrays.pointers.get(key)
        if key not in arrays.enabled or rows is None:
            return np.broadcast_to(np.array(standing, context.real), (end - first, len(standing)))
        if len(rows) < end:
            raise ValueError(f"{operation}: vertex {end - 1} is asked for, the array of {key} has {len(rows)}")
        return _full(rows[first:end], standing, context, key == "color")

    current_values = context.current
    texcoords = tuple(attribute(f"texcoord{unit}", current_values.texcoords[unit]) for unit in range(TEXTURE_UNITS))
    return Vertices(
        attribute("position", REST),
        attribute("color", current_values.color),
        attribute("normal", current_values.normal),
        texcoords,
    )


def _full(rows: np.ndarray, standing: tuple[float, ...], context: Context, is_color: bool) -> np.ndarray:
    """Return rows as read-only (V, 3 or 4) of the context's precision; missing numbers are 0, the fourth 1.

    The same content is converted once: a recording shares it among its draws.
    """
    root = _root(rows)
    if root.flags.writeable:
        content: Any = hashlib.blake2b(np.ascontiguousarray(rows).data, digest_size=16).digest()
    else:
        content = (id(root), rows.__array_interface__["data"][0])
    key = (content, rows.shape, rows.dtype, len(standing), is_color)
    if key not in context.arrays.converted:
        # the root is kept beside the result, so that its id stays its own
        context.arrays.converted[key] = (_convert(rows, standing, context, is_color), root)
    return context.arrays.converted[key][0]


def _root(rows: np.ndarray) -> np.ndarray:
    """Return the array that owns the memory, as far as NumPy tells."""
    while isinstance(rows.base, np.ndarray):
        rows = rows.base
    return rows


def _convert(rows: np.ndarray, standing: tuple[float, ...], context: Context, is_color: bool) -> np.ndarray:
    width = len(standing)
    full = np.empty((len(rows), width), context.real)
    full[:] = REST[:width]
    if rows.dtype.kind in "iu" and is_color:
        full[:, : rows.shape[1]] = rows / context.real(np.iinfo(rows.dtype).max)
    else:
        full[:, : rows.shape[1]] = rows
    full.setflags(write=False)
    return full


# -- debug groups ------------------------------------------------------------------------------------------------------
def glPushDebugGroup(source: int, id: int, length: int, message: str | bytes) -> None:
    """Name what is drawn until the matching pop; histories call it the object."""
    text = message.decode() if isinstance(message, bytes) else message
    current().labels.append(text if length < 0 else text[:length])


def glPopDebugGroup() -> None:
    """End the group of the last push."""
    context = current()
    if not context.labels:
        fail(gl.GL_STACK_UNDERFLOW, "glPopDebugGroup", "there was no glPushDebugGroup before it")
    else:
        context.labels.pop()
