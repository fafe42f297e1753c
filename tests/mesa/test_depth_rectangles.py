"""glDrawPixels and glCopyPixels of depths and stencil values give the buffers of Mesa."""

from typing import Any

import numpy as np
import pytest

from mesa.random_images import PIXEL_TYPES, client_pixels
from mesa.random_writer import Writer
from softshadow.testing import compare

pytestmark = pytest.mark.mesa

SIZE = WIDTH, HEIGHT = 30, 20
ZOOMS = [(1, 1), (2, 3), (-1, 1), (1.7, -2.3), (-0.3, 4.1)]
PACKED = np.random.default_rng(6).integers(0, 2**32, (HEIGHT, WIDTH), dtype=np.uint32)


def check(program: Any, size: tuple[int, int] = SIZE) -> None:
    """Compare the buffers and answers of a program with Mesa's."""
    comparison = compare(program, size)
    assert comparison, str(comparison)


def state(gl: Any, seed: int) -> None:
    """One of several states of the per-fragment operations, over buffers with different values everywhere."""
    gl.glClearColor(0.1, 0.2, 0.3, 0.4)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT)
    gl.glWindowPos2i(0, 0)
    gl.glDrawPixels(WIDTH, HEIGHT, gl.GL_DEPTH_STENCIL, gl.GL_UNSIGNED_INT_24_8, PACKED)
    gl.glColor4f(0.9, 0.5, 0.2, 0.6)
    if seed:
        gl.glEnable(gl.GL_DEPTH_TEST)
    if seed % 3 == 1:
        gl.glDepthFunc(gl.GL_GREATER)
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE)
    if seed % 3 == 2:
        for capability in (gl.GL_ALPHA_TEST, gl.GL_SCISSOR_TEST, gl.GL_STENCIL_TEST, gl.GL_CULL_FACE):
            gl.glEnable(capability)
        gl.glAlphaFunc(gl.GL_LESS, 0.3)
        gl.glScissor(2, 3, 20, 13)
        gl.glStencilFunc(gl.GL_LEQUAL, 90, 127)
        gl.glStencilOp(gl.GL_INVERT, gl.GL_INCR, gl.GL_REPLACE)
        gl.glStencilMask(0x7D)
        gl.glCullFace(gl.GL_FRONT_AND_BACK)
    if seed == 4:
        gl.glDepthMask(gl.GL_FALSE)


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("kind", sorted(PIXEL_TYPES))
def test_depths_of_every_type(kind, seed):
    pixels = client_pixels(Writer(np.random.default_rng(seed)), 11, 7, 1, kind)

    def program(gl):
        state(gl, seed)
        gl.glWindowPos3f(3, 4, 0.3)
        gl.glDrawPixels(11, 7, gl.GL_DEPTH_COMPONENT, getattr(gl, kind), pixels)

    check(program)


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("kind", sorted(PIXEL_TYPES))
def test_stencil_values_of_every_type(kind, seed):
    rng = np.random.default_rng(seed)
    pixels = rng.integers(0, 127 if kind == "GL_BYTE" else 255, (7, 11)).astype(PIXEL_TYPES[kind])

    def program(gl):
        state(gl, seed)
        gl.glWindowPos2i(3, 4)
        gl.glDrawPixels(11, 7, gl.GL_STENCIL_INDEX, getattr(gl, kind), pixels)

    check(program)


@pytest.mark.parametrize("zoom", ZOOMS)
@pytest.mark.parametrize("seed", range(5))
def test_zoomed_rectangles(zoom, seed):
    floats = np.zeros((5, 6), [("depth", np.float32), ("stencil", np.uint32)])
    floats["depth"], floats["stencil"] = np.linspace(-0.1, 1.1, 30).reshape(5, 6), np.arange(30).reshape(5, 6) * 8

    def program(gl):
        state(gl, seed)
        gl.glPixelZoom(*zoom)
        gl.glWindowPos2f(8.3, 6.8)
        gl.glDrawPixels(6, 5, gl.GL_DEPTH_STENCIL, gl.GL_UNSIGNED_INT_24_8, PACKED[:5, :6].copy())
        gl.glWindowPos2f(14.3, 9.8)
        gl.glDrawPixels(6, 5, gl.GL_DEPTH_STENCIL, gl.GL_FLOAT_32_UNSIGNED_INT_24_8_REV, floats)
        gl.glWindowPos2f(20, 7)
        gl.glDrawPixels(6, 5, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT, floats["depth"].copy())

    check(program)


@pytest.mark.parametrize("zoom", [(1, 1), (2, 2), (-1, 1), (1.7, -2.3)])
@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("kind", ["GL_DEPTH", "GL_STENCIL", "GL_DEPTH_STENCIL"])
def test_copies(kind, seed, zoom):
    def program(gl):
        rng = np.random.default_rng(seed)
        state(gl, seed)
        gl.glPixelZoom(*zoom)
        for rectangle in ((3, 4, 9, 6), (10, 12, 11, 6), (0, 0, 8, 9), (100, 0, 4, 4), (5, 5, 0, 3)):
            gl.glWindowPos2f(*rng.uniform(0, 19, 2))
            gl.glCopyPixels(*rectangle, getattr(gl, kind))

    check(program)


def test_queries_count_the_pixels_of_rectangles():
    words = PACKED[:4, :6].copy()

    def program(gl):
        gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
        gl.glEnable(gl.GL_DEPTH_TEST)
        counts = []
        for pixel_format, kind, pixels in (
            (gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, words.view(np.uint8).reshape(4, 6, 4)),
            (gl.GL_DEPTH_COMPONENT, gl.GL_UNSIGNED_INT, words),
            (gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE, words.astype(np.uint8)),
            (gl.GL_DEPTH_STENCIL, gl.GL_UNSIGNED_INT_24_8, words),
        ):
            query = gl.glGenQueries(1)
            gl.glBeginQuery(gl.GL_SAMPLES_PASSED, query)
            gl.glWindowPos3f(1, 1, 0.5)
            gl.glDrawPixels(6, 4, pixel_format, kind, pixels)
            gl.glEndQuery(gl.GL_SAMPLES_PASSED)
            counts.append(int(np.ravel(gl.glGetQueryObjectuiv(query, gl.GL_QUERY_RESULT))[0]))
        return [np.array(counts)]

    check(program)


def test_lists_and_missing_buffers():
    def program(gl):
        gl.glNewList(1, gl.GL_COMPILE)
        gl.glDrawPixels(11, 7, gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE, np.arange(77, dtype=np.uint8).reshape(7, 11))
        gl.glCopyPixels(0, 0, 3, 3, gl.GL_DEPTH_STENCIL)
        gl.glEndList()
        state(gl, 1)
        gl.glWindowPos2i(12, 2)
        gl.glCallList(1)
        texture, codes = gl.glGenTextures(1), []
        gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, 8, 8, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, None)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
        gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, texture, 0)
        for kind in ("GL_DEPTH_COMPONENT", "GL_STENCIL_INDEX"):
            try:
                gl.glDrawPixels(1, 1, getattr(gl, kind), gl.GL_UNSIGNED_BYTE, np.zeros((1, 1), np.uint8))
                codes.append(0)
            except gl.GLError as error:
                codes.append(int(error.err))
        for kind in ("GL_DEPTH", "GL_STENCIL", "GL_DEPTH_STENCIL", "GL_RGBA"):
            try:
                gl.glCopyPixels(0, 0, 1, 1, getattr(gl, kind))
                codes.append(0)
            except gl.GLError as error:
                codes.append(int(error.err))
        return [np.array(codes)]

    check(program)
