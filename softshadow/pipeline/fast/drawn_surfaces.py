"""Light added to surfaces that were drawn before; equals `raster.fill.fill`, see fast/test_drawn_surfaces.py.

A frame with several lights draws its surfaces once for their depths, and then once more for each light, with GL_LEQUAL
or GL_EQUAL and without writing depths. An opaque draw under GL_LESS or GL_LEQUAL leaves at each pixel the smallest of
the depths that were there and those of its fragments. So a later fragment of the same triangles can pass GL_LEQUAL or
GL_EQUAL only if it was the one that is visible, as long as stored depths have only become smaller: all others have
larger depths. Only where two fragments, or a fragment and the buffer, had the same depth, this does not hold; the fill
notes that (`any_state.fill_scratch`), and such a draw is not remembered.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from softshadow.framebuffer import Framebuffer, Storage
from softshadow.image import Image
from softshadow.jit import kernel
from softshadow.pipeline.fast.fragment_numbers import (
    READ,
    REF,
    depth_of,
    depth_passes,
    depth_test_of,
    numbers_of,
    stencil_passes,
    stencil_test_of,
)
from softshadow.pipeline.fast.visibility_cache import VisibilityCache, have_same_fragments
from softshadow.pipeline.memory.scratch import apart, scratch
from softshadow.pipeline.memory.threads import parts_of, share
from softshadow.pipeline.raster.fragment_ops import EQUAL, LEQUAL, LESS, NEVER, FragmentOps
from softshadow.pipeline.records import DepthRange, Region, Setup, Spans
from softshadow.pipeline.shade.visible_spans import VisibleSpans, joined_spans

MOST_SURFACES = 16  # of one storage
BLOCK = 64  # fragments of a span that are tested at a time
SHORT = 8  # fragments of a span that are tested one by one
NO_STENCIL = np.zeros((1, 1), np.uint8)


class DrawnSurface(NamedTuple):
    """The visible spans of an opaque draw, right after it.

    region: where the state lets it write; image: the depth buffer; then, now: its version tokens after the draw, and
    after later draws that have only made depths smaller.
    """

    triangles: Setup
    region: Region
    depth_range: DepthRange
    image: Image
    then: object
    now: object
    spans: VisibleSpans


def leaves_nearest(front: FragmentOps, back: FragmentOps) -> bool:
    """Return whether an opaque draw leaves the smallest depth at each pixel, and nothing but depths decides."""
    return all(
        ops.depth_test and ops.depth_write and ops.depth_func in (LESS, LEQUAL) and not ops.stencil_test
        for ops in (front, back)
    )


def only_lessens_depths(front: FragmentOps, back: FragmentOps) -> bool:
    """Return whether a draw makes no stored depth larger."""
    return all(not ops.depth_write or ops.depth_func in (NEVER, LESS, LEQUAL, EQUAL) for ops in (front, back))


def remember_surface(
    triangles: Setup,
    region: Region,
    depth_range: DepthRange,
    target: Framebuffer,
    storage: Storage,
    spans: VisibleSpans,
) -> None:
    """Remember the visible spans of a draw that `leaves_nearest`, in which no two depths were equal.

    Those of a cached fill may be known from an earlier frame: they become the latest.
    """
    surfaces, image = _surfaces_of(storage), target.depth
    if image is None:
        return
    if image.version is None:
        image.version = object()
    surfaces[:] = [surface for surface in surfaces if surface.spans is not spans]
    surfaces.append(DrawnSurface(triangles, region, depth_range, image, image.version, image.version, spans))
    del surfaces[:-MOST_SURFACES]


def _surfaces_of(storage: Storage) -> list[DrawnSurface]:
    cache: VisibilityCache = storage.visibility_cache or VisibilityCache()
    storage.visibility_cache = cache
    return cache.surfaces


class Watch:
    """Whether a draw keeps what is known about the surfaces in a depth buffer: it begins before the draw."""

    def __init__(self, target: Framebuffer, storage: Storage) -> None:
        self._image, cache = target.depth, storage.visibility_cache
        self._surfaces: list[DrawnSurface] = [] if cache is None else cache.surfaces
        self._before = None if self._image is None or not self._surfaces else self._image.version

    def note_drawn(self) -> None:
        """Note that the draw has only made depths smaller; surfaces of earlier depths are forgotten."""
        image = self._image
        if self._before is None or image is None or image.version is self._before:
            return
        if image.version is None:
            image.version = object()
        kept = []
        for surface in self._surfaces:
            if surface.image is not image or surface.now is image.version:
                kept.append(surface)
            elif surface.now is self._before:
                kept.append(surface._replace(now=image.version))
        self._surfaces[:] = kept


def passing_spans(
    front: FragmentOps,
    back: FragmentOps,
    triangles: Setup,
    region: Region,
    depth_range: DepthRange,
    target: Framebuffer,
    storage: Storage,
) -> list[Spans] | None:
    """Return the spans of the fragments that pass, if the triangles are those of surfaces that are known, else None.

    Draws under equal states are drawn together, as of the objects of a scene or for several lights. Each of the lists
    has the spans of one surface; they are in drawing order. A light may be limited by a scissor box: of spans that its
    region cuts, the parts in it are left.

    Parameters
    ----------
    front, back : the per-fragment operations, which change neither depth nor stencil (`plan.keeps_depth_and_stencil`)
    """
    image = target.depth
    if image is None or not (front.depth_test and back.depth_test) or storage.visibility_cache is None:
        return None
    known = [
        surface
        for surface in storage.visibility_cache.surfaces
        if surface.image is image
        and surface.now is image.version
        and _is_within(region, surface.region)
        and depth_range.same_as(surface.depth_range)
    ]
    found: list[tuple[int, DrawnSurface]] = []  # the number of the first triangle, and the surface
    first = 0
    while first < len(triangles.ids):
        surface = next((each for each in known if _begin_with(triangles, first, each.triangles)), None)
        if surface is None:
            return None
        found.append((first, surface))
        first += len(surface.triangles.ids)
    parts = [_tested(surface, region, front, back, depth_range, target) for _, surface in found]
    return [
        spans._replace(triangle=spans.triangle + np.int32(first)) if first else spans
        for (first, _), spans in zip(found, parts, strict=True)
    ]


def _is_within(region: Region, other: Region) -> bool:
    """Return whether a region contains no pixel outside another one."""
    in_columns = other.left <= region.left and region.right <= other.right
    in_rows = other.first_row <= region.first_row and region.end_row <= other.end_row
    return in_columns and in_rows and region.downwards == other.downwards


def _begin_with(triangles: Setup, first: int, others: Setup) -> bool:
    """Return whether the triangles from `first` on begin with the fragments of others."""
    rows = slice(first, first + len(others.ids))
    return rows.stop <= len(triangles.ids) and have_same_fragments(others, Setup(*(array[rows] for array in triangles)))


def _tested(
    surface: DrawnSurface,
    region: Region,
    front: FragmentOps,
    back: FragmentOps,
    depth_range: DepthRange,
    target: Framebuffer,
) -> Spans:
    tests_depth, tests_stencil = surface.then is not surface.now, bool(front.stencil_test or back.stencil_test)
    spans, triangles = surface.spans.joined, surface.triangles
    if not (tests_depth or tests_stencil) and region == surface.region:
        return spans
    depth, stencil = surface.image.read_cells, NO_STENCIL if target.stencil is None else target.stencil.read_cells
    parts = parts_of(len(spans.row))

    def test(n: int) -> Spans:
        part = spans.part(*parts[n])
        most = len(part.row) + part.fragments // 2
        row, left, triangle = scratch((3, most), np.int32)
        start = scratch(most + 1, np.int64)
        count = collect_passing(
            *part, int(tests_depth), int(tests_stencil), *numbers_of(front, back), front.depth_largest,
            triangles.depth, triangles.front, depth_range, region, depth, stencil, apart(BLOCK, np.uint8), row, left,
            triangle, start,
        )  # fmt: skip
        return Spans(row[:count], left[:count], triangle[:count], start[: count + 1])

    return joined_spans(share(test, len(parts)))


@kernel
def collect_passing(
    rows, lefts, triangles, starts, tests_depth, tests_stencil, numbers, byte_numbers, largest, planes, faces_front,
    depth_range, region, depth, stencil, hits, out_rows, out_lefts, out_triangles, out_starts,
):  # fmt: skip
    """Write the parts of spans in a region whose fragments pass the tests that there are; return how many they are.

    `numbers` are those of `fragment_numbers.numbers_of`; `hits` (BLOCK,) uint8 is scratch.
    """
    n, fragments = np.int64(0), np.int64(0)
    out_starts[0] = 0
    for r in range(rows.shape[0]):
        at, end = max(np.int64(lefts[r]), region.left), min(lefts[r] + (starts[r + 1] - starts[r]), region.right)
        if at >= end or not region.first_row <= rows[r] < region.end_row:
            continue
        t, j = np.uint64(triangles[r]), np.uint64(rows[r])
        f, row_at = np.uint64(faces_front[t]), np.float32(rows[r])
        depth_test, stencil_test = depth_test_of(numbers, f), stencil_test_of(byte_numbers, f)
        ref, read = byte_numbers[f, REF], byte_numbers[f, READ]
        z0 = dz = dz_row = offset = depth[0, 0]
        if tests_depth:
            z0, dz, dz_row, offset = planes[t, 0], planes[t, 1], planes[t, 2], planes[t, 3]
        begin = np.int64(-1)  # of the part that is not finished
        if not (tests_depth or tests_stencil):  # all of it passes
            at, begin = end, at
        while at < end:
            length = min(end - at, BLOCK)
            every, some = np.uint8(0), np.uint8(0)
            if length >= SHORT:
                every = np.uint8(255)
                if tests_depth:
                    start_at = np.float32(np.int32(at))
                    for k in range(np.uint64(length)):
                        column = start_at + np.float32(np.int32(k))
                        z = depth_of(z0, dz, dz_row, offset, column, row_at, depth_range, largest)
                        hits[k] = np.uint8(depth_passes(depth_test, z, depth[j, np.uint64(at) + k]))
                else:
                    for k in range(np.uint64(length)):
                        hits[k] = np.uint8(255)
                if tests_stencil:
                    for k in range(np.uint64(length)):
                        s = np.uint8(stencil[j, np.uint64(at) + k] & read)
                        hits[k] = np.uint8(hits[k] & stencil_passes(stencil_test, ref, s))
                for k in range(np.uint64(length)):
                    every, some = np.uint8(every & hits[k]), np.uint8(some | hits[k])
            if every:
                begin = at if begin < 0 else begin
            elif length >= SHORT and not some:
                n, fragments = finish(
                    begin, at, rows[r], t, n, fragments, out_rows, out_lefts, out_triangles, out_starts
                )
                begin = np.int64(-1)
            else:
                for k in range(np.uint64(length)):
                    place = np.int64(at + np.int64(k))
                    i, hit = np.uint64(place), True
                    if length >= SHORT:
                        hit = hits[k] != 0
                    else:
                        if tests_depth:
                            column = np.float32(np.int32(place))
                            z = depth_of(z0, dz, dz_row, offset, column, row_at, depth_range, largest)
                            hit = depth_passes(depth_test, z, depth[j, i]) != 0
                        if tests_stencil:
                            hit = hit and stencil_passes(stencil_test, ref, np.uint8(stencil[j, i] & read)) != 0
                    if hit:
                        begin = place if begin < 0 else begin
                    else:
                        n, fragments = finish(
                            begin, place, rows[r], t, n, fragments, out_rows, out_lefts, out_triangles, out_starts
                        )
                        begin = np.int64(-1)
            at += length
        n, fragments = finish(begin, end, rows[r], t, n, fragments, out_rows, out_lefts, out_triangles, out_starts)
    return n


@kernel
def finish(begin, end, row, triangle, n, fragments, rows, lefts, triangles, starts):
    """Write the span from column `begin` to `end`, unless `begin` is -1; return the numbers of spans and fragments."""
    if begin >= 0:
        fragments += end - begin
        rows[n], lefts[n], triangles[n], starts[n + 1] = row, begin, triangle, fragments
        n += 1
    return n, fragments
