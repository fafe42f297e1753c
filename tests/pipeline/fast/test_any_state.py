"""The textbook fill leaves the bits of all its variants: in vectors, in bands, interpreted, in order."""

import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from draws import draw, random_state, random_triangles, same_window, small_triangles, vertices
from softshadow import gl as gl_calls
from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.framebuffer import Attachment
from softshadow.image import FORMATS, PITCH, Image
from softshadow.pipeline import choose, set_threads, threads, use_short_cuts
from softshadow.pipeline.fast.any_state import any_state_kernel
from softshadow.pipeline.geometry.triangle_setup import MAX_SLOPE, Offset, set_up
from softshadow.pipeline.plan import Policy
from softshadow.pipeline.raster import fill
from softshadow.pipeline.raster.fill import FillKernel
from softshadow.pipeline.raster.fragment_ops import FragmentOps
from softshadow.pipeline.raster.spans import LAST, ONLY
from softshadow.pipeline.records import (
    NO_TRIANGLE,
    SEVERAL_TRIANGLES,
    DepthRange,
    FillBuffers,
    Region,
    Setup,
)  # fmt: skip
from softshadow.state import Cull

WIDTH, HEIGHT = 48, 40
FUNCS = range(gl.GL_NEVER, gl.GL_ALWAYS + 1)
OPS = (
    gl.GL_KEEP, gl.GL_ZERO, gl.GL_REPLACE, gl.GL_INCR, gl.GL_DECR, gl.GL_INVERT, gl.GL_INCR_WRAP, gl.GL_DECR_WRAP,
)  # fmt: skip
DEPTH_FORMATS = ["d16", "d24", "d32f", "d32"]
FRAMEBUFFER_FORMATS = {"d16": gl.GL_DEPTH_COMPONENT16, "d32": gl.GL_DEPTH_COMPONENT32}


def draw_at_random(seed: int, depth_format: str = "d24", precision: str = "mesa", ordered: bool = False) -> Context:
    """Return a window after a few random draws; `ordered` adds an alpha test that every fragment passes.

    "d16" and "d32" are otherwise depth formats of framebuffer objects only.
    """
    rng = np.random.default_rng(seed)
    context = Context(
        WIDTH, HEIGHT, "d24" if depth_format in FRAMEBUFFER_FORMATS else depth_format, precision=precision
    )
    if depth_format in FRAMEBUFFER_FORMATS:
        depth = Image.new(FORMATS[FRAMEBUFFER_FORMATS[depth_format]], WIDTH, HEIGHT)
        depth.cells[:] = rng.integers(0, depth.format.largest, depth.cells.shape, endpoint=True)
        context.storage.window.attachments[gl.GL_DEPTH_ATTACHMENT] = Attachment(depth)
    elif depth_format == "d32f":  # values that no draw leaves, but an upload does
        cells = context.storage.window.attachments[gl.GL_DEPTH_ATTACHMENT].image.cells
        cells[:] = rng.choice(np.float32([0, 0.5, 1, -1, 2, np.nan, np.inf, -np.inf]), cells.shape)
    for _ in range(3):
        state = random_state(rng, context.state)
        if ordered:
            state = replace(state, alpha=replace(state.alpha, enabled=True, func=gl.GL_GEQUAL, ref=0.0))
        else:
            state = replace(state, alpha=replace(state.alpha, enabled=False))
        draw(context, state, random_triangles(rng, 6))
        draw(context, state, small_triangles(rng, 12))
    return context


@given(st.integers(0, 2**32 - 1), st.sampled_from(DEPTH_FORMATS), st.sampled_from(["mesa", "exact"]))
def test_vectors_draw_what_the_textbook_draws(seed, depth_format, precision):
    with use_short_cuts(False):
        expected = draw_at_random(seed, depth_format, precision)
    assert same_window(draw_at_random(seed, depth_format, precision), expected)


def random_ops(rng: np.random.Generator, depth_largest: int) -> tuple[FragmentOps, FragmentOps]:
    """Return the operations of both facings, of any functions, operations, masks and number of stencil bits."""
    largest = 2 ** int(rng.integers(1, 9)) - 1
    tests_stencil, tests_depth = int(rng.random() < 0.7), int(rng.random() < 0.8)
    depth = (1, int(rng.choice(FUNCS)), int(rng.random() < 0.6)) if tests_depth else (0, gl.GL_ALWAYS, 0)

    def facing() -> FragmentOps:
        stencil = (int(rng.choice(FUNCS)), *(int(rng.choice(OPS)) for _ in range(3)), largest)
        numbers = tuple(int(rng.integers(0, largest, endpoint=True)) for _ in range(3))
        off = ((gl.GL_ALWAYS, gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP, 0), (0, 0, 0))
        stencil, numbers = (stencil, numbers) if tests_stencil else off
        fields: Any = (0, gl.GL_ALWAYS, tests_stencil, *stencil, *depth, depth_largest, 0, *numbers)
        return FragmentOps(*fields)

    front = facing()
    return front, facing() if rng.random() < 0.5 else front


def random_setup(rng: np.random.Generator, width: int, height: int, real: np.dtype) -> Setup:
    """Return triangles of a pixel to larger than the buffers, some with planes that are infinite or NaN."""
    window = np.ones((30, 3, 4), np.float32)
    extent = rng.choice([3.0, 12.0, 40.0, 100.0], (30, 1, 1))
    window[:, :, :2] = (
        rng.uniform(-9, [width + 9, height + 9], (30, 1, 2)) + rng.uniform(-0.5, 0.5, (30, 3, 2)) * extent
    )
    window[:, :, 2] = rng.uniform(-0.2, 1.2, (30, 3))
    corners = np.arange(90, dtype=np.int32).reshape(30, 3)
    offset = Offset(MAX_SLOPE, np.float32(0), np.float32(0), 1)
    setup = set_up(window.reshape(-1, 4), corners, Cull(), offset, bool(rng.integers(2)))
    depth = setup.depth.astype(real)
    odd = rng.random(depth.shape) < 0.03
    depth[odd] = rng.choice([np.nan, np.inf, -np.inf, 1e30, 0.0], int(odd.sum()))
    return setup._replace(depth=depth)


@given(st.integers(0, 2**32 - 1), st.sampled_from([0, 2**16 - 1, 2**24 - 1, 2**32 - 1]), st.booleans())
def test_vectors_leave_depth_stencil_and_ids_of_the_textbook(seed, depth_largest, exact):
    rng = np.random.default_rng(seed)
    stored = np.dtype(np.float64 if exact or depth_largest == 2**32 - 1 else np.float32)
    real = np.dtype(np.float64 if exact else np.float32)
    front, back = random_ops(rng, depth_largest)
    writes_ids = int(rng.choice([0, LAST, ONLY]))
    width, height = int(rng.choice([1, 31, 33, 64, 100])), int(rng.integers(1, 70))
    setup = random_setup(rng, width, height, real)
    pitches = [-(-width // PITCH) * PITCH + int(more) * PITCH for more in rng.integers(0, 2, 3)]
    depth = rng.random((height, pitches[0]))
    depth = (np.rint(depth * depth_largest) if depth_largest else depth).astype(stored)
    if not depth_largest:
        depth[rng.random(depth.shape) < 0.1] = np.nan
    stencil = rng.integers(0, max(front.stencil_largest, 1), (height, pitches[1]), np.uint8, endpoint=True)
    left, right = sorted(rng.integers(0, width, 2, endpoint=True).tolist()) if rng.random() < 0.5 else (0, width)
    first, end = sorted(rng.integers(0, height, 2, endpoint=True).tolist()) if rng.random() < 0.5 else (0, height)
    region = Region(left, right, first, end, int(rng.integers(2)))
    low, high = sorted(rng.random(2)) if rng.random() < 0.3 else (0, 1)
    depth_range = DepthRange(real.type(low), real.type(high))
    ids = rng.choice([NO_TRIANGLE, 3, SEVERAL_TRIANGLES], (max(end - first, 0), pitches[2])).astype(np.int32)

    def after(kernel: FillKernel) -> FillBuffers:
        cells = FillBuffers(np.arange(300, dtype=real), depth.copy(), stencil.copy(), ids.copy())
        fill.fill(kernel, front, back, setup, region, depth_range, cells, writes_ids=bool(writes_ids))
        return cells

    expected = after(fill.textbook_kernel(int(front != back), writes_ids, None))
    for actual, wanted in zip(after(any_state_kernel(writes_ids)), expected, strict=True):
        np.testing.assert_array_equal(actual, wanted)


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

    assert same_window(window(True), window(False))


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

    assert buffers(True) == buffers(False)


@given(st.integers(0, 2**32 - 1), st.sampled_from(["d24", "d32f", "d32"]))
def test_ordered_path_draws_what_the_opaque_path_draws(seed, depth_format):
    assert same_window(draw_at_random(seed, depth_format, ordered=True), draw_at_random(seed, depth_format))


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
from test_any_state import draw_at_random
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
