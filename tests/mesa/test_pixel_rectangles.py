"""glDrawPixels, glCopyPixels and glPixelZoom give the buffers of Mesa."""

import numpy as np
import pytest

from mesa.random_images import PIXEL_FORMATS, PIXEL_TYPES
from softshadow.testing import compare

pytestmark = pytest.mark.mesa


def check(program, size=(64, 48)):
    comparison = compare(program, size)
    assert comparison, str(comparison)


def state(gl, seed):
    """Some state of fragments, and of vertices that must not matter."""
    gl.glClearColor(0.1, 0.2, 0.3, 1)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
    gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1)
    gl.glRectf(-0.5, -0.5, 0.2, 0.3)
    if seed % 3 == 1:
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
        gl.glEnable(gl.GL_LIGHTING)
        gl.glRotatef(30, 1, 0, 0)
    if seed % 3 == 2:
        for capability in (gl.GL_ALPHA_TEST, gl.GL_SCISSOR_TEST, gl.GL_DEPTH_TEST, gl.GL_CULL_FACE):
            gl.glEnable(capability)
        gl.glAlphaFunc(gl.GL_GREATER, 0.3)
        gl.glScissor(5, 7, 40, 30)
        gl.glCullFace(gl.GL_FRONT_AND_BACK)


@pytest.mark.parametrize("kind", sorted(PIXEL_TYPES))
@pytest.mark.parametrize("pixel_format", sorted(PIXEL_FORMATS))
def test_every_format_and_type(pixel_format, kind):
    rng = np.random.default_rng(len(pixel_format) + len(kind))
    shape = (9, 13, PIXEL_FORMATS[pixel_format])
    if kind == "GL_FLOAT":
        pixels = rng.uniform(-0.1, 1.1, shape).astype(np.float32)
    else:
        limits = np.iinfo(PIXEL_TYPES[kind])
        pixels = rng.integers(limits.min, limits.max, shape, dtype=PIXEL_TYPES[kind], endpoint=True)

    def program(gl):
        gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1)
        gl.glWindowPos2i(3, 4)
        gl.glDrawPixels(13, 9, getattr(gl, pixel_format), getattr(gl, kind), pixels)

    check(program, (20, 16))


@pytest.mark.parametrize("bias", [0.0, -0.1466, 0.3])
@pytest.mark.parametrize("kind", ["GL_UNSIGNED_INT", "GL_INT", "GL_UNSIGNED_SHORT", "GL_SHORT", "GL_FLOAT"])
def test_colors_between_two_bytes_are_rounded_as_those_of_mesa(kind, bias):
    """Mesa's texture has other numbers than the client: they may be rounded to another byte."""
    dtype, places = PIXEL_TYPES[kind], np.linspace(-1.0, 1.0, 9)[:, np.newaxis]
    near = (np.arange(255) + 0.5) / 255 - np.float32(bias) + places / 65535 / 2
    colors = near if kind == "GL_FLOAT" else np.clip(near, 0, 1) * np.iinfo(dtype).max
    pixels = np.repeat(colors[..., np.newaxis], 3, axis=2).astype(dtype)

    def program(gl):
        gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1)
        gl.glPixelTransferf(gl.GL_GREEN_BIAS, bias)
        gl.glWindowPos2i(0, 0)
        gl.glDrawPixels(255, 9, gl.GL_RGB, getattr(gl, kind), pixels)

    check(program, (256, 10))


@pytest.mark.parametrize("zoom", [(1, 1), (2, 3), (-1, 1), (1, -2), (0.5, 0.5), (1.7, -2.3), (-0.3, 4.1)])
@pytest.mark.parametrize("seed", range(3))
def test_zoomed_rectangles(zoom, seed):
    def program(gl):
        rng = np.random.default_rng(seed)
        state(gl, seed)
        gl.glPixelZoom(*zoom)
        pixels = rng.integers(0, 256, (7, 11, 4), dtype=np.uint8)
        for place in ((-0.1, 0.2), (0.5, -0.3), (-0.83, -0.71), (1.5, 0)):
            gl.glRasterPos3f(*place, rng.uniform(-1, 1))
            gl.glDrawPixels(11, 7, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, pixels)

    check(program)


@pytest.mark.parametrize("zoom", [(1, 1), (2, 2), (-1, 1), (1.7, -2.3)])
@pytest.mark.parametrize("seed", range(3))
def test_copied_rectangles(zoom, seed):
    def program(gl):
        rng = np.random.default_rng(seed)
        state(gl, seed)
        gl.glWindowPos2i(0, 0)
        gl.glDrawPixels(64, 40, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, rng.integers(0, 256, (40, 64, 4), dtype=np.uint8))
        gl.glPixelZoom(*zoom)
        for rectangle in ((3, 4, 15, 9), (10, 12, 20, 6), (50, 40, 14, 8), (0, 0, 12, 9), (100, 0, 4, 4), (5, 5, 0, 3)):
            gl.glWindowPos2f(*rng.uniform(0, 40, 2))
            gl.glCopyPixels(*rectangle, gl.GL_COLOR)

    check(program)


def test_lists_and_the_attribute_stack():
    pixels = np.random.default_rng(5).integers(0, 256, (4, 4, 3), dtype=np.uint8)

    def program(gl):
        gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1)
        gl.glNewList(1, gl.GL_COMPILE)
        gl.glPixelZoom(3, 2)
        gl.glDrawPixels(4, 4, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, pixels)
        gl.glEndList()
        gl.glWindowPos2i(2, 2)
        gl.glPushAttrib(gl.GL_PIXEL_MODE_BIT)
        gl.glCallList(1)
        zoomed = float(gl.glGetFloatv(gl.GL_ZOOM_X))
        gl.glPopAttrib()
        gl.glWindowPos2i(20, 2)
        gl.glDrawPixels(4, 4, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, pixels)
        return [zoomed, float(gl.glGetFloatv(gl.GL_ZOOM_X)), float(gl.glGetFloatv(gl.GL_ZOOM_Y))]

    check(program)


@pytest.mark.parametrize("winding", ["GL_CCW", "GL_CW"])
@pytest.mark.parametrize("in_framebuffer_object", [False, True])
def test_the_stencil_of_two_sides_and_framebuffer_objects(in_framebuffer_object, winding):
    pixels = np.random.default_rng(5).integers(0, 256, (5, 4, 4), dtype=np.uint8)

    def program(gl):
        if in_framebuffer_object:
            texture, framebuffer = gl.glGenTextures(1), gl.glGenFramebuffers(1)
            gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
            image = (0, gl.GL_RGBA8, 30, 20, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, None)
            gl.glTexImage2D(gl.GL_TEXTURE_2D, *image)
            gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, framebuffer)
            gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, texture, 0)
            renderbuffer = gl.glGenRenderbuffers(1)
            gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, renderbuffer)
            gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, gl.GL_DEPTH24_STENCIL8, 30, 20)
            attachment = (gl.GL_DEPTH_STENCIL_ATTACHMENT, gl.GL_RENDERBUFFER, renderbuffer)
            gl.glFramebufferRenderbuffer(gl.GL_FRAMEBUFFER, *attachment)
            gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
        gl.glFrontFace(getattr(gl, winding))
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glStencilOpSeparate(gl.GL_FRONT, gl.GL_KEEP, gl.GL_KEEP, gl.GL_INCR)
        gl.glStencilOpSeparate(gl.GL_BACK, gl.GL_KEEP, gl.GL_KEEP, gl.GL_INVERT)
        gl.glWindowPos2i(2, 3)
        gl.glDrawPixels(4, 5, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, pixels)
        gl.glBitmap(8, 2, -10, 0, 0, 0, bytes([255, 0, 0, 0, 129, 0, 0, 0]))
        gl.glPixelZoom(2.3, -1.35)
        gl.glDrawPixels(4, 5, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, pixels)
        gl.glCopyPixels(2, 3, 3, 2, gl.GL_COLOR)
        rectangle = (0, 0, 30, 20)
        return [
            gl.glReadPixels(*rectangle, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE),
            gl.glReadPixels(*rectangle, gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE),
        ]

    check(program, (30, 20))


def fogged(gl, seed):
    """Rectangles and bitmaps in fog, at several depths, drawn to the window, to bytes or to floats."""
    rng = np.random.default_rng(seed)
    internal = [None, gl.GL_RGBA8, gl.GL_RGBA32F][seed % 3]
    if internal is not None:
        gl.glBindTexture(gl.GL_TEXTURE_2D, texture := gl.glGenTextures(1))
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, internal, 32, 24, 0, gl.GL_RGBA, gl.GL_FLOAT, None)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
        gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, texture, 0)
        gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT)
    gl.glEnable(gl.GL_FOG)
    if seed % 2:
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
    for mode in (gl.GL_LINEAR, gl.GL_EXP, gl.GL_LINEAR, gl.GL_EXP2):
        gl.glFogi(gl.GL_FOG_MODE, mode)
        for name, value in zip(("START", "END", "DENSITY"), rng.random(3) * (3, 2, 2) - (2, 0.5, 0), strict=True):
            gl.glFogf(getattr(gl, f"GL_FOG_{name}"), value)
        gl.glFogfv(gl.GL_FOG_COLOR, rng.random(4).astype(np.float32))
        gl.glColor4f(*rng.random(4))
        gl.glRasterPos3f(*(rng.random(3) * 1.6 - 1))
        gl.glDrawPixels(6, 5, gl.GL_RGBA, gl.GL_FLOAT, rng.random((5, 6, 4)).astype(np.float32))
        gl.glRasterPos3f(*(rng.random(3) * 1.6 - 1))
        gl.glCopyPixels(3, 2, 7, 6, gl.GL_COLOR)
        gl.glRasterPos3f(*(rng.random(3) * 1.6 - 1))
        gl.glBitmap(8, 4, 0, 0, 3, 1, rng.integers(0, 256, 16).astype(np.uint8).tobytes())
        gl.glFlush()  # else Mesa draws the bitmap later, in another fog
    return np.ravel(gl.glReadPixels(0, 0, 32, 24, gl.GL_RGBA, gl.GL_FLOAT))


@pytest.mark.parametrize("seed", range(3))
def test_fog_is_that_of_the_distance_0(seed):
    check(lambda gl: fogged(gl, seed), (32, 24))


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(3, 60))
def test_many_rectangles_in_fog_are_those_of_mesa(seed):
    check(lambda gl: fogged(gl, seed), (32, 24))


def clamped(gl, seed):
    """Draw rectangles beyond the near and far planes, with depth clamping; return the last raster position."""
    rng = np.random.default_rng(seed)
    for capability in (gl.GL_DEPTH_CLAMP, gl.GL_DEPTH_TEST):
        gl.glEnable(capability)
    gl.glDepthFunc(gl.GL_ALWAYS)
    gl.glDepthRange(*rng.choice([0, 1, 0.3, 0.8], 2))
    for i in range(6):
        gl.glRasterPos3f(*(rng.random(2) * 1.8 - 0.9), rng.random() * 6 - 3)
        if i % 3 == 0:
            gl.glDrawPixels(4, 4, gl.GL_RGB, gl.GL_FLOAT, rng.random((4, 4, 3)).astype(np.float32))
        elif i % 3 == 1:
            gl.glBitmap(8, 4, 0, 0, 0, 0, np.full((4, 4), 255, np.uint8))
        else:
            gl.glCopyPixels(0, 0, 4, 4, gl.GL_COLOR)
    return np.array(gl.glGetFloatv(gl.GL_CURRENT_RASTER_POSITION))


@pytest.mark.parametrize("seed", range(4))
def test_rectangles_beyond_the_planes_are_drawn_with_depth_clamping(seed):
    check(lambda gl: clamped(gl, seed), (32, 24))
