"""Rectangles that show texels as whole pixels; equals `draw`, see fast/test_shown_rectangles.py.

That is what glDrawPixels and glCopyPixels draw without zoom, mirrored, or enlarged by whole numbers. Their fragments
need no triangles, and their colours are copied where neither tests, blending nor fog concern them.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from softshadow.framebuffer import Framebuffer, Storage
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.fast.span_state import has_four_bytes
from softshadow.pipeline.raster.fragment_ops import FragmentOps
from softshadow.pipeline.raster.region import region_of
from softshadow.pipeline.shade.color_writes import as_pixels, colors_to_bytes, writable_bits

ALL_BITS = 0xFFFFFFFF
Place = tuple[slice, slice]


class Shown(NamedTuple):
    """What is shown: the place in the buffers, and its texels (h, w[, 4]), those of bytes as numbers of 32 bits."""

    place: Place
    texels: np.ndarray


def is_shown(command: Draw, target: Framebuffer, ops: FragmentOps) -> bool:
    """Return whether an opaque draw copies texels, and only the scissor box tests its fragments."""
    if ops.depth_test or ops.stencil_test or not shows_texels(command):
        return False
    return all(has_four_bytes(image.format) and not image.format.encoding for image in target.colors)


def shows_texels(command: Draw) -> bool:
    """Return whether the fragments of a draw have the colours of texels."""
    fog = command.state.fog
    return command.shown_at is not None and not fog.enabled and not fog.color_sum


def shown_part(command: Draw, target: Framebuffer, storage: Storage) -> Shown | None:
    """Return what a rectangle shows inside the scissor box, None for nothing."""
    assert command.shown_at is not None
    texture = storage.textures[command.state.units[0].bound_2d].images[0, 0]
    (x, y, zoom_x, zoom_y), region = command.shown_at, region_of(command.state, target)
    rows, texel_rows = _shown_side(y, zoom_y, texture.height, *_upwards(region.first_row, region.end_row, target))
    columns, texel_columns = _shown_side(x, zoom_x, texture.width, region.left, region.right)
    if rows.start >= rows.stop or columns.start >= columns.stop:
        return None
    cells = texture.read_cells
    texels = (as_pixels(cells) if cells.dtype == np.uint8 else cells)[texel_rows][:, texel_columns]
    if target.flipped:
        return Shown((slice(*_upwards(rows.start, rows.stop, target)), columns), texels[::-1])
    return Shown((rows, columns), texels)


def _upwards(first: int, end: int, target: Framebuffer) -> tuple[int, int]:
    """Return rows of the buffers counted from the bottom, or such rows as those of the buffers."""
    height = target.size[1]
    return (height - end, height - first) if target.flipped else (first, end)


def _shown_side(corner: int, zoom: int, n_texels: int, low: int, high: int) -> tuple[slice, slice | np.ndarray]:
    """Return the pixels from `low` to `high` where a side of a rectangle shows texels, and which these are."""
    first, end = sorted((corner, corner + zoom * n_texels))
    low, high = max(low, first), min(high, end)
    if zoom == 1:
        return slice(low, high), slice(low - corner, high - corner)
    pixels = np.arange(low, high)
    return slice(low, high), (pixels - corner if zoom > 0 else corner - 1 - pixels) // abs(zoom)


def show_rectangle(command: Draw, target: Framebuffer, storage: Storage) -> None:
    """Draw a rectangle that `is_shown`."""
    shown = shown_part(command, target, storage)
    if shown is not None:
        for image in target.colors:
            source = shown.texels
            if source.dtype != np.uint32:
                source = as_pixels(colors_to_bytes(source.reshape(-1, 4), image.format)).reshape(source.shape[:2])
            pixels, writable = as_pixels(image.cells)[shown.place], writable_bits(command.state, image)
            pixels[:] = source if writable == ALL_BITS else (pixels & ~writable) | (source & writable)


__all__ = ["Shown", "is_shown", "show_rectangle", "shown_part", "shows_texels"]
