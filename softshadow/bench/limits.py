"""Limits of the machine: memory bandwidth, and the simplest loop that tests depth and updates a stencil value.

No rasterizer can be faster than this loop, so a workload's share of its speed tells how much can still be gained.

References: McCalpin 1995, "Memory bandwidth and machine balance in current high performance computers" (triad).
"""

from __future__ import annotations

import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from softshadow.bench.plain_loops import stencil_sweeps, triad
from softshadow.bench.results import Limits

TRIAD_ELEMENTS = 1 << 23  # float32, three arrays of 32 MiB: larger than any cache
STENCIL_PIXELS = 1 << 14  # 80 KiB of depth and stencil: fits in a core's second-level cache
STENCIL_SWEEPS = 2000
ROUNDS = 25  # of a few milliseconds each; the fastest one was not interrupted
BYTES_PER_ELEMENT = 12  # two read, one written


def measure_limits(threads: int) -> Limits:
    """Return the limits with several threads at work at the same time, each on its own arrays."""
    random = np.random.default_rng(0)
    share = TRIAD_ELEMENTS // threads
    arrays = [[np.ones(share, np.float32) for _ in range(3)] for _ in range(threads)]
    buffers = [(random.random(STENCIL_PIXELS, np.float32), np.zeros(STENCIL_PIXELS, np.uint8)) for _ in range(threads)]
    z = np.array([0.4, 0.6], np.float32)
    scale = np.float32(3.0)
    seconds = time_in_parallel(threads, lambda k: triad(*arrays[k], scale))
    triad_rate = BYTES_PER_ELEMENT * share * threads / seconds
    seconds = time_in_parallel(threads, lambda k: stencil_sweeps(*buffers[k], z, STENCIL_SWEEPS))
    return Limits(threads, triad_rate, STENCIL_PIXELS * STENCIL_SWEEPS * threads / seconds)


def time_in_parallel(threads: int, work: Callable[[int], None]) -> float:
    """Return the seconds of the fastest of several rounds of `threads` parallel calls."""
    with ThreadPoolExecutor(threads) as pool:
        list(pool.map(work, range(threads)))
        seconds = []
        for _ in range(ROUNDS):
            start = time.perf_counter()
            list(pool.map(work, range(threads)))
            seconds.append(time.perf_counter() - start)
    return min(seconds)
