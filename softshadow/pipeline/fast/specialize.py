"""How the fill stage gets its state: closed over and compiled per state, or as an argument.

*Specialized*: a closure over the numbers that change the code; the compiler folds them away and vectorises the loop;
kept on disk per state. *Generic*: the state is an argument; nothing to compile, but slow. A state starts generic and is
specialized once it has drawn enough fragments to pay for the compilation, at once when its code is on disk already.
"""

import hashlib
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from softshadow.jit import cache_folder, inlined, kernel
from softshadow.pipeline.fast.hierarchical_z import order_independent
from softshadow.pipeline.fast.stencil_tiles import fill_in_tiles
from softshadow.pipeline.geometry.facing import BACK, EITHER, FRONT
from softshadow.pipeline.geometry.triangle_setup import Setup
from softshadow.pipeline.memory.threads import parts_of, share, threads
from softshadow.pipeline.raster.bins import ROWS_LOG2, Bins, sort_into_bands
from softshadow.pipeline.raster.fill import Planes, Region, count_triangle, fill_rows, fill_small, is_small
from softshadow.pipeline.raster.fragment_ops import FragmentOps
from softshadow.pipeline.raster.spans import LAST, DepthRange

PAYS_AFTER = 200_000_000  # fragments of one state; measured: the generic binding draws them in 1.5 s, what it takes
# to compile the state
WORTH = 1_000_000  # fragments from which sorting and the hand-over to other threads are small against the work
SMALL = 100  # fragments that take as long as a small triangle
WORTH_COUNTING = 200_000  # the same for draws that only count: the sides of volumes are long and thin
AT_A_TIME = 1 << 19  # triangles; bounds the memory of numbers where all of them meet all bands
SHARES = 4  # bands for each thread: what one is longer at than another, the others make up for
LAYERS = 4  # of fragments over each other, from which bands pay on one thread, too
VERDICT_COUNTS = 6  # one per verdict, and the number of stencil values that changed

_compiled: dict[tuple[int, ...], Callable[..., None]] = {}
_drawn: dict[tuple[int, ...], int] = {}
_policy: ContextVar[str] = ContextVar("policy", default="auto")  # each thread has its own


@contextmanager
def use_binding(policy: str) -> Iterator[None]:
    """Inside, draws use the "generic" binding, the "specialized" one, or "auto": what pays.

    Results are the same; for tests, `warmup` and the ledger.
    """
    before = _policy.set(policy)
    try:
        yield
    finally:
        _policy.reset(before)


@kernel
def generic(front, back, two_sided, writes_ids, counts, triangles, numbers, region, depth_range, planes):
    """Process all fragments of the triangles with these numbers, in this order: the state is an argument.

    It is `front`, and for back-facing triangles `back` where `two_sided` is 1. `counts` asks for the verdicts.
    """
    for n in range(numbers.shape[0]):
        t = int(numbers[n])
        ops = back if two_sided and not triangles.front[t] else front
        if counts:
            count_triangle(ops, triangles, t, region, depth_range, planes)
        fill_rows(
            ops, writes_ids, triangles.corners, triangles.depth, t, region, depth_range, planes.columns, planes.depth,
            planes.stencil, planes.ids,
        )  # fmt: skip


@inlined
def with_numbers(code, numbers):
    """Return the operations of `code` with the reference values and masks of `numbers`."""
    return FragmentOps(
        code.alpha_test, code.alpha_func, code.stencil_test, code.stencil_func, code.sfail, code.zfail, code.zpass,
        code.stencil_largest, code.depth_test, code.depth_func, code.depth_write, code.depth_largest,
        numbers.alpha_ref, numbers.ref, numbers.read_mask, numbers.write_mask,
    )  # fmt: skip


def specialize(front_code: FragmentOps, back_code: FragmentOps, two_sided: int, writes_ids: int) -> Callable[..., None]:
    """Return `generic` compiled for the code of one state; reference values and masks are still arguments."""
    if not two_sided:  # half the code

        @kernel
        def fill_one_sided(front, back, triangles, numbers, region, depth_range, planes):
            # taken out of the tuples once: for every triangle, counting the references would take as long as drawing it
            corners, z_planes, faces_front = triangles.corners, triangles.depth, triangles.front
            columns, depth, stencil, ids = planes.columns, planes.depth, planes.stencil, planes.ids
            ops, n = with_numbers(front_code, front), 0
            while n < numbers.shape[0]:
                n = fill_small(
                    ops, EITHER, writes_ids, corners, z_planes, faces_front, numbers, n, region, depth_range, depth,
                    stencil, ids,
                )  # fmt: skip
                if n < numbers.shape[0]:
                    t = int(numbers[n])
                    fill_rows(
                        ops, writes_ids, corners, z_planes, t, region, depth_range, columns, depth, stencil, ids
                    )  # fmt: skip
                    n += 1

        return fill_one_sided

    @kernel
    def fill_two_sided(front, back, triangles, numbers, region, depth_range, planes):
        corners, z_planes, faces_front = triangles.corners, triangles.depth, triangles.front
        columns, depth, stencil, ids = planes.columns, planes.depth, planes.stencil, planes.ids
        front_ops, back_ops, n = with_numbers(front_code, front), with_numbers(back_code, back), 0
        while n < numbers.shape[0]:
            n = fill_small(
                front_ops, FRONT, writes_ids, corners, z_planes, faces_front, numbers, n, region, depth_range, depth,
                stencil, ids,
            )  # fmt: skip
            n = fill_small(
                back_ops, BACK, writes_ids, corners, z_planes, faces_front, numbers, n, region, depth_range, depth,
                stencil, ids,
            )  # fmt: skip
            if n < numbers.shape[0] and not is_small(corners, np.uint64(numbers[n]), region, depth):
                t = int(numbers[n])
                if faces_front[t]:
                    fill_rows(
                        front_ops, writes_ids, corners, z_planes, t, region, depth_range, columns, depth, stencil, ids
                    )  # fmt: skip
                else:
                    fill_rows(
                        back_ops, writes_ids, corners, z_planes, t, region, depth_range, columns, depth, stencil, ids
                    )  # fmt: skip
                n += 1

    return fill_two_sided


def specialize_in_tiles(code: FragmentOps) -> Callable[..., None]:
    """Return `fill_in_tiles` compiled for the code of one state."""

    @kernel
    def fill(ops, facing, triangles, numbers, region, depth_range, planes):
        fill_in_tiles(with_numbers(code, ops), facing, triangles, numbers, region, depth_range, planes)

    return fill


def _marker(key: tuple[int, ...]) -> Path | None:
    """The empty file that says that a state's code is on disk."""
    folder = cache_folder()
    return folder / f"state-{hashlib.blake2b(repr(key).encode(), digest_size=8).hexdigest()}" if folder else None


def _pays(key: tuple[int, ...], fragments: int) -> bool:
    if _policy.get() != "auto":
        return _policy.get() == "specialized"
    _drawn[key] = _drawn.get(key, 0) + fragments
    marker = _marker(key)
    return _drawn[key] > PAYS_AFTER or (marker is not None and marker.exists())


def fill(
    front: FragmentOps,
    back: FragmentOps,
    triangles: Setup,
    fragments: int,
    region: Region,
    depth_range: DepthRange,
    depth: np.ndarray,
    stencil: np.ndarray,
    ids: np.ndarray | None = None,
    verdicts: np.ndarray | None = None,
    writes: int = LAST,
    runs: Sequence[tuple[int, int]] | None = None,
) -> None:
    """Process all fragments of the triangles inside the region, on the binding that pays and in bands where they pay.

    `fragments` is about how many there are (`coverage.extent`), `ids` and `verdicts` are those of `Planes`, `writes`
    is LAST or SOLE; verdicts are counted by the generic binding in one band. `runs` are the rows [first, end) of
    `triangles` to be drawn, without it all.
    """
    columns = np.arange(max(*depth.shape, region.right, region.end_row), dtype=triangles.depth.dtype)
    two_sided, writes_ids, counts = int(front != back), writes * (ids is not None), int(verdicts is not None)
    planes = Planes(
        columns,
        depth,
        stencil,
        np.empty((1, 1), np.int32) if ids is None else ids,
        np.zeros(VERDICT_COUNTS, np.int64) if verdicts is None else verdicts,
    )
    counting = (
        None if counts or writes_ids or not order_independent(front, back) else _bound_in_tiles(front, back, fragments)
    )
    bound = counting or _bound(front.code(), back.code(), two_sided, writes_ids, counts, fragments)

    def fill_part(numbers: np.ndarray, first_row: int, end_row: int) -> None:
        part = region._replace(first_row=first_row, end_row=end_row)
        rows = planes._replace(ids=planes.ids[first_row - region.first_row :]) if writes_ids else planes
        bound(front, back, triangles, numbers, part, depth_range, rows)

    drawn = len(triangles.ids) if runs is None else sum(end - first for first, end in runs)
    worth = fragments >= WORTH_COUNTING if counting else fragments + SMALL * drawn >= WORTH
    if counts or not worth or not _bands_pay(region, fragments):
        for first, end in [(0, len(triangles.ids))] if runs is None else runs:
            fill_part(np.arange(first, end, dtype=np.int32), region.first_row, region.end_row)
        return
    for parts in _chunks(len(triangles.ids)) if runs is None else [runs]:
        bins = sort_into_bands(triangles.corners, parts, region, _rows_log2(region, fragments))
        met = np.flatnonzero(np.diff(bins.starts)).tolist()

        def fill_band(n: int, bins: Bins = bins, met: list[int] = met) -> None:
            fill_part(bins.of(met[n]), *bins.rows_of(met[n], region))

        share(fill_band, len(met))


def _chunks(count: int) -> Iterator[list[tuple[int, int]]]:
    """Yield the parts of so many triangles that are sorted into bands at a time."""
    for begin in range(0, count, AT_A_TIME):
        yield [(begin + first, begin + end) for first, end in parts_of(min(AT_A_TIME, count - begin))]


def _bands_pay(region: Region, fragments: int) -> bool:
    """Return whether to sort the triangles into bands.

    For several threads, and for one where many layers lie on each other: the planes of a band stay in the cache while
    all of them are drawn.
    """
    return region.end_row - region.first_row > 1 << ROWS_LOG2 and (threads() > 1 or _has_layers(region, fragments))


def _has_layers(region: Region, fragments: int) -> bool:
    pixels = (region.right - region.left) * (region.end_row - region.first_row)
    return fragments > LAYERS * pixels


def _rows_log2(region: Region, fragments: int) -> int:
    """Return the binary logarithm of how many rows a band has: few bands where there is little to do in each."""
    if _has_layers(region, fragments):
        return ROWS_LOG2
    rows = int(region.end_row - region.first_row) // (SHARES * threads())
    return max(ROWS_LOG2, rows.bit_length() - 1)


def _bound(
    front: FragmentOps, back: FragmentOps, two_sided: int, writes_ids: int, counts: int, fragments: int
) -> Callable[..., None]:
    """Return the fill of a state, both codes: specialized where that pays and nothing is counted, else generic."""
    key = (*front, *back, two_sided, writes_ids)
    if not counts and _is_specialized(key, fragments, lambda: specialize(front, back, two_sided, writes_ids)):
        return _compiled[key]
    return lambda front, back, *rest: generic(front, back, two_sided, writes_ids, counts, *rest)


def _bound_in_tiles(front: FragmentOps, back: FragmentOps, fragments: int) -> Callable[..., None] | None:
    """Return the fill in tiles of a state that order_independent, specialized; None where that does not pay.

    What order_independent need not be done in drawing order: first all front-facing triangles, then the others. So both facings
    can use what was compiled for draws that cull the other one.
    """
    facings = ((front, FRONT), (back, BACK)) if front != back else ((front, EITHER),)
    fills = []
    for ops, facing in facings:
        code = ops.code()
        if not _is_specialized(tuple(code), fragments, partial(specialize_in_tiles, code)):
            return None
        fills.append((_compiled[tuple(code)], facing))

    def fill_facings(front: FragmentOps, back: FragmentOps, *rest: Any) -> None:
        for fill_facing, facing in fills:
            fill_facing(back if facing == BACK else front, facing, *rest)

    return fill_facings


def _is_specialized(key: tuple[int, ...], fragments: int, make: Callable[[], Callable[..., None]]) -> bool:
    """Return whether the code of a state is there, after making it where that pays."""
    if _policy.get() == "generic":
        return False
    if key not in _compiled and _pays(key, fragments):
        _compiled[key] = make()
        marker = _marker(key)
        if marker is not None:
            marker.touch()
    return key in _compiled
