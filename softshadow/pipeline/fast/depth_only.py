"""Draws that leave no colours, some ten thousand triangles at a time.

Nothing asks for their triangles afterwards: no fragment is shaded. So those of a portion are set up, filled and
forgotten before the next portion. Their arrays lie in the cache, and in memory that the portion before has had: handing
out fresh pages for the million triangles of a mesh takes the system as long as setting them up.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.framebuffer import Framebuffer
from softshadow.jit import kernel, read_only
from softshadow.pipeline.geometry.clip import CUT, INSIDE, OUTSIDE, clip_triangles, write_sides
from softshadow.pipeline.geometry.geometry import (
    Positions,
    has_float_units,
    is_filled,
    offset_in,
    positions_of,
    region_of,
    stored_rows,
    triangles_of,
)  # fmt: skip
from softshadow.pipeline.geometry.lines import LINES
from softshadow.pipeline.geometry.triangle_setup import (
    Setup,
    add_float_units,
    drawn_facing,
    room_for,
    set_up_triangles,
    snapped_vertices,
)  # fmt: skip
from softshadow.pipeline.geometry.vertex import to_window, with_rows
from softshadow.pipeline.memory.threads import parts_of, share
from softshadow.pipeline.raster.fill import Region

if TYPE_CHECKING:
    from softshadow.pipeline.commands import Draw

CHUNK_TRIANGLES = 1 << 19  # triangles, 30 MB; measured, smaller ones cost more in calls than the cache gives


class Chunk(NamedTuple):
    """Triangles in drawing order, in the rows [first, end) of `triangles` that `runs` has; the others are not set.

    The region has all rows that they meet; `fragments` is about how many they have.
    """

    triangles: Setup
    runs: list[tuple[int, int]]
    region: Region
    fragments: int


class Sides(NamedTuple):
    """The triangles of a draw, and what clipping makes of them: the whole ones are not copied.

    triangles (T, 3) int32; of each (T,) uint8: whether it is INSIDE, OUTSIDE or CUT, none where all are inside; cut
    (K,): the numbers of those that are cut; pieces (P, 3) int32: what is left of these, that of the k-th in
    ``pieces[starts[k] : starts[k + 1]]``.
    """

    triangles: np.ndarray
    of: np.ndarray
    cut: np.ndarray
    pieces: np.ndarray
    starts: np.ndarray

    def most(self, first: int, end: int) -> int:
        """Return how many triangles of [first, end) may be left."""
        first_cut, end_cut = np.searchsorted(self.cut, (first, end))
        return int(end - first + self.starts[end_cut] - self.starts[first_cut])

    def left(self, first: int, end: int) -> np.ndarray:
        """Return those of the triangles [first, end) that are inside and the pieces of the others, in drawing order."""
        if not self.of[first:end].any():
            return self.triangles[first:end]
        left = np.empty((self.most(first, end), 3), np.int32)
        count = write_left(*self, first, end, np.searchsorted(self.cut, first), left)
        return read_only(left[:count])


def writes_no_colors(command: Draw, target: Framebuffer) -> bool:
    """Return whether a draw is of filled triangles, changes depth and stencil alone, and no colour decides about it."""
    state = command.state
    if command.mode in (gl.GL_POINTS, *LINES) or not is_filled(state) or (target.colors and any(state.color.mask)):
        return False
    # where Mesa shades all the same, with flat colours it may cut quads in another way, see `Varyings.flat_input`
    is_shaded, is_flat = target.colors or state.alpha.enabled, state.lighting.shade_model == gl.GL_FLAT
    return not is_shaded or not (command.program_name or is_flat)


def chunks_of(command: Draw, target: Framebuffer) -> Iterator[Chunk]:
    """Yield the triangles of a draw that `writes_no_colors`."""
    window, sides = _clipped(command, target, positions_of(command, target))
    (snapped, (first_row, end_row)), offset = snapped_vertices(window), offset_in(command, target)
    facing, units = drawn_facing(command.state.cull, target.flipped), command.state.polygon.units
    region = region_of(command.state, target)
    region = region._replace(first_row=max(region.first_row, first_row), end_row=min(region.end_row, end_row))
    if region.first_row >= region.end_row:
        return
    for begin in range(0, len(sides.triangles), CHUNK_TRIANGLES):
        parts = [(begin + a, begin + b) for a, b in parts_of(min(CHUNK_TRIANGLES, len(sides.triangles) - begin))]
        places = np.cumsum([0, *(sides.most(*part) for part in parts)]).tolist()
        made = room_for(places[-1], window.dtype)

        def set_up_part(n: int, made: Setup = made, parts: list = parts, places: list = places) -> tuple[int, int]:
            left = sides.left(*parts[n])
            end, covered = set_up_triangles(window, snapped, left, 0, len(left), *facing, offset, places[n], *made)
            if has_float_units(command, target):
                rows = slice(places[n], int(end))
                add_float_units(made.depth[rows, 3], window[made.vertices[rows], 2], units)
            return int(end), covered

        ends, covered = zip(*share(set_up_part, len(parts)), strict=True)
        yield Chunk(made, list(zip(places, ends, strict=False)), region, sum(covered) >> 8)


def _clipped(command: Draw, target: Framebuffer, positions: Positions) -> tuple[np.ndarray, Sides]:
    """Return the vertices in the window, those that clipping makes last, and what is left of the triangles."""
    clip, codes, window, planes = positions
    triangles = read_only(triangles_of(command, target, positions, across=False).corners)
    none = np.empty(0, np.int64)
    if not codes.any():
        return window, Sides(triangles, np.empty(0, np.uint8), none, triangles[:0], np.zeros(1, np.int64))
    of, parts = np.empty(len(triangles), np.uint8), parts_of(len(triangles))
    share(lambda n: write_sides(triangles, codes, *parts[n], of), len(parts))
    cut = np.flatnonzero(of == CUT)
    corners = triangles[cut].ravel()
    own = np.arange(len(corners), dtype=np.int32).reshape(-1, 3)
    clipped = clip_triangles(clip[corners], np.empty((len(corners), 0), clip.dtype), own, codes[corners], planes)
    starts = np.searchsorted(clipped.source, np.arange(len(cut) + 1))
    pieces = clipped.triangles + np.int32(len(window))
    window = with_rows(window, to_window(clipped.clip, *stored_rows(command, target)))
    return window, Sides(triangles, of, cut, pieces, starts)


@kernel
def write_left(triangles, of, cut, pieces, starts, first, end, k, left):
    """Write `Sides.left`; `k` is the place in `cut` of the first that is cut. Returns how many are left."""
    count = 0
    for t in range(first, end):
        if of[t] == INSIDE:
            for i in range(3):
                left[count, i] = triangles[t, i]
            count += 1
        elif of[t] != OUTSIDE:
            for p in range(starts[k], starts[k + 1]):
                for i in range(3):
                    left[count, i] = pieces[p, i]
                count += 1
            k += 1
    return count
