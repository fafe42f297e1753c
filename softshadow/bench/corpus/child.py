"""A process that draws the frames of one program, on softshadow or on Mesa, and times them.

``python -m softshadow.bench.corpus.child SIDE PROGRAM WxH`` reads a line ``FRAMES FILE`` for each request, and answers
with a line of JSON. It writes the buffers after the last frame to the file, unless this is "-".

The first frame includes creating the context and preparing the program, but not the imports. Every frame ends with
reading a pixel, so that it is complete. With one thread CPU time counts, which a busy machine disturbs less; with more
it is wall time, which tells how well they work in parallel.
"""

from __future__ import annotations

import json
import os
import sys
import time
from typing import Any

import numpy as np

from softshadow.bench.corpus.program import Program
from softshadow.bench.corpus.programs import get

OWN = "softshadow"


def namespace(side: str) -> tuple[Any, Any]:
    """Return the GL namespace of a side, and its function that opens a window."""
    if side == OWN:
        from softshadow import gl

        return gl, gl.create_context
    from softshadow.testing.plain_opengl import PlainGL

    plain = PlainGL()
    return plain, plain.open_window


def buffers(gl: Any, size: tuple[int, int]) -> dict[str, Any]:
    """Return the buffers of the window, first row = bottom row: color (h, w, 4), depth and stencil (h, w)."""
    width, height = size
    color = np.zeros((height, width, 4), np.uint8)
    depth, stencil = np.zeros((height, width), np.uint32), np.zeros((height, width), np.uint8)
    gl.glPixelStorei(gl.GL_PACK_ALIGNMENT, 1)
    gl.glReadPixels(0, 0, *size, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, color)
    gl.glReadPixels(0, 0, *size, gl.GL_DEPTH_COMPONENT, gl.GL_UNSIGNED_INT, depth)
    gl.glReadPixels(0, 0, *size, gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE, stencil)
    return {"color": color, "depth": depth, "stencil": stencil}


def peak_memory() -> float | None:
    """Return the largest memory of this process so far, in MB; None where the system does not report it."""
    try:
        import resource
    except ImportError:  # Windows
        return None
    unit = 2**20 if sys.platform == "darwin" else 2**10
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / unit


def serve(side: str, program: Program) -> None:
    """Answer requests until the input ends."""
    clock = time.process_time if os.environ.get("SOFTSHADOW_THREADS") == "1" else time.perf_counter
    gl, open_window = namespace(side)
    windows, frame, number, pixel = [], None, 0, np.zeros((1, 1, 4), np.uint8)
    print(json.dumps({"ready": side}), flush=True)
    for line in sys.stdin:
        count, file = line.split()
        milliseconds = []
        for _ in range(int(count)):
            start = clock()
            if frame is None:
                windows.append(open_window(*program.size))
                frame = program.prepare(gl, program.size)
            frame(number)
            number += 1
            gl.glReadPixels(0, 0, 1, 1, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, pixel)
            milliseconds.append(1e3 * (clock() - start))
        if file != "-":
            np.savez(file, **buffers(gl, program.size))
        print(json.dumps({"milliseconds": milliseconds, "memory": peak_memory()}), flush=True)


if __name__ == "__main__":
    width, height = map(int, sys.argv[3].split("x"))
    serve(sys.argv[1], get(sys.argv[2]).resized((width, height)))
