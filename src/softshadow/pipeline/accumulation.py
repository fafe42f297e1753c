"""The accumulation buffer: 16-bit integers, -1 to 1, rounded as Mesa rounds them.

Products are cut towards zero: 256 times glAccum(GL_ACCUM, 1/256) of a byte loses up to half a step each time.

References: GL 2.1, sec. 4.2.4; Mesa 22.3, main/accum.c.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from softshadow import tokens as gl
from softshadow.framebuffer import Framebuffer, Storage
from softshadow.pipeline.bands import in_batches
from softshadow.pipeline.blend import to_unorm8
from softshadow.pipeline.geometry import region_of

if TYPE_CHECKING:
    from softshadow.pipeline.commands import Accumulate

LARGEST = np.float32(32767)
BYTE_STEP = np.float32(1) / np.float32(255)
CHANNELS = 4
ROWS = 16  # at a time; 640 columns of their intermediate floats stay in the cache


def accumulate(command: Accumulate, storage: Storage) -> None:
    """Carry out glAccum on the pixels inside the buffers and the scissor box."""
    state, value = command.state, np.float32(command.value)
    target = storage.framebuffers[state.draw_framebuffer]
    region = region_of(state, target)
    where = np.s_[region.first_row : region.end_row, region.left : region.right]
    sums = buffer_of(target)[where]
    if command.operation == gl.GL_ADD:
        sums += cut(value * LARGEST)
    elif command.operation == gl.GL_MULT:
        sums[:] = cut(sums.astype(np.float32) * value)
    elif command.operation == gl.GL_RETURN:
        colors = to_unorm8(sums.astype(np.float32) * (value / LARGEST))
        for image in target.colors:
            for channel in np.flatnonzero(state.color.mask):
                image.cells[where][..., channel] = colors[..., channel]
    elif target.read_color is not None:
        if command.operation == gl.GL_LOAD:
            sums[:] = 0
        add_products(target.read_color.cells[where], value, sums)


def add_products(colors: np.ndarray, value: np.float32, sums: np.ndarray) -> None:
    """Add bytes (rows, columns, 4) times a value to the sums, a few rows at a time, which stay in the cache."""

    def rows(first: int, end: int) -> None:
        with np.errstate(all="ignore"):  # set per thread
            sums[first:end] += cut(colors[first:end].astype(np.float32) * BYTE_STEP * (value * LARGEST))

    in_batches(rows, len(colors), ROWS)


def buffer_of(target: Framebuffer) -> np.ndarray:
    """Return the accumulation buffer (rows, columns, 4) int16 of the window, made where it is first needed."""
    if target.accumulation is None:
        width, height = target.size
        target.accumulation = np.zeros((height, width, CHANNELS), np.int16)
    return target.accumulation


def cut(values: np.ndarray | np.float32) -> np.ndarray:
    """Return 16-bit integers, cut towards zero, wrapped around."""
    return np.asarray(values).astype(np.int32).astype(np.int16)


def clear_value(color: tuple[float, ...]) -> np.ndarray:
    """Return what glClear writes, (4,) int16."""
    spread = (np.float32(65535) * np.array(color, np.float32)).astype(np.int32) - 1
    return np.trunc(spread / 2).astype(np.int16)
