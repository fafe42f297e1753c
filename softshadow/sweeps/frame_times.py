"""Times and memory of the frames of a point, and whether its process had a core for itself meanwhile."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from softshadow.runs import Run
from softshadow.sweeps.point import Point

MEGABYTE = 2**20
ALONE = 0.9  # of the time between start and end of a frame its thread was computing, at least


def timed(draw: Callable[[], Run], point: Point) -> tuple[Run, dict[str, Any]]:
    """Return the run of the first frame, and the times of all frames if the point asks for them.

    A frame had its core alone if the thread that drew it computed during (nearly) all of the time that passed: what is
    missing went to other processes and threads. With several kernel threads that is not known from this, so such times
    are marked as not alone.
    """
    frames = point.frames if "time" in point.measure else 0
    walls, shares = [], []
    drawn: Run | None = None
    for _ in range(1 + frames):
        wall, cpu = time.perf_counter(), time.thread_time()
        result = draw()
        wall, cpu = time.perf_counter() - wall, time.thread_time() - cpu
        walls.append(1000 * wall)
        shares.append(cpu / max(wall, 1e-9))
        drawn = drawn or result
    assert drawn is not None
    if not frames:
        return drawn, {}
    alone = point.threads == 1 and min(shares[1:]) >= ALONE
    return drawn, {
        "first_frame_ms": round(walls[0], 3),
        "frame_ms": round(float(np.median(walls[1:])), 3),
        "frame_min_ms": round(min(walls[1:]), 3),
        "core_alone": alone,
    }


def peak_from_here() -> bool:
    """Let the system forget the largest memory of this process so far; return False where it cannot."""
    try:
        Path("/proc/self/clear_refs").write_text("5")
    except OSError:
        return False
    return True


def peak_memory() -> float | None:
    """Return the largest resident memory since `peak_from_here`, in 2²⁰ bytes."""
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith("VmHWM:"):
            return round(int(line.split()[1]) * 1024 / MEGABYTE, 1)
    return None
