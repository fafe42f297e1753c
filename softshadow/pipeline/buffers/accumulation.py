"""The accumulation buffer: 16-bit integers, -1 to 1, rounded as Mesa rounds them.

Products are truncated: 256 times glAccum(GL_ACCUM, 1/256) of a byte loses up to half a step each time.

References: GL 2.1, sec. 4.2.4; Mesa 22.3, main/accum.c.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from softshadow import tokens as gl
from softshadow.framebuffer import Framebuffer, Storage
from softshadow.jit import kernel
from softshadow.pipeline.commands import Accumulate
from softshadow.pipeline.constants import ONE, ZERO
from softshadow.pipeline.memory.threads import parts_of, share
from softshadow.pipeline.raster.region import region_of
from softshadow.pipeline.records import Region
from softshadow.pipeline.shade.color_writes import LARGEST_BYTE
from softshadow.programs.wrapping import to_int32

LARGEST_SUM = np.float32(32767)
BYTE_STEP = np.float32(1) / np.float32(255)
CHANNELS = 4
PIXELS_PER_TASK = 1 << 18  # that a thread processes in one go


def accumulate(command: Accumulate, storage: Storage) -> None:
    """Carry out glAccum on the pixels inside the buffers and the scissor box."""
    state, value = command.state, np.float32(command.value)
    target = storage.framebuffers[state.draw_framebuffer]
    region = region_of(state, target)
    where = np.s_[region.first_row : region.end_row, region.left : region.right]
    sums = buffer_of(target)
    if command.operation == gl.GL_ADD:
        sums[where] += truncate(value * LARGEST_SUM)
    elif command.operation == gl.GL_MULT:
        sums[where] = truncate(sums[where].astype(np.float32) * value)
    elif command.operation == gl.GL_RETURN:
        colors, mask = np.empty_like(sums, np.uint8), np.array(state.color.mask)
        by_rows(write_bytes, region, sums, value / LARGEST_SUM, colors)
        for image in target.colors:
            image.cells[where] = colors[where] if mask.all() else np.where(mask, colors[where], image.cells[where])
    elif target.read_color is not None:
        if command.operation == gl.GL_LOAD:
            sums[where] = 0
        by_rows(add_products, region, target.read_color.cells, value * LARGEST_SUM, sums)


def by_rows(work: Callable[..., None], region: Region, source: np.ndarray, factor: np.float32, out: np.ndarray) -> None:
    """Call ``work(source, factor, left, right, out)`` for bands of rows of a region, on all threads.

    `source` and `out` (rows, columns, 4) are passed as rows of channels, of which [left, right) are in the region.
    """
    first, columns = region.first_row, (CHANNELS * region.left, CHANNELS * region.right)
    from_rows, to_rows = (cells.reshape(len(cells), -1)[first : region.end_row] for cells in (source, out))

    parts = parts_of(len(from_rows), PIXELS_PER_TASK // max(region.right - region.left, 1))

    def work_on_rows(n: int) -> None:
        rows = slice(*parts[n])
        with np.errstate(all="ignore"):  # set per thread
            work(from_rows[rows], factor, *columns, to_rows[rows])

    share(work_on_rows, len(parts))


@kernel
def add_products(colors, factor, left, right, sums):
    """Add bytes, as 0 to 1, times a factor to the sums; products are truncated, sums wrap around."""
    for row in range(colors.shape[0]):
        source, target = colors[row, left:right], sums[row, left:right]
        for i in range(source.shape[0]):
            target[i] += np.int16(to_int32(np.float32(source[i]) * BYTE_STEP * factor))


@kernel
def write_bytes(sums, factor, left, right, colors):
    """Write sums times a factor as bytes, clamped to [0, 1]; NaN becomes 0."""
    for row in range(sums.shape[0]):
        source, target = sums[row, left:right], colors[row, left:right]
        for i in range(source.shape[0]):
            value = np.float32(source[i]) * factor
            value = value if value > ZERO else ZERO
            target[i] = np.uint8(np.rint((value if value < ONE else ONE) * LARGEST_BYTE))


def buffer_of(target: Framebuffer) -> np.ndarray:
    """Return the accumulation buffer (rows, columns, 4) int16 of the window, created when first needed."""
    if target.accumulation is None:
        width, height = target.size
        target.accumulation = np.zeros((height, width, CHANNELS), np.int16)
    return target.accumulation


def truncate(values: np.ndarray | np.float32) -> np.ndarray:
    """Return values as 16-bit integers, truncated and wrapped around."""
    return np.asarray(values).astype(np.int32).astype(np.int16)


def clear_value(color: tuple[float, ...]) -> np.ndarray:
    """Return what glClear writes, (4,) int16."""
    spread = (np.float32(65535) * np.array(color, np.float32)).astype(np.int32) - 1
    return np.trunc(spread / 2).astype(np.int16)
