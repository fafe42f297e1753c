"""Copy framebuffers to textures, and view them in the order of GL's rows."""

from __future__ import annotations

import numpy as np

from softshadow.color_values import F32, color_as_float, to_base
from softshadow.framebuffer import Framebuffer, Storage
from softshadow.image import Image
from softshadow.jit import kernel
from softshadow.pipeline.commands import CopyToTexture
from softshadow.pipeline.constants import ONE, ZERO
from softshadow.pixel_transfer import PixelTransfer
from softshadow.pixels import (
    LARGEST_UINT,
    pack_depth,
    quantized_depth,
    sampled_depth,
    stored_units,
    to_cells,
)
from softshadow.texel_codes import drawn_cells

LARGEST_BYTE = np.float32(255)


def bottom_up(target: Framebuffer, image: Image) -> np.ndarray:
    """Return the cells of a framebuffer's image, for reading, with row 0 at the bottom: the one place that flips."""
    cells = image.read_cells[:, : image.width]
    return cells[::-1] if target.flipped else cells


def clipped(target: Framebuffer, x: int, y: int, width: int, height: int) -> tuple[slice, slice, int, int]:
    """Return the rows and columns of a rectangle inside the framebuffer, and the shift of its lower left corner."""
    total_width, total_height = target.size
    if 0 <= x <= x + width <= total_width and 0 <= y <= y + height <= total_height:
        return slice(y, y + height), slice(x, x + width), 0, 0
    left, bottom = min(max(x, 0), total_width), min(max(y, 0), total_height)
    right, top = min(max(x + width, left), total_width), min(max(y + height, bottom), total_height)
    return slice(bottom, top), slice(left, right), left - x, bottom - y


def copy_to_texture(command: CopyToTexture, storage: Storage) -> None:
    """Copy a rectangle of the read framebuffer into a texture's image, as llvmpipe does.

    The texture's format says what is copied: depth (with stencil in packed formats) or colour. Between equal
    formats it is copied unchanged. Between different formats, and out of the flipped window, depth goes through
    float32, which increases up to a quarter of 24-bit values by one.
    """
    source = storage.framebuffers[command.framebuffer]
    image = storage.textures[command.texture].images[command.face, command.level]
    rows, columns, moved_x, moved_y = clipped(source, command.x, command.y, command.width, command.height)
    left, bottom = command.x_offset + moved_x, command.z * image.height + command.y_offset + moved_y
    for buffer, source_buffer in _buffer_pairs(source, image):
        cells = bottom_up(source, source_buffer)[rows, columns]
        height, width = cells.shape[:2]
        place = np.s_[bottom : bottom + height, left : left + width]
        transfer, is_depth = command.transfer, buffer.format.kind == "depth"
        if transfer is not None and is_depth and transfer.changes_depth:
            copied = _transferred_depth(cells, source_buffer, buffer, transfer)
        elif transfer is not None and buffer.format.kind in ("unorm8", "float") and transfer.through_floats:
            copied = _transferred_color(cells, source_buffer, buffer, transfer)
        elif is_depth and source.flipped and _is_float32(source_buffer) and _is_float32(buffer):
            last_row = source_buffer.height - 1 - rows.start  # the lowest row of the rectangle
            write_depth_upwards(
                source_buffer.read_cells, last_row, columns.start, F32(1) / F32(source_buffer.format.largest),
                F32(buffer.format.largest), buffer.view[place],
            )  # fmt: skip
            continue
        elif is_depth:
            copied = _convert_depth(cells, source_buffer, buffer, source.flipped)
        else:
            copied = convert_color(cells, source_buffer, buffer)
        buffer.view[place] = copied


def _is_float32(image: Image) -> bool:
    """Return whether an image has fixed-point depth that is stored in float32: 16 or 24 bits."""
    return image.format.largest > 0 and image.format.dtype is F32


@kernel
def write_depth_upwards(cells, last_row, first_column, step, largest, copied):
    """Write `_convert_depth` of the rows from `last_row` on upwards, for formats of 16 and 24 bits."""
    for j in range(copied.shape[0]):
        row = np.uint64(last_row - j)
        for i in range(copied.shape[1]):
            copied[j, i] = np.rint(cells[row, np.uint64(first_column + i)] * step * largest)


def _buffer_pairs(source: Framebuffer, image: Image) -> list[tuple[Image, Image]]:
    """Return pairs (buffer of the texture, buffer of the framebuffer); the caller has checked that they exist."""
    if image.format.kind != "depth":
        assert source.read_color is not None
        return [(image, source.read_color)]
    assert source.depth is not None
    pairs = [(image, source.depth)]
    if image.stencil is not None and source.stencil is not None:
        pairs.append((image.stencil, source.stencil))
    return pairs


def _convert_depth(cells: np.ndarray, source: Image, image: Image, flipped: bool) -> np.ndarray:
    if source.format == image.format and not flipped:
        return cells
    return quantized_depth(sampled_depth(cells, source.format), image.format)


def _transferred_color(cells: np.ndarray, source: Image, image: Image, transfer: PixelTransfer) -> np.ndarray:
    colors = color_as_float(to_base(cells, source.format.base))
    return to_cells(transfer.color(colors), image.format)


def _transferred_depth(cells: np.ndarray, source: Image, image: Image, transfer: PixelTransfer) -> np.ndarray:
    """Return depths after scale and bias, in 32 bits on the way, as in Mesa."""
    units = transfer.scaled_depth_units(pack_depth(cells, source.format, np.uint32).astype(np.float64))
    largest = image.format.largest
    if not largest:
        return (units / LARGEST_UINT).astype(np.float32)
    return stored_units(units) if largest == LARGEST_UINT else np.floor(units / ((LARGEST_UINT + 1) // (largest + 1)))


def convert_color(cells: np.ndarray, source: Image, image: Image) -> np.ndarray:
    """Return cells of one colour image in the format of another; stencil values stay as they are."""
    if image.format.kind == "stencil":
        return cells
    if image.format.encoding:
        return drawn_cells(to_base(color_as_float(cells), image.format.base), image.format)
    if source.format.kind != image.format.kind:
        if image.format.kind == "float":
            cells = color_as_float(cells)
        else:
            floats, cells = np.ascontiguousarray(cells), np.empty(cells.shape, np.uint8)
            round_to_bytes(floats.reshape(-1), cells.reshape(-1))
    return to_base(cells, image.format.base)


@kernel
def round_to_bytes(floats, out):
    """Write colours (n,) as bytes; what is not a number becomes 0."""
    for i in range(len(out)):
        value = floats[i] if floats[i] > ZERO else ZERO
        out[i] = np.uint8(np.rint((value if value < ONE else ONE) * LARGEST_BYTE))
