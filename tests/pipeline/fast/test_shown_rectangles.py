"""Rectangles that show texels as whole pixels, copied and tested without triangles, leave the bits of the textbook."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softshadow import gl
from softshadow.gl import pixel_rectangles
from softshadow.pipeline import explain_paths, use_short_cuts

SIZE = WIDTH, HEIGHT = 40, 30
SEEDS = st.integers(0, 2**32 - 1)
FUNCTIONS = (gl.GL_LESS, gl.GL_LEQUAL, gl.GL_GREATER, gl.GL_ALWAYS, gl.GL_NEVER, gl.GL_EQUAL, gl.GL_NOTEQUAL)
COLORS = (gl.GL_RGBA8, gl.GL_RGB8, gl.GL_RGBA32F, gl.GL_R8)
DEPTHS = (gl.GL_DEPTH24_STENCIL8, gl.GL_DEPTH32F_STENCIL8, gl.GL_DEPTH_COMPONENT16, gl.GL_DEPTH_COMPONENT32, None)


def picture(seed, plain=False, precision="mesa"):
    """Return the buffers and answers after some rectangles; `plain`: of colours, under scissor and mask alone."""
    rng = np.random.default_rng(seed)
    gl.create_context(*SIZE, precision=precision)
    if not plain and rng.random() < 0.4:
        _framebuffer_object(rng)
    gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1)
    _background(rng)
    answers = []
    for _ in range(6):
        (_scissor_and_mask if plain else _state)(rng)
        if rng.random() < 0.4:
            gl.glPixelZoom(*rng.choice([1, 1, -1, 2, -3, 16] if plain else [1, -1, 2, 0.7, -1.5, 17], 2))
        gl.glWindowPos3f(*rng.uniform(-0.4, 1, 2) * SIZE * (rng.random(2) < 0.9), rng.choice([0, 0.3, 1]))
        counts = not plain and rng.random() < 0.2
        if counts:
            gl.glBeginQuery(gl.GL_SAMPLES_PASSED, 1)
        (_colors if plain or rng.random() < 0.4 else _depths)(rng)
        if counts:
            gl.glEndQuery(gl.GL_SAMPLES_PASSED)
            answers.append(np.array(gl.glGetQueryObjectuiv(1, gl.GL_QUERY_RESULT)))
    whole = (0, 0, *SIZE)
    answers.append(gl.glReadPixels(*whole, gl.GL_RGBA, gl.GL_FLOAT))
    target = gl.current().objects.framebuffers[gl.current().state.draw_framebuffer]
    answers += [image.view.copy() for image in (target.depth, target.stencil) if image is not None]
    return answers


def _framebuffer_object(rng):
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
    depth = DEPTHS[rng.integers(len(DEPTHS))]
    points = [(gl.GL_COLOR_ATTACHMENT0, int(rng.choice(COLORS)))]
    if depth is not None:
        packed = depth in (gl.GL_DEPTH24_STENCIL8, gl.GL_DEPTH32F_STENCIL8)
        points.append((gl.GL_DEPTH_STENCIL_ATTACHMENT if packed else gl.GL_DEPTH_ATTACHMENT, depth))
    for point, internal in points:
        gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, renderbuffer := gl.glGenRenderbuffers(1))
        gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, internal, *SIZE)
        gl.glFramebufferRenderbuffer(gl.GL_FRAMEBUFFER, point, gl.GL_RENDERBUFFER, renderbuffer)


def _background(rng):
    gl.glClearColor(*rng.random(4))
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
    for _ in range(3):
        gl.glColor4f(*rng.random(4))
        gl.glRectf(*rng.uniform(-1, 1, 4))


def _scissor_and_mask(rng):
    (gl.glEnable if rng.random() < 0.4 else gl.glDisable)(gl.GL_SCISSOR_TEST)
    gl.glScissor(*rng.integers(0, 20, 2), *rng.integers(0, 30, 2))
    gl.glColorMask(*(rng.random(4) < 0.8 if rng.random() < 0.5 else (1, 1, 1, 1)))


def _state(rng):
    _scissor_and_mask(rng)
    for capability, chance in (
        (gl.GL_DEPTH_TEST, 0.6), (gl.GL_STENCIL_TEST, 0.3), (gl.GL_BLEND, 0.2), (gl.GL_ALPHA_TEST, 0.15),
        (gl.GL_FOG, 0.1), (gl.GL_COLOR_LOGIC_OP, 0.1), (gl.GL_DEPTH_CLAMP, 0.1), (gl.GL_COLOR_SUM, 0.1),
    ):  # fmt: skip
        (gl.glEnable if rng.random() < chance else gl.glDisable)(capability)
    gl.glDepthFunc(int(rng.choice(FUNCTIONS)))
    gl.glDepthMask(bool(rng.random() < 0.8))
    gl.glStencilFunc(int(rng.choice(FUNCTIONS)), int(rng.integers(0, 256)), int(rng.integers(0, 256)))
    gl.glStencilOp(gl.GL_INCR, gl.GL_INVERT, gl.GL_REPLACE)
    gl.glStencilMask(int(rng.choice([255, rng.integers(0, 256)])))
    if rng.random() < 0.3:
        gl.glStencilOpSeparate(gl.GL_BACK, gl.GL_KEEP, gl.GL_DECR, gl.GL_INCR_WRAP)
    gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
    gl.glAlphaFunc(gl.GL_GREATER, 0.5)
    gl.glColor4f(*rng.random(4))


def _colors(rng):
    width, height = (int(side) for side in rng.integers(1, 60, 2))
    if rng.random() < 0.3:
        gl.glCopyPixels(*rng.integers(-5, 20, 2), width, height, gl.GL_COLOR)
        return
    values = rng.uniform(-0.2, 1.2, (height, width, 4)).astype(np.float32)
    values[rng.random(values.shape) < 0.01] = rng.choice([np.nan, np.inf, -np.inf, 1e7, 9e6, 8e6, -0.0])
    numbers = rng.integers(0, 2**16, (height, width, 4), dtype=np.uint16)
    kinds = (
        (gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, numbers.astype(np.uint8)),
        (gl.GL_BGR, gl.GL_UNSIGNED_BYTE, numbers[..., :3].astype(np.uint8)),
        (gl.GL_LUMINANCE_ALPHA, gl.GL_UNSIGNED_SHORT, numbers[..., :2].copy()),
        (gl.GL_RGBA, gl.GL_FLOAT, values), (gl.GL_LUMINANCE, gl.GL_FLOAT, values[..., 0].copy()),
        (gl.GL_BGR, gl.GL_SHORT, numbers[..., :3].view(np.int16).copy()),
        (gl.GL_RGBA, gl.GL_UNSIGNED_INT_10_10_10_2, numbers.view(np.uint32)[..., 0].copy()),
    )  # fmt: skip
    gl.glDrawPixels(width, height, *kinds[rng.integers(len(kinds))])


def _depths(rng):
    width, height = (int(side) for side in rng.integers(1, 60, 2))
    kind = int(rng.choice([gl.GL_DEPTH_COMPONENT, gl.GL_STENCIL_INDEX, gl.GL_DEPTH_STENCIL]))
    target = gl.current().objects.framebuffers[gl.current().state.draw_framebuffer]
    if (kind != gl.GL_STENCIL_INDEX and not target.depth) or (kind != gl.GL_DEPTH_COMPONENT and not target.stencil):
        return
    if rng.random() < 0.3:
        copied = {gl.GL_DEPTH_COMPONENT: gl.GL_DEPTH, gl.GL_STENCIL_INDEX: gl.GL_STENCIL}.get(kind, kind)
        gl.glCopyPixels(*rng.integers(-5, 20, 2), width, height, copied)
    elif kind == gl.GL_DEPTH_STENCIL:
        words = rng.integers(0, 2**32, (height, width), dtype=np.uint32)
        gl.glDrawPixels(width, height, kind, gl.GL_UNSIGNED_INT_24_8, words)
    elif kind == gl.GL_STENCIL_INDEX:
        values = rng.integers(0, 256, (height, width), dtype=np.uint8)
        gl.glDrawPixels(width, height, kind, gl.GL_UNSIGNED_BYTE, values)
    else:
        values = rng.uniform(-0.1, 1.1, (height, width)).astype(np.float32)
        gl.glDrawPixels(width, height, kind, gl.GL_FLOAT, values)


def assert_same(*arguments, **options):
    with explain_paths() as paths:
        answers = picture(*arguments, **options)
    with use_short_cuts(False):
        expected = picture(*arguments, **options)
    for mine, theirs in zip(answers, expected, strict=True):
        assert mine.tobytes() == theirs.tobytes()
    return {path.fill for path in paths}


@given(SEEDS)
def test_plain_rectangles_of_colours_are_copied(seed):
    assert "rectangle" in {*assert_same(seed, plain=True), *assert_same(seed + 1, plain=True)}


@given(SEEDS, st.sampled_from(["mesa", "exact"]))
def test_rectangles_under_any_state_leave_the_bits_of_the_textbook(seed, precision):
    assert_same(seed, precision=precision)


def test_which_rectangles_of_depths_are_tested_texel_by_texel():
    fills = set()
    for seed in range(3):
        fills |= assert_same(seed)
    assert "texel by texel" in fills
    assert "texel by texel" not in assert_same(0, precision="exact")


@given(SEEDS)
def test_colours_that_are_rounded_before_the_draw_are_those_rounded_by_it(seed):
    early = picture(seed, plain=True)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(pixel_rectangles, "_writes_bytes", lambda context: False)
        late = picture(seed, plain=True)
    assert all(mine.tobytes() == theirs.tobytes() for mine, theirs in zip(early, late, strict=True))


def test_a_rectangle_read_from_its_own_buffer_is_that_of_before():
    gl.create_context(64, 32)
    framebuffer, texture = gl.glGenFramebuffers(1), gl.glGenTextures(1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
    image = np.random.default_rng(1).integers(0, 256, (32, 64, 4), dtype=np.uint8)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, 64, 32, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, image)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, framebuffer)
    gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, texture, 0)
    gl.glWindowPos2i(0, 3)
    gl.glCopyPixels(0, 0, 64, 29, gl.GL_COLOR)
    expected = np.concatenate([image[:3], image[:29]])
    assert (gl.glReadPixels(0, 0, 64, 32, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE) == expected).all()


def test_clients_may_change_pixels_after_the_draw():
    context = gl.create_context(*SIZE)
    pixels = np.full((HEIGHT, WIDTH, 4), 9, np.uint8)
    gl.glWindowPos2i(0, 0)
    gl.glDrawPixels(WIDTH, HEIGHT, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, pixels)
    pixels[:] = 7
    gl.glFinish()
    assert (gl.glReadPixels(0, 0, *SIZE, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE) == 9).all()
    assert all((command.cells == 9).all() for command in context.frame.commands if hasattr(command, "cells"))


@pytest.mark.interpreted
def test_the_interpreted_kernels_leave_the_bits_of_the_textbook():
    for seed in range(8):
        assert_same(seed)
