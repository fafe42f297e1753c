"""How Mesa joins consecutive primitives of a display list, and completes those that have too few vertices.

What is drawn differs from the calls where vertices are left over: the third vertex of GL_LINES begins a line that ends
in the next pair, and GL_QUADS with three vertices draws a triangle. Between triangle strips lie triangles of no area;
they are seen where polygons are not filled.

References: merge_prims and compile_vertex_list, vbo_save_api.c; vbo_merge_draws, vbo_exec.c.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from softshadow import tokens as gl
from softshadow.context.arrays import POSITION
from softshadow.gl.list_primitives import ListPrimitive, joined_primitive
from softshadow.pipeline.mesa.driver_draws import SEPARATE

LEAST = {  # vertices: with fewer, the last one is repeated
    gl.GL_POINTS: 1, gl.GL_LINES: 2, gl.GL_LINE_LOOP: 2, gl.GL_LINE_STRIP: 2, gl.GL_TRIANGLES: 3,
    gl.GL_TRIANGLE_STRIP: 3, gl.GL_TRIANGLE_FAN: 3, gl.GL_QUADS: 4, gl.GL_QUAD_STRIP: 4, gl.GL_POLYGON: 3,
}  # fmt: skip
JOINED = (gl.GL_POINTS, gl.GL_LINES, gl.GL_LINE_STRIP, gl.GL_TRIANGLES, gl.GL_TRIANGLE_STRIP, gl.GL_QUADS)


@dataclass(eq=False)
class Part:
    """A primitive, or several joined ones: the mode that it is drawn in, and its indices into their vertices."""

    mode: int
    indices: list[int]
    members: list[ListPrimitive]


def completed(mode: int, indices: list[int]) -> list[int]:
    """Return the indices of a primitive, the last one repeated until there are enough for a primitive."""
    return indices + indices[-1:] * (LEAST[mode] - len(indices))


def joined(run: list[ListPrimitive], is_opening: bool, is_closing: bool) -> list[ListPrimitive]:
    """Return consecutive primitives with the same attributes as Mesa draws them.

    `is_opening`, `is_closing`: whether the run contains the first and the last primitive of those between two calls
    that neither set attributes nor add vertices.
    """
    if all(_is_complete(primitive) for primitive in run) and not _has_two_strips(run):
        return run
    parts = _consecutive(run, is_opening, is_closing)
    drawn: list[Part] = []
    for number, part in enumerate(parts):
        mode, indices = part.mode, part.indices
        before = drawn[-1] if drawn else None
        as_lines = gl.GL_LINES if mode == gl.GL_LINE_STRIP else mode
        joins = before is not None and before.mode == as_lines and as_lines in JOINED
        following = parts[number + 1].mode if number + 1 < len(parts) else -1
        if mode == gl.GL_LINE_STRIP and (joins or following in (gl.GL_LINE_STRIP, gl.GL_LINES)):
            mode = as_lines
            indices = [i for j, i in enumerate(indices) for _ in range(2 if 0 < j < len(indices) - 1 else 1)]
        if before is None or not joins:
            drawn.append(Part(mode, completed(mode, indices), list(part.members)))
            continue
        if mode == gl.GL_TRIANGLE_STRIP:
            repeated = 2 if len(before.indices) % 2 else 1  # so that the triangles that follow keep their facing
            before.indices += [before.indices[-1], *indices[:1] * repeated]
        before.indices += completed(mode, indices)
        before.members += part.members
    first, places = 0, []
    for part in drawn:
        places.append(first)
        first += sum(len(member.rows[POSITION]) for member in part.members)
    return [_primitive(part, place) for part, place in zip(drawn, places, strict=True)]


def _consecutive(run: list[ListPrimitive], is_opening: bool, is_closing: bool) -> list[Part]:
    """Return the primitives with indices into the vertices of all; separate ones join complete ones before them."""
    parts: list[Part] = []
    first = 0
    for number, primitive in enumerate(run):
        indices = [first + index for index in primitive.indices.tolist()]
        first += len(primitive.rows[POSITION])
        mode = primitive.mode
        if mode == gl.GL_LINE_LOOP and is_closing and number == len(run) - 1:
            mode, indices = gl.GL_LINE_STRIP, [*indices, indices[0]]
        if number or not is_opening:
            mode = _converted(mode, len(indices))
        before = parts[-1] if parts else None
        corners = SEPARATE.get(mode)
        if before is not None and before.mode == mode and corners and len(before.indices) % corners == 0:
            before.indices += indices
            before.members.append(primitive)
        else:
            parts.append(Part(mode, indices, [primitive]))
    return parts


def _converted(mode: int, count: int) -> int:
    """Return the mode of a strip or fan of one line or triangle (vbo_try_prim_conversion)."""
    if mode == gl.GL_LINE_STRIP and count == 2:
        return gl.GL_LINES
    return gl.GL_TRIANGLES if mode in (gl.GL_TRIANGLE_STRIP, gl.GL_TRIANGLE_FAN) and count == 3 else mode


def _is_complete(primitive: ListPrimitive) -> bool:
    count = len(primitive.indices)
    return count >= LEAST[primitive.mode] and count % SEPARATE.get(primitive.mode, 1) == 0


def _has_two_strips(run: list[ListPrimitive]) -> bool:
    modes = [primitive.mode for primitive in run]
    return any(a == b == gl.GL_TRIANGLE_STRIP for a, b in pairwise(modes))


def _primitive(part: Part, first: int) -> ListPrimitive:
    """Return a part as one primitive; `first` is the number of its first vertex in the run."""
    return joined_primitive(part.members, part.mode, np.array(part.indices, np.int32) - np.int32(first))


__all__ = ["completed", "joined"]
