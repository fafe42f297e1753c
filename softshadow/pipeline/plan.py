"""What the state decides about a draw before its geometry: in which order, and which short cuts may be taken.

The textbook is in `geometry/`, `raster/` and `shade/`; the short cuts are in `fast/`. `choose` decides what depends on
the triangles. `use_short_cuts` turns the short cuts off.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Literal, NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.framebuffer import Framebuffer, Storage
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.draw_path import DrawPath, begin_path, is_explained
from softshadow.pipeline.geometry.lines import LINES
from softshadow.pipeline.mesa.polygon_rules import has_special_fragments, passes_stages
from softshadow.pipeline.mesa.provoking_vertex import first_provokes
from softshadow.pipeline.raster.fragment_ops import FragmentOps, fragment_ops
from softshadow.pipeline.records import FragmentCounts, Region, Spans
from softshadow.pipeline.shade.visible_spans import VisibleSpans
from softshadow.state import State

try:
    from softshadow.pipeline.fast.batch.admission import can_begin_run, is_long
    from softshadow.pipeline.fast.batch.run import Run
    from softshadow.pipeline.fast.drawn_surfaces import (
        Watch,
        leaves_nearest,
        only_lessens_depths,
        passing_spans,
        remember_surface,
    )
    from softshadow.pipeline.fast.segment_tables import SegmentState
    from softshadow.pipeline.fast.shown_rectangles import is_shown, show_rectangle
    from softshadow.pipeline.fast.unordered_blend import triangles_without_overlaps
    from softshadow.pipeline.fast.visibility_cache import cached_fill

    SHORT_CUTS_EXIST = True
except ModuleNotFoundError:  # the folder can be deleted: the textbook draws everything
    SHORT_CUTS_EXIST = False

MOST_DRAWS = 4096  # of a run
MOST_VERTICES = 1 << 16  # of a run of several draws: more in one table gain nothing

Policy = bool | Literal["always"]
WithoutOverlaps = Callable[[Callable[[np.ndarray], None], Region, int], np.ndarray | None]

short_cuts: ContextVar[Policy] = ContextVar("short_cuts", default=SHORT_CUTS_EXIST)  # each thread has its own


@contextmanager
def use_short_cuts(policy: Policy) -> Iterator[None]:
    """Inside, draws use the short cuts of `softshadow.pipeline.fast` or not; results are the same.

    Parameters
    ----------
    policy : bool or "always"
        False: only the textbook; True: where they pay, which is the default; "always": also those whose kernels are
        not compiled yet, even where compiling takes longer than it saves.

    Raises
    ------
    ValueError
        `policy` is none of these, or the folder of short cuts was deleted.

    Examples
    --------
    >>> import softshadow as ss
    >>> with ss.use_short_cuts(False):
    ...     textbook = ss.run("planar", "boxes", size=(64, 48))
    >>> bool((textbook.image == ss.run("planar", "boxes", size=(64, 48)).image).all())
    True
    """
    if policy is not True and policy is not False and policy != "always":
        raise ValueError(f"use_short_cuts({policy!r}): expected True, False or 'always'")
    if policy and not SHORT_CUTS_EXIST:
        raise ValueError(f"use_short_cuts({policy!r}): softshadow.pipeline.fast is missing; expected False")
    token = short_cuts.set(policy)
    try:
        yield
    finally:
        short_cuts.reset(token)


class Plan(NamedTuple):
    """What the state decides about a draw.

    in_order: fragments are tested and written one by one; writes_color: colours may change; front, back: the
    per-fragment operations of each facing; counting: whether fragments are counted. The short cuts to take, or None:
    cached_fill looks for an equal fill, remember_surface keeps the visible spans, passing_spans looks for those of
    earlier draws, without_overlaps finds out whether blended fragments overlap; watch: begun before a draw that makes
    no depth larger; show_rectangle copies texels to pixels; in_chunks: whether some triangles are set up and filled at
    a time; forward: whether the draw may go triangle by triangle from coverage to pixels, for which `numbers` keeps
    what is computed from its state; one_by_one: whether large triangles that overlap may each be drawn as opaque ones.
    """

    in_order: bool
    writes_color: bool
    front: FragmentOps
    back: FragmentOps
    path: DrawPath
    numbers: list[SegmentState]
    in_chunks: bool = False
    cached_fill: Callable[..., tuple[VisibleSpans, bool]] | None = None
    remember_surface: Callable[..., None] | None = None
    passing_spans: Callable[..., list[Spans] | None] | None = None
    without_overlaps: WithoutOverlaps | None = None
    watch: Callable[[Framebuffer, Storage], Watch] | None = None
    show_rectangle: Callable[[Draw, Framebuffer, Storage], None] | None = None
    forward: bool = False
    one_by_one: bool = False
    counting: bool = False


def plan_draw(command: Draw, target: Framebuffer, counts: FragmentCounts | None = None) -> Plan:
    """Return what the state decides about a draw; with `counts`, its fragments are counted: each is processed once."""
    state, path = command.state, begin_path(command.label, command.called_mode)
    front = fragment_ops(state, target.depth, target.stencil, True)
    is_one_sided = state.stencil.front == state.stencil.back
    back = front if is_one_sided else fragment_ops(state, target.depth, target.stencil, False)
    is_special = has_special_fragments(state, command.mode)
    in_order, writes_color = needs_order(state) or is_special, bool(target.colors) and any(state.color.mask)
    plan = Plan(in_order, writes_color, front, back, path, [], counting=counts is not None)
    path.way = "in order" if in_order else "opaque"
    if is_special:
        path.note("stipple, smoothing or point sprites decide about each fragment")
    elif not in_order:
        path.note("neither blending nor alpha test: fragments are tested before any is shaded")
    else:
        path.note("the alpha test reads colours" if tests_alpha(state) else "blending depends on the drawing order")
    if not short_cuts.get():
        path.note("short cuts are off")
        return plan
    is_plain = counts is None and not (in_order or is_special)
    if command.shown_at is not None and is_plain and writes_color and is_shown(command, target, front):
        path.fill, path.shading = "rectangle", "copy of the texels"
        path.note("each pixel shows its texel, and only the scissor box tests it")
        return plan._replace(show_rectangle=show_rectangle)
    front, back = without_equal_writes(front), without_equal_writes(back)
    plan = plan._replace(front=front, back=back)
    if counts is not None:
        if not counts.only_passed or is_special or tests_alpha(state):
            path.note("fragments are counted: no short cut")
            return plan
        path.note("fragments that pass are counted: they are tested in drawing order")
        return plan._replace(forward=True, watch=Watch if only_lessens_depths(front, back) else None)
    if is_special:  # its fragments are not those of its triangles, which surfaces drawn before are compared by
        return plan._replace(forward=True)
    plan = plan._replace(watch=Watch if only_lessens_depths(front, back) else None)
    if in_order:
        only_writes_color = writes_color and not tests_alpha(state)
        if only_writes_color and keeps_depth_and_stencil(front, back):
            plan = plan._replace(without_overlaps=triangles_without_overlaps, passing_spans=passing_spans)
        return plan._replace(forward=True, one_by_one=only_writes_color)
    if writes_no_colors(command, target):
        path.way, path.reasons = "depth and stencil only, in chunks", ["no colour is written or tested"]
        return plan._replace(in_chunks=True)
    if writes_color:
        remembers = remember_surface if leaves_nearest(front, back) else None
        return plan._replace(cached_fill=cached_fill, remember_surface=remembers, forward=True)
    return plan


def may_wait(command: Draw) -> bool:
    """Return whether a draw may wait: short cuts are on, and nobody asks how draws went.

    Rectangles whose texels are copied do not wait: it takes less time than a batch, and most often another one follows,
    which needs their texture.
    """
    return short_cuts.get() is True and not is_explained() and not _may_be_copied(command)


def _may_be_copied(command: Draw) -> bool:
    """Return whether the texels of a rectangle may be copied: no test or blending is in the way (`is_shown`)."""
    state = command.state
    is_tested = state.depth.enabled or state.stencil.enabled or needs_order(state)
    return command.shown_at is not None and not is_tested


def begin_run(command: Draw, target: Framebuffer, storage: Storage) -> Run | None:
    """Return a run of draws that begins with this one: they wait, and are processed together. None: it cannot.

    Only draws that cannot fail wait, and of those without colours only short ones (`fast.depth_only`).
    """
    if not can_begin_run(command, target):
        return None
    colorless = writes_no_colors(command, target) and not tests_alpha(command.state)
    if colorless and is_long(command):
        return None
    return Run(command, storage, not colorless)


def needs_order(state: State) -> bool:
    """Return whether a draw's colours depend on the order of its fragments, or its fragments on their colours."""
    return tests_alpha(state) or state.blend.enabled or state.blend.logic_enabled


def tests_alpha(state: State) -> bool:
    """Return whether a fragment's colour decides if it passes."""
    return state.alpha.enabled and state.alpha.func != gl.GL_ALWAYS


def writes_no_colors(command: Draw, target: Framebuffer) -> bool:
    """Return whether a draw is of filled triangles, and no colour is written or decides about a fragment."""
    state = command.state
    if command.mode in (gl.GL_POINTS, *LINES) or passes_stages(state) or (target.colors and any(state.color.mask)):
        return False
    # where Mesa shades all the same, with flat colours it may cut quads in another way, see `Varyings.flat_input`
    is_shaded, is_flat = target.colors or state.alpha.enabled, state.lighting.shade_model == gl.GL_FLAT
    return not first_provokes(state) and (not is_shaded or not (command.program_name or is_flat))


def without_equal_writes(ops: FragmentOps) -> FragmentOps:
    """Return operations that write no depth under GL_EQUAL, where it is stored already; of floats, 0 may be -0."""
    return ops._replace(depth_write=0) if ops.depth_func == gl.GL_EQUAL and ops.depth_largest else ops


def keeps_depth_and_stencil(front: FragmentOps, back: FragmentOps) -> bool:
    """Return whether fragments change neither depth nor stencil, and are likely those of a surface drawn before."""
    for ops in (front, back):
        keeps_stencil = ops.write_mask == 0 or (ops.sfail, ops.zfail, ops.zpass) == (gl.GL_KEEP,) * 3
        if not keeps_stencil or ops.depth_write or ops.depth_func not in (gl.GL_EQUAL, gl.GL_LEQUAL):
            return False
    return True
