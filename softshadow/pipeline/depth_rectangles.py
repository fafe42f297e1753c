"""Draw rectangles of depths and stencil values: glDrawPixels and glCopyPixels of other buffers than colour.

The rectangle is a quad with a texture, as in Mesa: red is the depth of a fragment, green its stencil value. Depths go
through the tests and writes of any fragment, in the colour of the raster position. Stencil values are written to the
pixels inside the scissor box without any test, and depths beside them if the depth mask allows it.

References: GL 2.1, sec. 3.6.4, 4.3.1; st_cb_drawpixels.c of Mesa 22.3.
"""

from __future__ import annotations

import numpy as np

from softshadow import tokens as gl
from softshadow.framebuffer import Framebuffer, Storage
from softshadow.frozen import evolve
from softshadow.pipeline.choose import choose_depths, choose_geometry
from softshadow.pipeline.commands import DrawDepths
from softshadow.pipeline.plan import plan_draw
from softshadow.pipeline.raster.fragment_ops import fragment_ops
from softshadow.pipeline.raster.ordered import list_fragments, process_fragments
from softshadow.pipeline.raster.region import buffer_cells, depth_range_of, region_of
from softshadow.pipeline.records import PASSED, VERDICTS, FragmentCounts, Fragments, Setup
from softshadow.pipeline.shade.blend import compared_alpha
from softshadow.pipeline.shade.color_writes import color_writer
from softshadow.pipeline.shade.shading import shade
from softshadow.pipeline.shade.visible_spans import spans_of
from softshadow.state import State


def draw_depths(command: DrawDepths, storage: Storage, counts: FragmentCounts | None = None) -> None:
    """Draw a rectangle of depths, stencil values or both into the draw framebuffer."""
    draw = command.draw
    target = storage.framebuffers[draw.state.draw_framebuffer]
    short_cut = choose_depths(command, target)
    if short_cut:
        short_cut(command, target, storage, counts)
        return
    plan = plan_draw(draw, target, counts or FragmentCounts.zero())  # as if counted: no short cut
    with np.errstate(all="ignore"):
        geometry = choose_geometry(plan, draw, target, storage)
        fragments = list_fragments(geometry.triangles, region_of(draw.state, target))
        values = shade(geometry, spans_of(fragments))
    each = Fragments(fragments.row, fragments.column, np.arange(len(fragments.row), dtype=np.int32))
    planes = np.zeros((len(each.row), 4), geometry.triangles.depth.dtype)  # each fragment has a depth of its own
    planes[:, 0] = values[:, 0]
    front = geometry.triangles.front[fragments.triangle]
    triangles = geometry.triangles._replace(depth=planes, front=front)
    if command.has_stencil:
        _write_stencil(command, target, each, triangles, values[:, 1])
        if counts is not None:
            counts.verdicts[PASSED] += len(each.row)
        return
    alphas = np.full(len(each.row), command.color[3], values.dtype)
    verdicts = _test(draw.state, target, each, triangles, alphas)
    if counts is not None:
        counts.verdicts[:] += np.bincount(verdicts, minlength=len(VERDICTS))
    passed = np.flatnonzero(verdicts == PASSED)
    if plan.writes_color:
        spans = spans_of(Fragments(*(part[passed] for part in each)))
        colors = np.tile(np.array(command.color, values.dtype), (len(passed), 1))
        for image in target.colors:
            color_writer(draw.state, image)(spans, colors)


def _test(state: State, target: Framebuffer, fragments: Fragments, triangles: Setup, alphas: np.ndarray) -> np.ndarray:
    """Return the verdicts of fragments (n,) uint8; depth and stencil change."""
    real = triangles.depth.dtype
    alpha, alpha_ref = np.zeros(len(alphas), np.uint8), 0
    if state.alpha.enabled:
        alpha, alpha_ref = compared_alpha(state, target.color, alphas)
    ops = [
        fragment_ops(state, target.depth, target.stencil, is_front)._replace(alpha_ref=alpha_ref)
        for is_front in (True, False)
    ]
    depth, stencil = buffer_cells(target, real)
    verdicts, columns = np.empty(len(alphas), np.uint8), np.arange(max(depth.shape), dtype=real)
    process_fragments(
        *ops, fragments, alpha, triangles, depth_range_of(state, real.type), columns, depth, stencil, verdicts
    )
    return verdicts


def _write_stencil(
    command: DrawDepths, target: Framebuffer, fragments: Fragments, triangles: Setup, stencil: np.ndarray
) -> None:
    state = command.draw.state
    if command.has_depth and target.depth is not None:
        always = evolve(state.depth, enabled=True, func=gl.GL_ALWAYS)
        quiet = evolve(state.stencil, enabled=False)
        writing = evolve(state, depth=always, stencil=quiet, alpha=evolve(state.alpha, enabled=False))
        _test(writing, target, fragments, triangles, np.zeros(len(stencil), triangles.depth.dtype))
    if target.stencil is not None:
        mask = np.uint8(state.stencil.front.write_mask & target.stencil.format.largest)
        cells, place = target.stencil.cells, (fragments.row, fragments.column)
        cells[place] = (cells[place] & ~mask) | (stencil.astype(np.uint8) & mask)


__all__ = ["draw_depths"]
