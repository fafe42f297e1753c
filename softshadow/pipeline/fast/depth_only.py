"""Draws without colours, in chunks; equals `geometry.geometry.process_geometry`, see fast/test_depth_only.py.

No fragment is shaded, so the triangles are not needed after the fill: those of a chunk are set up, filled and dropped
before the next chunk, which uses the same memory. Fresh pages for the million triangles of a mesh would take the system
as long as setting the triangles up. Each thread takes blocks of triangles that stay in the first-level cache, if each
can fill a depth buffer of its own: where the smallest depth counts, in whatever order.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from softshadow.framebuffer import Framebuffer, Storage
from softshadow.jit import allocating_kernel, kernel, read_only
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.fast.any_state import KERNELS, fill_scratch
from softshadow.pipeline.fast.fragment_numbers import numbers_of
from softshadow.pipeline.fast.geometry_cache import is_covered, recent_of
from softshadow.pipeline.fast.recent_triangles import triangles_key, window_key
from softshadow.pipeline.geometry.clip import CUT, INSIDE, NO_STAGES, OUTSIDE, clip_triangles, write_sides
from softshadow.pipeline.geometry.draw_primitives import triangles_in_stages, triangles_of
from softshadow.pipeline.geometry.facing import CULL_NONE, facing_and_area, leave_out_culled, vertices_of
from softshadow.pipeline.geometry.geometry import (
    Positions,
    filled_offset,
    has_float_units,
    positions_of,
    window_transform,
)
from softshadow.pipeline.geometry.triangle_setup import (
    Offset,
    add_float_units,
    empty_setup,
    set_up_triangles,
    snapped_vertices,
    stored_culling,
)
from softshadow.pipeline.geometry.vertex import append_rows, to_window
from softshadow.pipeline.memory.scratch import scratch
from softshadow.pipeline.memory.threads import parts_of, share, threads
from softshadow.pipeline.raster.fragment_ops import FragmentOps
from softshadow.pipeline.raster.region import region_of
from softshadow.pipeline.records import DepthRange, Region, Setup
from softshadow.tokens import GL_LEQUAL, GL_LESS

FILL = KERNELS[False, False]  # without stencil test, without ids
BLOCK = 256  # triangles; 15 KB
WORTH_BLOCKS = 4_000  # triangles from which threads fill depth buffers of their own,
PIXELS_PER_TRIANGLE = 32  # and one more for so many pixels, which are cleared and compared in the end
FAR = np.inf  # any depth is smaller
MEASURED = 1 << 10  # triangles, about, from which the number of fragments is estimated
CHUNK_TRIANGLES = 1 << 19  # 30 MB; measured: smaller chunks cost more in calls than they save in cache misses


class Chunk(NamedTuple):
    """Triangles in drawing order: the rows [first, end) of `triangles` in `ranges`; the other rows are not set.

    The region has all rows that they meet; `fragments` is about how many they have.
    """

    triangles: Setup
    ranges: list[tuple[int, int]]
    region: Region
    fragments: int


class ClippedTriangles(NamedTuple):
    """The triangles of a draw and the pieces that clipping leaves; whole triangles are not copied.

    triangles (T, 3) int32; sides (T,) uint8: INSIDE, OUTSIDE or CUT, empty where all are inside; cut (K,): the numbers
    of those that are cut; pieces (P, 3) int32: what is left of these, of the k-th
    ``pieces[starts[k] : starts[k + 1]]``; in_stages (T,) uint8: which pass Mesa's cull stage, empty for none, or None
    where nobody has asked.
    """

    triangles: np.ndarray
    sides: np.ndarray
    cut: np.ndarray
    pieces: np.ndarray
    starts: np.ndarray
    in_stages: np.ndarray | None

    def most(self, first: int, end: int) -> int:
        """Return an upper bound on how many triangles clipping leaves of [first, end)."""
        first_cut, end_cut = np.searchsorted(self.cut, (first, end))
        return int(end - first + self.starts[end_cut] - self.starts[first_cut])

    def visible(self, first: int, end: int, window: np.ndarray, culled: int, positive_is_front: int) -> np.ndarray:
        """Return the triangles of [first, end) that are inside and the pieces of the others, in drawing order.

        Those that the cull stage leaves out have no area: see `facing.leave_out_culled`.
        """
        all_in_stages = NO_STAGES if self.in_stages is None else self.in_stages
        visible, in_stages = self.triangles[first:end], all_in_stages[first:end]
        if self.sides[first:end].any():
            most = self.most(first, end)
            visible, of_visible = np.empty((most, 3), np.int32), np.empty(most if len(in_stages) else 0, np.uint8)
            first_cut = np.searchsorted(self.cut, first)
            count = write_visible(*self[:5], all_in_stages, first, end, first_cut, visible, of_visible)
            visible, in_stages = visible[:count], of_visible[:count]
        elif culled and in_stages.any():
            visible = visible.copy()
        if culled and in_stages.any():
            leave_out_culled(window, visible, in_stages, culled, positive_is_front)
        return read_only(visible)


class WindowMesh(NamedTuple):
    """The triangles of a draw without colours, before setup.

    window (V, 4), snapped (V, 2): its vertices, those of clipping last; facing: see `stored_culling`; units of the
    offset: None where they are part of it; region: the rows that the vertices span.
    """

    window: np.ndarray
    snapped: np.ndarray
    clipped: ClippedTriangles
    facing: tuple[int, int]
    offset: Offset
    units: float | None
    region: Region

    def fragments(self) -> int:
        """Return about how many fragments there are, from some of the triangles."""
        triangles = self.clipped.triangles
        every = len(triangles) // MEASURED + 1
        return int(sum_of_areas(self.snapped, triangles, every)) * every


def window_mesh(command: Draw, target: Framebuffer, storage: Storage | None = None) -> WindowMesh:
    """Return the triangles of a draw without colours (`plan.writes_no_colors`).

    With a `storage`, those of an equal draw before it, but for its culling and its scissor box, if they are recent.
    """
    recent, key = recent_of(storage), None
    vertices = command.vertices
    if is_covered(command) and vertices.edges is None:
        key = "mesh", *triangles_key(command), *window_key(command, target)
    found = recent.look_up(key) if recent and key else None
    if found is not None and command.state.cull.enabled and found[1].in_stages is None:
        found = None
    if found is None:
        window, clipped = _clipped(command, target, positions_of(command, target))
        found = window, clipped, *snapped_vertices(window)
        if recent and key:
            arrays = window, clipped.triangles, clipped.sides, clipped.pieces, found[2]
            recent.add(key, found, arrays, (vertices.position, command.indices))
    window, clipped, snapped, (first_row, end_row) = found
    region = region_of(command.state, target)
    first_row, end_row = max(region.first_row, first_row), min(region.end_row, end_row)
    return WindowMesh(
        window, snapped, clipped, stored_culling(command.state.cull, target.flipped), filled_offset(command, target),
        command.state.polygon.units if has_float_units(command, target) else None,
        region._replace(first_row=first_row, end_row=max(first_row, end_row)),
    )  # fmt: skip


def threads_of_blocks(mesh: WindowMesh, front: FragmentOps, back: FragmentOps) -> int:
    """Return how many threads fill blocks of triangles, 0 where chunks are the faster."""
    if threads() == 1:
        return 1
    region, n_triangles = mesh.region, len(mesh.clipped.triangles)
    pixels = (region.right - region.left) * (region.end_row - region.first_row)
    pays = n_triangles >= WORTH_BLOCKS + pixels / PIXELS_PER_TRIANGLE
    return threads() if pays and _keeps_nearest(front, back) else 0


def _keeps_nearest(front: FragmentOps, back: FragmentOps) -> bool:
    """Return whether a pixel keeps the smallest depth of all its fragments, of equal ones the first or the last."""
    nearest = all(ops.depth_test and ops.depth_write and not ops.stencil_test for ops in (front, back))
    return nearest and front.depth_func == back.depth_func and front.depth_func in (GL_LESS, GL_LEQUAL)


def fill_in_blocks(
    mesh: WindowMesh,
    front: FragmentOps,
    back: FragmentOps,
    depth_range: DepthRange,
    depth: np.ndarray,
    n_threads: int = 1,
) -> None:
    """Set up and fill triangles without stencil test, a block of them at a time.

    Several threads (see `threads_of_blocks`) share them: the first part goes to `depth`, any other one to a buffer of
    its own.
    """
    visible = mesh.clipped.visible(0, len(mesh.clipped.triangles), mesh.window, *mesh.facing)
    numbers, rows = numbers_of(front, back), slice(mesh.region.first_row, mesh.region.end_row)
    ends = [len(visible) * n // n_threads for n in range(n_threads + 1)]

    def fill_part(n: int) -> np.ndarray:
        buffer = scratch(depth.shape, depth.dtype) if n else depth
        if n:
            buffer[rows] = FAR
        fill_blocks(
            mesh.window, mesh.snapped, visible[ends[n] : ends[n + 1]], *mesh.facing, mesh.offset, *numbers,
            front.depth_largest, mesh.region, depth_range, buffer, np.empty((1, 1), np.uint8),
            np.empty((1, 1), np.int32), np.arange(BLOCK, dtype=np.int32), *empty_setup(BLOCK, mesh.window.dtype),
            fill_scratch(depth.shape[1], mesh.region),
        )  # fmt: skip
        return buffer

    for later in share(fill_part, n_threads)[1:]:
        keep_nearest(later[rows], front.depth_func == GL_LEQUAL, depth[rows])


@kernel
def sum_of_areas(snapped, triangles, every):
    """Return the sum of the areas of every n-th triangle in pixels, each rounded down."""
    total = 0
    for t in range(0, len(triangles), every):
        _, doubled = facing_and_area(snapped, *vertices_of(triangles, t), CULL_NONE, 1)
        total += abs(doubled) >> 17
    return total


@kernel
def keep_nearest(later, or_equal, depth):
    """Write the smaller depths to `depth`, as if the fragments of `later` came after those in it."""
    for j in range(depth.shape[0]):
        for i in range(depth.shape[1]):
            z, stored = later[j, i], depth[j, i]
            depth[j, i] = z if z < stored or (or_equal and z == stored) else stored


@allocating_kernel
def fill_blocks(
    window, snapped, triangles, culled, positive_is_front, offset, ops, byte_ops, largest, region, depth_range, depth,
    no_stencil, no_ids, numbers, corners, vertices, planes, front, ids, scratch,
):  # fmt: skip
    """Do `fill_in_blocks`; before `scratch` stand the arrays of a `Setup` for the triangles of a block."""
    for first in range(0, len(triangles), BLOCK):
        end = min(first + BLOCK, len(triangles))
        n_drawn, _ = set_up_triangles(
            window, snapped, triangles, first, end, culled, positive_is_front, offset, 0, corners, vertices, planes,
            front, ids,
        )  # fmt: skip
        FILL(
            0, ops, byte_ops, largest, corners, planes, front, numbers[: np.int64(n_drawn)], region, depth_range,
            depth.shape[1], depth, no_stencil, no_ids, *scratch,
        )  # fmt: skip


def chunks_of(mesh: WindowMesh) -> Iterator[Chunk]:
    """Yield the triangles of a mesh in chunks, set up."""
    window, snapped, clipped, facing, offset, units, region = mesh
    for begin in range(0, len(clipped.triangles), CHUNK_TRIANGLES):
        parts = [(begin + a, begin + b) for a, b in parts_of(min(CHUNK_TRIANGLES, len(clipped.triangles) - begin))]
        places = np.cumsum([0, *(clipped.most(*part) for part in parts)]).tolist()
        setup = empty_setup(places[-1], window.dtype)

        def set_up_part(n: int, setup: Setup = setup, parts: list = parts, places: list = places) -> tuple[int, int]:
            first, last = parts[n]
            visible = clipped.visible(first, last, window, *facing)
            end, covered = set_up_triangles(
                window, snapped, visible, 0, len(visible), *facing, offset, places[n], *setup
            )
            if units is not None:
                rows = slice(places[n], int(end))
                add_float_units(setup.depth[rows, 3], window[setup.vertices[rows], 2], units)
            return int(end), covered

        ends, covered = zip(*share(set_up_part, len(parts)), strict=True)
        yield Chunk(setup, list(zip(places, ends, strict=False)), region, sum(covered) >> 8)


def _clipped(command: Draw, target: Framebuffer, positions: Positions) -> tuple[np.ndarray, ClippedTriangles]:
    """Return the vertices in the window, new ones of clipping last, and the clipped triangles."""
    clip, codes, window, planes = positions
    triangles = triangles_of(command, target, codes, planes, across=False).corners
    in_stages = triangles_in_stages(command, codes, planes, triangles) if command.state.cull.enabled else None
    triangles = read_only(triangles)
    none = np.empty(0, np.int64)
    if not codes.any():
        starts = np.zeros(1, np.int64)
        return window, ClippedTriangles(triangles, np.empty(0, np.uint8), none, triangles[:0], starts, NO_STAGES)
    sides, parts = np.empty(len(triangles), np.uint8), parts_of(len(triangles))
    share(lambda n: write_sides(triangles, codes, *parts[n], sides), len(parts))
    cut = np.flatnonzero(sides == CUT)
    corners = triangles[cut].ravel()
    own = np.arange(len(corners), dtype=np.int32).reshape(-1, 3)
    clipped = clip_triangles(clip[corners], np.empty((len(corners), 0), clip.dtype), own, codes[corners], planes)
    starts = np.searchsorted(clipped.source, np.arange(len(cut) + 1))
    pieces = clipped.triangles + np.int32(len(window))
    window = append_rows(window, to_window(clipped.clip, *window_transform(command, target)))
    return window, ClippedTriangles(triangles, sides, cut, pieces, starts, in_stages)


@kernel
def write_visible(triangles, sides, cut, pieces, starts, in_stages, first, end, k, visible, of_visible):
    """Write the triangles of `ClippedTriangles.visible`, and which pass the cull stage unless none does.

    Return their number; `k`: where in `cut` the first cut triangle stands.
    """
    count = 0
    for t in range(first, end):
        before = count
        if sides[t] == INSIDE:
            for i in range(3):
                visible[count, i] = triangles[t, i]
            count += 1
        elif sides[t] != OUTSIDE:
            for p in range(starts[k], starts[k + 1]):
                for i in range(3):
                    visible[count, i] = pieces[p, i]
                count += 1
            k += 1
        if of_visible.shape[0]:
            for row in range(before, count):
                of_visible[row] = in_stages[t]
    return count
