"""Stencil fill workload: large quads increment and decrement the stencil buffer, like the sides of shadow volumes.

Only the stencil buffer changes, so it measures coverage, depth test and stencil update.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow.testing.timing import DrawFrame

QUADS = 400
SEED = 1991  # of Heidmann's "Real shadows, real time"; any fixed number would do
WALLS = 12


def prepare(gl: Any, size: tuple[int, int], *, counting: str, depth_format: str, quads: int = QUADS) -> DrawFrame:
    """Fill the depth buffer; a frame clears the stencil buffer and counts all quads into it in two passes.

    Parameters
    ----------
    counting : "zpass" or "zfail"
    depth_format : "d24" (the window) or "d32f" (a framebuffer object)
    """
    if depth_format == "d32f":
        bind_float_depth(gl, size)
    gl.glViewport(0, 0, *size)
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
    random = np.random.default_rng(SEED)
    draw_quads(gl, tilted_quads(random, WALLS))
    sides = tilted_quads(random, quads)

    gl.glDepthMask(gl.GL_FALSE)
    gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glEnable(gl.GL_CULL_FACE)
    gl.glStencilFunc(gl.GL_ALWAYS, 0, 0xFF)

    def frame() -> None:
        gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
        for culled, operation in ((gl.GL_BACK, gl.GL_INCR_WRAP), (gl.GL_FRONT, gl.GL_DECR_WRAP)):
            gl.glCullFace(culled)
            if counting == "zpass":
                gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, operation)
            else:
                gl.glStencilOp(gl.GL_KEEP, operation, gl.GL_KEEP)
            draw_quads(gl, sides)

    return frame


def tilted_quads(random: np.random.Generator, n_quads: int) -> np.ndarray:
    """Return planar quads (n_quads, 4, 3) float32 in clip space, with random facing.

    Each covers a fifth to a quarter of the screen, half its height and nearly half its width, like the side of a shadow
    volume that extends towards the eye.
    """
    width = random.uniform(0.8, 0.9, n_quads)  # clip space is 2 x 2
    height = random.uniform(1.0, 1.1, n_quads)
    shear = random.uniform(-0.2, 0.2, n_quads)
    x = random.uniform(-0.95, 0.95 - width)
    y = random.uniform(-0.95, 0.95 - height)
    u, v = np.array([0.0, 1.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0, 1.0])
    corners = np.empty((n_quads, 4, 3))
    corners[:, :, 0] = np.clip(x[:, None] + u * width[:, None] + v * shear[:, None], -1, 1)
    corners[:, :, 1] = y[:, None] + v * height[:, None]
    slopes = random.uniform(-0.6, 0.6, (n_quads, 2))
    middle = random.uniform(-0.3, 0.3, n_quads)
    corners[:, :, 2] = middle[:, None] + slopes[:, :1] * corners[:, :, 0] / 2 + slopes[:, 1:] * corners[:, :, 1] / 2
    backs = random.random(n_quads) < 0.5
    corners[backs] = corners[backs, ::-1]
    quads = corners.astype(np.float32)
    quads.setflags(write=False)
    return quads


def draw_quads(gl: Any, quads: np.ndarray) -> None:
    """Draw quads (n, 4, 3) float32."""
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, quads)
    gl.glDrawArrays(gl.GL_QUADS, 0, 4 * len(quads))
    gl.glDisableClientState(gl.GL_VERTEX_ARRAY)


def bind_float_depth(gl: Any, size: tuple[int, int]) -> None:
    """Bind a framebuffer object with RGBA8 colour and 32-bit float depth with stencil."""
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
    for point, internal_format in (
        (gl.GL_COLOR_ATTACHMENT0, gl.GL_RGBA8),
        (gl.GL_DEPTH_STENCIL_ATTACHMENT, gl.GL_DEPTH32F_STENCIL8),
    ):
        buffer = gl.glGenRenderbuffers(1)
        gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, buffer)
        gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, internal_format, *size)
        gl.glFramebufferRenderbuffer(gl.GL_FRAMEBUFFER, point, gl.GL_RENDERBUFFER, buffer)
