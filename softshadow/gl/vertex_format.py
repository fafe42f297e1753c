"""The vertex format of immediate mode: which attributes the collected vertices carry, and when they are submitted.

Mesa collects glBegin ... glEnd pairs in one buffer, in which all vertices carry the same attributes. An attribute that
they do not carry yet, or with fewer components, submits the collected vertices, and so does a full buffer
(vbo_exec_api.c). So the format decides which quads are drawn together, and whether they share one constant colour.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, Primitive, VertexBuffer
from softshadow.context.current_values import UNIT_OF
from softshadow.gl.constant_attributes import OPTIONAL, carried_of, kept_constants
from softshadow.pipeline.commands import Vertices
from softshadow.pipeline.mesa.driver_draws import SEPARATE

REST = (0.0, 0.0, 0.0, 1.0)  # default values of components that a call does not set
TEXCOORDS = tuple(UNIT_OF)
NO_MATERIALS: frozenset[str] = frozenset()
NONE: dict[str, np.ndarray] = {}
FEW_CHANGES = 4  # an attribute that changes at one vertex in so many, or fewer, is repeated in runs
FEW_VERTICES = 8  # with more collected vertices, a new attribute outside glBegin makes Mesa reset all others


class Cut(NamedTuple):
    """Where to cut a primitive that is submitted before its glEnd.

    Its vertices [start, end) are drawn in `mode`; those with indices `copied` also begin the rest of the primitive.
    """

    mode: int
    start: int
    end: int
    copied: tuple[int, ...]


def forget_outside(context: Context) -> None:
    """Let vertices carry no attribute because a call before glBegin has set it, if none are collected."""
    sizes = context.vertex_buffer.sizes
    if "position" not in sizes:
        sizes.clear()
        if context.pending.names:
            context.reset_attributes()


def begin(context: Context, mode: int) -> None:
    """Begin a primitive. Attributes set before its first vertex are constant for all its vertices."""
    forget_outside(context)
    buffer = context.vertex_buffer
    sizes, context.ready = buffer.sizes, False
    materials = carried_of(tuple(sizes)).materials if sizes else NO_MATERIALS
    primitive = context.primitive = Primitive(mode, context.list_depth > 0, materials)
    size = sizes.get("position")
    if size and size == buffer.active_sizes["position"] and not (context.list_depth or context.executes_list):
        primitive.position_size = size  # vertices like the last ones do not change the format
        set_limit(buffer, primitive)


def carry_attribute(context: Context, name: str, size: int) -> int:
    """Make the following vertices carry an attribute of `size` components; submit the vertices that do not.

    Returns
    -------
    int
        The number of components that keep a value set by this call or an earlier one; the others become 0 and 1. Mesa
        resets the components that a call leaves out only if the previous call set more of them, and it loses track of
        this: after glColor4, glColor3, glColor4, glColor3, the last call keeps the third one's alpha. Display lists
        do not lose track.
    """
    if name != "position" and name not in context.pending.old_values:
        context.remember_attribute(name)
    buffer, primitive = context.vertex_buffer, context.primitive
    sizes, active_sizes = buffer.sizes, buffer.active_sizes
    carried = sizes.get(name, 0)
    if carried >= size:
        in_list = context.list_depth > 0 or (primitive is not None and context.executes_list)
        if in_list or size < active_sizes.get(name, 0):
            active_sizes[name] = size
            return size
        return carried
    active_sizes[name] = size
    if primitive is not None:
        primitive.position_size = 0  # there is room for fewer vertices
        if primitive.start:
            _split(context, primitive)
        if not primitive.positions and not primitive.from_list:
            buffer.submit()
        elif not primitive.from_list:
            _wrap(context, primitive)
            if not carried:
                _shorten(context, primitive, name, size)
    else:
        had_many = buffer.n_vertices > FEW_VERTICES
        buffer.submit()
        if name not in sizes and had_many:
            sizes.clear()
            context.reset_attributes()
            context.pending.reset_due = context.pending.has_vertices = True  # Mesa still flushes at the next change
            context.remember_attribute(name)
    sizes[name], context.ready = size, False
    return size


def _shorten(context: Context, primitive: Primitive, name: str, size: int) -> None:
    """Reset all but `size` components of an attribute in the copied vertices, which did not carry it, as Mesa does."""
    if name == "color" or name in UNIT_OF:
        value = context.attribute(name)
        primitive.changes[name] = [(0, (*value[:size], *REST[size:]))]


def set_attribute(context: Context, name: str, size: int, value: Any) -> None:
    """Set a current colour, normal or texture coordinate, after `carry_attribute` with `size` components."""
    primitive, buffer = context.primitive, context.vertex_buffer
    if primitive is not None:
        primitive.change(name, context.attribute(name), value)
        # calls that a list also records go the long way
        if buffer.sizes[name] == buffer.active_sizes[name] == size and not context.executes_list:
            primitive.steady[name] = size
        else:
            primitive.steady.pop(name, None)
    context.set_attribute(name, value)


def add_vertex(context: Context, *coordinates: float) -> None:
    """Add a vertex with the current attributes to the primitive; missing coordinates are z = 0, w = 1."""
    primitive, size = context.primitive, len(coordinates)
    if primitive is None:  # undefined in GL; here it adds nothing
        context.flush()
        return
    if primitive.positions or primitive.from_list or "position" in context.vertex_buffer.sizes:
        carry_attribute(context, "position", size)
    else:
        _carry_first_position(context, size)
    primitive.positions += (*coordinates, *REST[size:])
    store_vertices(context, primitive)
    primitive.position_size = 0 if context.executes_list else size


def _carry_first_position(context: Context, size: int) -> None:
    """Do what `carry_attribute` does for the first vertex after a flush."""
    buffer = context.vertex_buffer
    buffer.submit()
    buffer.sizes["position"] = buffer.active_sizes["position"] = size
    context.ready = False


def begin_format(context: Context, mode: int, sizes: Mapping[str, int], late: Collection[str]) -> None:
    """Make the vertices after a flush carry attributes of so many components, as the calls of a pair do.

    They set the attributes in `late` after the first vertex. The buffer must have room for this vertex.
    """
    begin(context, mode)
    primitive, buffer = context.primitive, context.vertex_buffer
    assert primitive is not None
    for name, size in sizes.items():
        if name != "position" and name not in late:
            carry_attribute(context, name, size)
    _carry_first_position(context, sizes["position"])
    if late:
        primitive.positions += REST
        _count(context, primitive)
        for name in late:
            carry_attribute(context, name, sizes[name])
        buffer.n_vertices -= primitive.counted
    context.primitive = None


def store_vertices(context: Context, primitive: Primitive) -> None:
    """Count the vertices; when the buffer is full, submit all of them. Set how many more there is room for."""
    if primitive.from_list:
        primitive.limit = sys.maxsize
        return
    if context.deferred is not None and context.deferred.store_first():
        return
    buffer = context.vertex_buffer
    _count(context, primitive)
    if set_limit(buffer, primitive) <= 0:
        _wrap(context, primitive)
        set_limit(buffer, primitive)


def set_limit(buffer: VertexBuffer, primitive: Primitive) -> int:
    """Set how many numbers the positions may have, by the room in the buffer; return for how many vertices it is."""
    room = buffer.room - 1 - buffer.n_vertices  # one is reserved for the end of a line loop
    primitive.limit = len(primitive.positions) + 4 * room
    return room


def _count(context: Context, primitive: Primitive) -> None:
    count = len(primitive.positions) // 4
    context.vertex_buffer.n_vertices += count - primitive.counted
    primitive.counted = count


def end(context: Context, primitive: Primitive) -> None:
    """Count the vertices of a primitive at its glEnd; turn the rest of a cut line loop into a line strip.

    The strip ends at the first vertex of the loop.
    """
    if primitive.waiting is not None:
        primitive.waiting.compute(context, primitive)
    if not primitive.from_list:
        _count(context, primitive)
    if primitive.continued and primitive.mode == gl.GL_LINE_LOOP:
        primitive.select([*range(1, len(primitive)), 0])
        primitive.mode = gl.GL_LINE_STRIP
        context.vertex_buffer.n_vertices += 1  # the first one stays in the buffer


def _split(context: Context, primitive: Primitive) -> None:
    """Leave the pairs before to be drawn without this one."""
    if primitive.waiting is not None:
        primitive.waiting.compute(context, primitive)
    context.vertex_buffer.split(primitive)


def _wrap(context: Context, primitive: Primitive) -> None:
    """Draw the collected vertices, and keep those that the rest of the primitive needs."""
    if primitive.start:
        _split(context, primitive)
    elif primitive.waiting is not None:
        primitive.waiting.compute(context, primitive)
    _count(context, primitive)
    n = len(primitive)
    alone = context.vertex_buffer.n_vertices == n
    cut = _cut(primitive, n)
    if cut.end > cut.start and not (alone and len(cut.copied) == n):
        context.draw_primitive(cut.mode, vertices_of(context, primitive, cut.start, cut.end))
    context.vertex_buffer.submit()
    primitive.select(cut.copied)
    primitive.continued = primitive.continued or len(cut.copied) != n
    context.vertex_buffer.n_vertices = primitive.counted = len(cut.copied)


def _cut(primitive: Primitive, n: int) -> Cut:
    """Return where to cut a primitive of `n` vertices (vbo_copy_vertices)."""
    mode, last = primitive.mode, n - 1
    if mode in SEPARATE:
        end = n - n % SEPARATE[mode]
        return Cut(mode, 0, end, tuple(range(end, n)))
    if mode == gl.GL_LINE_STRIP:
        return Cut(mode, 0, n if n > 1 else 0, (last,) if n else ())
    if mode in (gl.GL_TRIANGLE_STRIP, gl.GL_QUAD_STRIP):
        end = n - n % 2  # so that the rest begins with a triangle of the same winding
        return Cut(mode, 0, end if end > 2 else 0, tuple(range(max(end - 2, 0), n)))
    if mode == gl.GL_LINE_LOOP and primitive.continued:
        # its first vertex is needed at the end; Mesa copies the last but one, and so loses a line
        return Cut(gl.GL_LINE_STRIP, 1, n if n > 2 else 1, (0, last - 1) if n > 2 else (0,))
    drawn = gl.GL_LINE_STRIP if mode == gl.GL_LINE_LOOP else mode
    least = 2 if mode == gl.GL_LINE_LOOP else 3
    return Cut(drawn, 0, n if n >= least else 0, (0, last) if n > 1 else tuple(range(n)))


def vertices_of(context: Context, primitive: Primitive, start: int = 0, end: int | None = None) -> Vertices:
    """Return the vertices [start, end) of a primitive; attributes that they do not carry are repeats of one row."""
    carried, kept = carried_of(tuple(context.vertex_buffer.sizes)), kept_constants(context)
    positions, current = primitive.positions, context.current
    if end is None:
        arrays, end = primitive.arrays, len(positions) // 4
    else:
        arrays, positions = NONE, positions[4 * start : 4 * end]
    count = end - start

    def rows(name: str) -> np.ndarray:
        return arrays[name] if name in arrays else _rows(context, primitive, name, start, count)

    texcoords = kept.find_texcoords(context, carried.units).rows(count)
    for unit, name in carried.units:
        texcoords = (*texcoords[:unit], rows(name), *texcoords[unit + 1 :])
    edges = secondary = fog_coordinates = None
    if carried.optional or not current.is_plain:
        edges, secondary, fog_coordinates = [
            _optional_rows(context, primitive, name, rows, start, end) for name in OPTIONAL
        ]
    return Vertices(
        arrays["position"] if arrays else context.packed(positions, count, 4),
        rows("color") if carried.color else kept.latest_color.of(context, current.color, count),
        rows("normal") if carried.normal else kept.latest_normal.of(context, current.normal, count),
        texcoords,
        {name: rows(name) for name in primitive.materials} if primitive.materials else NONE,
        edges,
        secondary,
        fog_coordinates,
    )


def _rows(context: Context, primitive: Primitive, name: str, start: int, count: int) -> np.ndarray:
    """Return the numbers of an attribute of `count` vertices from `start` on."""
    changes, value = primitive.changes.get(name), context.attribute(name)
    if type(value) is not tuple:
        return context.packed(primitive.values(name, value)[start : start + count])
    if changes is None:
        return context.repeated(value, count)
    if not changes[-1][0]:  # it was set before the first vertex
        return context.repeated(changes[-1][1], count)
    if len(changes) * FEW_CHANGES < count and not start:
        return _in_runs(context, changes, count)
    width, numbers = len(value), primitive.components(name, value)
    if len(numbers) != width * count:
        numbers = numbers[width * start : width * (start + count)]
    return context.packed(numbers, count, width)


def _in_runs(context: Context, changes: Sequence[tuple[int, tuple[float, ...]]], count: int) -> np.ndarray:
    """Return the rows of an attribute of `count` vertices that changes at a few places."""
    values = context.packed([number for _, value in changes for number in value], len(changes), len(changes[0][1]))
    starts = [min(place // 4, count) for place, _ in changes]
    return _read_only(np.repeat(values, np.diff(starts, append=count), axis=0))


def _optional_rows(
    context: Context, primitive: Primitive, name: str, rows: Callable[[str], np.ndarray], start: int, end: int
) -> np.ndarray | None:
    """Return an attribute of the vertices [start, end); None if all have its initial value. `rows` is for numbers."""
    current = context.current.__dict__[name]
    is_flag = OPTIONAL[name] is True
    if name in context.vertex_buffer.sizes:
        return _read_only(np.array(primitive.values(name, current)[start:end], bool)) if is_flag else rows(name)
    if current == OPTIONAL[name]:
        return None
    value = np.array(current) if is_flag else context.frozen(current)
    return np.broadcast_to(value, (end - start, *value.shape))


def _read_only(rows: np.ndarray) -> np.ndarray:
    rows.flags.writeable = False
    return rows
