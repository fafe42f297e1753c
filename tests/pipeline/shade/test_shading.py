"""Shading in chunks gives the same bits as shading all fragments at once."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from draws import ADDING, MIXING, same_window, surface_blended_twice
from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.image import FORMATS
from softshadow.pipeline import set_threads, threads
from softshadow.pipeline.shade import blend, color_writes, float_writes, shading


@given(st.integers(0, 2**32 - 1), st.sampled_from([gl.GL_LEQUAL, gl.GL_ALWAYS]), st.sampled_from([1, 3]))
def test_results_do_not_depend_on_chunks(seed, func, thread_count):
    at_once, before = surface_blended_twice(seed, func, MIXING, True), threads()
    try:
        set_threads(thread_count)
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(shading, "CHUNK", 37)
            assert same_window(at_once, surface_blended_twice(seed, func, MIXING, True))
    finally:
        set_threads(before)


@pytest.mark.interpreted
def test_bytes_are_added_as_the_blend_equation_adds_them():
    source, target = (a.astype(np.uint8).repeat(4, axis=1) for a in (np.arange(256)[:, None], np.arange(256)[:, None]))
    span = np.zeros(1, np.int32), np.zeros(1, np.int32), np.array([0, 256])
    state = blend.blend_ops(ADDING, Context(1, 1).storage.window.color.format)
    assert color_writes.is_additive(state)
    for shift in (0, 1, 2, 128, 255):
        expected, added = np.roll(target, shift, axis=0)[None].copy(), np.roll(target, shift, axis=0)[None].copy()
        color_writes.blend_bytes(state, *span, source, np.ones(4, bool), expected)
        color_writes.add_bytes(*span, source.reshape(-1), added.reshape(1, -1))
        assert np.array_equal(added, expected)


@pytest.mark.interpreted
@pytest.mark.parametrize("is_half", [False, True])
@pytest.mark.parametrize("source_factor", [gl.GL_ONE, gl.GL_SRC_ALPHA])
@pytest.mark.parametrize("target_factor", [gl.GL_ONE, gl.GL_ONE_MINUS_SRC_ALPHA])
def test_weighted_floats_are_added_as_the_blend_equation_adds_them(source_factor, target_factor, is_half):
    rng = np.random.default_rng(0)
    source, target = rng.normal(0, 3, (4, 300)).astype(np.float32), rng.normal(0, 3, (2, 200, 4)).astype(np.float32)
    target[0, :7, 0] = -0.0, np.inf, -np.inf, np.nan, 65504, 1e-6, 0.0
    target = float_writes.halves_of(target.reshape(1, -1)).reshape(target.shape) if is_half else target
    spans = np.array([0, 1, 1], np.int32), np.array([3, 0, 50], np.int32), np.array([0, 100, 200, 300])
    factors = {
        "src_rgb": source_factor,
        "src_alpha": source_factor,
        "dst_rgb": target_factor,
        "dst_alpha": target_factor,
    }
    state = blend.blend_ops(replace(ADDING, **factors), FORMATS[gl.GL_RGBA32F])
    assert float_writes.is_weighted_sum(state)
    weighs = source_factor != gl.GL_ONE, target_factor != gl.GL_ONE
    for mask in ([True] * 4, [True, False, True, False]):
        expected, added = target.copy(), target.copy()
        with np.errstate(all="ignore"):
            float_writes.blend_floats(state, *spans, source, np.array(mask), is_half, expected)
            float_writes.add_weighted(*spans, source, np.array(mask), *weighs, is_half, added)
        assert added.tobytes() == expected.tobytes()


@pytest.mark.parametrize(
    "changed",
    [
        {"src_rgb": gl.GL_DST_ALPHA}, {"dst_rgb": gl.GL_SRC_ALPHA}, {"src_alpha": gl.GL_SRC_ALPHA},
        {"dst_alpha": gl.GL_ONE_MINUS_SRC_ALPHA}, {"equation_rgb": gl.GL_FUNC_SUBTRACT}, {"equation_alpha": gl.GL_MAX},
    ],
)  # fmt: skip
def test_other_blending_is_no_weighted_sum(changed):
    assert float_writes.is_weighted_sum(blend.blend_ops(ADDING, FORMATS[gl.GL_RGBA32F]))
    assert not float_writes.is_weighted_sum(blend.blend_ops(replace(ADDING, **changed), FORMATS[gl.GL_RGBA32F]))
    assert not float_writes.is_weighted_sum(blend.blend_ops(ADDING, FORMATS[gl.GL_R32F]))
