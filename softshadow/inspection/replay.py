"""Playing a recorded frame again: the window's buffers after any step, kept while they fit into a number of bytes."""

from __future__ import annotations

from collections import OrderedDict
from typing import NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Frame
from softshadow.errors import StateError
from softshadow.framebuffer import Framebuffer, Storage
from softshadow.image import Format
from softshadow.pipeline.execute import execute
from softshadow.pixels import depth_as_float

BUDGET = 256 << 20  # bytes


class Buffers(NamedTuple):
    """The window at one moment, row 0 on top, read-only.

    color (H, W, 4) uint8; depth (H, W) float32, window z in [0, 1]; stencil (H, W) uint8.
    """

    color: np.ndarray
    depth: np.ndarray
    stencil: np.ndarray

    @property
    def bytes(self) -> int:
        return sum(plane.nbytes for plane in self)


class Cells(NamedTuple):
    """The window at one moment, copied as it is stored; it becomes `Buffers` when these are asked for."""

    color: np.ndarray
    depth: np.ndarray
    stencil: np.ndarray
    depth_format: Format

    def buffers(self) -> Buffers:
        """Return what a read-out delivers."""
        made = Buffers(self.color, np.ascontiguousarray(depth_as_float(self.depth, self.depth_format)), self.stencil)
        for plane in made:
            plane.setflags(write=False)
        return made

    @property
    def bytes(self) -> int:
        return self.color.nbytes + self.depth.nbytes + self.stencil.nbytes


def copy_window(window: Framebuffer, before: Cells | None = None) -> Cells:
    """Return the window's cells. It is stored top row first, so nothing is flipped.

    Planes that are as they were in `before` are shared with it: comparing takes a tenth of the time of fresh memory.
    """
    color, depth, stencil = window.image(gl.GL_COLOR_ATTACHMENT0), window.depth, window.stencil
    assert color is not None
    assert depth is not None
    assert stencil is not None
    now = Cells(color.view, depth.view, stencil.view, depth.format)
    if before is None:
        return Cells(now.color.copy(), now.depth.copy(), now.stencil.copy(), depth.format)
    return Cells(
        shared_or_copied(now.color, before.color),
        shared_or_copied(now.depth, before.depth),
        shared_or_copied(now.stencil, before.stencil),
        depth.format,
    )


def shared_or_copied(now: np.ndarray, before: np.ndarray) -> np.ndarray:
    """Return the earlier plane where nothing has changed, else a copy."""
    return before if np.array_equal(now, before) else now.copy()


class Replay:
    """A recorded frame that can be played to any command, on storage of its own.

    Parameters
    ----------
    frame : Frame                the recording; not changed
    budget : int                 bytes of buffers to keep; what does not fit is played again when asked for
    """

    def __init__(self, frame: Frame, budget: int = BUDGET) -> None:
        self.frame, self.budget = frame, budget
        self._kept: OrderedDict[int, Buffers | Cells] = OrderedDict()
        self._last: Cells | None = None
        self._storage: Storage | None = None  # made when something is played
        self._played = 0

    def storage_after(self, commands: int) -> Storage:
        """Return the storage as it was after the first `commands` commands; it is played on by the next call.

        Raises
        ------
        StateError                   the recording is shorter
        """
        recorded = self.frame.commands
        if not 0 <= commands <= len(recorded):
            raise StateError(f"commands={commands}: the recording has {len(recorded)}")
        if self._storage is None or commands < self._played:
            self._storage, self._played = self.frame.fresh_storage(), 0
        for command in recorded[self._played : commands]:
            execute(command, self._storage)
        self._played = commands
        return self._storage

    def after_step(self, index: int) -> Buffers:
        """Return the window's buffers at the end of a step."""
        if index not in self._kept:
            self.keep_window(index, self.storage_after(self.frame.steps[index][1]).window)
        kept = self._kept[index]
        if isinstance(kept, Cells):
            kept = self._kept[index] = kept.buffers()
        self._kept.move_to_end(index)
        return kept

    def keep_window(self, index: int, window: Framebuffer) -> None:
        """Keep what the window holds at the end of a step."""
        self._last = copy_window(window, self._last)
        self.keep(index, self._last)

    def keep(self, index: int, buffers: Buffers | Cells) -> None:
        """Keep the buffers of a step; the longest unused ones make room for it."""
        self._kept[index] = buffers
        while len(self._kept) > 1 and sum(each.bytes for each in self._kept.values()) > self.budget:
            self._kept.popitem(last=False)
