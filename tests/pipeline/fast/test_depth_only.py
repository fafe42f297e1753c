"""Draws without colours, in chunks of triangles, leave the bits of drawing all triangles at once."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from draws import draw, random_state, random_triangles, same_window, small_triangles
from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.pipeline import choose, set_threads, threads, use_short_cuts
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.fast import depth_only
from softshadow.pipeline.fast.depth_only import chunks_of, fill_in_blocks, window_mesh
from softshadow.pipeline.memory import threads as pool
from softshadow.pipeline.raster.coverage import extent
from softshadow.pipeline.raster.region import region_of
from softshadow.state import ClipPlanes

seeds = st.integers(0, 2**32 - 1)


def draw_without_colors(seed: int, depth_format: str) -> Context:
    """Return a window after draws of triangles, in and around the frustum, that change only depth and stencil."""
    rng = np.random.default_rng(seed)
    context = Context(48, 40, depth_format)
    plane = ClipPlanes((True,) + (False,) * 5, ((1.0, 0.3, 0.1, 0.2),) + ((0.0,) * 4,) * 5)
    plain = replace(context.state, depth=replace(context.state.depth, enabled=True, func=gl.GL_ALWAYS))
    for _ in range(2):
        state = plain if rng.random() < 0.5 else random_state(rng, plain)
        lighting = replace(state.lighting, shade_model=int(rng.choice([gl.GL_FLAT, gl.GL_SMOOTH])))
        planes = plane if rng.random() < 0.3 else plain.clip_planes
        color = replace(state.color, mask=(False,) * 4)
        state = replace(state, lighting=lighting, clip_planes=planes, color=color)
        mode = int(rng.choice([gl.GL_TRIANGLES, gl.GL_TRIANGLE_STRIP, gl.GL_QUADS, gl.GL_QUAD_STRIP]))
        draw(context, state, random_triangles(rng, 12), mode)
        draw(context, state, small_triangles(rng, 25), mode)
        inside = small_triangles(rng, 25)
        inside.position[:, :3] *= np.float32(0.4)
        draw(context, state, inside, mode)
    return context


def all_at_once(seed: int, depth_format: str) -> Context:
    with use_short_cuts(False):
        return draw_without_colors(seed, depth_format)


@given(seeds, st.sampled_from(["d24", "d32f"]), st.sampled_from([1, 3]), st.sampled_from([1, 7, 16]))
def test_chunks_leave_the_bits_of_all_triangles_at_once(seed, depth_format, n_threads, size):
    before = threads()
    expected = all_at_once(seed, depth_format)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(depth_only, "CHUNK_TRIANGLES", size)
        patch.setattr(pool, "PART_SIZE", 1 + size // 3)
        for name in ("WORTH_BANDS", "WORTH_BANDS_IN_TILES"):  # so that a small window is divided, too
            patch.setattr(choose, name, 0)
        set_threads(n_threads)
        try:
            assert same_window(draw_without_colors(seed, depth_format), expected)
        finally:
            set_threads(before)


@given(seeds, st.sampled_from(["d24", "d32f"]), st.sampled_from([1, 2, 3]))
def test_blocks_leave_the_bits_of_all_triangles_at_once(seed, depth_format, n_threads):
    expected, before = all_at_once(seed, depth_format), threads()
    with pytest.MonkeyPatch.context() as patch, use_short_cuts("always"):
        patch.setattr(depth_only, "MEASURED", 1 << 20)
        patch.setattr(depth_only, "WORTH_BLOCKS", 0)
        patch.setattr(depth_only, "PIXELS_PER_TRIANGLE", 1 << 20)
        patch.setattr(choose, "LAYERS", 1 << 20)  # so that layers do not need bands
        set_threads(n_threads)
        try:
            assert same_window(draw_without_colors(seed, depth_format), expected)
        finally:
            set_threads(before)


@pytest.mark.parametrize("func", [gl.GL_LESS, gl.GL_LEQUAL])
@pytest.mark.parametrize("seed", range(4))
def test_threads_share_blocks_where_the_nearest_depth_counts(monkeypatch, seed, func):
    shared: list[int] = []

    def spy(*arguments):
        shared.append(arguments[-1])
        fill_in_blocks(*arguments)

    def drawn() -> Context:
        rng, context = np.random.default_rng(seed), Context(70, 60, "d24")
        depth = replace(context.state.depth, enabled=True, func=func)
        state = replace(context.state, depth=depth, color=replace(context.state.color, mask=(False,) * 4))
        for _ in range(2):
            draw(context, state, random_triangles(rng, 80))
        return context

    monkeypatch.setattr(choose, "fill_in_blocks", spy)
    monkeypatch.setattr(depth_only, "MEASURED", 1 << 20)
    monkeypatch.setattr(depth_only, "WORTH_BLOCKS", 0)
    monkeypatch.setattr(depth_only, "PIXELS_PER_TRIANGLE", 1 << 20)
    monkeypatch.setattr(choose, "LAYERS", 1 << 40)
    before = threads()
    set_threads(2)
    try:
        with use_short_cuts("always"):
            result = drawn()
        with use_short_cuts(False):
            assert same_window(result, drawn())
    finally:
        set_threads(before)
    assert shared == [2, 2]


def test_draws_that_change_depths_alone_are_filled_in_blocks(monkeypatch):
    filled: list[int] = []
    monkeypatch.setattr(choose, "fill_in_blocks", lambda mesh, *rest: filled.append(len(mesh.clipped.triangles)))
    before = threads()
    set_threads(1)
    try:
        with use_short_cuts("always"):
            for seed in range(10):
                draw_without_colors(seed, "d24")
    finally:
        set_threads(before)
    assert len(filled) > 2


@pytest.mark.interpreted
@pytest.mark.parametrize("seed", range(2))
def test_interpreted_chunks_leave_the_same_bits(seed):
    assert same_window(draw_without_colors(seed, "d24"), all_at_once(seed, "d24"))


@given(seeds)
def test_a_chunk_has_the_rows_and_the_area_of_its_triangles(seed):
    context = draw_without_colors(seed, "d24")
    for command in context.frame.commands:
        if not isinstance(command, Draw):
            continue
        target_region = region_of(command.state, context.storage.window)
        for triangles, ranges, region, fragments in chunks_of(window_mesh(command, context.storage.window)):
            extents = [extent(triangles.corners, first, end) for first, end in ranges]
            assert fragments == sum(area for *_, area in extents) >> 8
            for first_row, end_row, *_ in extents:
                first_row, end_row = max(first_row, target_region.first_row), min(end_row, target_region.end_row)
                assert first_row >= end_row or region.first_row <= first_row < end_row <= region.end_row
