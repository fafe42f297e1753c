"""The pipeline: one file per stage, and this file is the diagram.

::

    Draw --> geometry/ --------------------------------------------------> triangles
             assembly > vertex > clip > triangle_setup                         |
                                                                               v
             opaque:    raster/fill (coverage, depth, process_fragment) --> triangle per pixel --> spans --> shade/
             in order:  raster/ordered (list, process_fragment) ----------> those that passed --> shade/ (blend)

An opaque draw is filled first; then each visible pixel is shaded once. A draw whose colours depend on the order of its
fragments (alpha test, blending, logic op) lists them and tests them one by one; for the alpha test they are shaded
before that. Rooms: `records` (what stages hand to each other), `geometry/`, `raster/`, `shade/`; `buffers/` (clears,
copies, blits), `memory/` (scratch arrays, threads), `mesa/` (accidents of one driver), and `fast/`: short cuts that
`plan` and `choose` take where they pay. Without them the buffers are the same (`use_short_cuts`); `draw_path` tells
which way a draw went. `execute` carries out any recorded command (`commands`).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from softshadow.errors import StateError
from softshadow.framebuffer import Framebuffer, Storage
from softshadow.pipeline.choose import (
    MANY_TRIANGLES,
    ONE_BY_ONE,
    choose_fill,
    choose_forward,
    choose_geometry,
    choose_shading,
    fill_colorless,
    shades_in_bands,
)
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.draw_path import DrawPath, explain_paths
from softshadow.pipeline.memory.threads import set_threads, threads
from softshadow.pipeline.plan import Plan, WithoutOverlaps, plan_draw, tests_alpha, use_short_cuts
from softshadow.pipeline.raster.fill import OfRows, fill, fill_buffers, nothing
from softshadow.pipeline.raster.ordered import process_fragments
from softshadow.pipeline.raster.region import buffer_cells, covered, depth_range_of, padded_shape, region_of
from softshadow.pipeline.raster.spans import LAST, ONLY
from softshadow.pipeline.records import (
    PASSED,
    VERDICTS,
    FragmentCounts,
    Fragments,
    Geometry,
    Region,
    Setup,
    Spans,
)
from softshadow.pipeline.shade.blend import compared_alpha
from softshadow.pipeline.shade.color_writes import color_writer
from softshadow.pipeline.shade.discards import fragments_in
from softshadow.pipeline.shade.shading import shade, shade_and_write
from softshadow.pipeline.shade.visible_spans import BandsOfIds, VisibleSpans, spans_of, visible_spans
from softshadow.state import State

__all__ = [
    "VERDICTS",
    "DrawPath",
    "FragmentCounts",
    "draw",
    "explain_paths",
    "set_threads",
    "shade",
    "threads",
    "use_short_cuts",
]


def draw(command: Draw, storage: Storage, counts: FragmentCounts | None = None) -> None:
    """Draw: change the buffers of the framebuffer that the command's state names.

    Parameters
    ----------
    counts : FragmentCounts, optional
        The draw's fragments are added to it.

    Raises
    ------
    StateError
        The framebuffer has no buffers, or the draw needs what is not part of this subset. Nothing is drawn.
    """
    target = storage.framebuffers[command.state.draw_framebuffer]
    if not target.attachments:
        raise StateError(f"framebuffer {target.name} has nothing attached to draw to")
    plan = plan_draw(command, target, counts)
    if plan.show_rectangle:
        plan.show_rectangle(command, target, storage)
        return
    with np.errstate(all="ignore"):  # infinities of vertices that clipping removes; interpreted kernels would warn
        if plan.in_chunks:
            watch = plan.watch(target, storage) if plan.watch else None
            for triangles, ranges, region, fragments in fill_colorless(plan, command, target, storage):
                _fill(plan, command.state, target, triangles, region, fragments, ranges=ranges)
            if watch:
                watch.note_drawn()
            return
        draw_geometry(plan, command, target, storage, choose_geometry(plan, command, target, storage), counts)


def draw_geometry(
    plan: Plan,
    command: Draw,
    target: Framebuffer,
    storage: Storage,
    geometry: Geometry,
    counts: FragmentCounts | None = None,
) -> None:
    """Draw triangles in the window, under the state of a command."""
    if not len(geometry.triangles.ids):
        return
    watch = plan.watch(target, storage) if plan.watch else None
    draw_triangles = _draw_in_order if plan.in_order else _draw_opaque
    draw_triangles(plan, command, target, storage, geometry, counts)
    if watch:
        watch.note_drawn()


def _draw_opaque(
    plan: Plan,
    command: Draw,
    target: Framebuffer,
    storage: Storage,
    geometry: Geometry,
    counts: FragmentCounts | None,
) -> None:
    """Fill all triangles, then shade each visible pixel once."""
    state, triangles, real = command.state, geometry.triangles, geometry.window.dtype.type
    region, fragments = covered(triangles, region_of(state, target))
    if region.first_row >= region.end_row:
        return
    forward = choose_forward(plan, state, target, geometry, region, fragments, storage)
    if forward:
        _count_passed(forward(), counts)
        return

    ties: list[int] = []

    def fill_all(bands: BandsOfIds | None = None) -> None:
        _fill(plan, state, target, triangles, region, fragments, bands=bands, counts=counts, ties=ties)

    if not plan.writes_color:
        fill_all()
        return

    def visible() -> VisibleSpans:
        in_bands = shades_in_bands(plan, target, geometry)
        shade_band = choose_shading(plan, state, target, geometry) if in_bands else None
        bands = BandsOfIds(region, padded_shape(target)[1], shade_band)
        fill_all(bands)
        return bands.spans()

    was_cached = False
    if plan.cached_fill:
        depth_range = depth_range_of(state, real)
        spans, was_cached = plan.cached_fill(
            plan.front, plan.back, triangles, region, depth_range, target, storage, visible, ties
        )
        if was_cached:
            plan.path.note("an equal draw over the same depths was filled before: only shaded")
        if plan.remember_surface and not ties:
            plan.remember_surface(triangles, region_of(state, target), depth_range, target, storage, spans)
    else:
        spans = visible()
    if was_cached or not spans.are_shaded:
        choose_shading(plan, state, target, geometry)(spans.joined)  # not earlier: this may clear the colours


def _draw_in_order(
    plan: Plan,
    command: Draw,
    target: Framebuffer,
    storage: Storage,
    geometry: Geometry,
    counts: FragmentCounts | None,
) -> None:
    """Test and write the fragments one by one, in drawing order."""
    state, triangles = command.state, geometry.triangles
    region, real = region_of(state, target), geometry.window.dtype
    if _shade_known_surface(plan, command, target, storage, geometry):
        return
    is_mesh = len(triangles.ids) >= MANY_TRIANGLES
    if is_mesh and _shade_without_overlaps(plan, command, target, geometry):
        return
    rows, n_fragments = covered(triangles, region)
    if plan.forward:
        forward = choose_forward(plan, state, target, geometry, rows, n_fragments)
        if forward:
            _count_passed(forward(), counts)
            return
    if not is_mesh and _shade_without_overlaps(plan, command, target, geometry):
        return
    if plan.one_by_one and n_fragments >= ONE_BY_ONE * len(triangles.ids):
        _draw_one_by_one(plan, command, target, storage, geometry)
        return
    fragments = fragments_in(geometry, region)
    colors = shade(geometry, spans_of(fragments)) if tests_alpha(state) else None
    depth, stencil = buffer_cells(target, real)
    alpha, alpha_ref = np.zeros(len(fragments.row), np.uint8), 0
    if colors is not None:
        alpha, alpha_ref = compared_alpha(state, target.color, colors[:, 3])
    front, back = plan.front._replace(alpha_ref=alpha_ref), plan.back._replace(alpha_ref=alpha_ref)
    verdicts, depth_range = np.empty(len(fragments.row), np.uint8), depth_range_of(state, real.type)
    columns = np.arange(max(depth.shape), dtype=real)
    changed = process_fragments(
        front, back, fragments, alpha, triangles, depth_range, columns, depth, stencil, verdicts
    )
    if counts is not None:
        counts.verdicts[:] += np.bincount(verdicts, minlength=len(VERDICTS))
        counts.stencil_updates[:] += changed
    if plan.writes_color:
        plan.path.fill, plan.path.shading = "fragment by fragment", "program"
        passed = np.flatnonzero(verdicts == PASSED)
        spans = spans_of(Fragments(*(part[passed] for part in fragments)))
        if colors is None:
            shade_and_write(state, target, geometry, spans, ordered=True)
        else:
            for image in target.colors:
                color_writer(state, image)(spans, colors[passed])


def _count_passed(n_fragments: int, counts: FragmentCounts | None) -> None:
    if counts is not None:
        counts.verdicts[PASSED] += n_fragments


def _shade_known_surface(plan: Plan, command: Draw, target: Framebuffer, storage: Storage, geometry: Geometry) -> bool:
    """Shade a blended draw over the surfaces that an earlier draw of the same triangles left; return whether it is."""
    state, triangles = command.state, geometry.triangles
    if not plan.passing_spans:
        return False
    depth_range = depth_range_of(state, triangles.depth.dtype.type)
    parts = plan.passing_spans(plan.front, plan.back, triangles, region_of(state, target), depth_range, target, storage)
    if parts is None:
        return False
    plan.path.way = "opaque"
    plan.path.note("earlier draws left these surfaces in the depth buffer: only their fragments are tested")
    shade_spans = choose_shading(plan, state, target, geometry)
    for spans in parts:
        shade_spans(spans)
    return True


def _shade_without_overlaps(plan: Plan, command: Draw, target: Framebuffer, geometry: Geometry) -> bool:
    """Shade a blended draw where each pixel takes at most one fragment; return whether that is so."""
    if not plan.without_overlaps:
        return False
    spans = _spans_without_overlaps(plan, plan.without_overlaps, command, target, geometry)
    if spans is None:
        return False
    choose_shading(plan, command.state, target, geometry)(spans)
    return True


def _draw_one_by_one(plan: Plan, command: Draw, target: Framebuffer, storage: Storage, geometry: Geometry) -> None:
    """Draw triangles like opaque ones, one after the other: each has one fragment for a pixel, which needs no list."""
    for n in range(len(geometry.triangles.ids)):
        one = geometry._replace(triangles=Setup(*[array[n : n + 1] for array in geometry.triangles]))
        _draw_opaque(plan, command, target, storage, one, None)
    plan.path.way = "opaque"
    plan.path.note("large triangles are drawn one by one: none overlaps itself")


def _spans_without_overlaps(
    plan: Plan, without_overlaps: WithoutOverlaps, command: Draw, target: Framebuffer, geometry: Geometry
) -> Spans | None:
    """Return the spans of a blended draw where each pixel takes at most one fragment, or None."""
    triangles = geometry.triangles
    region, fragments = covered(triangles, region_of(command.state, target))
    if region.first_row >= region.end_row:
        return None

    def dry_run(ids: np.ndarray) -> None:
        _fill(plan, command.state, target, triangles, region, fragments, ids=ids)

    ids = without_overlaps(dry_run, region, padded_shape(target)[1])
    plan.path.note("a dry run found overlapping fragments" if ids is None else "a dry run found no overlaps")
    if ids is None:
        return None
    plan.path.way = "opaque"
    return visible_spans(ids, region)


def _fill(
    plan: Plan,
    state: State,
    target: Framebuffer,
    triangles: Setup,
    region: Region,
    fragments: int,
    *,
    ids: np.ndarray | None = None,
    bands: BandsOfIds | None = None,
    counts: FragmentCounts | None = None,
    ranges: Sequence[tuple[int, int]] | None = None,
    ties: list[int] | None = None,
) -> None:
    """Fill the triangles; `fragments` is about how many they have, the other arguments are those of `fill`.

    `bands` receive the last triangle of each pixel; `ids` the only one, or that there are several.
    """
    writes_ids = LAST if bands else ONLY if ids is not None else 0
    before: OfRows = nothing
    after: OfRows = nothing
    if bands:
        ids, before, after = bands.ids, bands.clear, bands.finish
    n_triangles = len(triangles.ids) if ranges is None else sum(end - first for first, end in ranges)
    choice = choose_fill(
        plan, n_triangles, fragments, region, writes_ids=writes_ids, counts=counts, depth=target.depth, ties=ties
    )
    if bands and not choice.are_few:
        bands.shade = None
    real, writes_depth = triangles.depth.dtype, bool(plan.front.depth_write or plan.back.depth_write)
    buffers = fill_buffers(*buffer_cells(target, real, writes_depth=writes_depth), real, region, ids)
    fill(
        choice.kernel, plan.front, plan.back, triangles, region, depth_range_of(state, real.type), buffers,
        writes_ids=bool(writes_ids), band_rows=choice.band_rows, ranges=ranges, before=before,
        after=after,
    )  # fmt: skip
