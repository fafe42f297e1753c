"""Draws below the GL facade: triangles into a window under any state."""

from dataclasses import replace
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.pipeline.commands import Vertices
from softshadow.state import Blend, State

ADDING = Blend(enabled=True, src_rgb=gl.GL_ONE, dst_rgb=gl.GL_ONE, src_alpha=gl.GL_ONE, dst_alpha=gl.GL_ONE)
MIXING = replace(ADDING, src_rgb=gl.GL_SRC_ALPHA, dst_rgb=gl.GL_ONE_MINUS_SRC_ALPHA)


def vertices(positions: Any, colors: Any = None) -> Vertices:
    """Return vertices with positions (V, 4) and colours (V, 4), white by default."""
    positions = np.ascontiguousarray(positions, np.float32)
    n = len(positions)
    colors = np.ones((n, 4), np.float32) if colors is None else np.ascontiguousarray(colors, np.float32)
    return Vertices(positions, colors, np.zeros((n, 3), np.float32), ())


def random_triangles(rng: np.random.Generator, n: int) -> Vertices:
    """Return triangles in clip space in and around the frustum: some behind the eye, some with w = 0, some huge."""
    positions = rng.normal(0, 1, (3 * n, 4)).astype(np.float32)
    positions[:, 3] = rng.choice(np.float32([1, 1, 1, 0.5, 2, -1, 0, 0.01]), 3 * n)
    return vertices(positions * np.float32(rng.choice([0.3, 1, 3])), rng.random((3 * n, 4)))


def small_triangles(rng: np.random.Generator, n: int) -> Vertices:
    """Return triangles of up to a few pixels in a small window, some of them across its borders."""
    positions = np.ones((n, 3, 4), np.float32)
    positions[:, :, :3] = rng.uniform(-1.05, 1.05, (n, 1, 3))
    positions[:, :, :3] += rng.normal(0, 1, (n, 3, 3)) * rng.choice([0.02, 0.1, 0.3], (n, 1, 1))
    return vertices(positions.reshape(-1, 4), rng.random((3 * n, 4)))


def random_state(rng: np.random.Generator, state: State) -> State:
    """Return a state with random tests, operations, masks, offset and culling."""

    def func() -> int:
        return int(rng.integers(gl.GL_NEVER, gl.GL_ALWAYS + 1))

    def op() -> int:
        ops = (gl.GL_KEEP, gl.GL_ZERO, gl.GL_REPLACE, gl.GL_INCR, gl.GL_DECR, gl.GL_INVERT, gl.GL_INCR_WRAP)
        return int(rng.choice([*ops, gl.GL_DECR_WRAP]))

    def on() -> bool:
        return bool(rng.random() < 0.6)

    faces = [
        replace(
            state.stencil.front, func=func(), ref=int(rng.integers(0, 8)), read_mask=int(rng.choice([255, 3, 0])),
            write_mask=int(rng.choice([255, 255, 6])), sfail=op(), zfail=op(), zpass=op(),
        )
        for _ in range(2)
    ]  # fmt: skip
    return replace(
        state,
        stencil=replace(state.stencil, enabled=on(), front=faces[0], back=faces[on()]),
        depth=replace(state.depth, enabled=on(), func=func(), write=on(), clamp=on()),
        cull=replace(state.cull, enabled=not on(), face=int(rng.choice([gl.GL_FRONT, gl.GL_BACK]))),
        polygon=replace(state.polygon, offset_fill=on(), factor=float(rng.normal()), units=float(rng.normal())),
        scissor=replace(state.scissor, enabled=not on(), x=5, y=7, width=31, height=20),
        color=replace(state.color, mask=tuple(on() for _ in range(4))),
    )


def draw(context: Context, state: State, triangles: Vertices, mode: int = gl.GL_TRIANGLES) -> None:
    """Draw vertices as triangles, or in another mode, under a state and in the precision of the context."""
    context.state = state
    position, color, normal = (context.frozen(rows) for rows in (triangles.position, triangles.color, triangles.normal))
    context.draw(mode, Vertices(position, color, normal, ()))


def same_window(a: Context, b: Context) -> bool:
    """Return whether colour, depth and stencil are equal to the last bit, in the window or what is drawn to."""
    mine, theirs = (each.storage.framebuffers[each.state.draw_framebuffer].attachments for each in (a, b))
    return all(mine[k].image.same_as(theirs[k].image) for k in mine)


def surface_blended_twice(seed, func, blending, overlapping, precision="mesa"):
    """Return a window after a surface and the same surface blended onto it; `overlapping`: then more triangles."""
    rng = np.random.default_rng(seed)
    context = Context(48, 40, "d24", precision=precision)
    state = replace(random_state(rng, context.state), alpha=replace(context.state.alpha, enabled=False))
    surface = replace(state, depth=replace(state.depth, enabled=True, func=gl.GL_LESS, write=True), blend=Blend())
    blended = replace(state, depth=replace(state.depth, enabled=True, func=func, write=False), blend=blending)
    triangles = random_triangles(rng, 6)
    draw(context, surface, triangles)
    draw(context, blended, triangles)
    if overlapping:
        draw(context, blended, random_triangles(rng, 6))
    return context
