"""glBegin ... glEnd pairs in a row that differ in nothing but their vertices, such as the strips of a sphere.

The first pair sets the vertex format: by its calls, unless no vertices are collected before it, or those that are have
the format already. The others have the same format and the same state, so they are one draw of separate triangles or
lines; where that has other pixels, their draws are copies of one draw with other vertices.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import accumulate, groupby

import numpy as np

from softshadow.context import Context
from softshadow.context.arrays import SLOTS
from softshadow.gl.constant_attributes import ConstantSet, DrawnVertices, carried_of, constant_attributes
from softshadow.gl.framebuffers import can_be_drawn_to
from softshadow.gl.pair_numbers import can_be_joined
from softshadow.gl.vertex_format import REST, TEXCOORDS, begin_format
from softshadow.pipeline.commands import Draw, Vertices, draws_like
from softshadow.pipeline.geometry.separate import SEPARABLE, STRIPS, can_be_separated, separated
from softshadow.pipeline.mesa.driver_draws import MAX_PAIRS, SEPARATE

MOST_PARTS = 128  # of a series: which pairs are drawn together depends on how many are collected before
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


class PairSeries:
    """Pairs in a row, whose vertices have the same attributes.

    Parameters
    ----------
    arrays : dict                  as of `PairVertices`, of all pairs
    modes, counts : sequence of int    of each pair: its mode and number of vertices
    starts : dict                  as of `PairVertices`, for the first pair: the others have values of all attributes
    """

    def __init__(
        self,
        arrays: Mapping[str, np.ndarray],
        modes: Sequence[int],
        counts: Sequence[int],
        starts: Mapping[str, int] = NO_STARTS,
    ) -> None:
        self.modes, self.counts = tuple(modes), tuple(counts)
        self._arrays, self._starts = arrays, starts
        self._ends = (0, *accumulate(counts))
        self._parts: dict[tuple[int, int], PairVertices] = {}

    def part(self, start: int, end: int) -> PairVertices:
        """Return the vertices of the pairs [start, end): the same object for each draw of them."""
        part = self._parts.get((start, end))
        if part is None:
            if len(self._parts) >= MOST_PARTS:
                self._parts.clear()
            rows = slice(self._ends[start], self._ends[end])
            arrays = {name: array[rows] for name, array in self._arrays.items()}
            part = self._parts[start, end] = PairVertices(arrays, NO_STARTS if start else self._starts)
        return part


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

    def add(self, series: PairSeries, start: int) -> int:
        """Draw pairs from `start` on; return the end of these: if it is not the last, its calls draw it.

        Afterwards the current values are those before them.
        """
        while (end := self._end_of_fitting(series, start)) > start:
            self._draw_all(series, start, end)
            start = end
        return start

    def _end_of_fitting(self, series: PairSeries, start: int) -> int:
        """Return the end of those that need not be drawn by their calls, and fit into the vertex buffer."""
        buffer, end = self._context.vertex_buffer, start
        n_vertices, most = buffer.n_vertices, buffer.room - 1
        for count in series.counts[start : start + MAX_PAIRS - buffer.pairs.n_pairs]:
            n_vertices += count
            if count < FEWEST or n_vertices >= most or series.modes[end] in SEPARATE:
                break
            end += 1
        return end

    def _draw_all(self, series: PairSeries, start: int, end: int) -> None:
        buffer, draws, modes = self._context.vertex_buffer, [], series.modes[start:end]
        first = self._draw_of(modes[0], series.part(start, end))
        joins = can_be_joined(self._context)
        joins_modes = joins and STRIPS.issuperset(modes) and not buffer.driver_draw.is_lost
        if joins_modes and can_be_separated(first.state, first.mode, modes):
            draws.append(separated(first, series.counts[start:end], modes))
        else:
            for mode, same in groupby(range(start, end), series.modes.__getitem__):
                draws += self._draws_of(mode, series, list(same), joins)
        buffer.draw_pairs(draws, modes, series.counts[start:end])

    def _draws_of(self, mode: int, series: PairSeries, numbers: Sequence[int], joins: bool) -> list[Draw]:
        """Return the draws of pairs in a row of one mode."""
        start, end = numbers[0], numbers[-1] + 1
        draw = self._draw_of(mode, series.part(start, end))
        if joins and mode in SEPARABLE and can_be_separated(draw.state, mode):
            return [separated(draw, series.counts[start:end])]
        parts = [series.part(number, number + 1) for number in numbers]
        return draws_like(draw, [self._with_constants(part) for part in parts])

    def _draw_of(self, mode: int, part: PairVertices) -> Draw:
        """Return a draw of these vertices under the current state."""
        vertices, draw = self._with_constants(part), self._draw
        if draw is None:
            draw = self._draw = self._context.draw_command(mode, vertices)
            return draw
        return draw._replace(mode=mode, vertices=vertices)

    def _with_constants(self, part: PairVertices) -> Vertices:
        return part.with_constants(constant_attributes(self._context) if part.has_late else self._constants)


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
    if not _can_be_similar(context):
        return None
    if buffer.n_vertices:  # of pairs before: since then, calls have only set attributes
        return similar_pairs(context, sizes)
    if buffer.joined_pairs is not None or "position" in buffer.sizes:
        return None
    if not can_be_drawn_to(context):
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
    context.pending.reset_due = context.pending.has_vertices = True
    return SimilarPairs(context, sizes)


def _can_be_similar(context: Context) -> bool:
    """Return whether pairs may be drawn without their calls, as far as the vertex format does not decide it."""
    is_listed = context.compiled_list is not None or context.list_depth or context.executes_list
    return context.current.is_plain and not is_listed and context.primitive is None


def similar_pairs(context: Context, sizes: Mapping[str, int]) -> SimilarPairs | None:
    """Return what draws more pairs like a collected one; None if they may need more than that.

    Parameters
    ----------
    context : Context
    sizes : dict                   "position", "normal" ...: components that the calls of the vertices set
    """
    pending, buffer = context.pending, context.vertex_buffer
    if not (_can_be_similar(context) and pending.has_vertices):
        return None
    carried, active = buffer.sizes, buffer.active_sizes
    attributes = carried_of(tuple(carried))
    if attributes.optional or attributes.materials:
        return None
    if "color" in carried and "color" not in sizes and not context.has_followed(context.drawn_state):
        return None  # vertices that carry a colour may have other materials (`with_kept_materials`)
    for name, size in sizes.items():
        if not carried.get(name) == active.get(name) == size:
            return None
        if name != "position" and name not in pending.old_values:
            return None
    return SimilarPairs(context, sizes)


__all__ = ["NO_STARTS", "PairSeries", "PairVertices", "SimilarPairs", "first_pairs", "similar_pairs"]
