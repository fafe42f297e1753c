"""Which way a draw goes, and why: every decision between the textbook and its short cuts.

The textbook is in `geometry/`, `raster/` and `shade/`; the short cuts are in `fast/`. All ways leave the same buffers.
What the state decides is decided before the geometry (`plan_draw`); what depends on the triangles, after it
(`choose_fill`, `choose_shading`). `explain_paths` collects the decisions, `use_short_cuts` turns the short cuts off.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Literal, NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.framebuffer import Framebuffer, Storage
from softshadow.image import Image
from softshadow.kernel_cache import KernelGroup
from softshadow.pipeline.commands import Draw, DrawDepths
from softshadow.pipeline.draw_path import DrawPath, begin_path, is_explained
from softshadow.pipeline.geometry.geometry import process_geometry
from softshadow.pipeline.geometry.lines import LINES
from softshadow.pipeline.memory.threads import threads
from softshadow.pipeline.mesa.polygon_rules import has_special_fragments, passes_stages
from softshadow.pipeline.mesa.provoking_vertex import first_provokes
from softshadow.pipeline.raster.bins import BAND_ROWS_LOG2, few_bands
from softshadow.pipeline.raster.fill import FillKernel, textbook_kernel
from softshadow.pipeline.raster.fragment_ops import FragmentOps, fragment_ops
from softshadow.pipeline.raster.region import depth_range_of
from softshadow.pipeline.records import FragmentCounts, Geometry, Region, Spans
from softshadow.pipeline.shade.shading import shade_and_write
from softshadow.state import State

try:
    from softshadow.pipeline.fast.any_state import FILL_KERNELS, any_state_kernel
    from softshadow.pipeline.fast.batch.run import Run, can_begin_run
    from softshadow.pipeline.fast.batch.segments import Part
    from softshadow.pipeline.fast.depth_only import Chunk, chunks_of, fill_in_blocks, threads_of_blocks, window_mesh
    from softshadow.pipeline.fast.drawn_surfaces import (
        Watch,
        leaves_nearest,
        only_lessens_depths,
        passing_spans,
        remember_surface,
    )
    from softshadow.pipeline.fast.fixed_function_spans import SPAN_KERNELS, fixed_function_shader
    from softshadow.pipeline.fast.forward import draw_forward
    from softshadow.pipeline.fast.geometry_cache import cached_geometry
    from softshadow.pipeline.fast.hierarchical_z import only_counts, order_independent
    from softshadow.pipeline.fast.map_visibility_kernel import VISIBILITY_KERNEL, map_visibility_shader
    from softshadow.pipeline.fast.segment_tables import SegmentState, segment_state
    from softshadow.pipeline.fast.shadow_map_kernel import shadow_map_shader
    from softshadow.pipeline.fast.shown_depths import draw_shown_depths, shows_depths
    from softshadow.pipeline.fast.shown_rectangles import is_shown, show_rectangle
    from softshadow.pipeline.fast.special_fragments import discards_some
    from softshadow.pipeline.fast.stencil_tiles import shared_tiles_kernel, tiles_kernel
    from softshadow.pipeline.fast.unordered_blend import triangles_without_overlaps
    from softshadow.pipeline.fast.visibility_cache import FillInputs, cached_fill, is_repeated

    SHORT_CUTS_EXIST = True
except ModuleNotFoundError:  # the folder can be deleted: the textbook draws everything
    SHORT_CUTS_EXIST = False

WORTH_BANDS = 1_000_000  # fragments from which one thread draws layers in bands: sorting is small against the work
WORTH_THREADS = 400_000  # fragments from which several threads share bands: these take some 800 us
SMALL_TRIANGLE = 100  # fragments that are filled in the time that a small triangle takes
WORTH_SHARING = 64  # triangles for each thread, from which threads share them in place of bands of rows
WORTH_BANDS_IN_TILES = 200_000  # the same for fills in tiles: the sides of volumes are long and thin
FEW_FRAGMENTS = 20_000  # opaque draws up to these are drawn triangle by triangle: finding their spans would cost more
TRIANGLES_OF_QUAD = 2
SPARSE = 0.3  # fragments for each pixel of their region: from fewer on, most of the search for spans finds nothing
# fragments of a triangle, and for each pixel of their region: such triangles have long spans, of which few are hidden
LARGE_TRIANGLE, FEW_LAYERS = 32, 1.3
# draws of so many triangles are cheaper to fill, shading each visible pixel once, than to draw triangle by triangle
MANY_TRIANGLES = 4096
LARGE_DRAW = 50_000  # fragments of a draw that counts as such when the kernels of the fixed function are to be compiled
SMALL_DRAW = 25  # what any other draw counts: ten thousand of them are some seconds, which compiling takes, too
LAYERS = 4  # of fragments over each other, from which bands pay on one thread, too

MOST_DRAWS = 4096  # of a run
MOST_VERTICES = 1 << 16  # of a run of several draws: more in one table gain nothing
LONG_DRAW = 1 << 14  # vertices from which a draw without colours goes in chunks (fast.depth_only)

Policy = bool | Literal["always"]
WithoutOverlaps = Callable[[Callable[[np.ndarray], None], Region, int], np.ndarray | None]

_short_cuts: ContextVar[Policy] = ContextVar("short_cuts", default=SHORT_CUTS_EXIST)  # each thread has its own


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
    token = _short_cuts.set(policy)
    try:
        yield
    finally:
        _short_cuts.reset(token)


class Plan(NamedTuple):
    """What the state decides about a draw.

    in_order: fragments are tested and written one by one; writes_color: colours may change; front, back: the
    per-fragment operations of each facing; counting: whether fragments are counted. The short cuts to take, or None:
    cached_fill looks for an equal fill, remember_surface keeps the visible spans, passing_spans looks for those of
    earlier draws, without_overlaps finds out whether blended fragments overlap; watch: begun before a draw that makes
    no depth larger; show_rectangle copies texels to pixels; in_chunks: whether some triangles are set up and filled at
    a time; forward: whether the draw may go triangle by triangle from coverage to pixels, for which `numbers` keeps
    what is computed from its state.
    """

    in_order: bool
    writes_color: bool
    front: FragmentOps
    back: FragmentOps
    path: DrawPath
    numbers: list[SegmentState]
    in_chunks: bool = False
    cached_fill: Callable[..., tuple[Spans, bool]] | None = None
    remember_surface: Callable[..., None] | None = None
    passing_spans: Callable[..., list[Spans] | None] | None = None
    without_overlaps: WithoutOverlaps | None = None
    watch: Callable[[Framebuffer, Storage], Watch] | None = None
    show_rectangle: Callable[[Draw, Framebuffer, Storage], None] | None = None
    forward: bool = False
    counting: bool = False


def plan_draw(command: Draw, target: Framebuffer, counts: FragmentCounts | None = None) -> Plan:
    """Return what the state decides about a draw; with `counts`, its fragments are counted: each is processed once."""
    state, path = command.state, begin_path(command.label, command.mode)
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
    if not _short_cuts.get():
        path.note("short cuts are off")
        return plan
    if counts is not None:
        if not counts.only_passed or is_special or tests_alpha(state):
            path.note("fragments are counted: no short cut")
            return plan
        path.note("fragments that pass are counted: they are tested in drawing order")
        return plan._replace(forward=True, watch=Watch if only_lessens_depths(front, back) else None)
    if is_special:  # its fragments are not those of its triangles, which surfaces drawn before are compared by
        return plan._replace(forward=True)
    if not in_order and writes_color and is_shown(command, target, front):
        path.fill, path.shading = "rectangle", "copy of the texels"
        path.note("each pixel shows its texel, and only the scissor box tests it")
        return plan._replace(show_rectangle=show_rectangle)
    plan = plan._replace(watch=Watch if only_lessens_depths(front, back) else None)
    if in_order:
        if writes_color and not tests_alpha(state) and keeps_depth_and_stencil(front, back):
            plan = plan._replace(without_overlaps=triangles_without_overlaps, passing_spans=passing_spans)
        return plan._replace(forward=True)
    if writes_no_colors(command, target):
        path.way, path.reasons = "depth and stencil only, in chunks", ["no colour is written or tested"]
        return plan._replace(in_chunks=True)
    if writes_color:
        remembers = remember_surface if leaves_nearest(front, back) else None
        return plan._replace(cached_fill=cached_fill, remember_surface=remembers, forward=True)
    return plan


def choose_depths(command: DrawDepths, target: Framebuffer) -> Callable[..., None] | None:
    """Return the function that draws a rectangle of depths without triangles, or None."""
    if not _short_cuts.get() or not shows_depths(command.draw, target):
        return None
    path = begin_path(command.draw.label, command.draw.mode)
    path.way, path.fill = "rectangle of depths", "texel by texel"
    return draw_shown_depths


def may_wait(command: Draw) -> bool:
    """Return whether a draw may wait: short cuts are on, and nobody asks how draws went.

    Rectangles that are copied do not wait: what follows is most often another one, which needs their texture.
    """
    return _short_cuts.get() is True and not is_explained() and command.shown_at is None


def begin_run(command: Draw, target: Framebuffer, storage: Storage) -> Run | None:
    """Return a run of draws that begins with this one: they wait, and are processed together. None: it cannot.

    Only draws that cannot fail wait, and of those without colours only short ones (`fast.depth_only`).
    """
    if not can_begin_run(command, target):
        return None
    colorless = writes_no_colors(command, target) and not tests_alpha(command.state)
    if colorless and len(command.vertices.position) >= LONG_DRAW:
        return None
    return Run(command, storage, not colorless)


def choose_geometry(plan: Plan, command: Draw, target: Framebuffer, storage: Storage) -> Geometry:
    """Return the triangles of a draw; with short cuts, those of an equal earlier draw if they are cached."""
    if (plan.counting and not plan.forward) or not _short_cuts.get():
        return process_geometry(command, target, storage)
    geometry, was_cached = cached_geometry(command, target, storage)
    if was_cached:
        plan.path.note("an equal draw has set up its triangles before")
    return geometry


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


def keeps_depth_and_stencil(front: FragmentOps, back: FragmentOps) -> bool:
    """Return whether fragments change neither depth nor stencil, and are likely those of a surface drawn before."""
    for ops in (front, back):
        keeps_stencil = ops.write_mask == 0 or (ops.sfail, ops.zfail, ops.zpass) == (gl.GL_KEEP,) * 3
        if not keeps_stencil or ops.depth_write or ops.depth_func not in (gl.GL_EQUAL, gl.GL_LEQUAL):
            return False
    return True


class FillChoice(NamedTuple):
    """The kernel that fills, and the binary logarithm of how many rows a band has (0: no bands)."""

    kernel: FillKernel
    band_rows_log2: int


def choose_fill(
    plan: Plan,
    n_triangles: int,
    n_fragments: int,
    region: Region,
    *,
    writes_ids: int = 0,
    counts: FragmentCounts | None = None,
    depth: Image | None = None,
    ties: list[int] | None = None,
) -> FillChoice:
    """Return how to fill triangles with about so many fragments.

    Parameters
    ----------
    writes_ids : 0, LAST or ONLY
    counts : receives the number of fragments by verdict, where they are counted
    depth : the depth buffer, which keeps its tile bounds
    ties : receives numbers, if a fragment has the depth that is stored, or could have it
    """
    front, back, path = plan.front, plan.back, plan.path
    in_tiles, work = False, n_fragments + SMALL_TRIANGLE * n_triangles
    if not _short_cuts.get() or counts is not None:
        path.fill, kernel = "textbook", textbook_kernel(int(front != back), writes_ids, counts)
    elif not _pays(FILL_KERNELS, work):
        path.fill, kernel = "textbook", textbook_kernel(int(front != back), writes_ids, None)
        path.note("too few fragments were filled so far to compile faster kernels")
    elif not writes_ids and order_independent(front, back):
        path.fill, kernel, in_tiles = "stencil tiles", tiles_kernel(depth), True
        path.note("only the stencil buffer changes, in an order that does not matter")
    else:
        path.fill, kernel = "vectors", any_state_kernel(writes_ids, ties)
    if ties is not None and path.fill != "vectors":
        ties.append(1)
    if in_tiles:
        bands_pay = n_fragments >= WORTH_BANDS_IN_TILES
        if bands_pay and threads() > 1 and _shares_triangles(front, back, n_triangles, n_fragments):
            path.fill += ", triangles shared"
            return FillChoice(shared_tiles_kernel(depth), 0)
    else:
        bands_pay = work >= (WORTH_BANDS if threads() == 1 else WORTH_THREADS)
    if counts is not None or not bands_pay or not _bands_pay(region, n_fragments):
        return FillChoice(kernel, 0)
    path.fill += " in bands"
    return FillChoice(kernel, _band_rows_log2(region, n_fragments))


def _shares_triangles(front: FragmentOps, back: FragmentOps, n_triangles: int, n_fragments: int) -> bool:
    """Return whether threads share the triangles of a fill in tiles: they are many, and of few fragments each.

    In bands of rows, a triangle is set up again in each band that it meets; but rows stay in the cache.
    """
    is_many = n_triangles >= WORTH_SHARING * threads() and n_fragments < FEW_FRAGMENTS * n_triangles
    return is_many and only_counts(front, back)


def _bands_pay(region: Region, fragments: int) -> bool:
    """Return whether to sort the triangles into bands of rows.

    They pay for several threads, and for one where many layers lie on each other: the rows of a band stay in the cache
    while all layers are drawn.
    """
    return region.end_row - region.first_row > 1 << BAND_ROWS_LOG2 and (threads() > 1 or _has_layers(region, fragments))


def _has_layers(region: Region, fragments: int) -> bool:
    return fragments > LAYERS * (region.right - region.left) * (region.end_row - region.first_row)


def _band_rows_log2(region: Region, fragments: int) -> int:
    """Return the binary logarithm of how many rows a band has: few bands where each has little to do."""
    return BAND_ROWS_LOG2 if _has_layers(region, fragments) else few_bands(region)


def fill_colorless(plan: Plan, command: Draw, target: Framebuffer, storage: Storage) -> Iterator[Chunk]:
    """Yield the triangles of a draw without colours in chunks to fill; fill them here where blocks of them pay.

    Blocks are for triangles without many layers: `FillChoice` has bands for those.
    """
    front, back = plan.front, plan.back
    tests_stencil, writes_depth = front.stencil_test or back.stencil_test, front.depth_write or back.depth_write
    # those that count front faces, and then back faces, in the stencil buffer are drawn twice
    mesh = window_mesh(command, target, storage if tests_stencil else None)
    if mesh.region.first_row >= mesh.region.end_row:
        return
    fragments, depth = mesh.fragments(), target.depth
    n_threads = threads_of_blocks(mesh, front, back)
    in_blocks = n_threads and writes_depth and not tests_stencil and mesh.units is None
    if depth is None or not in_blocks or _has_layers(mesh.region, fragments):
        yield from chunks_of(mesh)
    elif not _pays(FILL_KERNELS, fragments + SMALL_TRIANGLE * len(mesh.clipped.triangles)):
        yield from chunks_of(mesh)
    else:
        plan.path.fill = "vectors"
        depth_range = depth_range_of(command.state, mesh.window.dtype.type)
        fill_in_blocks(mesh, front, back, depth_range, depth.cells, n_threads)


def choose_forward(
    plan: Plan,
    state: State,
    target: Framebuffer,
    geometry: Geometry,
    region: Region,
    fragments: int,
    storage: Storage | None = None,
) -> Callable[[], int] | None:
    """Return the function that draws triangle by triangle from coverage to pixels, or None where another way is taken.

    It returns how many fragments have passed the tests before shading.

    It is for draws in order, for opaque ones of few fragments, and where finding visible spans would cost more than it
    saves: for a quad, few fragments in a large region, or large triangles that hide little of each other; but not if
    such a draw is made again and again. `fragments` is about how many they are; without a `storage`, only their number
    decides.
    """
    is_small = fragments <= FEW_FRAGMENTS and _short_cuts.get() != "always"  # which wants its fill to be compiled
    hides_little = storage is not None and _hides_little(len(geometry.triangles.ids), fragments, region)
    must_test_in_order = plan.in_order or plan.counting
    if not plan.forward or not (must_test_in_order or is_small or (hides_little and _short_cuts.get() is True)):
        return None
    numbers = segment_state(state, plan.front, plan.back, target, geometry, geometry.program.units, plan.numbers)
    if numbers is None or not _are_compiled(fragments):
        return None
    if plan.counting and discards_some(numbers.special):  # of those that pass the tests, some are left out later
        return None
    if not (must_test_in_order or is_small):
        assert storage is not None
        depth_range = depth_range_of(state, geometry.window.dtype.type)
        if is_repeated(FillInputs(plan.front, plan.back, geometry.triangles, region, depth_range), target, storage):
            return None
    plan.path.fill, plan.path.shading = "span by span", "fixed-function kernel"
    return lambda: draw_forward(numbers, state, target, geometry, region, fragments)


def _hides_little(n_triangles: int, fragments: int, region: Region) -> bool:
    """Return whether finding the visible spans of an opaque draw would cost more than it saves."""
    layers = fragments / ((region.right - region.left) * (region.end_row - region.first_row) or 1)
    is_coarse = fragments >= LARGE_TRIANGLE * n_triangles and layers < FEW_LAYERS
    return n_triangles <= TRIANGLES_OF_QUAD or layers < SPARSE or is_coarse


def joins_others(plan: Plan, state: State, target: Framebuffer, part: Part) -> SegmentState | None:
    """Return the fragment state of a small segment that is drawn with others (`fast.segment_groups`), or None."""
    is_small = 0 <= part.fragments <= FEW_FRAGMENTS and part.end - part.first < MANY_TRIANGLES
    if not plan.forward or not is_small:
        return None
    numbers = segment_state(state, plan.front, plan.back, target, part.batch, part.program.units, plan.numbers)
    if plan.counting and numbers is not None and discards_some(numbers.special):  # some that pass are left out later
        return None
    return numbers if SPAN_KERNELS.are_compiled() else None  # else a draw on its own pays for compiling them


def choose_shading(plan: Plan, state: State, target: Framebuffer, geometry: Geometry) -> Callable[[Spans], None]:
    """Return the function that shades spans of a draw without overlaps and writes their colours."""
    if _short_cuts.get():
        shader = shadow_map_shader(state, target, geometry)
        if shader is not None:
            plan.path.shading = "shadow-map kernel"
            plan.path.note("plain depth map and one buffer of bytes without blending")
            return shader
        visibility = map_visibility_shader(state, target, geometry)
        if visibility is not None:
            return lambda spans: _shade_visibility(visibility, plan, state, target, geometry, spans)
        fixed = fixed_function_shader(state, target, geometry)
        if fixed is not None:
            return lambda spans: _shade_fixed_function(fixed, plan, state, target, geometry, spans)
    plan.path.shading = "program"
    return lambda spans: shade_and_write(state, target, geometry, spans, ordered=False)


def _shade_visibility(
    shader: Callable[[Spans], None], plan: Plan, state: State, target: Framebuffer, geometry: Geometry, spans: Spans
) -> None:
    """Shade with the kernel of the visibility in a map, or with the program until compiling it pays."""
    if _pays(VISIBILITY_KERNEL, spans.fragments):
        plan.path.shading = "map-visibility kernel"
        plan.path.note("a single comparison with a plain depth map, and one buffer of floats without blending")
        shader(spans)
        return
    plan.path.shading = "program"
    plan.path.note("too few comparisons with maps were made so far to compile their kernel")
    shade_and_write(state, target, geometry, spans, ordered=False)


def _shade_fixed_function(
    shader: Callable[[Spans], None], plan: Plan, state: State, target: Framebuffer, geometry: Geometry, spans: Spans
) -> None:
    """Shade with the kernels of the fixed function, or with the program until compiling them pays."""
    if _are_compiled(spans.fragments):
        plan.path.shading = "fixed-function kernel"
        plan.path.note("fixed function with four textures at most, and one buffer of bytes")
        shader(spans)
        return
    plan.path.shading = "program"
    plan.path.note("the fixed function has not shaded enough fragments to compile its kernels")
    shade_and_write(state, target, geometry, spans, ordered=False)


def _are_compiled(fragments: int) -> bool:
    """Return whether to shade with the kernels of the fixed function: they are compiled, or compiling them pays now."""
    return _pays(SPAN_KERNELS, fragments if fragments >= LARGE_DRAW else SMALL_DRAW)


def _pays(kernels: KernelGroup, work: int) -> bool:
    """Return whether to use kernels for so much work: they are compiled, compiling them pays now, or is asked for."""
    return kernels.pay_for(work, at_once=_short_cuts.get() == "always")
