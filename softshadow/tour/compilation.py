"""Compiling kernels in a second process while the first tour is drawn: Numba compiles one kernel at a time.

``python -m softshadow.tour.compilation`` first rehearses one stop of each technique: it draws a tiny picture with all
kernels as plain Python, and notes the types of their arguments. Then it compiles the kernels, the last one first, while
the tour compiles them from the first one on. Each process finds the other's machine code in the cache folder.
"""

from __future__ import annotations

import subprocess
import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress

from softshadow import techniques
from softshadow.jit import Kernels, rehearsing
from softshadow.pipeline import threads
from softshadow.runs import run
from softshadow.tour.stops import STOPS

SIZE, MAP_SIZE = (16, 12), 8


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
    """Compile the kernels of the tour, those that it needs last first."""
    for kernel, types in reversed(rehearsed_kernels()):
        kernel.compile(types)


def rehearsed_kernels() -> Kernels:
    """Return the kernels that one stop of each technique calls."""
    with rehearsing() as kernels, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for stop in {stop.technique: stop for stop in STOPS}.values():
            options = dict(stop.options)
            if "map_size" in techniques.get(stop.technique).options:
                options["map_size"] = MAP_SIZE
            run(stop.technique, "boxes", SIZE, **options)
    return kernels


if __name__ == "__main__":
    compile_backwards()
