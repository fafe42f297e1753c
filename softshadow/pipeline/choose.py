"""Which way the triangles of a draw go, and why: every decision that depends on them.

What the state alone decides, `plan` has decided before. All ways leave the same buffers. `explain_paths` collects the
decisions.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from typing import NamedTuple

from softshadow.framebuffer import Framebuffer, Storage
from softshadow.image import Image
from softshadow.kernel_cache import KernelGroup
from softshadow.pipeline.commands import Draw, DrawDepths
from softshadow.pipeline.draw_path import begin_path
from softshadow.pipeline.geometry.geometry import process_geometry
from softshadow.pipeline.memory.threads import threads
from softshadow.pipeline.plan import Plan, short_cuts
from softshadow.pipeline.raster.bins import BAND_ROWS, rows_of_few_bands
from softshadow.pipeline.raster.fill import FillKernel, textbook_kernel
from softshadow.pipeline.raster.fragment_ops import FragmentOps
from softshadow.pipeline.raster.region import depth_range_of
from softshadow.pipeline.records import FragmentCounts, Geometry, Region, Spans
from softshadow.pipeline.shade.shading import shade_and_write
from softshadow.state import State

try:
    from softshadow.pipeline.fast.any_state import FILL_KERNELS, any_state_kernel
    from softshadow.pipeline.fast.batch.segments import Part
    from softshadow.pipeline.fast.depth_only import Chunk, chunks_of, fill_in_blocks, threads_of_blocks, window_mesh
    from softshadow.pipeline.fast.fixed_function_spans import SPAN_KERNELS, fixed_function_shader
    from softshadow.pipeline.fast.forward import draw_forward
    from softshadow.pipeline.fast.geometry_cache import cached_geometry
    from softshadow.pipeline.fast.hierarchical_z import only_counts, order_independent
    from softshadow.pipeline.fast.map_visibility_kernel import VISIBILITY_KERNEL, map_visibility_shader
    from softshadow.pipeline.fast.segment_tables import SegmentState, segment_state
    from softshadow.pipeline.fast.shadow_map_kernel import shadow_map_shader
    from softshadow.pipeline.fast.shown_depths import draw_shown_depths, shows_depths
    from softshadow.pipeline.fast.special_fragments import discards_some
    from softshadow.pipeline.fast.stencil_tiles import shared_tiles_kernel, tiles_kernel
    from softshadow.pipeline.fast.visibility_cache import FillInputs, is_repeated
except ModuleNotFoundError:  # the folder can be deleted, see `plan`
    pass

WORTH_BANDS = 1_000_000  # fragments from which one thread draws layers in bands: sorting is small against the work
WORTH_THREADS = 400_000  # fragments from which several threads share bands: these take some 800 us
SMALL_TRIANGLE = 100  # fragments that are filled in the time that a small triangle takes
WORTH_SHARING = 64  # triangles for each thread, from which threads share them in place of bands of rows
WORTH_BANDS_IN_TILES = 200_000  # the same for fills in tiles: the sides of volumes are long and thin
FEW_FRAGMENTS = 20_000  # opaque draws up to these are drawn triangle by triangle: finding their spans would cost more
TRIANGLES_OF_QUAD = 2
# fragments for each pixel of their region: from fewer on, most of the search for spans finds nothing; and pixels for
# each triangle: with fewer, the search takes less time than drawing the triangles one by one
SPARSE, SPACIOUS = 0.3, 12
# fragments of a triangle, and for each pixel of their region: such triangles have long spans, of which few are hidden
LARGE_TRIANGLE, FEW_LAYERS = 80, 1.3
# the same without textures, where shading a hidden span costs less than to find out that it is hidden
LARGE_PLAIN_TRIANGLE, FEW_PLAIN_LAYERS = 250, 3.0
# draws of so many triangles are cheaper to fill, shading each visible pixel once, than to draw triangle by triangle
MANY_TRIANGLES = 4096
ONE_BY_ONE = 8_000  # fragments of a triangle, from which a fill of its own takes less time than a list of fragments
LARGE_DRAW = 50_000  # fragments of a draw that counts as such when the kernels of the fixed function are to be compiled
SMALL_DRAW = 25  # what any other draw counts: ten thousand of them are some seconds, which compiling takes, too
LAYERS = 4  # of fragments over each other, from which bands pay on one thread, too


def choose_depths(command: DrawDepths, target: Framebuffer) -> Callable[..., None] | None:
    """Return the function that draws a rectangle of depths without triangles, or None."""
    if not short_cuts.get() or not shows_depths(command.draw, target):
        return None
    path = begin_path(command.draw.label, command.draw.mode)
    path.way, path.fill = "rectangle of depths", "texel by texel"
    return draw_shown_depths


def choose_geometry(plan: Plan, command: Draw, target: Framebuffer, storage: Storage) -> Geometry:
    """Return the triangles of a draw; with short cuts, those of an equal earlier draw if they are cached."""
    if (plan.counting and not plan.forward) or not short_cuts.get():
        return process_geometry(command, target, storage)
    geometry, was_cached = cached_geometry(command, target, storage)
    if was_cached:
        plan.path.note("an equal draw has set up its triangles before")
    return geometry


class FillChoice(NamedTuple):
    """The kernel that fills, how many rows a band has (0: no bands), and whether each thread has a band or two."""

    kernel: FillKernel
    band_rows: int
    are_few: bool = False


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
    if not short_cuts.get() or counts is not None:
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
    return FillChoice(kernel, _band_rows(region, n_fragments), not _has_layers(region, n_fragments))


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
    return region.end_row - region.first_row > BAND_ROWS and (threads() > 1 or _has_layers(region, fragments))


def _has_layers(region: Region, fragments: int) -> bool:
    return fragments > LAYERS * (region.right - region.left) * (region.end_row - region.first_row)


def _band_rows(region: Region, fragments: int) -> int:
    """Return how many rows a band has: few bands where each has little to do."""
    return BAND_ROWS if _has_layers(region, fragments) else rows_of_few_bands(region, fragments)


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

    It is for draws in order, for opaque ones of few fragments and triangles, and where finding visible spans would cost
    more than it saves: for a quad, few fragments in a large region, or large triangles that hide little of each other;
    but not if such a draw is made again and again. `fragments` is about how many they are; without a `storage`, only
    their number and that of the triangles decide.
    """
    n_triangles = len(geometry.triangles.ids)
    is_small = fragments <= FEW_FRAGMENTS and n_triangles < MANY_TRIANGLES
    is_small = is_small and short_cuts.get() != "always"  # which wants its fill to be compiled
    hides_little = storage is not None and _hides_little(geometry, fragments, region)
    must_test_in_order = plan.in_order or plan.counting
    if not plan.forward or not (must_test_in_order or is_small or (hides_little and short_cuts.get() is True)):
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


def _hides_little(geometry: Geometry, fragments: int, region: Region) -> bool:
    """Return whether finding the visible spans of an opaque draw would cost more than it saves."""
    pixels = (region.right - region.left) * (region.end_row - region.first_row) or 1
    layers = fragments / pixels
    n_triangles, is_textured = len(geometry.triangles.ids), bool(geometry.program.units)
    if n_triangles <= TRIANGLES_OF_QUAD or (layers < SPARSE and pixels >= SPACIOUS * n_triangles):
        return True
    if layers < FEW_LAYERS and fragments >= LARGE_TRIANGLE * n_triangles:
        return True
    return not is_textured and layers < FEW_PLAIN_LAYERS and fragments >= LARGE_PLAIN_TRIANGLE * n_triangles


def can_join_others(plan: Plan, part: Part) -> bool:
    """Return whether a segment may be drawn with others, as far as its fragments and triangles decide it."""
    most = sys.maxsize if plan.in_order and not plan.passing_spans else FEW_FRAGMENTS
    return plan.forward and 0 <= part.fragments <= most and part.end - part.first < MANY_TRIANGLES


def joins_others(plan: Plan, state: State, target: Framebuffer, part: Part) -> SegmentState | None:
    """Return the fragment state of a segment that is drawn with others (`fast.segment_groups`), or None.

    It is one of few fragments, or one that is drawn in order in any case.
    """
    if not can_join_others(plan, part):
        return None
    if state.polygon.upper_edges:  # those of a group have one rule for edges
        return None
    numbers = segment_state(state, plan.front, plan.back, target, part.batch, part.program.units, plan.numbers)
    if plan.counting and numbers is not None and discards_some(numbers.special):  # some that pass are left out later
        return None
    return numbers if SPAN_KERNELS.are_compiled() else None  # else a draw on its own pays for compiling them


def choose_shading(plan: Plan, state: State, target: Framebuffer, geometry: Geometry) -> Callable[[Spans], None]:
    """Return the function that shades spans of a draw without overlaps and writes their colours."""
    if short_cuts.get():
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


def shades_in_bands(plan: Plan, target: Framebuffer, geometry: Geometry) -> bool:
    """Return whether threads may shade the bands of a fill before all are filled: by kernels, from other textures."""
    units = geometry.program.units
    if threads() == 1 or not plan.forward or units is None or not SPAN_KERNELS.are_compiled():
        return False
    return not any(target.attaches(unit.texture.name) for unit in units)


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
    return kernels.pay_for(work, at_once=short_cuts.get() == "always")
