"""Stencil-only draws filled by tiles leave the bits of the fill that processes every fragment."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softshadow import tokens as gl
from softshadow.pipeline import choose, set_threads, threads, use_short_cuts
from softshadow.pipeline.choose import Plan, choose_fill
from softshadow.pipeline.draw_path import DrawPath
from softshadow.pipeline.fast import stencil_tiles
from softshadow.pipeline.fast.fragment_numbers import update_of, updated
from softshadow.pipeline.fast.hierarchical_z import (
    FAIL,
    MIXED,
    PASS,
    decide,
    find_bounds,
    only_counts,
    order_independent,
)  # fmt: skip
from softshadow.pipeline.geometry.triangle_setup import MAX_SLOPE, Offset, set_up
from softshadow.pipeline.raster import fill as fill_stage
from softshadow.pipeline.raster.coverage import bounds, row_span, row_spans
from softshadow.pipeline.raster.fill import fill, fill_buffers
from softshadow.pipeline.raster.fragment_ops import FragmentOps, compare, stencil_op
from softshadow.pipeline.records import DepthRange, Region, Setup
from softshadow.state import Cull

WIDTH, PITCH, HEIGHT = 150, 160, 70  # some whole tiles of 64 x 16, and some cut at the borders
FUNCS = range(gl.GL_NEVER, gl.GL_ALWAYS + 1)
OPS = (
    gl.GL_KEEP, gl.GL_ZERO, gl.GL_REPLACE, gl.GL_INCR, gl.GL_DECR, gl.GL_INVERT, gl.GL_INCR_WRAP, gl.GL_DECR_WRAP,
)  # fmt: skip
LARGEST = {"d16": 2**16 - 1, "d24": 2**24 - 1, "d32": 2**32 - 1, "d32f": 0, "exact": 2**24 - 1}
seeds = st.integers(0, 2**32 - 1)


def order_independent_state(rng: np.random.Generator, depth_format: str) -> tuple[FragmentOps, FragmentOps]:
    """Return two order-independent facings, mostly with the usual pair of increment and decrement."""
    bits = int(rng.integers(1, 9))
    largest = 2**bits - 1
    op = int(rng.choice(OPS))
    choices = [gl.GL_KEEP, gl.GL_INCR_WRAP, gl.GL_DECR_WRAP] if rng.random() < 0.6 else [gl.GL_KEEP, op]
    depth = (int(rng.random() < 0.9), int(rng.choice(FUNCS)), 0, LARGEST[depth_format])
    ref = int(rng.integers(0, largest + 1))

    def facing() -> FragmentOps:
        fail, zfail, zpass = (int(rng.choice(choices)) for _ in range(3))
        read_mask = int(rng.integers(0, largest + 1))
        return FragmentOps(
            0, gl.GL_ALWAYS, 1, gl.GL_ALWAYS, fail, zfail, zpass, largest, *depth, 0, ref, read_mask, largest
        )

    front = facing()
    return front, facing() if rng.random() < 0.5 else front


def large_and_small(rng: np.random.Generator, n: int, downwards: bool) -> tuple[Setup, np.ndarray]:
    """Return triangles smaller than a pixel to larger than the window, some slivers, some of constant depth."""
    extent = rng.choice([2.0, 20.0, 200.0, 1000.0], (n, 1, 1))
    window = np.ones((n, 3, 4), np.float32)
    center = rng.uniform(-20, [WIDTH + 20, HEIGHT + 20], (n, 2))[:, None]
    window[:, :, :2] = center + rng.uniform(-0.5, 0.5, (n, 3, 2)) * extent
    slivers = rng.random(n) < 0.2
    window[slivers, 2, :2] = (window[slivers, 0, :2] + window[slivers, 1, :2]) / 2 + rng.uniform(-1, 1, 2)
    on_samples = rng.random(n) < 0.3
    window[on_samples, :, :2] = np.rint(window[on_samples, :, :2]) + 0.5
    window[:, :, 2] = rng.uniform(0, 1, (n, 1)) + rng.uniform(-0.5, 0.5, (n, 3)) * rng.choice([0, 0.05, 1])
    corners = np.arange(3 * n, dtype=np.int32).reshape(n, 3)
    offset = Offset(MAX_SLOPE, np.float32(0), np.float32(0), 1)
    return set_up(window.reshape(-1, 4), corners, Cull(), offset, downwards), window


def buffers(rng: np.random.Generator, depth_format: str, stencil_largest: int) -> tuple[np.ndarray, np.ndarray]:
    """Return a depth buffer with a slope, a step and some noise, and a buffer of random stencil values."""
    row, column = np.mgrid[:HEIGHT, :PITCH]
    z = rng.uniform(0, 1) + rng.uniform(-0.5, 0.5) * row / HEIGHT + rng.uniform(-0.5, 0.5) * column / PITCH
    z[:, int(rng.integers(WIDTH)) :] = rng.choice([0.0, 0.5, 1.0])
    z = np.clip(z + rng.uniform(0, 1, z.shape) * (rng.random(z.shape) < rng.choice([0, 0.001, 0.3])), 0, 1)
    largest = LARGEST[depth_format]
    z = np.rint(z * largest) if largest else z
    depth = z.astype(np.float64 if depth_format == "exact" else np.float32)
    if depth_format == "d32f":
        depth[rng.random(depth.shape) < rng.choice([0, 0.0005])] = rng.choice([np.nan, np.inf, -1.0])
    return depth, rng.integers(0, stencil_largest + 1, depth.shape, dtype=np.uint8)


def buffers_after(seed: int, depth_format: str) -> tuple[np.ndarray, np.ndarray]:
    """Return the buffers after an order-independent draw."""
    rng = np.random.default_rng(seed)
    front, back = order_independent_state(rng, depth_format)
    assert order_independent(front, back)
    downwards = int(rng.integers(2))
    triangles, _ = large_and_small(rng, 24, bool(downwards))
    if depth_format == "exact":
        triangles = triangles._replace(depth=triangles.depth.astype(np.float64))
    real = triangles.depth.dtype.type
    depth, stencil = buffers(rng, depth_format, front.stencil_largest)
    left, right = sorted(int(x) for x in rng.choice([0, 7, 64, 100, 128, WIDTH], 2, replace=False))
    first, end = sorted(int(y) for y in rng.choice([0, 5, 16, 40, HEIGHT], 2, replace=False))
    region = Region(left, right, first, end, downwards)
    plan = Plan(False, False, front, back, DrawPath("", gl.GL_TRIANGLES), [])
    choice = choose_fill(plan, len(triangles.ids), 10**6, region)
    depth_range, cells = DepthRange(real(0), real(1)), fill_buffers(depth, stencil, triangles.depth.dtype, region)
    with np.errstate(all="ignore"):  # as in pipeline.draw: interpreted bytes wrap with a warning
        fill(choice.kernel, front, back, triangles, region, depth_range, cells, band_rows=choice.band_rows)
    return depth, stencil


def buffers_of_the_textbook(seed: int, depth_format: str) -> tuple[np.ndarray, np.ndarray]:
    """Return the same, with every fragment processed in drawing order."""
    with use_short_cuts(False):
        return buffers_after(seed, depth_format)


def assert_same(actual: tuple[np.ndarray, np.ndarray], expected: tuple[np.ndarray, np.ndarray]) -> None:
    for a, b in zip(actual, expected, strict=True):
        np.testing.assert_array_equal(a, b)


@given(seeds, st.sampled_from(sorted(LARGEST)))
def test_tiles_leave_the_bits_of_the_textbook(seed, depth_format):
    assert_same(buffers_after(seed, depth_format), buffers_of_the_textbook(seed, depth_format))


@given(seeds)
def test_tiles_in_bands_leave_the_same_bits(seed):
    before = threads()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(fill_stage, "AT_A_TIME", 7)
        patch.setattr(choose, "WORTH_BANDS_IN_TILES", 0)
        try:
            set_threads(3)
            assert_same(buffers_after(seed, "d24"), buffers_of_the_textbook(seed, "d24"))
        finally:
            set_threads(before)


@given(seeds, st.sampled_from(sorted(LARGEST)))
def test_threads_that_share_the_triangles_leave_the_same_bits(seed, depth_format):
    before = threads()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(stencil_tiles, "SHARED_TRIANGLES", 3)
        patch.setattr(choose, "WORTH_BANDS_IN_TILES", 0)
        patch.setattr(choose, "_shares_triangles", lambda front, back, *_: only_counts(front, back))
        try:
            set_threads(3)
            assert_same(buffers_after(seed, depth_format), buffers_of_the_textbook(seed, depth_format))
        finally:
            set_threads(before)


@pytest.mark.parametrize("op", [gl.GL_INCR, gl.GL_DECR, gl.GL_INVERT, gl.GL_INCR_WRAP])
@pytest.mark.parametrize("n", [3, 4, 5, 300, 2**16 - 1, 2**16, 2**16 + 7])
def test_a_part_of_a_tile_is_updated_any_number_of_times(op, n):
    front = facing(zfail=gl.GL_KEEP, zpass=op, depth_func=gl.GL_LESS)
    window = np.ones((3, 4), np.float32)
    window[:, :3] = (3, 2, 0.5), (100, 9, 0.5), (5, 11, 0.5)
    one = set_up(
        window, np.arange(3, dtype=np.int32)[None], Cull(), Offset(MAX_SLOPE, np.float32(0), np.float32(0), 1), True
    )
    assert len(one.ids) == 1
    numbers, region = np.zeros(n, np.int32), Region(0, WIDTH, 0, HEIGHT, 1)
    before = np.full((HEIGHT, PITCH), 100, np.uint8)
    depth, stencil = np.ones((HEIGHT, PITCH), np.float32) * (2**24 - 1), before.copy()
    cells = fill_buffers(depth, stencil, one.depth.dtype, region)
    with np.errstate(all="ignore"):
        stencil_tiles.tiles_kernel()(
            front, front, one, numbers, region, DepthRange(np.float32(0), np.float32(1)), cells
        )
    covered = np.zeros(before.shape, bool)
    for row in range(*bounds(one.corners, 0)):
        covered[row, slice(*row_span(one.corners, 0, row, 1))] = True
    after = {
        gl.GL_INCR: min(100 + n, 255), gl.GL_DECR: max(100 - n, 0), gl.GL_INVERT: 155 if n % 2 else 100,
        gl.GL_INCR_WRAP: (100 + n) % 256,
    }  # fmt: skip
    np.testing.assert_array_equal(stencil, np.where(covered, after[op], before))


def test_many_small_triangles_are_shared_where_updates_are_sums():
    before, region = threads(), Region(0, 640, 0, 480, 1)
    try:
        set_threads(2)
        for front, n_triangles, shares in (
            (facing(), 10_000, True),
            (facing(), 100, False),
            (facing(zfail=gl.GL_INCR), 10_000, False),
        ):
            plan = Plan(False, False, front, front, DrawPath("", gl.GL_TRIANGLES), [])
            choose_fill(plan, n_triangles, 10**6, region)
            assert ("shared" in plan.path.fill) == shares
    finally:
        set_threads(before)


@pytest.mark.interpreted
@pytest.mark.parametrize("seed", range(2))
def test_interpreted_tiles_leave_the_same_bits(seed):
    assert_same(buffers_after(seed, "d24"), buffers_of_the_textbook(seed, "d24"))


def facing(**changes: int) -> FragmentOps:
    """Return the state that counts fragments failing the depth test, in 8 bits."""
    keep, up, always = gl.GL_KEEP, gl.GL_INCR_WRAP, gl.GL_ALWAYS
    ops = FragmentOps(0, always, 1, always, keep, up, keep, 255, 1, gl.GL_LESS, 0, 2**24 - 1, 0, 0, 255, 255)
    return ops._replace(**changes)


def test_counting_up_and_down_is_order_independent():
    assert order_independent(facing(), facing(zfail=gl.GL_DECR_WRAP))
    assert order_independent(facing(zfail=gl.GL_INCR), facing(zfail=gl.GL_INCR))


@pytest.mark.parametrize(
    "changes",
    [
        {"zfail": gl.GL_DECR},  # stops at 0: up, then down is not the same as down, then up
        {"zpass": gl.GL_INVERT},
        {"stencil_func": gl.GL_EQUAL},  # the value decides about the next fragment
        {"depth_write": 1},
        {"write_mask": 0x0F},
        {"alpha_test": 1},
    ],
)
def test_updates_that_depend_on_the_order_are_not_order_independent(changes):
    assert not order_independent(facing(), facing(**changes))


def test_replacing_by_two_references_is_not_order_independent():
    assert not order_independent(facing(zfail=gl.GL_REPLACE, ref=1), facing(zfail=gl.GL_REPLACE, ref=2))


@pytest.mark.interpreted
@given(st.sampled_from(OPS), st.integers(1, 8), st.integers(0, 600), st.integers(0, 255), st.integers(0, 255))
def test_n_updates_at_once_equal_n_single_updates(op, bits, n, s, ref):
    largest = np.uint8(2**bits - 1)
    s, ref = np.uint8(s) & largest, np.uint8(ref) & largest
    expected = s
    for _ in range(n):
        expected = np.uint8(stencil_op(op, expected, ref, largest))
    if n:
        with np.errstate(over="ignore"):  # interpreted, bytes that wrap round warn
            assert updated(update_of(op, n, ref, largest), s, largest) == expected


@pytest.mark.interpreted
@given(st.sampled_from(FUNCS), st.lists(st.integers(0, 3), min_size=4, max_size=4))
def test_a_decision_holds_for_every_pair_of_depths(func, values):
    low, high, stored_low, stored_high = *sorted(values[:2]), *sorted(values[2:])
    outcome = decide(func, low, high, stored_low, stored_high)
    passed = {compare(func, z, stored) for z in range(low, high + 1) for stored in range(stored_low, stored_high + 1)}
    assert outcome == (MIXED if len(passed) == 2 else PASS if True in passed else FAIL)


@pytest.mark.interpreted
def test_depth_bounds_are_those_of_the_tile_and_infinite_with_nan():
    depth = np.arange(100, dtype=np.float32).reshape(10, 10)
    scratch = np.empty((3, 64), np.float32)
    assert find_bounds(depth, 2, 5, 3, 7, scratch) == (23, 46)
    depth[3, 4] = np.nan
    assert find_bounds(depth, 2, 5, 3, 7, scratch) == (-np.inf, np.inf)


@pytest.mark.interpreted
@given(seeds, st.booleans(), st.sampled_from([8, 12, 20, 22, 24, 28]))
def test_row_spans_equal_row_span_in_every_row(seed, downwards, bits):
    rng = np.random.default_rng(seed)
    corners = large_and_small(rng, 8, downwards)[0].corners
    corners[::2] += rng.integers(-(1 << bits), 1 << bits, corners[::2].shape, dtype=np.int32)
    x, y = corners[:, 0::2].astype(np.int64), corners[:, 1::2].astype(np.int64)
    area = (x[:, 0] - x[:, 1]) * (y[:, 2] - y[:, 0]) - (x[:, 2] - x[:, 0]) * (y[:, 0] - y[:, 1])
    corners[area < 0] = corners[area < 0][:, [0, 1, 4, 5, 2, 3]]
    for t in range(len(corners)):
        first, end = bounds(corners, t)
        first, end = max(first, 3), min(end, HEIGHT)
        lefts, rights = np.empty(HEIGHT, np.int32), np.empty(HEIGHT, np.int32)
        row_spans(corners, t, first, end, int(downwards), 5, WIDTH, lefts, rights)
        for row in range(first, end):
            left, right = row_span(corners, t, row, int(downwards))
            left, right = max(left, 5), min(right, WIDTH)
            if left < right:
                assert (lefts[row], rights[row]) == (left, right)
            else:
                assert lefts[row] >= rights[row]
