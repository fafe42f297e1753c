"""Frame times, measured in the same way on softshadow and in Mesa's process.

A *frame program* is called once with a GL namespace, prepares what the frames need, and returns a function that draws
one frame. It uses only this namespace, so it runs unchanged on softshadow and on Mesa.
"""

import time
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

DrawFrame = Callable[[], Any]
FrameProgram = Callable[[Any], DrawFrame]


class Timing(NamedTuple):
    """Wall time and CPU time (of all threads of the process), in seconds."""

    wall: float
    cpu: float


def timed(gl: Any, work: Callable[[], Any]) -> tuple[Any, Timing]:
    """Call a function that draws, and return its result and its time, which includes glFinish."""
    wall, cpu = time.perf_counter(), time.process_time()
    result = work()
    gl.glFinish()
    return result, Timing(time.perf_counter() - wall, time.process_time() - cpu)


def read_buffers(gl: Any, size: tuple[int, int]) -> dict[str, np.ndarray]:
    """Return the buffers of the bound framebuffer, first row = bottom row.

    Returns
    -------
    dict      "color" (h, w, 4) float32, "depth" (h, w) float32, "stencil" (h, w) uint8
    """
    # float is exact for 8-bit colours, too, so one call serves both kinds of colour buffer
    color = gl.glReadPixels(0, 0, *size, gl.GL_RGBA, gl.GL_FLOAT)
    depth = gl.glReadPixels(0, 0, *size, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT)
    stencil = gl.glReadPixels(0, 0, *size, gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE)
    return {"color": color, "depth": depth, "stencil": stencil}
