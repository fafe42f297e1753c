"""The pipeline: one file per stage, and this file is the diagram.

::

    Draw --> geometry ---------------------------------------------> triangles
             vertex > clip > window > setup                              |
                                                                         v
             opaque:   fill (coverage, depth, process_fragment) ----> triangle per pixel --> spans --> shade --> write
             ordered:  list fragments --> process_fragment --> those that passed --> shade --> blend, write

Draws that leave no colours are set up and filled a portion at a time (`portions.py`): nobody shades their triangles.
Opaque draws shade each visible pixel once, after the fill; draws whose colours depend on the order of their fragments
(alpha test, blending, logic op) take the ordered path, and with an alpha test are shaded before `process_fragment`.
Blended draws whose fragments do not overlap go the first way after all (`sole_fragments`). A draw that was filled
before, over the same depths, is only shaded (`reuse`). All leave the same buffers.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from softshadow.errors import StateError
from softshadow.framebuffer import Framebuffer, Storage
from softshadow.pipeline.buffers.clear import clear
from softshadow.pipeline.fast.depth_only import chunks_of, writes_no_colors
from softshadow.pipeline.fast.specialize import VERDICT_COUNTS, fill, use_binding
from softshadow.pipeline.fast.unordered_blend import sole_fragments
from softshadow.pipeline.fast.visibility_cache import FillInputs, cached_fill, clear_visibility_cache
from softshadow.pipeline.geometry.geometry import Geometry, depth_range_of, process_geometry, region_of
from softshadow.pipeline.geometry.triangle_setup import Setup
from softshadow.pipeline.memory.threads import parts_of, set_threads, share, threads
from softshadow.pipeline.raster.coverage import extent
from softshadow.pipeline.raster.fill import Region, no_ids
from softshadow.pipeline.raster.fragment_ops import PASSED, VERDICTS, fragment_ops
from softshadow.pipeline.raster.ordered import Fragments, list_fragments, process_fragments
from softshadow.pipeline.shade.blend import compared_alpha, needs_order, tests_alpha
from softshadow.pipeline.shade.color_writes import color_writer
from softshadow.pipeline.shade.shading import shade, shade_and_write
from softshadow.pipeline.shade.visible_spans import Spans, spans_of, visible_spans

if TYPE_CHECKING:
    from softshadow.pipeline.commands import Draw

__all__ = ["VERDICTS", "clear", "clear_visibility_cache", "draw", "set_threads", "shade", "threads", "use_binding"]


def draw(command: Draw, storage: Storage, verdicts: np.ndarray | None = None) -> None:
    """Draw: change the buffers of the framebuffer that the command's state names.

    Parameters
    ----------
    verdicts : (6,) int64, optional
        Receives the number of fragments per verdict (`VERDICTS`), and last that of changed stencil values.

    Raises
    ------
    StateError
        The framebuffer has no buffers, or the draw needs what is not part of this subset. Nothing is drawn.
    """
    target = storage.framebuffers[command.state.draw_framebuffer]
    if not target.attachments:
        raise StateError(f"framebuffer {target.name} has nothing attached to draw to")
    with np.errstate(all="ignore"):  # infinities of vertices that clipping removes; interpreted kernels would warn
        if verdicts is None and not needs_order(command.state) and writes_no_colors(command, target):
            _draw_in_portions(command, target)
            return
        geometry = process_geometry(command, target, storage)
        if not len(geometry.triangles.ids):
            return
        writes_color = bool(target.colors) and any(command.state.color.mask)
        if needs_order(command.state):
            _draw_in_order(command, target, geometry, writes_color, verdicts)
        else:
            _draw_opaque(command, target, storage, geometry, writes_color, verdicts)


def _draw_opaque(
    command: Draw,
    target: Framebuffer,
    storage: Storage,
    geometry: Geometry,
    writes_color: bool,
    verdicts: np.ndarray | None,
) -> None:
    state, triangles = command.state, geometry.triangles
    region, fragments = _covered(triangles, region_of(state, target))
    if region.first_row >= region.end_row:
        return
    front, back = (fragment_ops(state, target.depth, target.stencil, facing) for facing in (True, False))
    depth_range = depth_range_of(state, geometry.window.dtype.type)

    def fill_planes(ids: np.ndarray | None) -> None:
        planes = _planes(target, geometry.window.dtype)
        fill(front, back, triangles, fragments, region, depth_range, *planes, ids, verdicts)

    def fill_and_find() -> Spans:
        ids = no_ids(region, _shape(target)[1])
        fill_planes(ids)
        return visible_spans(ids, region.first_row)

    if not writes_color:
        fill_planes(None)
        return
    if verdicts is None:
        spans = cached_fill(FillInputs(front, back, triangles, region, depth_range), target, storage, fill_and_find)
    else:
        spans = fill_and_find()
    shade_and_write(state, target, geometry, spans, ordered=False)


def _draw_in_portions(command: Draw, target: Framebuffer) -> None:
    state, real = command.state, command.vertices.position.dtype
    depth, stencil = _planes(target, real)
    front, back = (fragment_ops(state, target.depth, target.stencil, facing) for facing in (True, False))
    depth_range = depth_range_of(state, real.type)
    for triangles, spans, region, fragments in chunks_of(command, target):
        fill(front, back, triangles, fragments, region, depth_range, depth, stencil, spans=spans)


def _draw_in_order(
    command: Draw, target: Framebuffer, geometry: Geometry, writes_color: bool, verdicts: np.ndarray | None
) -> None:
    state, triangles = command.state, geometry.triangles
    region = region_of(state, target)
    depth_range = depth_range_of(state, geometry.window.dtype.type)
    if writes_color and verdicts is None and not tests_alpha(state):
        used, count = _covered(triangles, region)
        front, back = (fragment_ops(state, target.depth, target.stencil, facing) for facing in (True, False))
        planes = _planes(target, geometry.window.dtype)
        ids = sole_fragments(front, back, triangles, count, used, depth_range, *planes)
        if ids is not None:
            shade_and_write(state, target, geometry, visible_spans(ids, used.first_row), ordered=False)
            return
    fragments = list_fragments(triangles, region)
    colors = shade(geometry, spans_of(fragments)) if tests_alpha(state) else None
    depth, stencil = _planes(target, geometry.window.dtype)
    alpha, alpha_ref = np.zeros(len(fragments.row), np.uint8), 0
    if colors is not None:
        alpha, alpha_ref = compared_alpha(state, target.color, colors[:, 3])
    front, back = (
        fragment_ops(state, target.depth, target.stencil, facing)._replace(alpha_ref=alpha_ref)
        for facing in (True, False)
    )
    verdict = np.empty(len(fragments.row), np.uint8)
    columns = np.arange(max(depth.shape), dtype=geometry.window.dtype)
    changed = process_fragments(front, back, fragments, alpha, triangles, depth_range, columns, depth, stencil, verdict)
    if verdicts is not None:
        verdicts[:-1] += np.bincount(verdict, minlength=VERDICT_COUNTS - 1)
        verdicts[-1] += changed
    if writes_color:
        passed = np.flatnonzero(verdict == PASSED)
        written = spans_of(Fragments(*(part[passed] for part in fragments)))
        if colors is None:
            shade_and_write(state, target, geometry, written, ordered=True)
        else:
            for image in target.colors:
                color_writer(state, image)(written, colors[passed])


def _covered(triangles: Setup, region: Region) -> tuple[Region, int]:
    """Return the region cut to the rows that the triangles meet, and about how many fragments they have."""
    parts = parts_of(len(triangles.corners))
    extents = share(lambda n: extent(triangles.corners, *parts[n]), len(parts))
    firsts, ends, areas = zip(*extents, strict=True)
    cut = region._replace(first_row=max(region.first_row, min(firsts)), end_row=min(region.end_row, max(ends)))
    return cut, sum(areas) >> 8


def _planes(target: Framebuffer, real: np.dtype) -> tuple[np.ndarray, np.ndarray]:
    """Return depth and stencil cells; a buffer that is missing is stood in for by scratch, its test is off."""
    shape = _shape(target)
    depth = target.depth.cells if target.depth is not None else np.zeros(shape, real)
    stencil = target.stencil.cells if target.stencil is not None else np.zeros(shape, np.uint8)
    return depth, stencil


def _shape(target: Framebuffer) -> tuple[int, int]:
    """Return how many rows and columns the planes have, with their padding."""
    return next(iter(target.attachments.values())).image.shape
