"""Compiling kernels in a second process while the first tour is drawn: in one process Numba compiles one at a time.

``python -m softshadow.tour.compilation`` first rehearses one stop of each technique: it draws a tiny picture with all
kernels as plain Python, and notes the types of their arguments. Then it compiles the kernels, the last one first, while
the tour compiles them from the first one on. Each process finds the other's machine code in the cache folder.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace

from softshadow.pipeline import threads

SIZE, MAP_SIZE = (8, 6), 8


@contextmanager
def compiling_ahead() -> Iterator[None]:
    """Inside the block, let a second process compile, too, if draws may use two threads; the block ends it.

    The cache folder must be writable (`cache_folder`).
    """
    helper = None
    if threads() > 1:
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


def compile_backwards() -> None:
    """Compile the kernels of the tour, beginning with those that the tour needs last."""
    from softshadow.jit import rehearsing

    with rehearsing() as kernels:
        draw_tiny_pictures()
    for kernel, types in reversed(kernels):
        kernel.compile(types)


def draw_tiny_pictures() -> None:
    """Draw one stop of each technique as a tiny picture of a scene with few triangles."""
    from softshadow import techniques
    from softshadow.runs import run
    from softshadow.scene import Scene, shapes
    from softshadow.tour.stops import STOPS

    scene = Scene.named("torus")
    torus = replace(scene.casters[0], mesh=shapes.torus(0.9, 0.33, segments=6, sides=4))
    scene = replace(scene, objects=(*scene.receivers, torus))
    for stop in {stop.technique: stop for stop in STOPS}.values():
        options = dict(stop.options)
        if "map_size" in techniques.get(stop.technique).options:
            options["map_size"] = MAP_SIZE
        run(stop.technique, scene, SIZE, **options)


if __name__ == "__main__":
    compile_backwards()
