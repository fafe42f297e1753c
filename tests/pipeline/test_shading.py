"""Shading in batches, and blended draws without overlaps: what is left does not tell how it was shaded."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from draws import draw, random_state, random_triangles, same_window, vertices
from softshadow import pipeline
from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.pipeline import set_threads, threads
from softshadow.pipeline.shade import blend, color_writes, shading
from softshadow.state import Blend

ADDING = Blend(enabled=True, src_rgb=gl.GL_ONE, dst_rgb=gl.GL_ONE, src_alpha=gl.GL_ONE, dst_alpha=gl.GL_ONE)
MIXING = replace(ADDING, src_rgb=gl.GL_SRC_ALPHA, dst_rgb=gl.GL_ONE_MINUS_SRC_ALPHA)


def added(seed, func, blending, overlapping, precision="mesa"):
    """A window after a surface, and after the same surface blended with it."""
    rng = np.random.default_rng(seed)
    context = Context(48, 40, "d24", precision=precision)
    state = replace(random_state(rng, context.state), alpha=replace(context.state.alpha, enabled=False))
    surface = replace(state, depth=replace(state.depth, enabled=True, func=gl.GL_LESS, write=True), blend=Blend())
    again = replace(state, depth=replace(state.depth, enabled=True, func=func, write=False), blend=blending)
    triangles = random_triangles(rng, 6)
    draw(context, surface, triangles)
    draw(context, again, triangles)
    if overlapping:
        draw(context, again, random_triangles(rng, 6))
    return context


@given(
    st.integers(0, 2**32 - 1),
    st.sampled_from([gl.GL_EQUAL, gl.GL_LEQUAL]),
    st.sampled_from([ADDING, MIXING]),
    st.booleans(),
    st.sampled_from(["mesa", "exact"]),
)
def test_draws_without_overlaps_blend_as_in_order(seed, func, blending, overlapping, precision):
    made = added(seed, func, blending, overlapping, precision)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(pipeline, "sole_fragments", lambda *_: None)
        assert same_window(made, added(seed, func, blending, overlapping, precision))


@given(st.integers(0, 2**32 - 1), st.sampled_from([gl.GL_LEQUAL, gl.GL_ALWAYS]), st.sampled_from([1, 3]))
def test_results_do_not_depend_on_batches(seed, func, thread_count):
    whole, before = added(seed, func, MIXING, True), threads()
    try:
        set_threads(thread_count)
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(shading, "CHUNK", 37)
            assert same_window(whole, added(seed, func, MIXING, True))
    finally:
        set_threads(before)


@pytest.mark.interpreted
def test_bytes_are_added_as_the_blend_equation_adds_them():
    source, target = (a.astype(np.uint8).repeat(4, axis=1) for a in (np.arange(256)[:, None], np.arange(256)[:, None]))
    run = np.zeros(1, np.int32), np.zeros(1, np.int32), np.array([0, 256])
    state = blend.blend_ops(ADDING, Context(1, 1).storage.window.color.format)
    assert color_writes.adds(state)
    for shift in (0, 1, 2, 128, 255):
        expected, found = np.roll(target, shift, axis=0)[None].copy(), np.roll(target, shift, axis=0)[None].copy()
        color_writes.blend_bytes(state, *run, source, np.ones(4, bool), expected)
        color_writes.add_bytes(*run, source.reshape(-1), found.reshape(1, -1))
        assert np.array_equal(found, expected)


def test_light_added_upon_a_surface_is_listed_pixel_by_pixel(monkeypatch):
    found = []
    original = pipeline.sole_fragments
    monkeypatch.setattr(pipeline, "sole_fragments", lambda *arguments: found.append(original(*arguments)))
    context = Context(8, 8, "d24")
    depth = replace(context.state.depth, enabled=True)
    square = vertices([[-1, -1, 0, 1], [1, -1, 0, 1], [1, 1, 0, 1], [-1, -1, 0, 1], [1, 1, 0, 1], [-1, 1, 0, 1]])
    draw(context, replace(context.state, depth=depth), square)
    again = replace(context.state, depth=replace(depth, func=gl.GL_EQUAL, write=False), blend=ADDING)
    draw(context, again, square)
    twice = vertices([*square.position, *square.position])
    draw(context, again, twice)
    assert found[0] is not None
    assert (found[0][:, :8] >= 0).all()
    assert found[1] is None
