"""What the vertices of immediate mode carry, and when that ends a batch of quads.

Mesa collects glBegin ... glEnd pairs in one buffer, in which all vertices carry the same attributes. An attribute that
they do not carry yet, or with fewer numbers, sends off what has been collected (vbo_exec_api.c). So it decides which
quads are drawn together, and whether their colour is one for all.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, Primitive
from softshadow.pipeline.commands import Vertices
from softshadow.state import TEXTURE_UNITS

FEW_VERTICES = 8  # an attribute given after more of them, outside glBegin, makes Mesa forget all others


def begin(context: Context, mode: int) -> None:
    """Start to collect a primitive. Attributes that were given before any vertex are constants of it."""
    if "position" not in context.vertex_sizes:
        context.vertex_sizes.clear()
        if context.given.names:
            context.forget_given()
    materials: dict[str, list[Any]] = {name: [] for name in context.vertex_sizes if "." in name}
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
        context.about_to_give(name)
    sizes, primitive = context.vertex_sizes, context.primitive
    carried, given_before = sizes.get(name, 0), context.given_sizes.get(name, 0)
    if carried >= size:
        if size < given_before or context.list_depth:
            context.given_sizes[name] = size
            return size
        return carried
    context.given_sizes[name] = size
    context.draw_waiting()
    if primitive is not None:
        if not primitive.from_list:
            _draw_finished(context, primitive)
        context.stored_vertices = len(primitive.positions)
    else:
        if name not in sizes and context.stored_vertices > FEW_VERTICES:
            sizes.clear()
        context.stored_vertices = 0
    sizes[name] = size
    return size


def _draw_finished(context: Context, primitive: Primitive) -> None:
    """Draw the quads that are complete, and keep the vertices that the rest of the primitive needs.

    Other primitives are left whole: it makes no difference to their triangles.
    """
    count = len(primitive.positions)
    if primitive.mode == gl.GL_QUADS:
        kept, drawn = count % 4, count - count % 4
    elif primitive.mode == gl.GL_QUAD_STRIP:
        kept, drawn = min(count, 2 + count % 2), count - count % 2
    else:
        return
    if count - kept:
        context.draw_primitive(primitive.mode, vertices_of(context, primitive, drawn))
        for rows in (primitive.positions, primitive.colors, primitive.normals, primitive.texcoords):
            del rows[: count - kept]
        for rows in primitive.materials.values():
            del rows[: count - kept]


def vertices_of(context: Context, primitive: Primitive, end: int | None = None) -> Vertices:
    """Return the vertices of a primitive, up to `end`; an attribute that they do not carry is spread from one row."""

    def rows(name: str, values: Sequence[Any]) -> np.ndarray:
        if name in context.vertex_sizes:
            return context.frozen(values[:end])
        constant = context.frozen(values[0])
        return np.broadcast_to(constant, (len(values[:end]), *constant.shape))

    texcoords = list(zip(*primitive.texcoords, strict=True))
    return Vertices(
        context.frozen(primitive.positions[:end]),
        rows("color", primitive.colors),
        rows("normal", primitive.normals),
        tuple(rows(f"texcoord{unit}", texcoords[unit]) for unit in range(TEXTURE_UNITS)),
        {name: context.frozen(values[:end]) for name, values in primitive.materials.items()},
    )
