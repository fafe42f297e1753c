"""Transfers between images: framebuffer to texture, and the view of a framebuffer that GL's rows count in."""

from __future__ import annotations

import numpy as np

from softshadow.framebuffer import Framebuffer, Storage
from softshadow.image import Image
from softshadow.pipeline.commands import CopyToTexture
from softshadow.pixels import color_as_float, quantized_depth, sampled_depth, to_base


def bottom_up(target: Framebuffer, image: Image) -> np.ndarray:
    """Return the cells of an image of the framebuffer as a view, row 0 at the bottom: the one place that flips."""
    return image.view[::-1] if target.flipped else image.view


def clipped(target: Framebuffer, x: int, y: int, width: int, height: int) -> tuple[slice, slice, int, int]:
    """Return rows and columns of a rectangle inside the framebuffer, and how far its left lower corner moved."""
    total_width, total_height = target.size
    left, bottom = min(max(x, 0), total_width), min(max(y, 0), total_height)
    right, top = min(max(x + width, left), total_width), min(max(y + height, bottom), total_height)
    return np.s_[bottom:top], np.s_[left:right], left - x, bottom - y


def copy_to_texture(command: CopyToTexture, storage: Storage) -> None:
    """Copy a rectangle of the read framebuffer into a texture's image, as llvmpipe does.

    The texture's format says what is copied: depth (with stencil in packed formats) or colour. A copy between equal
    formats is plain, out of the flipped window it is not: there, as between formats, depth goes through float32, and
    of 24-bit values up to a quarter grows by one.
    """
    source = storage.framebuffers[command.framebuffer]
    image = storage.textures[command.texture].images[command.face, command.level]
    rows, columns, moved_x, moved_y = clipped(source, command.x, command.y, command.width, command.height)
    left, bottom = command.x_offset + moved_x, command.y_offset + moved_y
    for plane, from_plane in _planes(source, image):
        cells = bottom_up(source, from_plane)[rows, columns]
        height, width = cells.shape[:2]
        plane.view[bottom : bottom + height, left : left + width] = (
            _convert_depth(cells.copy(), from_plane, plane, source.flipped)
            if plane.format.kind == "depth"
            else convert_color(cells.copy(), from_plane, plane)
        )


def _planes(source: Framebuffer, image: Image) -> list[tuple[Image, Image]]:
    """Return (plane of the texture, plane of the framebuffer) pairs; the caller has made sure that they exist."""
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


def convert_color(cells: np.ndarray, source: Image, image: Image) -> np.ndarray:
    """Return cells of one colour image as those of another; stencil values stay as they are."""
    if image.format.kind == "stencil":
        return cells
    if source.format.kind != image.format.kind:
        if image.format.kind == "float":
            cells = color_as_float(cells)
        else:
            cells = np.rint(np.clip(cells, np.float32(0), np.float32(1)) * np.float32(255)).astype(np.uint8)
    return to_base(cells, image.format.base)
