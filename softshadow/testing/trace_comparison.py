"""Frames of recorded programs here and on Mesa: colour, depth and stencil, bit for bit."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from softshadow.recordings.left_out import LeftOut
from softshadow.recordings.replaying import frames_of, replay_frame
from softshadow.runs import Run
from softshadow.testing.comparison import BufferDifference, differences
from softshadow.testing.result import ProgramResult
from softshadow.testing.trace_on_mesa import trace_on_mesa

LARGEST_DEPTH = (1 << 24) - 1


@dataclass(frozen=True, eq=False)
class FrameComparison:
    """A frame of a trace, replayed here and on Mesa; true if it has the same bits.

    Attributes
    ----------
    frame : int                  its number, from 0
    differences : one for each buffer that differs; `y` of its first pixel counts from the bottom
    left_out : LeftOut           the calls that the replay here has left out, up to the end of the frame
    run : Run                    the frame, to ask about a pixel that differs
    """

    frame: int
    differences: tuple[BufferDifference, ...]
    left_out: tuple[LeftOut, ...]
    run: Run

    def __bool__(self) -> bool:
        return not self.differences

    def __str__(self) -> str:
        told = [f"frame {self.frame}: {each}" for each in self.differences or ("no pixel differs",)]
        return "\n".join(told + [f"left out: {each}" for each in self.left_out])


def compare_trace(
    path: str | os.PathLike[str], frames: Iterable[int] | None = None, timeout: float = 60.0
) -> list[FrameComparison]:
    """Return the comparisons of some frames of a recorded program, by default of all, with Mesa.

    Parameters
    ----------
    path : path of a .trace file
    frames : int                 numbers of frames, from 0
    timeout : float              seconds for Mesa

    Raises
    ------
    SoftShadowError              the file cannot be read
    TraceError                   it is damaged
    MesaError                    Mesa is missing, crashed, or took too long
    """
    chosen: Sequence[int] = range(len(frames_of(path).frames)) if frames is None else tuple(frames)
    return [
        compare_frame(path, frame, theirs)
        for frame, theirs in zip(chosen, trace_on_mesa(path, chosen, timeout), strict=True)
    ]


def compare_frame(path: str | os.PathLike[str], frame: int, theirs: ProgramResult) -> FrameComparison:
    """Return the comparison of a frame with what Mesa has drawn."""
    replayed = replay_frame(path, frame)
    return FrameComparison(frame, differences(window_of(replayed.run), theirs), replayed.left_out, replayed.run)


def window_of(run: Run) -> ProgramResult:
    """Return the window at the end of a run, the bottom row first."""
    buffers = run.steps[-1].buffers
    depth = np.rint(buffers.depth[::-1].astype(np.float64) * LARGEST_DEPTH).astype(np.uint32)
    return ProgramResult(buffers.color[::-1], depth, buffers.stencil[::-1])
