"""Small frames recorded by hand through a context, below the facade."""

from dataclasses import replace
from typing import Any

import numpy as np

from draws import draw, random_state, random_triangles, vertices
from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.pipeline.commands import Clear

SIZE = (16, 12)
ALL_BUFFERS = gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT
FACTORS = (gl.GL_ZERO, gl.GL_ONE, gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA, gl.GL_DST_COLOR)


def random_frame(seed: int, draws: int = 5, **options: Any) -> Context:
    """A context after draws under random states, a clear before some of them, each draw a step of its own."""
    rng = np.random.default_rng(seed)
    context = Context(*SIZE, **options)
    for number in range(draws):
        state = random_state(rng, context.state)
        on = rng.random(4) < 0.4
        context.state = replace(
            state,
            scissor=replace(state.scissor, x=3, y=2, width=10, height=7),
            alpha=replace(state.alpha, enabled=bool(on[0]), func=gl.GL_GREATER, ref=0.4),
            blend=replace(
                state.blend, enabled=bool(on[1]), src_rgb=int(rng.choice(FACTORS)), dst_rgb=int(rng.choice(FACTORS))
            ),
            color=replace(state.color, clear=(0.1, 0.2, 0.3, 1.0)),
        )
        if on[2]:
            context.execute(Clear(context.state, ALL_BUFFERS))
        context.labels[:] = ["frame", f"object {number}"]
        draw(context, context.state, random_triangles(rng, 4))
        context.end_step(f"step {number}")
    return context


def set_groups(context: Context, **groups: Any) -> None:
    """Replace groups of a context's state, each by its name."""
    context.change_state(replace(context.state, **groups))


def covering(z: float, color: tuple[float, float, float, float] = (1, 1, 1, 1)) -> Any:
    """One counter-clockwise triangle over the whole window at a depth in clip space."""
    return vertices([[-1, -1, z, 1], [3, -1, z, 1], [-1, 3, z, 1]], np.tile(color, (3, 1)))
