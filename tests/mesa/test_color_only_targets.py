"""Rectangles in framebuffer objects have the bits of Mesa, with a depth buffer and without.

For framebuffers without depth llvmpipe has another rasterizer, which computes one plane equation for both triangles of
a rectangle. Fixed-function programs do not use it. Texels whose borders lie near the samples would show it.
"""

import numpy as np
import pytest

from combinations import sampled
from softshadow.testing import compare

pytestmark = pytest.mark.mesa

SIDE = 150
TEXELS = np.random.default_rng(3).integers(0, 256, (64, 128, 4), dtype=np.uint8)
ORDERS = {
    "quads": ("GL_QUADS", (0, 1, 2, 3)),
    "clockwise quads": ("GL_QUADS", (3, 2, 1, 0)),
    "triangles": ("GL_TRIANGLES", (0, 1, 2, 0, 2, 3)),
    "triangles along the diagonal": ("GL_TRIANGLES", (0, 1, 2, 2, 3, 0)),
    "triangles cut across": ("GL_TRIANGLES", (0, 1, 3, 1, 2, 3)),
    "fan": ("GL_TRIANGLE_FAN", (0, 1, 2, 3)),
    "strip": ("GL_TRIANGLE_STRIP", (0, 1, 3, 2)),
    "polygon": ("GL_POLYGON", (0, 1, 2, 3)),
    "quad strip": ("GL_QUAD_STRIP", (0, 1, 3, 2)),
}


def target(gl, has_depth):
    """Create and bind a framebuffer object with an RGBA8 texture, and with 24 bits of depth or none."""
    texture = gl.glGenTextures(1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
    size = (SIDE, SIDE, 0)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, *size, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, None)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
    gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, texture, 0)
    if has_depth:
        depth = gl.glGenRenderbuffers(1)
        gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, depth)
        gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, gl.GL_DEPTH_COMPONENT24, SIDE, SIDE)
        gl.glFramebufferRenderbuffer(gl.GL_FRAMEBUFFER, gl.GL_DEPTH_ATTACHMENT, gl.GL_RENDERBUFFER, depth)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT)


FILTERS = ("GL_NEAREST", "GL_LINEAR", "")  # "" stands for no texture
BOXES = ((-1, -1, 1, 1), (-0.7, -0.83, 0.91, 0.77), (-1.7, -1.2, 1.4, 3))


@pytest.mark.parametrize(
    ("box", "texture_filter", "order", "has_depth"),
    sampled(BOXES, FILTERS, ORDERS, [False, True]),
)
def test_rectangles_are_two_triangles_with_or_without_depth(box, texture_filter, order, has_depth):
    left, bottom, right, top = box
    mode, corners = ORDERS[order]

    def program(gl):
        target(gl, has_depth)
        if texture_filter:
            gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
            size = (TEXELS.shape[1], TEXELS.shape[0], 0)
            gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, *size, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, TEXELS)
            for side in ("GL_TEXTURE_MIN_FILTER", "GL_TEXTURE_MAG_FILTER"):
                gl.glTexParameteri(gl.GL_TEXTURE_2D, getattr(gl, side), getattr(gl, texture_filter))
            gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glBegin(getattr(gl, mode))
        for corner in corners:
            x, y = [(left, bottom), (right, bottom), (right, top), (left, top)][corner]
            s, t = [(0.1, 0.2), (0.8, 0.2), (0.8, 0.9), (0.1, 0.9)][corner]
            gl.glColor4f(s, t, 0.5 * s + 0.25 * t, 1)
            gl.glTexCoord2f(s, t)
            gl.glVertex2f(x, y)
        gl.glEnd()
        return gl.glReadPixels(0, 0, SIDE, SIDE, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)

    comparison = compare(program, (SIDE, SIDE))
    assert comparison, str(comparison)
