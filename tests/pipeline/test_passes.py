"""The same geometry under the same matrices has the same depth in every pass."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from draws import draw, random_state, random_triangles
from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.state import State

pytestmark = pytest.mark.interpreted


def nearest_only(state: State) -> State:
    """Return a state that draws the depth of the nearest surface, and nothing else."""
    depth = replace(state.depth, enabled=True, func=gl.GL_LESS, write=True, clamp=False)
    return replace(State(), viewport=state.viewport, depth=depth)


def marks_equal(state: State) -> State:
    """Return a state that counts the fragments of equal depth in the stencil buffer."""
    face = replace(state.stencil.front, zpass=gl.GL_INCR)
    depth = replace(state.depth, enabled=True, func=gl.GL_EQUAL, write=False, clamp=False)
    return replace(
        State(),
        viewport=state.viewport,
        depth=depth,
        stencil=replace(State().stencil, enabled=True, front=face, back=face),
    )


@given(st.integers(0, 2**32 - 1), st.sampled_from(["d24", "d32f"]), st.sampled_from(["mesa", "exact"]))
def test_equal_passes_where_a_surface_is_drawn_again(seed, depth_format, precision):
    rng = np.random.default_rng(seed)
    context = Context(40, 30, depth_format, precision=precision)
    triangles = random_triangles(rng, 5)
    draw(context, nearest_only(context.state), triangles)
    # another state, blending, flat shading: another path through the pipeline, the same depth
    second = marks_equal(context.state)
    second = replace(
        second,
        blend=replace(second.blend, enabled=bool(rng.integers(2)), dst_rgb=gl.GL_ONE),
        lighting=replace(second.lighting, shade_model=gl.GL_FLAT),
        color=replace(second.color, mask=(bool(rng.integers(2)),) * 4),
    )
    draw(context, second, triangles)
    window = context.storage.window
    assert window.depth is not None
    assert window.stencil is not None
    clear_value = window.depth.format.largest or 1.0
    covered = window.depth.view != clear_value
    assert (window.stencil.view[covered] >= 1).all()


@given(st.integers(0, 2**32 - 1), st.sampled_from(["d24", "d32f"]))
def test_less_never_passes_where_a_surface_is_drawn_again(seed, depth_format):
    rng = np.random.default_rng(seed)
    context = Context(40, 30, depth_format)
    triangles = random_triangles(rng, 5)
    draw(context, nearest_only(context.state), triangles)
    second = marks_equal(context.state)
    draw(context, replace(second, depth=replace(second.depth, func=gl.GL_LESS)), triangles)
    assert context.storage.window.stencil is not None
    assert not context.storage.window.stencil.view.any()


@given(st.integers(0, 2**32 - 1))
def test_a_fragment_changes_only_what_its_masks_allow(seed):
    rng = np.random.default_rng(seed)
    context = Context(40, 30)
    before = [a.image.copy() for a in context.storage.window.attachments.values()]
    state = random_state(rng, context.state)
    closed = replace(state.stencil.front, write_mask=0)
    state = replace(
        state,
        depth=replace(state.depth, write=False),
        stencil=replace(state.stencil, front=closed, back=closed),
        color=replace(state.color, mask=(False,) * 4),
    )
    draw(context, state, random_triangles(rng, 5))
    after = [a.image for a in context.storage.window.attachments.values()]
    assert all(now.same_as(then) for now, then in zip(after, before, strict=True))
