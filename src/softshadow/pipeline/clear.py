"""glClear:

Colour under its mask, depth under its mask, stencil under the front write mask, all inside the scissor box.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from softshadow import tokens as gl
from softshadow.framebuffer import Storage
from softshadow.image import Image
from softshadow.pipeline.blend import to_unorm8
from softshadow.pipeline.geometry import region_of

if TYPE_CHECKING:
    from softshadow.pipeline.commands import Clear


def clear(command: Clear, storage: Storage) -> None:
    """Clear the buffers that the command's mask names (GL 2.1, sec. 4.2.3)."""
    state = command.state
    target = storage.framebuffers[state.draw_framebuffer]
    region = region_of(state, target)
    where = np.s_[region.first_row : region.end_row, region.left : region.right]
    if command.mask & gl.GL_COLOR_BUFFER_BIT and target.color is not None:
        color = np.array(state.color.clear, np.float32)
        value = to_unorm8(color) if target.color.format.kind == "unorm8" else color
        for channel, written in enumerate(state.color.mask):
            if written:
                target.color.cells[where][..., channel] = value[channel]
    if command.mask & gl.GL_DEPTH_BUFFER_BIT and target.depth is not None and state.depth.write:
        target.depth.cells[where] = clear_depth(state.depth.clear, target.depth)
    if command.mask & gl.GL_STENCIL_BUFFER_BIT and target.stencil is not None:
        cells, largest = target.stencil.cells[where], target.stencil.format.largest
        mask = state.stencil.front.write_mask & largest
        cells[:] = (cells & (largest ^ mask)) | (state.stencil.clear & mask)


def clear_depth(value: float, depth: Image) -> float:
    """Return the clear depth in buffer units: rounded in double precision for fixed-point formats."""
    clamped = min(max(value, 0.0), 1.0)
    return float(np.rint(clamped * depth.format.largest)) if depth.format.largest else clamped
