"""glDrawPixels and glCopyPixels into a framebuffer object, with zooms that are no whole numbers: edges meet centres."""

import numpy as np
import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa

WIDTH, HEIGHT = 24, 20
ZOOMS = (-2.5, -1.5, -0.5, 0.25, 0.5, 1.0, 1.5, 2.5)


def draw_into_object(gl):
    gl.glBindTexture(gl.GL_TEXTURE_2D, texture := gl.glGenTextures(1))
    texels = np.random.default_rng(5).integers(0, 255, (HEIGHT, WIDTH, 4), np.uint8)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, WIDTH, HEIGHT, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)
    gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, depths := gl.glGenRenderbuffers(1))
    gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, gl.GL_DEPTH_COMPONENT24, WIDTH, HEIGHT)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
    gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, texture, 0)
    gl.glFramebufferRenderbuffer(gl.GL_FRAMEBUFFER, gl.GL_DEPTH_ATTACHMENT, gl.GL_RENDERBUFFER, depths)
    gl.glViewport(0, 0, WIDTH, HEIGHT)
    gl.glClear(gl.GL_DEPTH_BUFFER_BIT)


@pytest.mark.parametrize("seed", range(24))
def test_rectangles_in_an_object_are_those_of_mesa(seed):
    def program(gl):
        random = np.random.default_rng(seed)  # the program runs twice
        draw_into_object(gl)
        gl.glDepthFunc(gl.GL_ALWAYS)
        for kind in ("colors", "copy", "depths", "colors"):
            gl.glPixelZoom(*random.choice(ZOOMS, 2))
            gl.glWindowPos2f(*random.uniform(-3, 20, 2).round(random.integers(0, 2)))
            width, height = map(int, random.integers(1, 12, 2))
            if kind == "copy":
                gl.glCopyPixels(2, 3, width, height, gl.GL_COLOR)
            elif kind == "depths":
                gl.glEnable(gl.GL_DEPTH_TEST)
                depths = random.random((height, width), np.float32)
                gl.glDrawPixels(width, height, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT, depths)
                gl.glDisable(gl.GL_DEPTH_TEST)
            else:
                pixels = random.integers(0, 255, (height, width, 4), np.uint8)
                gl.glDrawPixels(width, height, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, pixels)
            gl.glRectf(-0.9, -0.9, -0.6, -0.5)  # its edges have the rule of other triangles
        return [
            gl.glReadPixels(0, 0, WIDTH, HEIGHT, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE),
            gl.glReadPixels(0, 0, WIDTH, HEIGHT, gl.GL_DEPTH_COMPONENT, gl.GL_UNSIGNED_INT),
        ]

    comparison = compare(program, (8, 8))
    assert comparison, str(comparison)
