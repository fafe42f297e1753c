"""Rectangles whose pixels are the texels of a texture, one by one: what glDrawPixels and glCopyPixels draw unzoomed.

Their fragments need no triangles, and their colours are copied where neither tests, blending nor fog concern them.
Equals `pipeline.draw`, see fast/test_shown_rectangles.py.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from softshadow.framebuffer import Framebuffer, Storage
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.fast.span_state import is_covered
from softshadow.pipeline.raster.fragment_ops import FragmentOps
from softshadow.pipeline.raster.region import region_of
from softshadow.pipeline.shade.color_writes import as_pixels, colors_to_bytes, writable_bits

ALL_BITS = 0xFFFFFFFF
Place = tuple[slice, slice]


class Shown(NamedTuple):
    """What is shown: cells of buffers, and the texels in the order of the buffers' rows."""

    place: Place
    texels: np.ndarray


def is_shown(command: Draw, target: Framebuffer, ops: FragmentOps) -> bool:
    """Return whether an opaque draw copies texels, and only the scissor box tests its fragments."""
    if ops.depth_test or ops.stencil_test or not shows_texels(command):
        return False
    return all(is_covered(image.format) and not image.format.encoding for image in target.colors)


def shows_texels(command: Draw) -> bool:
    """Return whether the fragments of a draw have the colours of texels, one by one."""
    fog = command.state.fog
    return command.shown_at is not None and not fog.enabled and not fog.color_sum


def shown_part(command: Draw, target: Framebuffer, storage: Storage) -> Shown | None:
    """Return what a rectangle shows inside the scissor box, None for nothing."""
    assert command.shown_at is not None
    texture = storage.textures[command.state.units[0].bound_2d].images[0, 0]
    (x, y), (_, height), region = command.shown_at, target.size, region_of(command.state, target)
    first, end = region.first_row, region.end_row
    low, high = (height - end, height - first) if target.flipped else (first, end)
    left, right = max(region.left, x), min(region.right, x + texture.width)
    bottom, top = max(low, y), min(high, y + texture.height)
    if left >= right or bottom >= top:
        return None
    texels = texture.read_cells[bottom - y : top - y, left - x : right - x]
    if target.flipped:
        return Shown(np.s_[height - top : height - bottom, left:right], texels[::-1])
    return Shown(np.s_[bottom:top, left:right], texels)


def show_rectangle(command: Draw, target: Framebuffer, storage: Storage) -> None:
    """Draw a rectangle that `is_shown`."""
    shown = shown_part(command, target, storage)
    if shown is not None:
        texels = shown.texels
        for image in target.colors:
            if texels.dtype != np.uint8:
                texels = colors_to_bytes(texels.reshape(-1, 4), image.format).reshape(texels.shape)
            source = as_pixels(texels)
            pixels, writable = as_pixels(image.cells)[shown.place], writable_bits(command.state, image)
            pixels[:] = source if writable == ALL_BITS else (pixels & ~writable) | (source & writable)


__all__ = ["Shown", "is_shown", "show_rectangle", "shown_part", "shows_texels"]
