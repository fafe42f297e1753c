"""glClear: colour, depth and stencil under their masks, inside the scissor box.

The stencil mask is that of front faces.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.framebuffer import DEFAULT, Framebuffer, Storage
from softshadow.image import EXACT_DEPTH, Format, Image
from softshadow.pipeline.buffers import accumulation
from softshadow.pipeline.commands import Clear
from softshadow.pipeline.raster.region import region_of
from softshadow.pipeline.records import Region
from softshadow.pipeline.shade.blend import to_unorm8
from softshadow.pipeline.shade.color_writes import as_pixels
from softshadow.pixels import quantized_depth, stored_units
from softshadow.state import State
from softshadow.texel_codes import drawn_cells


def clear(command: Clear, storage: Storage) -> None:
    """Clear the buffers that the command's mask names (GL 2.1, sec. 4.2.3)."""
    state = command.state
    target = storage.framebuffers[state.draw_framebuffer]
    region = region_of(state, target)
    where = np.s_[region.first_row : region.end_row, region.left : region.right]
    for image in target.colors if command.mask & gl.GL_COLOR_BUFFER_BIT else ():
        is_unorm8 = image.format.kind == "unorm8"
        if is_unorm8 and _is_all_of(image, region) and all(state.color.mask) and all(image.format.written):
            image.write_later(0, _rows_of_pixels(state.color.clear, image.shape), None)
            continue
        color = np.array(state.color.clear, np.float32)
        value = to_unorm8(color) if is_unorm8 else drawn_cells(color, image.format)
        written = np.array(state.color.mask) & np.array(image.format.written)
        if written.all() and is_unorm8:
            as_pixels(image.cells)[where] = as_pixels(value)
        elif written.all():  # a row at a time: pixel by pixel takes ten times as long
            image.cells[where] = np.tile(value, (max(region.right - region.left, 0), 1))
        else:
            for channel in np.flatnonzero(written):
                image.cells[where][..., channel] = value[channel]
    if command.mask & gl.GL_DEPTH_BUFFER_BIT and target.depth is not None and state.depth.write:
        by_drawing = clears_by_drawing(state, target, command.mask) and target.depth.format != EXACT_DEPTH
        value_of = drawn_clear_depth if by_drawing else clear_depth
        write_region(target.depth, region, value_of(state.depth.clear, target.depth))
    if command.mask & gl.GL_STENCIL_BUFFER_BIT and target.stencil is not None:
        largest = target.stencil.format.largest
        mask = state.stencil.front.write_mask & largest
        if mask == largest:
            write_region(target.stencil, region, state.stencil.clear & mask)
        else:
            cells = target.stencil.cells[where]
            cells[:] = (cells & (largest ^ mask)) | (state.stencil.clear & mask)
    if command.mask & gl.GL_ACCUM_BUFFER_BIT and target.name == DEFAULT:
        # the four sums of a pixel as one number: sum by sum takes ten times as long
        sums, value = accumulation.buffer_of(target), accumulation.clear_value(state.color.clear_accum)
        sums.view(np.int64)[..., 0][where] = value.view(np.int64)[0]


def write_region(image: Image, region: Region, value: float) -> None:
    """Write a value to a region of depth or stencil cells; a clear of all cells gets a version token of the value."""
    if _is_all_of(image, region):
        rows, version = _rows_of_cells(value, image.format, image.shape)
        image.write_later(0, rows, version)
    else:
        image.cells[region.first_row : region.end_row, region.left : region.right] = value


# A program clears all frames with the same values. Where two values are equal, so are their cells: a depth or stencil
# clear value is never -0.0, and a colour of 8 bits has no sign.
@lru_cache(maxsize=64)
def _rows_of_pixels(color: tuple[float, ...], shape: tuple[int, int]) -> np.ndarray:
    return np.broadcast_to(as_pixels(to_unorm8(np.array(color, np.float32))), shape)


@lru_cache(maxsize=64)
def _rows_of_cells(value: float, format: Format, shape: tuple[int, int]) -> tuple[np.ndarray, Any]:
    """Return the rows of a cleared image, and their version token."""
    cell = np.array(value, format.dtype)
    return np.broadcast_to(cell, shape), (cell.tobytes(), format, shape)


def _is_all_of(image: Image, region: Region) -> bool:
    return (region.left, region.right, region.first_row, region.end_row) == (0, image.width, 0, image.height)


def clear_depth(value: float, depth: Image) -> float:
    """Return the clear depth in buffer units: rounded in double precision for fixed-point formats."""
    return _clear_units(min(max(value, 0.0), 1.0), depth.format.largest)


@lru_cache(maxsize=64)
def _clear_units(value: float, largest: int) -> float:
    return float(stored_units(np.rint(value * largest))) if largest else value


def clears_by_drawing(state: State, target: Framebuffer, mask: int) -> bool:
    """Return whether llvmpipe clears depth by drawing a rectangle: a scissor box or a stencil mask limits the clear."""
    box = state.scissor
    if box.enabled:
        width, height = target.size
        if box.x > 0 or box.y > 0 or box.x + box.width < width or box.y + box.height < height:
            return True
    if not mask & gl.GL_STENCIL_BUFFER_BIT or target.stencil is None:
        return False
    largest = target.stencil.format.largest
    return 0 < state.stencil.front.write_mask & largest < largest


def drawn_clear_depth(value: float, depth: Image) -> float:
    """Return the depth of that rectangle in buffer units: the way through clip space costs the last bits of float32."""
    clip = np.float32(min(max(value, 0.0), 1.0) * 2 - 1)
    z = clip * np.float32(0.5) + np.float32(0.5)
    return float(quantized_depth(np.array([z], np.float32), depth.format)[0])
