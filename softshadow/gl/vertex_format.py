"""What the vertices of immediate mode carry, and what sends off those that have been collected.

Mesa collects glBegin ... glEnd pairs in one buffer, in which all vertices carry the same attributes. An attribute that
they do not carry yet, or with fewer numbers, sends off what has been collected, and so does the end of the buffer
(vbo_exec_api.c). So it decides which quads are drawn together, and whether their colour is one for all.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, Primitive
from softshadow.pipeline.commands import Vertices
from softshadow.pipeline.mesa.driver_draws import SEPARATE
from softshadow.state import TEXTURE_UNITS

REST = (0.0, 0.0, 0.0, 1.0)  # what a vector gets where the call gives fewer than four numbers
FEW_VERTICES = 8  # an attribute given after more of them, outside glBegin, makes Mesa forget all others


class Cut(NamedTuple):
    """Where a primitive is cut that is sent off before its glEnd.

    As which mode its vertices [start, end) are drawn, and the numbers of those that the rest of it needs.
    """

    mode: int
    start: int
    end: int
    kept: tuple[int, ...]


def begin(context: Context, mode: int) -> None:
    """Start to collect a primitive. Attributes that were given before any vertex are constants of it."""
    if "position" not in context.vertex_buffer.sizes:
        context.vertex_buffer.sizes.clear()
        if context.pending.names:
            context.pending.forget(context)
    materials: dict[str, list[Any]] = {name: [] for name in context.vertex_buffer.sizes if "." in name}
    context.primitive = Primitive(mode, from_list=context.list_depth > 0, materials=materials)


def give(context: Context, name: str, size: int) -> int:
    """Make the vertices to come carry an attribute of `size` numbers, sending off those that cannot.

    Returns
    -------
    int
        How many numbers of the attribute, from the first on, are the ones given or given before; those after them
        become 0 and 1. Mesa sets what a call leaves out only where the call before gave more numbers, and it forgets
        that one did: of glColor4, glColor3, glColor4, glColor3 the last keeps the alpha of the third. Display lists
        keep count.
    """
    if name != "position":
        context.pending.about_to_give(name, context)
    sizes, primitive = context.vertex_buffer.sizes, context.primitive
    carried, given_before = sizes.get(name, 0), context.vertex_buffer.given_sizes.get(name, 0)
    if carried >= size:
        in_list = context.list_depth > 0 or (primitive is not None and context.executes_list)
        if size < given_before or in_list:
            context.vertex_buffer.given_sizes[name] = size
            return size
        return carried
    context.vertex_buffer.given_sizes[name] = size
    if primitive is not None:
        if not primitive.from_list:
            _wrap(context, primitive)
            if name not in sizes:
                _shorten(primitive, name, size)
    else:
        many = context.vertex_buffer.stored > FEW_VERTICES
        context.vertex_buffer.send_off()
        if name not in sizes and many:
            sizes.clear()
    sizes[name] = size
    return size


def _shorten(primitive: Primitive, name: str, size: int) -> None:
    """Give the vertices that are kept only `size` numbers of an attribute that they did not carry, as Mesa does."""
    if name == "color":
        primitive.colors[:] = [(*color[:size], *REST[size:]) for color in primitive.colors]  # type: ignore[misc]
    elif name.startswith("texcoord"):
        unit = int(name.removeprefix("texcoord"))
        for number, rows in enumerate(primitive.texcoords):
            shortened = (*rows[unit][:size], *REST[size:])
            primitive.texcoords[number] = (*rows[:unit], shortened, *rows[unit + 1 :])  # type: ignore[arg-type]


def store_vertex(context: Context, primitive: Primitive) -> None:
    """Count a vertex that has been collected; the one that fills the buffer sends off all of them."""
    if primitive.from_list:
        return
    context.vertex_buffer.stored += 1
    if context.vertex_buffer.stored >= context.vertex_buffer.room - 1:  # one is kept free, for the end of a line loop
        _wrap(context, primitive)


def _wrap(context: Context, primitive: Primitive) -> None:
    """Draw what has been collected, and keep the vertices that the rest of the primitive needs."""
    count, alone = len(primitive.positions), context.vertex_buffer.stored == len(primitive.positions)
    cut = _cut(primitive, count)
    if cut.end > cut.start and not (alone and len(cut.kept) == count):
        context.draw_primitive(cut.mode, vertices_of(context, primitive, cut.start, cut.end))
    context.vertex_buffer.send_off()
    for rows in primitive.rows:
        rows[:] = [rows[i] for i in cut.kept]
    primitive.continued = primitive.continued or len(cut.kept) != count
    context.vertex_buffer.stored = len(cut.kept)


def _cut(primitive: Primitive, count: int) -> Cut:
    """Return where to cut a primitive after `count` vertices (vbo_copy_vertices)."""
    mode, last = primitive.mode, count - 1
    if mode in SEPARATE:
        end = count - count % SEPARATE[mode]
        return Cut(mode, 0, end, tuple(range(end, count)))
    if mode == gl.GL_LINE_STRIP:
        return Cut(mode, 0, count if count > 1 else 0, (last,) if count else ())
    if mode in (gl.GL_TRIANGLE_STRIP, gl.GL_QUAD_STRIP):
        end = count - count % 2  # the rest begins with a triangle that turns as the first one did
        return Cut(mode, 0, end if end > 2 else 0, tuple(range(max(end - 2, 0), count)))
    if mode == gl.GL_LINE_LOOP and primitive.continued:
        # its first vertex waits for the end; that the last but one is kept loses a line, which is so in Mesa
        return Cut(gl.GL_LINE_STRIP, 1, count if count > 2 else 1, (0, last - 1) if count > 2 else (0,))
    drawn = gl.GL_LINE_STRIP if mode == gl.GL_LINE_LOOP else mode
    least = 2 if mode == gl.GL_LINE_LOOP else 3
    return Cut(drawn, 0, count if count >= least else 0, (0, last) if count > 1 else tuple(range(count)))


def end_continued_loop(context: Context, primitive: Primitive) -> None:
    """Make the rest of a line loop that was cut a line strip, which ends at the first vertex of the loop."""
    for rows in primitive.rows:
        rows.append(rows.pop(0))
    primitive.mode = gl.GL_LINE_STRIP
    context.vertex_buffer.stored += 1  # the first one stays in the buffer


def vertices_of(context: Context, primitive: Primitive, start: int = 0, end: int | None = None) -> Vertices:
    """Return the vertices [start, end) of a primitive; an attribute that they do not carry is spread from one row."""

    def rows(name: str, values: Sequence[Any]) -> np.ndarray:
        if name in context.vertex_buffer.sizes:
            return context.frozen(values[start:end])
        constant = context.frozen(values[start])
        return np.broadcast_to(constant, (len(values[start:end]), *constant.shape))

    texcoords = list(zip(*primitive.texcoords, strict=True))
    return Vertices(
        context.frozen(primitive.positions[start:end]),
        rows("color", primitive.colors),
        rows("normal", primitive.normals),
        tuple(rows(f"texcoord{unit}", texcoords[unit]) for unit in range(TEXTURE_UNITS)),
        {name: context.frozen(values[start:end]) for name, values in primitive.materials.items()},
    )
