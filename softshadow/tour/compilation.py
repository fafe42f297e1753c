"""Compiling kernels in a second process while the first tour is drawn: in one process Numba compiles one at a time.

``python -m softshadow.tour.compilation`` first rehearses one stop of each technique: it draws a tiny picture with all
kernels as plain Python, and notes the types of their arguments. Then it compiles the kernels, the last one first, while
the tour compiles them from the first one on. Each process finds the other's machine code in the cache folder.

The package is imported inside functions, so that the first process can start the second before it loads Numba.
"""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace

SIZE, MAP_SIZE = (8, 6), 8


@contextmanager
def compiling_ahead() -> Iterator[None]:
    """Inside the block, let a second process compile, too, unless there is one core or SOFTSHADOW_THREADS is 1.

    The cache folder must be writable (`cache_folder`). The process is stopped when the block ends.
    """
    helper = None
    if cores() > 1 and os.environ.get("SOFTSHADOW_THREADS", "").strip() != "1":
        with suppress(OSError):  # without a second process this one compiles everything
            helper = subprocess.Popen(
                [sys.executable, "-m", __name__],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
            )
    try:
        yield
    finally:
        if helper is not None:
            helper.kill()
            helper.wait()


def cores() -> int:
    """Return how many cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def compile_backwards() -> None:
    """Compile the kernels of the tour, beginning with those that the tour needs last."""
    from softshadow.jit import rehearsing

    with rehearsing() as kernels:
        draw_tiny_pictures()
    for kernel, types in reversed(kernels):
        kernel.compile(types)


def draw_tiny_pictures() -> None:
    """Draw a stop of each technique as a tiny picture of a scene with few triangles, and ask for two of its pixels."""
    from softshadow import techniques
    from softshadow.runs import run
    from softshadow.scene import Scene, shapes
    from softshadow.tour.stops import STOPS

    scene = Scene.named("torus")
    torus = replace(scene.casters[0], mesh=shapes.torus(0.9, 0.33, segments=3, sides=3))
    scene = replace(scene, objects=(*scene.receivers, torus))
    for stop in {stop.technique: stop for stop in STOPS}.values():
        options = dict(stop.options)
        if "map_size" in techniques.get(stop.technique).options:
            options["map_size"] = MAP_SIZE
        drawn = run(stop.technique, scene, SIZE, **options)
        for place in ((0, 0), (SIZE[0] // 2, SIZE[1] // 2)):
            drawn.pixel(*place)


if __name__ == "__main__":
    compile_backwards()
