"""The visibility cache makes no difference to buffers, whatever happens between equal draws."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from draws import random_triangles
from softshadow import gl
from softshadow.context import Context
from softshadow.pipeline import choose, explain_paths, use_short_cuts
from softshadow.pipeline.commands import Vertices
from softshadow.pipeline.fast import visibility_cache
from softshadow.pipeline.fast.visibility_cache import clear_visibility_cache


@pytest.fixture(autouse=True)
def _no_small_draws(monkeypatch):
    """The fills of small draws are not cached: they go from their triangles to the pixels at once."""
    monkeypatch.setattr(choose, "FEW_FRAGMENTS", -1)


SIZE = 24  # of the window and the framebuffer object
DEPTH_TEXTURE, FRAMEBUFFER = 1, 1


def frame(seed: int, kinds: list[str], meshes: int = 2) -> tuple[Context, int]:
    """Return a context after calls of these kinds, and how many of its draws were only shaded.

    There are few meshes and few states, so that many draws are equal.
    """
    rng = np.random.default_rng(seed)
    context = gl.create_context(SIZE, SIZE)
    random_meshes = [random_mesh(context, rng) for _ in range(meshes)]
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
    new_depths(context, rng, random_meshes)
    make_framebuffer()
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
    with explain_paths() as paths:
        for kind in kinds:
            CALLS[kind](context, rng, random_meshes)
        gl.glFinish()
    return context, sum("an equal draw over the same depths was filled before: only shaded" in p.reasons for p in paths)


def make_framebuffer() -> None:
    """Create a framebuffer object with the bound depth texture and a colour renderbuffer."""
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
    for point in (gl.GL_DEPTH_ATTACHMENT, gl.GL_STENCIL_ATTACHMENT):
        gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, point, gl.GL_TEXTURE_2D, DEPTH_TEXTURE, 0)
    gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, gl.glGenRenderbuffers(1))
    gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, gl.GL_RGBA8, SIZE, SIZE)
    gl.glFramebufferRenderbuffer(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_RENDERBUFFER, 1)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)


def depths(rng) -> np.ndarray:
    """Return random depths and stencil values of the texture, packed."""
    return rng.integers(0, 1 << 32, (SIZE, SIZE), np.uint32)


def random_mesh(context: Context, rng) -> Vertices:
    mesh = random_triangles(rng, 4)
    position, color, normal = (context.frozen(rows) for rows in (mesh.position, mesh.color, mesh.normal))
    return Vertices(position, color, normal, ())


def draw(context, rng, meshes) -> None:
    mesh = meshes[rng.integers(len(meshes))]
    colors = context.frozen(rng.random(mesh.color.shape))  # equal visible triangles in other colours
    context.draw(gl.GL_TRIANGLES, mesh._replace(color=colors))


def clear(context, rng, meshes) -> None:
    gl.glClearDepth(float(rng.choice([1.0, 1.0, 0.5])))
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)


def clear_stencil(context, rng, meshes) -> None:
    gl.glClear(gl.GL_STENCIL_BUFFER_BIT)


def clear_box(context, rng, meshes) -> None:
    gl.glEnable(gl.GL_SCISSOR_TEST)
    gl.glScissor(3, 4, 9, int(rng.choice([8, 100])))
    gl.glClearDepth(float(rng.random()))
    gl.glClear(gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
    gl.glDisable(gl.GL_SCISSOR_TEST)


def draw_in_box(context, rng, meshes) -> None:
    gl.glEnable(gl.GL_SCISSOR_TEST)
    gl.glScissor(3, 4, int(rng.choice([9, 10])), 8)
    draw(context, rng, meshes)
    gl.glDisable(gl.GL_SCISSOR_TEST)


def draw_depth_only(context, rng, meshes) -> None:
    gl.glColorMask(False, False, False, False)
    gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
    gl.glPolygonOffset(float(rng.normal()), 0.0)
    draw(context, rng, meshes)
    gl.glDisable(gl.GL_POLYGON_OFFSET_FILL)
    gl.glColorMask(True, True, True, True)


def draw_without_writing_depth(context, rng, meshes) -> None:
    gl.glDepthMask(False)
    draw(context, rng, meshes)
    gl.glDepthMask(True)


def draw_with_offset(context, rng, meshes) -> None:
    gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
    gl.glPolygonOffset(float(rng.choice([0.0, 1.0])), 2.0)
    draw(context, rng, meshes)
    gl.glDisable(gl.GL_POLYGON_OFFSET_FILL)


def draw_counting_in_stencil(context, rng, meshes) -> None:
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilFunc(gl.GL_GEQUAL, int(rng.integers(3)), 255)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_INCR, gl.GL_INCR_WRAP)
    draw(context, rng, meshes)
    gl.glDisable(gl.GL_STENCIL_TEST)


def draw_without_depth_test(context, rng, meshes) -> None:
    gl.glDisable(gl.GL_DEPTH_TEST)
    draw(context, rng, meshes)
    gl.glEnable(gl.GL_DEPTH_TEST)


def draw_with_query(context, rng, meshes) -> None:
    query = gl.glGenQueries(1)
    gl.glBeginQuery(gl.GL_SAMPLES_PASSED, query)
    draw(context, rng, meshes)
    gl.glEndQuery(gl.GL_SAMPLES_PASSED)


def upload_depths(context, rng, meshes) -> None:
    gl.glTexSubImage2D(gl.GL_TEXTURE_2D, 0, 0, 0, SIZE, SIZE, gl.GL_DEPTH_STENCIL, gl.GL_UNSIGNED_INT_24_8, depths(rng))


def new_depths(context, rng, meshes) -> None:
    size, packed = (SIZE, SIZE), (gl.GL_DEPTH_STENCIL, gl.GL_UNSIGNED_INT_24_8)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_DEPTH24_STENCIL8, *size, 0, *packed, depths(rng))


def copy_depths(context, rng, meshes) -> None:
    gl.glCopyTexSubImage2D(gl.GL_TEXTURE_2D, 0, 2, 3, 1, 1, 12, 13)


def blit_depths(context, rng, meshes) -> None:
    gl.glBindFramebuffer(gl.GL_READ_FRAMEBUFFER, FRAMEBUFFER - context.state.draw_framebuffer)
    box = (0, 0, SIZE, SIZE)
    gl.glBlitFramebuffer(*box, *box, gl.GL_DEPTH_BUFFER_BIT, gl.GL_NEAREST)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, context.state.draw_framebuffer)


def other_framebuffer(context, rng, meshes) -> None:
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, FRAMEBUFFER - context.state.draw_framebuffer)


def read(context, rng, meshes) -> None:
    gl.glReadPixels(0, 0, SIZE, SIZE, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT)


def clear_cache(context, rng, meshes) -> None:
    clear_visibility_cache(context.storage)


CALLS = {
    call.__name__: call
    for call in (
        draw, clear, clear_stencil, clear_box, draw_in_box, draw_depth_only, draw_without_writing_depth,
        draw_with_offset, draw_counting_in_stencil, draw_without_depth_test, draw_with_query, upload_depths, new_depths,
        copy_depths, blit_depths, other_framebuffer, read, clear_cache,
    )
}  # fmt: skip
SAMPLES = ["clear", "draw", "draw"] * 8
KINDS = st.lists(st.sampled_from(["clear", "draw", "draw", "other_framebuffer", *CALLS]), min_size=6, max_size=40)


def buffers(context: Context) -> list:
    """Return all buffers of a context as bytes."""
    return [
        attachment.image.cells.tobytes()
        for target in context.storage.framebuffers.values()
        for attachment in target.attachments.values()
    ]


def assert_cache_makes_no_difference(seed: int, kinds: list[str], meshes: int = 2) -> None:
    cached, _ = frame(seed, kinds, meshes)
    with use_short_cuts(False):
        expected, _ = frame(seed, kinds, meshes)
    for ours, theirs in zip(buffers(cached), buffers(expected), strict=True):
        assert ours == theirs
    assert cached.storage.queries == expected.storage.queries


@given(st.integers(0, 2**32 - 1), KINDS)
def test_buffers_are_those_without_the_cache(seed, kinds):
    assert_cache_makes_no_difference(seed, kinds)


@pytest.mark.parametrize("other", [False, True])
@pytest.mark.parametrize("between", CALLS)
def test_no_call_between_equal_draws_makes_a_difference(between, other):
    changes = ["upload_depths"] * (not other)  # of the texture: copies of it always differ
    kinds = [*["clear", "draw"] * 2, *["clear", "draw", *changes, between, "draw"] * 3]
    assert_cache_makes_no_difference(3, ["other_framebuffer"] * other + kinds, meshes=1)


def test_equal_draws_over_cleared_depths_are_only_shaded():
    # of 8 pairs one is seen first, and one is cached over each of two depths that `clear` chooses from
    assert frame(3, SAMPLES, meshes=1)[1] == 10


@pytest.mark.parametrize("between", ["clear_box", "blit_depths", "draw_depth_only", "draw_counting_in_stencil"])
@pytest.mark.parametrize("other", [False, True])
def test_a_draw_over_depths_that_another_call_changed_is_filled(between, other):
    kinds = ["other_framebuffer"] * other + ["clear", "draw"] * 3
    hits = frame(3, [*kinds, "clear"], meshes=1)[1]
    assert hits == 1
    for harmless in ([], ["read"]):
        assert frame(3, [*kinds, "clear", *harmless, "draw"], meshes=1)[1] == hits + 1
    assert frame(3, [*kinds, "clear", between, "draw"], meshes=1)[1] == hits


@pytest.mark.parametrize("between", ["upload_depths", "new_depths", "copy_depths"])
def test_a_draw_over_new_depths_of_a_texture_is_filled(between):
    kinds = ["other_framebuffer", *["clear", "draw"] * 3]
    assert frame(3, [*kinds, "clear", between, "draw"], meshes=1)[1] == 1


def test_entries_evicted_without_a_hit_are_not_cached_again():
    gl.create_context(SIZE, SIZE)
    context, _ = frame(1, ["clear", "draw", "draw", "draw", "draw"] * 2)
    cache = context.storage.visibility_cache
    cache.entries.clear()
    rng = np.random.default_rng(5)
    mesh = random_mesh(context, rng)
    for _ in range(2):
        clear(context, rng, [])
        draw(context, rng, [mesh, mesh])
        context.finish()
    assert len(cache.entries) == 1
    clear_visibility_cache(context.storage)
    clear(context, rng, [])
    draw(context, rng, [mesh, mesh])
    context.finish()
    assert not cache.entries


def test_equal_draws_that_wait_together_are_only_shaded():
    context = gl.create_context(SIZE, SIZE)
    gl.glEnable(gl.GL_DEPTH_TEST)
    for _ in range(5):
        gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
        gl.glRectf(-0.5, -0.5, 0.5, 0.5)
        gl.glAccum(gl.GL_ACCUM, 0.2)
    gl.glFinish()
    (entry,) = context.storage.visibility_cache.entries.values()
    assert entry.hits == 3  # one was seen before, and one was cached


def test_a_draw_over_other_depths_each_time_is_cached_a_few_times():
    context = gl.create_context(SIZE, SIZE)
    gl.glEnable(gl.GL_DEPTH_TEST)
    for n in range(10):
        gl.glClearDepth(1 - n / 100)
        gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
        gl.glRectf(-0.5, -0.5, 0.5, 0.5)
        gl.glFinish()
    assert len(context.storage.visibility_cache.entries) == visibility_cache.MOST_MISSES


def test_the_cache_stays_within_its_bytes(monkeypatch):
    monkeypatch.setattr(visibility_cache, "CACHE_BYTES", 5000)
    context, _ = frame(4, ["clear", "draw", "draw", "draw_in_box", "draw_with_offset"] * 6)
    cache = context.storage.visibility_cache
    assert cache.bytes == sum(entry.bytes for entry in cache.entries.values()) <= 5000
