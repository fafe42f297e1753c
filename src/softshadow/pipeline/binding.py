"""How the fill stage gets its state: closed over and compiled per state, or as an argument.

*Specialised*: a closure over the numbers that change the code; the compiler folds them away and vectorises the loop;
kept on disk per state. *Generic*: the state is an argument; nothing to compile, but slow. A state starts generic and is
specialised once it has drawn enough fragments to pay for the compilation, at once when its code is on disk already.
"""

import hashlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path

import numpy as np

from softshadow.jit import cache_folder, inlined, kernel
from softshadow.pipeline.bands import share, threads
from softshadow.pipeline.bins import AT_A_TIME, ROWS, Bins, bands_of, sort_into_bands
from softshadow.pipeline.fill import Planes, Region, fill_triangles
from softshadow.pipeline.fill_tiles import BACK, EITHER, FRONT, fill_in_tiles
from softshadow.pipeline.fragment_ops import FragmentOps
from softshadow.pipeline.setup import Setup
from softshadow.pipeline.spans import LAST, DepthRange
from softshadow.pipeline.tiles import commutes

PAYS_AFTER = (
    40_000_000  # fragments of one state; measured: about 0.4 s of compilation at the speed of the generic binding
)
WORTH = 200_000  # fragments from which sorting and the hand-over to other threads are small against the work
LAYERS = 4  # of fragments over each other, from which bands pay on one thread, too
VERDICT_COUNTS = 6  # one per verdict, and the number of stencil values that changed

_compiled: dict[tuple[int, ...], Callable[..., None]] = {}
_drawn: dict[tuple[int, ...], int] = {}
_policy: ContextVar[str] = ContextVar("policy", default="auto")  # each thread has its own


@contextmanager
def use_binding(policy: str) -> Iterator[None]:
    """Inside, draws use the "generic" binding, the "specialised" one, or "auto": what pays.

    Results are the same; for tests, `warmup` and the ledger.
    """
    before = _policy.set(policy)
    try:
        yield
    finally:
        _policy.reset(before)


@kernel
def generic(front, back, two_sided, writes_ids, counts, triangles, numbers, region, depth_range, planes):
    """`fill_triangles` with the state as an argument."""
    fill_triangles(front, back, two_sided, writes_ids, counts, 0, triangles, numbers, region, depth_range, planes)


@kernel
def generic_in_tiles(ops, facing, triangles, numbers, region, depth_range, planes):
    """`fill_in_tiles` with the state as an argument."""
    fill_in_tiles(ops, facing, triangles, numbers, region, depth_range, planes)


@inlined
def with_numbers(code, numbers):
    """Return the operations of `code` with the reference values and masks of `numbers`."""
    return FragmentOps(
        code.alpha_test, code.alpha_func, code.stencil_test, code.stencil_func, code.sfail, code.zfail, code.zpass,
        code.stencil_largest, code.depth_test, code.depth_func, code.depth_write, code.depth_largest,
        numbers.alpha_ref, numbers.ref, numbers.read_mask, numbers.write_mask,
    )  # fmt: skip


def specialise(front_code: FragmentOps, back_code: FragmentOps, two_sided: int, writes_ids: int) -> Callable[..., None]:
    """Return `fill_triangles` compiled for the code of one state; reference values and masks are still arguments."""

    @kernel
    def fill(front, back, triangles, numbers, region, depth_range, planes):
        now_front, now_back = with_numbers(front_code, front), with_numbers(back_code, back)
        fill_triangles(
            now_front, now_back, two_sided, writes_ids, 0, 1, triangles, numbers, region, depth_range, planes
        )

    return fill


def specialise_in_tiles(code: FragmentOps) -> Callable[..., None]:
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
        return _policy.get() == "specialised"
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
) -> None:
    """Process all fragments of the triangles inside the region, on the binding that pays and in bands where they pay.

    `fragments` is about how many there are (`coverage.extent`), `ids` and `verdicts` are those of `Planes`, `writes`
    is LAST or SOLE; verdicts are counted by the generic binding in one band.
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
    in_tiles = not counts and not writes_ids and commutes(front, back)
    # updates that commute need not be in drawing order: first all front-facing triangles, then the others
    facings = ((front, FRONT), (back, BACK)) if two_sided else ((front, EITHER),)
    if in_tiles:
        fills = [_bound_in_tiles(ops.code(), fragments) for ops, _ in facings]
    else:
        fills = [_bound(front.code(), back.code(), two_sided, writes_ids, counts, fragments)]

    def fill_rows(numbers: np.ndarray, first_row: int, end_row: int) -> None:
        part = region._replace(first_row=first_row, end_row=end_row)
        rows = planes._replace(ids=planes.ids[first_row - region.first_row :]) if writes_ids else planes
        if in_tiles:
            for fill_facing, (ops, facing) in zip(fills, facings, strict=True):
                fill_facing(ops, facing, triangles, numbers, part, depth_range, rows)
        else:
            fills[0](front, back, triangles, numbers, part, depth_range, rows)

    if counts or not _bands_pay(region, fragments):
        fill_rows(np.arange(len(triangles.ids), dtype=np.int32), region.first_row, region.end_row)
        return
    for begin in range(0, len(triangles.ids), AT_A_TIME):
        bins = sort_into_bands(triangles.corners, begin, min(begin + AT_A_TIME, len(triangles.ids)), region)

        def fill_band(band: int, bins: Bins = bins) -> None:
            first = region.first_row + band * ROWS
            numbers = bins.of(band)
            if len(numbers):
                fill_rows(numbers, first, min(first + ROWS, region.end_row))

        share(fill_band, bands_of(region))


def _bands_pay(region: Region, fragments: int) -> bool:
    """Return whether to sort the triangles into bands.

    For several threads where there is enough to do, and for one where many layers lie on each other: the planes of a
    band stay in the cache while all of them are drawn.
    """
    if region.end_row - region.first_row <= ROWS or fragments < WORTH:
        return False
    pixels = (region.right - region.left) * (region.end_row - region.first_row)
    return threads() > 1 or fragments > LAYERS * pixels


def _bound(
    front: FragmentOps, back: FragmentOps, two_sided: int, writes_ids: int, counts: int, fragments: int
) -> Callable[..., None]:
    """Return the fill of a state, both codes: specialised where that pays and nothing is counted, else generic."""
    key = (*front, *back, two_sided, writes_ids)
    if not counts and _is_specialised(key, fragments, lambda: specialise(front, back, two_sided, writes_ids)):
        return _compiled[key]
    return lambda front, back, *rest: generic(front, back, two_sided, writes_ids, counts, *rest)


def _bound_in_tiles(code: FragmentOps, fragments: int) -> Callable[..., None]:
    """Return the fill in tiles of the code of one facing: specialised where that pays, else generic."""
    if _is_specialised(tuple(code), fragments, lambda: specialise_in_tiles(code)):
        return _compiled[tuple(code)]
    generic_fill: Callable[..., None] = generic_in_tiles
    return generic_fill


def _is_specialised(key: tuple[int, ...], fragments: int, make: Callable[[], Callable[..., None]]) -> bool:
    """Return whether the code of a state is there, after making it where that pays."""
    if _policy.get() == "generic":
        return False
    if key not in _compiled and _pays(key, fragments):
        _compiled[key] = make()
        marker = _marker(key)
        if marker is not None:
            marker.touch()
    return key in _compiled
