"""Measure programs: compare the buffers first, then time frames in fresh processes, in turns.

llvmpipe is timed with its fastest settings, and compared without fused multiply-add: with it, its results depend on the
processor.
"""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np

from softshadow.bench.corpus.child import OWN
from softshadow.bench.corpus.program import Program
from softshadow.bench.corpus.results import ProgramTimes
from softshadow.testing import MesaError, mesa_available, mesa_reason

MESA, CHILD = "llvmpipe", "softshadow.bench.corpus.child"
SECONDS = 0.15  # of each side in a round
MOST_FRAMES = 40  # of each side in a round
WITHOUT_FUSING = {"GALLIUM_OVERRIDE_CPU_CAPS": "sse4.1"}


class Child:
    """A process that draws a program on one side; see `softshadow.bench.corpus.child`."""

    def __init__(self, side: str, program: Program, threads: int, more: dict[str, str] | None = None) -> None:
        environment = {
            **os.environ,
            "PYTHONPATH": os.pathsep.join(entry or os.getcwd() for entry in sys.path),
            "GALLIUM_DRIVER": MESA,
            # LP_NUM_THREADS=1 would add a rasterizer thread to the calling thread, which makes two
            "LP_NUM_THREADS": "0" if threads == 1 else str(threads),
            "SOFTSHADOW_THREADS": str(threads),
            "NUMBA_NUM_THREADS": str(threads),
            **(more or {}),
        }
        self.name = f"{program.name} on {side}"
        self.process = subprocess.Popen(
            [sys.executable, "-P", "-m", CHILD, side, program.name, f"{program.size[0]}x{program.size[1]}"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            env=environment,
        )
        self._receive()

    def draw(self, frames: int, file: Path | None = None) -> dict[str, Any]:
        """Draw frames, and return their milliseconds and the memory; write the last one's buffers to a file (.npz).

        Raises
        ------
        MesaError                    the process has ended
        """
        assert self.process.stdin is not None
        self.process.stdin.write(f"{frames} {file or '-'}\n")
        self.process.stdin.flush()
        return self._receive()

    def _receive(self) -> dict[str, Any]:
        assert self.process.stdout is not None
        line = self.process.stdout.readline()
        if not line:
            raise MesaError(f"the process of {self.name} ended (exit code {self.process.wait()})")
        answer: dict[str, Any] = json.loads(line)
        return answer

    def close(self) -> None:
        """End the process."""
        for pipe in (self.process.stdin, self.process.stdout):
            assert pipe is not None
            pipe.close()
        self.process.wait()


@contextmanager
def child(side: str, program: Program, threads: int, more: dict[str, str] | None = None) -> Iterator[Child]:
    """Inside, a process draws the program."""
    process = Child(side, program, threads, more)
    try:
        yield process
    finally:
        process.close()


def measure(program: Program, threads: Sequence[int], rounds: int) -> list[ProgramTimes]:
    """Return the times of a program on Mesa and on softshadow, and how many pixels differ, for each number of threads.

    All processes draw in each round, so that ratios compare times of the same seconds: also those of one number of
    threads with those of another.

    Raises
    ------
    MesaError                    Mesa is missing, or a process ended
    """
    if not mesa_available():
        raise MesaError(mesa_reason())
    # which also fills the disk caches of both sides
    differing = {number: differing_pixels(program, number) for number in threads}
    with ExitStack() as processes:
        sides = {
            (side, number): processes.enter_context(child(side, program, number))
            for number in threads
            for side in (MESA, OWN)
        }
        first = {peer: each.draw(1)["milliseconds"][0] for peer, each in sides.items()}
        frames = {peer: frames_in_a_round(each.draw(3)["milliseconds"]) for peer, each in sides.items()}
        times: dict[tuple[str, int], list[float]] = {peer: [] for peer in sides}
        memory = {}
        for _ in range(rounds):
            for peer, each in sides.items():
                answer = each.draw(frames[peer])
                times[peer].append(median(answer["milliseconds"]))
                memory[peer] = answer["memory"]
    return [
        ProgramTimes(
            program.name, program.size, number, median(times[MESA, number]), median(times[OWN, number]),
            median(mesa / own for mesa, own in zip(times[MESA, number], times[OWN, number], strict=True)),
            first[MESA, number], first[OWN, number], *differing[number], memory[OWN, number],
        )
        for number in threads
    ]  # fmt: skip


def frames_in_a_round(milliseconds: list[float]) -> int:
    """Return how many frames take about `SECONDS`."""
    return max(1, min(MOST_FRAMES, math.ceil(1e3 * SECONDS / median(milliseconds))))


def differing_pixels(program: Program, threads: int) -> tuple[dict[str, int], int]:
    """Return how many pixels differ after two frames: by buffer without fusing, and of the colours with it."""
    with tempfile.TemporaryDirectory() as folder:

        def drawn(side: str, more: dict[str, str] | None = None) -> dict[str, np.ndarray]:
            file = Path(folder, "buffers.npz")
            with child(side, program, threads, more) as process:
                process.draw(2, file)
            with np.load(file) as arrays:
                return dict(arrays)

        ours, theirs, fused = drawn(OWN), drawn(MESA, WITHOUT_FUSING), drawn(MESA)
    differing = {name: count_differing(ours[name], theirs[name]) for name in ours}
    return differing, count_differing(ours["color"], fused["color"])


def count_differing(ours: np.ndarray, theirs: np.ndarray) -> int:
    """Return the number of pixels at which two buffers (h, w[, c]) differ."""
    differs = ours != theirs
    return int(np.count_nonzero(differs.any(axis=-1) if differs.ndim == 3 else differs))
