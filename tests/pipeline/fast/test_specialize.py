"""The textbook fill leaves the bits of all its variants: compiled for a state, in bands, interpreted, in order."""

import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from combinations import with_quick
from draws import draw, random_state, random_triangles, same_window, small_triangles, vertices
from softshadow import gl as gl_calls
from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.framebuffer import Attachment
from softshadow.image import FORMATS, Image
from softshadow.pipeline import choose, set_threads, threads, use_short_cuts
from softshadow.pipeline.choose import Policy
from softshadow.pipeline.raster import fill

WIDTH, HEIGHT = 48, 40
# each compiles its own code, which takes seconds: a fixed sample, so that later sessions find it on disk
SPECIALIZED = with_quick([(seed, format) for seed in range(6) for format in ("d24", "d32f", "d32")], [0, 4])


def draw_at_random(seed: int, depth_format: str = "d24", precision: str = "mesa", ordered: bool = False) -> Context:
    """Return a window after a few random draws; `ordered` adds an alpha test that every fragment passes.

    "d32", 32-bit integers, is otherwise a depth format of framebuffer objects only.
    """
    rng = np.random.default_rng(seed)
    context = Context(WIDTH, HEIGHT, "d24" if depth_format == "d32" else depth_format, precision=precision)
    if depth_format == "d32":
        depth = Image.new(FORMATS[gl.GL_DEPTH_COMPONENT32], WIDTH, HEIGHT)
        depth.cells[:] = rng.integers(0, 1 << 32, depth.cells.shape)
        context.storage.window.attachments[gl.GL_DEPTH_ATTACHMENT] = Attachment(depth)
    for _ in range(3):
        state = random_state(rng, context.state)
        if ordered:
            state = replace(state, alpha=replace(state.alpha, enabled=True, func=gl.GL_GEQUAL, ref=0.0))
        else:
            state = replace(state, alpha=replace(state.alpha, enabled=False))
        draw(context, state, random_triangles(rng, 6))
        draw(context, state, small_triangles(rng, 12))
    return context


@pytest.mark.parametrize(("seed", "depth_format"), SPECIALIZED)
def test_specialized_draws_what_the_textbook_draws(seed, depth_format):
    with use_short_cuts(False):
        expected = draw_at_random(seed, depth_format)
    with use_short_cuts("always"):
        assert same_window(draw_at_random(seed, depth_format), expected)


@given(st.integers(0, 2**32 - 1), st.booleans(), st.sampled_from([0.5, 4.0, 9.0, 15.0, 64.0, 300.0]))
def test_small_triangles_at_the_end_of_the_buffers_are_drawn_as_by_the_textbook(seed, scissored, pixels):
    """In 128 columns, buffers have no padding after the last box; the stencil buffer shows pixels processed twice."""

    def window(policy: Policy) -> Context:
        rng, context = np.random.default_rng(seed), Context(128, 70)
        scissor = replace(context.state.scissor, enabled=scissored, x=5, y=3, width=120, height=60)
        depth = replace(context.state.depth, enabled=True, func=gl.GL_LEQUAL)
        counting = replace(context.state.stencil.front, zpass=gl.GL_INCR_WRAP)
        stencil = replace(context.state.stencil, enabled=True, front=counting, back=counting)
        state = replace(context.state, scissor=scissor, depth=depth, stencil=stencil)
        positions = np.ones((30, 3, 4), np.float32)
        positions[:, :, :3] = rng.uniform(-1, 1, (30, 1, 3))
        positions[:, :, :2] += rng.normal(0, pixels / 64, (30, 3, 2)) * rng.choice([0.1, 1.0], (30, 1, 2))
        with use_short_cuts(policy):
            draw(context, state, vertices(positions.reshape(-1, 4), rng.random((90, 4))))
        return context

    assert same_window(window("always"), window(False))


@pytest.mark.interpreted  # there an index beyond an array is an error
@pytest.mark.parametrize("depth_first", [False, True])
@pytest.mark.parametrize(("color_width", "depth_width"), [(30, 100), (100, 30), (64, 65)])
def test_attachments_of_different_widths_are_drawn_as_by_the_textbook(color_width, depth_width, depth_first):
    """Rows of the narrower one end within its padding, though chunks and strips go beyond the triangles."""
    rng = np.random.default_rng(color_width)
    shades = rng.uniform(-1, 1, (40, 1, 3)) + rng.normal(0, 1, (40, 3, 3)) * rng.choice([0.1, 0.4], (40, 1, 1))
    volumes = rng.uniform(-3, 3, (10, 3, 3))

    def buffers(policy: Policy) -> list[bytes]:
        width, height = min(color_width, depth_width), 9
        with use_short_cuts(policy), gl_calls.create_context(4, 4):
            gl_calls.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl_calls.glGenFramebuffers(1))
            attachments = [
                (gl.GL_COLOR_ATTACHMENT0, gl.GL_RGBA8, color_width, height),
                (gl.GL_DEPTH_STENCIL_ATTACHMENT, gl.GL_DEPTH24_STENCIL8, depth_width, height + 3),
            ]
            for point, *image in attachments[:: -1 if depth_first else 1]:
                name = gl_calls.glGenRenderbuffers(1)
                gl_calls.glBindRenderbuffer(gl.GL_RENDERBUFFER, name)
                gl_calls.glRenderbufferStorage(gl.GL_RENDERBUFFER, *image)
                gl_calls.glFramebufferRenderbuffer(gl.GL_FRAMEBUFFER, point, gl.GL_RENDERBUFFER, name)
            gl_calls.glViewport(0, 0, width, height)
            gl_calls.glClear(gl.GL_DEPTH_BUFFER_BIT)
            for capability in (gl.GL_DEPTH_TEST, gl.GL_STENCIL_TEST):
                gl_calls.glEnable(capability)
            gl_calls.glStencilOp(gl.GL_KEEP, gl.GL_INCR_WRAP, gl.GL_INCR_WRAP)
            for triangles, visible in ((shades, True), (volumes, False)):
                gl_calls.glColorMask(*[visible] * 4)
                gl_calls.glDepthMask(visible)
                gl_calls.glBegin(gl.GL_TRIANGLES)
                for corner in triangles.reshape(-1, 3):
                    gl_calls.glColor3d(*corner)
                    gl_calls.glVertex3d(*corner)
                gl_calls.glEnd()
            kinds = [
                (gl.GL_RGBA, gl.GL_UNSIGNED_BYTE), (gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT),
                (gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE),
            ]  # fmt: skip
            return [gl_calls.glReadPixels(0, 0, width, height, *kind).tobytes() for kind in kinds]

    assert buffers("always") == buffers(False)


@given(st.integers(0, 2**32 - 1), st.sampled_from(["d24", "d32f", "d32"]))
def test_ordered_path_draws_what_the_opaque_path_draws(seed, depth_format):
    assert same_window(draw_at_random(seed, depth_format, ordered=True), draw_at_random(seed, depth_format))


@pytest.mark.interpreted
@given(st.integers(0, 2**32 - 1), st.sampled_from([1, 5, fill.AT_A_TIME]))
def test_results_do_not_depend_on_the_number_of_threads_or_the_bands(seed, at_a_time):
    before = threads()
    with pytest.MonkeyPatch.context() as patch:
        set_threads(1)
        expected = draw_at_random(seed)
        for name in ("WORTH_BANDS", "WORTH_BANDS_IN_TILES"):  # so that a small window is divided, too
            patch.setattr(choose, name, 0)
        patch.setattr(fill, "AT_A_TIME", at_a_time)
        try:
            set_threads(3)
            assert same_window(draw_at_random(seed), expected)
            set_threads(1)
            patch.setattr(choose, "LAYERS", 0)
            assert same_window(draw_at_random(seed), expected)
        finally:
            set_threads(before)


DIGESTS = """
import hashlib, sys
sys.path[:0] = {path!r}
from test_specialize import draw_at_random
for seed in {seeds!r}:
    for depth_format, precision in (("d24", "mesa"), ("d32f", "mesa"), ("d32", "mesa"), ("d24", "exact")):
        window = draw_at_random(seed, depth_format, precision).storage.window
        print(hashlib.sha256(b"".join(a.image.view.tobytes() for a in window.attachments.values())).hexdigest())
"""


@pytest.mark.parametrize("seeds", [[0], pytest.param([1, 2, 3], marks=pytest.mark.slow)])
def test_interpreted_draws_what_compiled_draws(seeds):
    here = Path(__file__).parent
    code = DIGESTS.format(path=[str(here), str(here.parents[1])], seeds=seeds)
    digests = [
        subprocess.run(
            [sys.executable, "-c", code],
            env={**os.environ, "NUMBA_DISABLE_JIT": disabled},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for disabled in ("0", "1")
    ]
    assert digests[0] == digests[1]
    assert len(set(digests[0].split())) > 2 * len(seeds)  # the windows are not all empty


@pytest.mark.parametrize("bad", [0, -1, 1.5, True, "2"])
def test_set_threads_refuses_what_is_not_a_number_of_threads(bad):
    with pytest.raises(ValueError, match="number of threads"):
        set_threads(bad)
