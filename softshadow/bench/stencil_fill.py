"""Stencil fill workloads: large faces increment and decrement the stencil buffer, like the sides of shadow volumes.

Only the stencil buffer changes, so they measure coverage, depth test and stencil update. The quads of `prepare` are
tilted little and hidden by few walls, so that whole tiles pass or fail. Those of `prepare_steep` are triangles through
the whole depth of a scene of many small things: a quarter of their fragments lie in tiles where some pass and some
fail.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow.testing.timing import DrawFrame

QUADS = 400
SEED = 1991  # of Heidmann's "Real shadows, real time"; any fixed number would do
WALLS = 12
TRIANGLES = 400
RECTANGLES = 150  # in the depth buffer, 2 to 16 % of the width


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
    draw_polygons(gl, tilted_quads(random, WALLS))
    return counting_frame(gl, tilted_quads(random, quads), counting, (gl.GL_INCR_WRAP, gl.GL_DECR_WRAP))


def prepare_steep(
    gl: Any,
    size: tuple[int, int],
    *,
    counting: str,
    depth_format: str,
    saturating: bool = False,
    triangles: int = TRIANGLES,
    rectangles: int = RECTANGLES,
) -> DrawFrame:
    """Do the same with steep triangles over a depth buffer of many small rectangles.

    Parameters
    ----------
    counting, depth_format : as for `prepare`
    saturating : bool            counts stop at 0 and 255 in place of wrapping round
    """
    if depth_format == "d32f":
        bind_float_depth(gl, size)
    gl.glViewport(0, 0, *size)
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
    random = np.random.default_rng(SEED)
    draw_polygons(gl, small_rectangles(random, rectangles, size[0] / size[1]))
    operations = (gl.GL_INCR, gl.GL_DECR) if saturating else (gl.GL_INCR_WRAP, gl.GL_DECR_WRAP)
    return counting_frame(gl, steep_triangles(random, triangles), counting, operations)


def counting_frame(gl: Any, faces: np.ndarray, counting: str, operations: tuple[int, int]) -> DrawFrame:
    """Return a frame that clears the stencil buffer and counts front faces, then back faces into it."""
    gl.glDepthMask(gl.GL_FALSE)
    gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glEnable(gl.GL_CULL_FACE)
    gl.glStencilFunc(gl.GL_ALWAYS, 0, 0xFF)

    def frame() -> None:
        gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
        for culled, operation in zip((gl.GL_BACK, gl.GL_FRONT), operations, strict=True):
            gl.glCullFace(culled)
            if counting == "zpass":
                gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, operation)
            else:
                gl.glStencilOp(gl.GL_KEEP, operation, gl.GL_KEEP)
            draw_polygons(gl, faces)

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


def small_rectangles(random: np.random.Generator, n_rectangles: int, aspect: float) -> np.ndarray:
    """Return tilted rectangles (n_rectangles, 4, 3) float32 in clip space, sides 2 to 16 % of the screen's width."""
    extent = random.uniform(0.04, 0.32, (n_rectangles, 2)) * (1, aspect)  # clip space is 2 x 2
    first = random.uniform(-1, 1 - extent)
    along = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    corners = np.empty((n_rectangles, 4, 3))
    corners[:, :, :2] = first[:, None] + along * extent[:, None]
    tilts = random.uniform(-1.0, 1.0, (n_rectangles, 2))
    middle = random.uniform(-0.9, 0.9, (n_rectangles, 1))
    corners[:, :, 2] = np.clip(middle + ((along - 0.5) @ tilts[:, :, None])[:, :, 0], -0.98, 0.98)
    rectangles = corners.astype(np.float32)
    rectangles.setflags(write=False)
    return rectangles


def steep_triangles(random: np.random.Generator, n_triangles: int) -> np.ndarray:
    """Return triangles (n_triangles, 3, 3) float32 in clip space, of random facing, each corner at any depth.

    Each covers 20 to 27 % of the screen.
    """
    found: list[np.ndarray] = []
    while len(found) < n_triangles:
        corners = random.uniform(-1, 1, (3, 2))
        (a, b), (c, d) = corners[1:] - corners[0]
        if 4 * 0.2 <= abs(a * d - b * c) / 2 <= 4 * 0.27:
            found.append(corners)
    window_z = random.uniform(0.15, 0.95, (n_triangles, 3, 1))
    triangles = np.concatenate([np.stack(found), 2 * window_z - 1], axis=2).astype(np.float32)
    triangles.setflags(write=False)
    return triangles


def draw_polygons(gl: Any, polygons: np.ndarray) -> None:
    """Draw triangles (n, 3, 3) or quads (n, 4, 3), float32."""
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, polygons)
    n_polygons, n_corners = polygons.shape[:2]
    gl.glDrawArrays(gl.GL_QUADS if n_corners == 4 else gl.GL_TRIANGLES, 0, n_corners * n_polygons)
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
