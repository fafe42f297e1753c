"""Consecutive draws, drawn together; equals `raster.ordered.process_fragments`, see fast/test_segments.py.

A program that binds a texture or moves the scissor box between small draws makes segments of a few triangles. To begin
one costs more than its fragments, so consecutive ones are drawn by one call of a kernel. Large draws in order are added
to them: threads share the rows of all of them at once.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import accumulate
from typing import Any, NamedTuple

import numpy as np

from softshadow.framebuffer import Framebuffer, Storage
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.fast.batch.segments import Part
from softshadow.pipeline.fast.drawn_surfaces import Watch
from softshadow.pipeline.fast.forward import (
    TRIANGLES,
    Segments,
    buffers_of,
    draw_rows,
    in_order,
    work_of,
    write_planes,
)
from softshadow.pipeline.fast.segment_tables import (
    END,
    FIRST,
    FLATS,
    TEXTURES,
    SegmentState,
    padded_textures,
    state_tables,
)
from softshadow.pipeline.fast.span_state import UNITS
from softshadow.pipeline.fast.span_texels import texels_of
from softshadow.pipeline.memory.scratch import scratch
from softshadow.pipeline.memory.threads import share
from softshadow.pipeline.raster.bins import bands_of, rows_of_band, rows_of_few_bands
from softshadow.pipeline.raster.region import depth_range_of, region_of
from softshadow.pipeline.records import DepthRange, Geometry, Region, Setup
from softshadow.state import State
from softshadow.texture import Texture

SEGMENTS = 1 << 10  # of one group
WORTH_KEEPING = 1 << 17  # bytes that are copied in the time in which a group is drawn


@dataclass(slots=True)
class Triangles:
    """Triangles [first, end) of a batch, which has a `place` among those of a group."""

    place: int
    batch: Geometry
    first: int
    end: int


class Taken(NamedTuple):
    """What the draws of one state have in common in a group.

    alive: what they are known by, by identity; triangles: of their batch; row: theirs in the table of segments, but for
    which triangles they have; range: of depths; place: among all that is taken.
    """

    alive: tuple[Any, ...]
    triangles: Triangles
    row: tuple[int, ...]
    range: DepthRange
    place: int


class Group:
    """Consecutive draws to one framebuffer.

    Parameters
    ----------
    target : Framebuffer     that they are drawn to, in this storage
    """

    def __init__(self, target: Framebuffer, storage: Storage) -> None:
        self._target, self._storage = target, storage
        self._taken: list[Taken] = []
        self._rows: list[tuple[int, int, int]] = []  # of each segment: its `Taken`, first and end triangle in its batch
        self._queries: list[int] = []  # the occlusion query of each segment
        self._states: dict[int, tuple[int, SegmentState]] = {}  # with their places, by identity
        self._batches: dict[int, Triangles] = {}  # in use, by the identity of the batch
        self._texels: list[np.ndarray] = []
        self._places: dict[int, tuple[int, Texture]] = {}  # of the texels of textures, by the textures' identity
        self._regions: dict[tuple[int, ...], Region] = {}  # by the identity of what they depend on
        self._known: dict[tuple[int, ...], Taken] = {}  # by the identity of what a draw has in common with later ones
        # by the identity of a draw and a batch: a program draws shapes of a few kinds in turn
        self._again: dict[tuple[int, int], tuple[Draw, Taken, SegmentState]] = {}
        self._n_triangles, self._work, self._columns = 0, 0, 0

    def takes(self, command: Draw, numbers: SegmentState, part: Part, target: Framebuffer, query: int) -> bool:
        """Add a draw, whose fragments a query counts if it is not 0; return False where it belongs to another group."""
        if self._rows and (target is not self._target or not self._has_room(part)):
            return False
        state = command.state
        key = id(state), id(numbers), id(part.batch), id(part.program)
        taken = self._known.get(key)
        if taken is None:
            taken = self._take_first(state, numbers, part)
            if taken is None:
                return False
            self._known[key] = taken
            self._taken.append(taken)
        self._again[id(command), id(part.batch)] = command, taken, numbers
        self._add(taken, numbers, part, query)
        return True

    def takes_again(self, command: Draw, part: Part) -> bool:
        """Add a draw if others of the same command and batch have been added last; no query counts its fragments."""
        known = self._again.get((id(command), id(part.batch)))
        if known is None or not self._has_room(part):
            return False
        _, taken, numbers = known
        self._add(taken, numbers, part, 0)
        return True

    def _has_room(self, part: Part) -> bool:
        return self._n_triangles + part.end - part.first <= TRIANGLES and len(self._rows) < SEGMENTS

    def _add(self, taken: Taken, numbers: SegmentState, part: Part, query: int) -> None:
        count = part.end - part.first
        taken.triangles.end = part.end
        self._rows.append((taken.place, part.first, part.end))
        self._queries.append(query)
        self._n_triangles += count
        self._work += work_of(numbers, part.fragments, count)

    def _take_first(self, state: State, numbers: SegmentState, part: Part) -> Taken | None:
        """Return what a draw has in common with later ones; None if its textures have no place in this group."""
        units = part.program.units or []
        new = [unit for unit in units if id(unit.texture) not in self._places]
        if self._rows and len(self._texels) + len(new) >= TEXTURES:  # one place is left for units that are not in use
            return None
        used = [self._place_of(unit.texture) for unit in units]
        used += [TEXTURES - 1] * (UNITS - len(used))
        k, _ = self._states.setdefault(id(numbers), (len(self._states), numbers))
        triangles = self._batches.get(id(part.batch))
        if triangles is None:
            triangles = self._batches[id(part.batch)] = Triangles(len(self._batches), part.batch, part.first, part.end)
            self._columns = max(self._columns, len(part.batch.flat))
        row = k, triangles.place, 0, 0, *self._region_of(state)[:4], *used
        return Taken((state, part), triangles, row, depth_range_of(state, np.float32), len(self._taken))

    def _place_of(self, texture: Texture) -> int:
        if id(texture) not in self._places:
            self._places[id(texture)] = len(self._texels), texture
            self._texels.append(texels_of(texture))
        return self._places[id(texture)][0]

    def keeps(self, name: int) -> bool:
        """Keep the texels of a texture, which will change, for the draws before.

        Return False if they are too many, or if the draws write to the texture: then the draws come first.
        """
        if self._target.attaches(name):
            return False
        changing = {key: place for key, (place, texture) in self._places.items() if texture.name == name}
        if any(self._texels[place].nbytes > WORTH_KEEPING for place in changing.values()):
            return False
        for key, place in changing.items():
            self._texels[place] = self._texels[place].copy()
            del self._places[key]
        if changing:
            self._known.clear()
            self._again.clear()
        return True

    def _region_of(self, state: State) -> Region:
        key = id(state.scissor), id(state.points), id(state.viewport)
        if key not in self._regions:
            self._regions[key] = region_of(state, self._target)
        return self._regions[key]

    def draw(self) -> None:
        """Draw them in their order."""
        lessens = all(numbers.only_lessens for _, numbers in self._states.values())
        watch = Watch(self._target, self._storage) if lessens else None
        passed = self._draw()
        if any(self._queries):
            for query, count in zip(self._queries, passed.tolist(), strict=True):
                self._storage.note_passed(query, count)
        if watch:
            watch.note_drawn()

    def _draw(self) -> np.ndarray:
        """Draw them; return how many fragments of each have passed the tests before shading."""
        triangles, planes = self._joined()
        segments = self._segments()
        region, order = segments.region, in_order[: self._n_triangles]
        if not segments.pay_bands:
            return draw_rows(segments, region.first_row, region.end_row, triangles, planes, order)
        band_rows = rows_of_few_bands(region, segments.work)

        def draw_band(n: int) -> np.ndarray:
            return draw_rows(segments, *rows_of_band(n, region, band_rows), triangles, planes, order)

        passed: np.ndarray = np.sum(share(draw_band, bands_of(region, band_rows)), axis=0)
        return passed

    def _segments(self) -> Segments:
        batches, rows = list(self._batches.values()), np.array(self._rows, np.int32)
        places, table = rows[:, 0], np.array([taken.row for taken in self._taken], np.int32)[rows[:, 0]]
        table[:, FIRST : END + 1] = rows[:, 1:]
        starts = accumulate([each.end - each.first for each in batches], initial=0)
        shifts = [start - each.first for start, each in zip(starts, batches, strict=False)]
        if any(shifts):
            table[:, FIRST : END + 1] += np.array(shifts, np.int32)[table[:, FLATS], None]
        states = [numbers for _, numbers in self._states.values()]
        flats = [_widened(each.batch.flat, self._columns, True) for each in batches]
        buffers = buffers_of(self._target, any(numbers.writes_depth for numbers in states))
        lefts, rights, firsts, ends, _ = zip(*self._regions.values(), strict=True)
        region = Region(min(lefts), max(rights), min(firsts), max(ends), int(self._target.flipped))
        return Segments(
            table, np.array([taken.range for taken in self._taken], np.float32)[places], np.array(flats),
            state_tables(states), padded_textures(self._texels), *buffers, region, self._work,
        )  # fmt: skip

    def _joined(self) -> tuple[Setup, np.ndarray]:
        """Return the triangles of all batches, one after the other, and the planes of their values."""
        planes, first, parts = scratch((self._n_triangles, 3, self._columns + 1), np.float32), 0, []
        for each in self._batches.values():
            own = Setup(*[array[each.first : each.end] for array in each.batch.triangles])
            write_planes(_with_columns(each.batch, self._columns), own, planes[first : first + len(own.ids)])
            first += len(own.ids)
            parts.append(own)
        return (parts[0] if len(parts) == 1 else Setup(*map(np.concatenate, zip(*parts, strict=True)))), planes


def _with_columns(batch: Geometry, columns: int) -> Geometry:
    """Return triangles with so many columns of values; nobody reads those that are added."""
    if len(batch.flat) == columns:
        return batch
    back = None if batch.back is None else _widened(batch.back, columns, 0)
    flat = _widened(batch.flat, columns, True)
    return batch._replace(values=_widened(batch.values, columns, 0), back=back, flat=flat)


def _widened(rows: np.ndarray, columns: int, value: float) -> np.ndarray:
    """Return rows with so many columns, the last ones of them of one value."""
    if rows.shape[-1] == columns:
        return rows
    wide = np.full((*rows.shape[:-1], columns), value, rows.dtype)
    wide[..., : rows.shape[-1]] = rows
    return wide
