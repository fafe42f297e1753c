"""Texture images of one, two and three dimensions: defined, and changed in part."""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.compression import COMPRESSED, CompressedFormat, chosen_format, decoded, encoded
from softshadow.context import Context, current
from softshadow.encoded_pixels import bytes_of
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.compression_problems import compression_problem, to_compress_problem, to_update_problem
from softshadow.gl.errors import fail, outside_begin
from softshadow.gl.pixel_formats import kind_of, pixels_problem, upload_problem
from softshadow.gl.pixel_memory import image_for_list, image_source
from softshadow.gl.proxy_textures import define_proxy
from softshadow.gl.texture_mipmaps import follow_base_level
from softshadow.gl.texture_problems import (
    PROXIES,
    Shape,
    base_format_problem,
    border_problem,
    internal_problem,
    level_problem,
    memory_problem,
    missing_problem,
    negative_problem,
    region_problem,
    size_problem,
)
from softshadow.gl.textures import bound_texture, face_of, image_target_problem, note_defined
from softshadow.image import FORMATS, WITH_STENCIL, Format, storage_format
from softshadow.pipeline.commands import DefineImage, UpdateImage
from softshadow.pixels import (
    unpack_color,
    unpack_depth,
    unpack_packed_depth,
    unpack_packed_stencil,
    unpack_stencil,
)
from softshadow.texture import Texture

Parts = tuple[np.ndarray | None, np.ndarray | None]  # cells and stencil values to be stored
NOTHING: Parts = (None, None)


def glTexImage1D(
    target: int, level: int, internalformat: int, width: int, border: int, format: int, type: int, pixels: Any = None
) -> None:
    """Define a level of the bound 1-D texture from a row of pixels; None fills it with zeros.

    For a proxy texture see `glTexImage2D`.
    """
    _tex_image(1, target, level, internalformat, (width, 1, 1), border, format, type, pixels)


def glTexImage2D(
    target: int,
    level: int,
    internalformat: int,
    width: int,
    height: int,
    border: int,
    format: int,
    type: int,
    pixels: Any = None,
) -> None:
    """Define a level of the bound texture from an image, first row = bottom row; None fills it with zeros.

    The target is GL_TEXTURE_2D, GL_TEXTURE_RECTANGLE or a face of a cube map. For a proxy texture only what
    glGetTexLevelParameter returns is set, to 0 if there cannot be such a texture, even while a display list is
    compiled.
    """
    _tex_image(2, target, level, internalformat, (width, height, 1), border, format, type, pixels)


def glTexImage3D(
    target: int,
    level: int,
    internalformat: int,
    width: int,
    height: int,
    depth: int,
    border: int,
    format: int,
    type: int,
    pixels: Any = None,
) -> None:
    """Define a level of the bound 3-D texture from `depth` images, one after the other; None fills it with zeros.

    For a proxy texture see `glTexImage2D`.
    """
    _tex_image(3, target, level, internalformat, (width, height, depth), border, format, type, pixels)


def glTexSubImage1D(
    target: int, level: int, xoffset: int, width: int, format: int, type: int, pixels: Any = None
) -> None:
    """Replace some texels of a level of the bound 1-D texture."""
    _tex_sub_image(1, target, level, (xoffset, 0, 0), (width, 1, 1), format, type, pixels)


def glTexSubImage2D(
    target: int,
    level: int,
    xoffset: int,
    yoffset: int,
    width: int,
    height: int,
    format: int,
    type: int,
    pixels: Any = None,
) -> None:
    """Replace a rectangle of a level of the bound texture."""
    _tex_sub_image(2, target, level, (xoffset, yoffset, 0), (width, height, 1), format, type, pixels)


def glTexSubImage3D(
    target: int,
    level: int,
    xoffset: int,
    yoffset: int,
    zoffset: int,
    width: int,
    height: int,
    depth: int,
    format: int,
    type: int,
    pixels: Any = None,
) -> None:
    """Replace a box of a level of the bound 3-D texture."""
    corner, shape = (xoffset, yoffset, zoffset), (width, height, depth)
    _tex_sub_image(3, target, level, corner, shape, format, type, pixels)


# -- carried out -------------------------------------------------------------------------------------------------------
def _tex_image(
    dimensions: int,
    target: int,
    level: int,
    internalformat: int,
    shape: Shape,
    border: int,
    format: int,
    type: int,
    pixels: Any,
) -> None:
    operation = f"glTexImage{dimensions}D"
    pixels = image_for_list(current(), pixels, *_lengths(dimensions, shape), format, type, operation)
    define = _define.__wrapped__ if target in PROXIES else _define  # type: ignore[attr-defined]
    define(operation, dimensions, target, level, internalformat, shape, border, format, type, pixels)


def _tex_sub_image(
    dimensions: int, target: int, level: int, corner: Shape, shape: Shape, format: int, type: int, pixels: Any
) -> None:
    operation = f"glTexSubImage{dimensions}D"
    (x, y, z), (width, height, slices) = map(int, corner), map(int, shape)  # C cuts fractions off
    corner, shape = (x, y, z), (width, height, slices)
    pixels = image_for_list(current(), pixels, *_lengths(dimensions, shape), format, type, operation)
    _update(operation, dimensions, target, level, corner, shape, format, type, pixels)


def _lengths(dimensions: int, shape: Shape) -> tuple[int, int, int]:
    """Return width, height and number of slices of an image in memory: 0 slices unless it has three dimensions."""
    return shape if dimensions == 3 else (shape[0], shape[1], 0)


@in_lists
def _define(
    operation: str,
    dimensions: int,
    target: int,
    level: int,
    internalformat: int,
    shape: Shape,
    border: int,
    format: int,
    type: int,
    pixels: Any,
) -> None:
    if (context := outside_begin(operation)) is None:
        return None
    is_proxy = PROXIES.get(target) == dimensions
    wanted, internalformat = internalformat, chosen_format(internalformat, dimensions)
    compressed = COMPRESSED.get(internalformat)
    problem = (
        (None if is_proxy else image_target_problem(target, dimensions))
        or level_problem(target, level)
        or border_problem(target, border)
        or negative_problem(shape)
        or pixels_problem(format, type)
        or (compression_problem if compressed else internal_problem)(internalformat, gl.GL_INVALID_VALUE)
        or upload_problem(format, _stored(internalformat), internalformat in WITH_STENCIL)
        or (to_compress_problem(target, border) if compressed else base_format_problem(target, internalformat))
    )
    if problem:
        return fail(problem[0], operation, problem[1])
    stored = compressed.stored if compressed else storage_format(internalformat, type, format)
    problem = size_problem(target, level, shape, border) or memory_problem(target, shape, stored)
    if is_proxy:
        define_proxy(context, target, level, None if problem else stored, internalformat, shape)
        return None
    if problem:
        return fail(problem[0], operation, problem[1])
    parts: Parts | None = NOTHING
    if shape[2]:
        cells_format = bytes_of(stored) if compressed else stored
        parts = _cells(context, pixels, _lengths(dimensions, shape), format, type, cells_format, operation)
    if parts is None:
        return None
    texture, face = bound_texture(context, target), face_of(target)
    width, height, slices = inner = _inside(shape) if border else shape
    parts = _cropped(parts[0], shape, inner), _cropped(parts[1], shape, inner)
    layout = stored, internalformat if compressed else wanted, width, height
    if compressed:
        blocks = _compressed(parts[0], compressed, width, height)
        cells = decoded(blocks, compressed, width, height)
        context.execute(DefineImage(texture.name, face, level, *layout, cells, blocks=blocks))
    else:
        context.execute(DefineImage(texture.name, face, level, *layout, *parts, slices=slices))
    note_defined(context, texture, level, depths_copied=False)
    follow_base_level(context, texture, face, level)
    return None


@in_lists
def _update(
    operation: str,
    dimensions: int,
    target: int,
    level: int,
    corner: Shape,
    shape: Shape,
    format: int,
    type: int,
    pixels: Any,
) -> None:
    if (context := outside_begin(operation)) is None:
        return None
    problem = (
        image_target_problem(target, dimensions)
        or level_problem(target, level)
        or negative_problem(shape)
        or missing_problem(context, target, level)
        or pixels_problem(format, type)
    )
    if problem:
        return fail(problem[0], operation, problem[1])
    texture, face = bound_texture(context, target), face_of(target)
    image = texture.images[face, level]
    problem = (
        upload_problem(format, image.format, image.stencil is not None)
        or region_problem(context, target, level, corner, shape)
        or (to_update_problem(image, corner, shape) if image.blocks is not None else None)
    )
    if problem:
        return fail(problem[0], operation, problem[1])
    parts: Parts | None = NOTHING
    if shape[2]:
        stored = bytes_of(image.format) if image.blocks is not None else image.format
        parts = _cells(context, pixels, _lengths(dimensions, shape), format, type, stored, operation)
    if parts is not None and image.blocks is not None:
        _update_blocks(context, texture, (face, level), corner, parts[0])
    elif parts is not None and 0 not in shape and any(part is not None for part in parts):
        x, y, z = corner
        context.execute(UpdateImage(texture.name, face, level, x, y, *parts, z=z, slices=shape[2]))
        follow_base_level(context, texture, face, level)
    return None


def _stored(internalformat: int) -> Format:
    compressed = COMPRESSED.get(internalformat)
    return compressed.stored if compressed else FORMATS[internalformat]


def _compressed(cells: np.ndarray | None, compressed: CompressedFormat, width: int, height: int) -> np.ndarray:
    """Return the blocks of colours (height, width, 4) in bytes; zeros for none."""
    if cells is None:
        return np.zeros((*compressed.blocks(width, height), compressed.block_bytes), np.uint8)
    return encoded(cells, compressed)


def _update_blocks(
    context: Context, texture: Texture, place: tuple[int, int], corner: Shape, cells: np.ndarray | None
) -> None:
    """Replace blocks of a compressed level, given as (face, level), by those of colours in bytes."""
    if cells is None or not cells.size:
        return
    compressed = COMPRESSED[texture.images[place].internal_format]
    blocks = encoded(cells, compressed)
    decoded_cells = decoded(blocks, compressed, cells.shape[1], cells.shape[0])
    context.execute(UpdateImage(texture.name, *place, *corner[:2], decoded_cells, blocks=blocks))
    follow_base_level(context, texture, *place)


def _inside(shape: Shape) -> Shape:
    """Return the sides of an image without its border, which Mesa drops; it keeps heights and depths below 3."""
    width, height, slices = shape
    return width - 2, height - 2 if height > 2 else height, slices - 2 if slices > 2 else slices


def _cropped(cells: np.ndarray | None, shape: Shape, inner: Shape) -> np.ndarray | None:
    """Return the middle of an image (slices * height, width[, channels]); None for none."""
    if cells is None or shape == inner:
        return cells
    width, height, slices = shape
    places = (slice((whole - part) // 2, (whole + part) // 2) for whole, part in zip(shape, inner, strict=True))
    columns, rows, planes = places
    images = cells.reshape(slices, height, width, *cells.shape[2:])[planes, rows, columns]
    return np.ascontiguousarray(images).reshape(inner[2] * inner[1], inner[0], *cells.shape[2:])


def _cells(
    context: Context,
    pixels: Any,
    lengths: tuple[int, int, int],
    format: int,
    type: int,
    stored: Format,
    operation: str,
) -> Parts | None:
    """Return client pixels as (cells, stencil values) to be stored; None for a part that the format does not have.

    None after an error of GL.
    """
    if pixels is None and (not context.unpack_store.buffer or context.executes_list or context.list_depth):
        return NOTHING
    image = image_source(context, pixels, *lengths, format, type, operation)
    if image is None:
        return None
    kind, transfer = kind_of(format), context.pixel_transfer
    if kind == "color":
        cells = unpack_color(image, format, stored, type, transfer)
        return (cells.copy() if np.may_share_memory(cells, image) else cells), None
    elements = image[..., 0]
    if kind == "depth-stencil":
        return unpack_packed_depth(elements, stored, transfer), unpack_packed_stencil(elements, transfer)
    if kind == "depth":
        return unpack_depth(elements, stored, transfer), None
    values = unpack_stencil(elements, transfer)
    return (values, None) if stored.kind == "stencil" else (None, values)


__all__ = spelled_like_gl(globals())
