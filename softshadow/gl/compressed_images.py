"""Compressed texture images: defined, changed in part, and read back as they are.

References: GL 2.1, sec. 3.8.3 and 6.1.4; teximage.c and texgetimage.c of Mesa 22.3, for the order of the checks.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from softshadow.compression import COMPRESSED, CompressedFormat, decoded
from softshadow.context import Context, current
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.compression_problems import (
    alignment_problem,
    compressible_problem,
    content_problem,
    format_to_update_problem,
    not_compressed_problem,
    same_format_problem,
    target_to_update_problem,
    whole_border_problem,
)
from softshadow.gl.errors import fail, outside_begin
from softshadow.gl.pixel_memory import destination, source
from softshadow.gl.proxy_textures import define_proxy
from softshadow.gl.texture_mipmaps import follow_base_level
from softshadow.gl.texture_problems import (
    PROXIES,
    Shape,
    level_problem,
    missing_problem,
    negative_problem,
    region_problem,
    size_problem,
)
from softshadow.gl.textures import bound_texture, face_of, image_at, image_target_problem
from softshadow.pipeline.commands import DefineImage, UpdateImage


class Content(NamedTuple):
    """The bytes of an image, as a call has got them: `data` is an array, or an offset into a buffer object."""

    n_bytes: int
    data: Any


def glCompressedTexImage1D(target: int, level: int, internalformat: int, width: int, border: int, *image: Any) -> None:
    """Fail: no format compresses 1-D textures."""
    _tex_image(1, target, level, internalformat, (width, 1, 1), border, image)


def glCompressedTexImage2D(
    target: int, level: int, internalformat: int, width: int, height: int, border: int, *image: Any
) -> None:
    """Define a level of the bound texture, or of a face of a cube map, from blocks.

    Parameters
    ----------
    internalformat : GL_COMPRESSED_RGBA_S3TC_DXT5_EXT or another format of S3TC, RGTC or LATC
    image : the blocks, as bytes or array; or, as in C, their number of bytes and the blocks
    """
    _tex_image(2, target, level, internalformat, (width, height, 1), border, image)


def glCompressedTexImage3D(
    target: int, level: int, internalformat: int, width: int, height: int, depth: int, border: int, *image: Any
) -> None:
    """Fail: none of the formats here compresses 3-D textures."""
    _tex_image(3, target, level, internalformat, (width, height, depth), border, image)


def glCompressedTexSubImage1D(target: int, level: int, xoffset: int, width: int, format: int, *image: Any) -> None:
    """Fail: no format compresses 1-D textures."""
    _tex_sub_image(1, target, level, (xoffset, 0, 0), (width, 1, 1), format, image)


def glCompressedTexSubImage2D(
    target: int, level: int, xoffset: int, yoffset: int, width: int, height: int, format: int, *image: Any
) -> None:
    """Replace blocks of a level of the bound texture: offsets and sides are multiples of 4, or end at the border."""
    _tex_sub_image(2, target, level, (xoffset, yoffset, 0), (width, height, 1), format, image)


def glCompressedTexSubImage3D(
    target: int,
    level: int,
    xoffset: int,
    yoffset: int,
    zoffset: int,
    width: int,
    height: int,
    depth: int,
    format: int,
    *image: Any,
) -> None:
    """Fail: none of the formats here compresses 3-D textures."""
    _tex_sub_image(3, target, level, (xoffset, yoffset, zoffset), (width, height, depth), format, image)


def glGetCompressedTexImage(target: int, level: int, img: Any = None) -> Any:
    """Return the blocks of a level of the bound texture as they were given, uint8; an array `img` is filled, too."""
    operation = "glGetCompressedTexImage"
    if (context := outside_begin(operation)) is None:
        return None
    problem = (
        image_target_problem(target)
        or level_problem(target, level)
        or not_compressed_problem(image := image_at(context, target, level))
    )
    if problem:
        return fail(problem[0], operation, problem[1])
    context.finish()
    assert image is not None
    assert image.blocks is not None
    return destination(context, img, image.blocks.reshape(-1).copy(), operation)


# -- carried out -------------------------------------------------------------------------------------------------------
def _tex_image(
    dimensions: int, target: int, level: int, internalformat: int, shape: Shape, border: int, image: tuple[Any, ...]
) -> None:
    operation = f"glCompressedTexImage{dimensions}D"
    content = _content_for_list(operation, image)
    define = _define.__wrapped__ if target in PROXIES else _define  # type: ignore[attr-defined]
    if content is not None:
        define(operation, dimensions, target, level, internalformat, shape, border, content)


def _tex_sub_image(
    dimensions: int, target: int, level: int, corner: Shape, shape: Shape, format: int, image: tuple[Any, ...]
) -> None:
    operation = f"glCompressedTexSubImage{dimensions}D"
    content = _content_for_list(operation, image)
    if content is not None:
        _update(operation, dimensions, target, level, corner, shape, format, content)


@in_lists
def _define(
    operation: str,
    dimensions: int,
    target: int,
    level: int,
    internalformat: int,
    shape: Shape,
    border: int,
    content: Content,
) -> None:
    if (context := outside_begin(operation)) is None:
        return None
    is_proxy = PROXIES.get(target) == dimensions
    problem = (
        (None if is_proxy else image_target_problem(target, dimensions))
        or compressible_problem(target, internalformat)
        or level_problem(target, level)
        or whole_border_problem(border)
        or content_problem(internalformat, shape, content.n_bytes)
    )
    if problem:
        return fail(problem[0], operation, problem[1])
    compressed = COMPRESSED[internalformat]
    problem = size_problem(target, level, shape)
    if is_proxy:
        define_proxy(context, target, level, None if problem else compressed.stored, internalformat, shape)
        return None
    if problem:
        return fail(problem[0], operation, problem[1])
    blocks = _blocks(context, content, compressed, shape, operation)
    if blocks is None:
        return None
    texture, face, (width, height, _) = bound_texture(context, target), face_of(target), shape
    cells = decoded(blocks, compressed, width, height)
    layout = compressed.stored, internalformat, width, height
    context.execute(DefineImage(texture.name, face, level, *layout, cells, blocks=blocks))
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
    content: Content,
) -> None:
    if (context := outside_begin(operation)) is None:
        return None
    problem = (
        target_to_update_problem(target, dimensions)
        or format_to_update_problem(format)
        or level_problem(target, level)
        or content_problem(format, shape, content.n_bytes)
        or missing_problem(context, target, level)
        or same_format_problem(image_at(context, target, level), format)
        or negative_problem(shape)
        or region_problem(context, target, level, corner, shape)
        or alignment_problem(image_at(context, target, level), corner, shape)
    )
    if problem:
        return fail(problem[0], operation, problem[1])
    compressed = COMPRESSED[format]
    blocks = _blocks(context, content, compressed, shape, operation)
    if blocks is None or 0 in shape:
        return None
    texture, face = bound_texture(context, target), face_of(target)
    cells = decoded(blocks, compressed, *shape[:2])
    context.execute(UpdateImage(texture.name, face, level, *corner[:2], cells, blocks=blocks))
    follow_base_level(context, texture, face, level)
    return None


# -- bytes -------------------------------------------------------------------------------------------------------------
def _content_for_list(operation: str, image: tuple[Any, ...]) -> Content | None:
    """Return what a call has got; while a display list is compiled, the bytes as they are now. None after an error."""
    if len(image) not in (1, 2):
        raise TypeError(f"{operation}: expected an image, or its number of bytes and the image")
    data = image[-1]
    content = Content(int(image[0]) if len(image) == 2 else _n_bytes(data), data)
    context = current()
    if context.compiled_list is None or data is None or content.n_bytes < 0:
        return content
    memory = _memory(context, content, operation)
    return None if memory is None else Content(content.n_bytes, memory)


def _n_bytes(data: Any) -> int:
    return len(data) if isinstance(data, bytes | bytearray | memoryview) else np.asarray(data).nbytes


def _memory(context: Context, content: Content, operation: str) -> np.ndarray | None:
    """Return the bytes of an image, of the client or of the bound buffer object; None after an error of GL."""
    memory = source(context, content.data, content.n_bytes, 1, operation)
    if memory is None:
        return None
    if isinstance(memory, bytes | bytearray | memoryview):
        values = np.frombuffer(memory, np.uint8)
    else:
        values = np.ascontiguousarray(memory).reshape(-1).view(np.uint8)
    if len(values) < content.n_bytes:
        raise ValueError(f"{operation}: the image has {len(values)} bytes, {content.n_bytes} are needed")
    return values[: content.n_bytes].copy()


def _blocks(
    context: Context, content: Content, compressed: CompressedFormat, shape: Shape, operation: str
) -> np.ndarray | None:
    """Return the blocks (rows, columns, bytes) of an image; zeros without data. None after an error of GL."""
    blocks = *compressed.blocks(*shape[:2]), compressed.block_bytes
    if content.data is None and not context.unpack_store.buffer:
        return np.zeros(blocks, np.uint8)
    memory = _memory(context, content, operation)
    return None if memory is None else memory.reshape(blocks)


__all__ = spelled_like_gl(globals())
