"""Blended draws without overlaps leave the bits of the ordered path."""

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from draws import ADDING, MIXING, draw, same_window, surface_blended_twice, vertices
from softshadow import pipeline
from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.pipeline import choose, explain_paths, use_short_cuts


@pytest.fixture(autouse=True)
def _not_forward(monkeypatch):
    monkeypatch.setattr(choose, "segment_state", lambda *arguments: None)  # which the fixed function would take


@given(
    st.integers(0, 2**32 - 1),
    st.sampled_from([gl.GL_EQUAL, gl.GL_LEQUAL]),
    st.sampled_from([ADDING, MIXING]),
    st.booleans(),
    st.sampled_from(["mesa", "exact"]),
)
def test_draws_without_overlaps_are_blended_as_in_order(seed, func, blending, overlapping, precision):
    window = surface_blended_twice(seed, func, blending, overlapping, precision)
    with use_short_cuts(False):
        assert same_window(window, surface_blended_twice(seed, func, blending, overlapping, precision))


@given(
    st.integers(0, 2**32 - 1),
    st.sampled_from([gl.GL_EQUAL, gl.GL_LEQUAL, gl.GL_LESS]),
    st.sampled_from([ADDING, MIXING]),
    st.sampled_from(["mesa", "exact"]),
)
def test_triangles_drawn_one_by_one_are_blended_as_in_order(seed, func, blending, precision):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(pipeline, "ONE_BY_ONE", 0)
        window = surface_blended_twice(seed, func, blending, True, precision)
    with use_short_cuts(False):
        assert same_window(window, surface_blended_twice(seed, func, blending, True, precision))


def test_large_triangles_are_drawn_one_by_one():
    context = Context(128, 128, "d24")
    square = [[-1, -1, 0, 1], [1, -1, 0, 1], [1, 1, 0, 1], [-1, -1, 0, 1], [1, 1, 0, 1], [-1, 1, 0, 1]]
    blending = replace(context.state, blend=MIXING)
    with explain_paths() as paths:
        draw(context, blending, vertices(2 * square))
        draw(context, blending, vertices([[x / 2, y, z, w] for x, y, z, w in 2 * square]))
    assert [path.way for path in paths] == ["opaque", "in order"]
    assert "large triangles are drawn one by one: none overlaps itself" in paths[0].reasons


def test_light_added_onto_a_surface_is_drawn_as_opaque():
    context = Context(8, 8, "d24")
    depth = replace(context.state.depth, enabled=True)
    square = vertices([[-1, -1, 0, 1], [1, -1, 0, 1], [1, 1, 0, 1], [-1, -1, 0, 1], [1, 1, 0, 1], [-1, 1, 0, 1]])
    draw(context, replace(context.state, depth=depth), square)
    added_light = replace(context.state, depth=replace(depth, func=gl.GL_EQUAL, write=False), blend=ADDING)
    # cut along the other diagonal: these triangles are those of no surface that is known
    other = [[-1, -1, 0, 1], [1, -1, 0, 1], [-1, 1, 0, 1], [1, -1, 0, 1], [1, 1, 0, 1], [-1, 1, 0, 1]]
    twice = vertices([*other, *other])
    with explain_paths() as paths:
        draw(context, added_light, square)
        draw(context, added_light, twice)
    assert [path.way for path in paths] == ["opaque", "in order"]
    assert "a dry run found overlapping fragments" in paths[1].reasons
