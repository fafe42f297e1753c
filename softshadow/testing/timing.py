"""How long frames take: the same clocks around the same calls, here and in Mesa's process.

A *frame program* is called once with a GL namespace, makes what the frames need, and returns the function that draws
one frame. It touches nothing but that namespace, so it runs on softshadow and on Mesa unchanged.
"""

import time
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

Frame = Callable[[], Any]
FrameProgram = Callable[[Any], Frame]


class Timing(NamedTuple):
    """Seconds by the clock on the wall, and of the process on all its threads."""

    wall: float
    cpu: float


def timed(gl: Any, work: Callable[[], Any]) -> tuple[Any, Timing]:
    """Return what a function returns and how long it took, until everything that it drew is in the buffers."""
    wall, cpu = time.perf_counter(), time.process_time()
    result = work()
    gl.glFinish()
    return result, Timing(time.perf_counter() - wall, time.process_time() - cpu)


def read_buffers(gl: Any, size: tuple[int, int]) -> dict[str, np.ndarray]:
    """Return the buffers of the framebuffer that is bound, first row = bottom row.

    Returns
    -------
    dict      "color" (h, w, 4) float32, "depth" (h, w) float32, "stencil" (h, w) uint8
    """
    # 32 bits from a buffer of 8 are exact, too, so one call serves both kinds of colour
    color = gl.glReadPixels(0, 0, *size, gl.GL_RGBA, gl.GL_FLOAT)
    depth = gl.glReadPixels(0, 0, *size, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT)
    stencil = gl.glReadPixels(0, 0, *size, gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE)
    return {"color": color, "depth": depth, "stencil": stencil}
