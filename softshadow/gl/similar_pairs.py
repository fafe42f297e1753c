"""glBegin ... glEnd pairs in a row that differ in nothing but their vertices, such as the strips of a sphere.

The first pair sets the vertex format: by its calls, unless no vertices are collected before it. The others have the
same format and the same state, so their draws are copies of one draw with other vertices.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from softshadow.context import Context
from softshadow.context.arrays import SLOTS
from softshadow.framebuffer import DEFAULT
from softshadow.gl.constant_attributes import ConstantSet, DrawnVertices, carried_of, constant_attributes
from softshadow.gl.materials import follow_color
from softshadow.gl.vertex_format import REST, TEXCOORDS, begin_format
from softshadow.pipeline.commands import Draw, Vertices, draws_like
from softshadow.pipeline.mesa.driver_draws import MAX_PAIRS, SEPARATE

FEWEST = 4  # vertices: Mesa draws some pairs with fewer in another mode
NO_STARTS: Mapping[str, int] = {}


class PairVertices:
    """The vertices of a pair.

    Attributes
    ----------
    arrays : dict            "position" (N, 4), "normal" (N, 3) ...: one row for each vertex
    has_late : bool          whether some vertices have a current value instead: those before the numbers in `starts`
    count : int              N
    """

    __slots__ = ("_drawn", "_starts", "arrays", "count", "has_late")

    def __init__(self, arrays: Mapping[str, np.ndarray], starts: Mapping[str, int] = NO_STARTS) -> None:
        self.arrays, self.count = arrays, len(arrays["position"])
        self._starts = {name: start for name, start in starts.items() if start}
        self.has_late = bool(self._starts)
        self._drawn = DrawnVertices()

    def with_constants(self, constants: ConstantSet) -> Vertices:
        """Return the vertices of a draw; attributes without an array are constant."""
        vertices = self._drawn.get(constants)
        if vertices is None:
            arrays = self._complete(constants)
            own = {SLOTS[name]: array for name, array in arrays.items()}
            vertices = Vertices(arrays["position"], *constants.columns(self.count, own))
            self._drawn.keep(constants, vertices)
        return vertices

    def _complete(self, constants: ConstantSet) -> Mapping[str, np.ndarray]:
        """Return the arrays, with the current values where vertices have these."""
        complete = dict(self.arrays)
        for name, start in self._starts.items():
            rows = complete[name] = complete[name].copy()
            rows[:start] = constants.attribute(name).row
            rows.setflags(write=False)
        return complete


class SimilarPairs:
    """Pairs that follow a drawn one without a call between, and whose vertices set the same attributes.

    Parameters
    ----------
    context : Context
    sizes : dict                   "position", "normal" ...: components that the calls of each vertex set
    """

    def __init__(self, context: Context, sizes: Mapping[str, int]) -> None:
        self._context, self.sizes = context, sizes
        self._constants = constant_attributes(context)
        self._draw: Draw | None = None

    def add(self, mode: int, pairs: Sequence[PairVertices]) -> int:
        """Draw pairs of a mode; return how many: if not all, the next one must be drawn by its calls.

        Afterwards the current values are those before them. Only the first pair may have vertices before its `starts`.
        """
        n_done = 0
        while n_done < len(pairs) and (fitting := self._fitting(mode, pairs[n_done:])):
            self._draw_all(mode, fitting)
            n_done += len(fitting)
        return n_done

    def _fitting(self, mode: int, pairs: Sequence[PairVertices]) -> list[PairVertices]:
        """Return the first ones that need not be drawn by their calls, and fit into the vertex buffer."""
        if mode in SEPARATE:
            return []
        buffer, fitting = self._context.vertex_buffer, []
        n_vertices, most = buffer.n_vertices, buffer.room - 1
        for pair in pairs[: MAX_PAIRS - buffer.pairs.n_pairs]:
            n_vertices += pair.count
            if pair.count < FEWEST or n_vertices >= most:
                break
            fitting.append(pair)
        return fitting

    def _draw_all(self, mode: int, pairs: Sequence[PairVertices]) -> None:
        constants = constant_attributes(self._context) if pairs[0].has_late else self._constants
        vertices = [pair.with_constants(constants) for pair in pairs]
        if self._draw is None:
            self._draw = self._context.draw_command(mode, vertices[0])
        elif self._draw.mode != mode:
            self._draw = self._draw._replace(mode=mode)
        self._context.vertex_buffer.draw_pairs(draws_like(self._draw, vertices))


def first_pairs(
    context: Context, mode: int, sizes: Mapping[str, int], starts: Mapping[str, int], count: int
) -> SimilarPairs | None:
    """Return what draws a pair of `count` vertices, and more like it; None if the pair must be drawn by its calls.

    Parameters
    ----------
    context : Context
    sizes : dict                   "position", "normal" ...: components that the calls of each vertex set
    starts : dict                  the first vertex for which they set each attribute
    """
    buffer = context.vertex_buffer
    if buffer.n_vertices or buffer.joined_pairs is not None or "position" in buffer.sizes:
        return None
    if not _can_be_similar(context) or context.groups[""].fields["draw_framebuffer"] != DEFAULT:
        return None
    if mode in SEPARATE or not FEWEST <= count < buffer.room_for(sizes) - 2:
        return None
    late = [name for name, start in starts.items() if start]
    for name in late:
        width = sizes[name]
        is_reset = name in TEXCOORDS and context.attribute(name)[width:] != REST[width:]  # in the first vertex, by Mesa
        if starts[name] > 1 or is_reset:
            return None
    begin_format(context, mode, sizes, late)
    follow_color(context)
    context.pending.reset_due = context.pending.has_vertices = True
    return SimilarPairs(context, sizes)


def _can_be_similar(context: Context) -> bool:
    """Return whether pairs may be drawn without their calls, as far as the vertex format does not decide it."""
    is_listed = context.compiled_list is not None or context.list_depth or context.executes_list
    return context.current.is_plain and not is_listed and context.primitive is None


def similar_pairs(context: Context, sizes: Mapping[str, int]) -> SimilarPairs | None:
    """Return what draws more pairs like the one that has ended just now; None if they may need more than that.

    Parameters
    ----------
    context : Context
    sizes : dict                   "position", "normal" ...: components that the calls of the vertices set
    """
    current, pending, buffer = context.current, context.pending, context.vertex_buffer
    if not (_can_be_similar(context) and pending.has_vertices):
        return None
    carried, active = buffer.sizes, buffer.active_sizes
    attributes = carried_of(tuple(carried))
    if attributes.optional or attributes.materials:
        return None
    if "color" in carried and "color" not in sizes and context.groups["lighting"].fields["color_material"]:
        followed = context.state_groups.followed
        if followed is None or followed[2] is not current.color:
            return None  # vertices that carry a colour may have other materials (`with_kept_materials`)
    for name, size in sizes.items():
        if not carried.get(name) == active.get(name) == size:
            return None
        if name != "position" and name not in pending.old_values:
            return None
    return SimilarPairs(context, sizes)


__all__ = ["NO_STARTS", "PairVertices", "SimilarPairs", "first_pairs", "similar_pairs"]
