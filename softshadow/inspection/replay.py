"""Replaying a recorded frame: the window's buffers after any step, cached up to a number of bytes."""

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

BUDGET = 256 << 20  # bytes of cached buffers


class Buffers(NamedTuple):
    """The window's buffers after a step, row 0 on top, read-only.

    color (H, W, 4) uint8; depth (H, W) float32, window z in [0, 1]; stencil (H, W) uint8.
    """

    color: np.ndarray
    depth: np.ndarray
    stencil: np.ndarray

    def __repr__(self) -> str:
        height, width = self.stencil.shape
        return f"Buffers({width} x {height}: color, depth, stencil)"

    @property
    def bytes(self) -> int:
        """The size of the buffers in bytes."""
        return sum(buffer.nbytes for buffer in self)


class Cells(NamedTuple):
    """The window's cells after a step in their stored format; they are converted to `Buffers` when needed."""

    color: np.ndarray
    depth: np.ndarray
    stencil: np.ndarray
    depth_format: Format

    def buffers(self) -> Buffers:
        """Return the buffers as glReadPixels returns them, but row 0 on top."""
        depth = np.ascontiguousarray(depth_as_float(self.depth, self.depth_format))
        for buffer in (self.color, depth, self.stencil):
            buffer.setflags(write=False)
        return Buffers(self.color, depth, self.stencil)

    @property
    def bytes(self) -> int:
        """The size of the cells in bytes."""
        return self.color.nbytes + self.depth.nbytes + self.stencil.nbytes


def copy_window(window: Framebuffer, before: Cells | None = None) -> Cells:
    """Return a copy of the window's cells. They are stored top row first, so nothing is flipped.

    Buffers that equal those of `before` are shared with it: comparing takes a tenth of the time of new memory.
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
    """Return the earlier buffer if nothing has changed, else a copy of the present one."""
    return before if np.array_equal(now, before) else now.copy()


class Replay:
    """A recorded frame that can be replayed up to any command, on its own storage.

    Parameters
    ----------
    frame : Frame                the recording; it is not changed
    budget : int                 bytes of buffers to cache; the others are replayed when needed
    """

    def __init__(self, frame: Frame, budget: int = BUDGET) -> None:
        self.frame, self.budget = frame, budget
        self._cache: OrderedDict[int, Buffers | Cells] = OrderedDict()  # by step, least recently used first
        self._last: Cells | None = None
        self._storage: Storage | None = None  # allocated by the first replay
        self._played, self._dropped = 0, 0  # number of commands; of those that the frame had dropped by then

    def storage_after(self, commands: int) -> Storage:
        """Return the storage as it was after the first `commands` commands; the next call changes it.

        Raises
        ------
        StateError                   the recording is shorter
        """
        recorded = self.frame.commands
        if not 0 <= commands <= len(recorded):
            raise StateError(f"commands={commands}: the recording has {len(recorded)}")
        if self._storage is None or commands < self._played or self._dropped != self.frame.dropped:
            self._storage, self._played, self._dropped = self.frame.fresh_storage(), 0, self.frame.dropped
        for command in recorded[self._played : commands]:
            execute(command, self._storage)
        self._played = commands
        return self._storage

    def after_step(self, index: int) -> Buffers:
        """Return the window's buffers at the end of a step."""
        if index not in self._cache:
            self.cache_window(index, self.storage_after(self.frame.steps[index][1]).window)
        buffers = self._cache[index]
        if isinstance(buffers, Cells):
            buffers = self._cache[index] = buffers.buffers()
        self._cache.move_to_end(index)
        return buffers

    def cache_window(self, index: int, window: Framebuffer) -> None:
        """Cache the window's present contents as those at the end of a step."""
        self._last = copy_window(window, self._last)
        self.cache(index, self._last)

    def cache(self, index: int, buffers: Buffers | Cells) -> None:
        """Cache the buffers of a step; the least recently used ones make room for them."""
        self._cache[index] = buffers
        while len(self._cache) > 1 and sum(each.bytes for each in self._cache.values()) > self.budget:
            self._cache.popitem(last=False)
