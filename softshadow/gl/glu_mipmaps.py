"""GLU's images: gluScaleImage, and textures with all their mipmaps from one image."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, current
from softshadow.framebuffer import LARGEST_SIDE
from softshadow.frozen import evolve
from softshadow.gl.calls import spelled_like_gl
from softshadow.gl.glu_tokens import GLU_INVALID_ENUM, GLU_INVALID_OPERATION, GLU_INVALID_VALUE
from softshadow.gl.image_scaling import from_shorts, halve, scale_shorts, to_shorts
from softshadow.gl.mipmap_scaling import scale
from softshadow.gl.pixel_memory import image_source
from softshadow.gl.texture_images import glTexImage2D
from softshadow.packed_colors import PACKED_COLORS
from softshadow.pixel_store import COMPONENTS, TYPES, image_view

INDICES = (gl.GL_COLOR_INDEX, gl.GL_STENCIL_INDEX)


def gluScaleImage(
    format: int, wIn: int, hIn: int, typeIn: int, dataIn: Any, wOut: int, hOut: int, typeOut: int, dataOut: np.ndarray
) -> int:
    """Scale an image into the array `dataOut`; return 0, or an error code of GLU."""
    if not (wIn and hIn and wOut and hOut):
        return 0
    if min(wIn, hIn, wOut, hOut) < 0:
        return GLU_INVALID_VALUE
    problem = wrong_image(format, typeIn) or wrong_image(format, typeOut)
    if problem:
        return problem
    context = current()
    image = image_source(context, dataIn, wIn, hIn, 0, format, typeIn, "gluScaleImage")
    if image is None:
        return 0
    is_index = format in INDICES
    scaled = scale_shorts(to_shorts(image, is_index), wOut, hOut)
    view = image_view(dataOut, context.pack_store, wOut, hOut, format, typeOut, "gluScaleImage")
    view[...] = from_shorts(scaled, np.dtype(TYPES[typeOut]), is_index)
    return 0


def gluBuild2DMipmaps(
    target: int, internalFormat: int, width: int, height: int, format: int, type: int, data: Any
) -> int:
    """Define all levels of a texture from an image of any size; return 0, or an error code of GLU.

    The image is scaled to the nearest powers of two first.
    """
    problem = wrong_image(format, type)
    if problem or width < 1 or height < 1:
        return problem or GLU_INVALID_VALUE
    scaled = min(nearest_power(width), LARGEST_SIDE), min(nearest_power(height), LARGEST_SIDE)
    levels = max(scaled).bit_length() - 1
    return _build(target, internalFormat, (width, height), scaled, format, type, (0, 0, levels), data)


def gluBuild2DMipmapLevels(
    target: int, internalFormat: int, width: int, height: int, format: int, type: int, level: int, base: int, max: int,
    data: Any,
) -> int:  # fmt: skip
    """Define levels `base` to `max` of a texture whose level `level` is an image; return 0 or an error code."""
    problem = wrong_image(format, type)
    if problem:
        return problem
    powers = [side for side in (width, height) if side > 0 and not side & (side - 1)]
    levels = level + (sorted(powers)[-1].bit_length() if powers else 0) - 1
    if not 0 <= level <= base <= max <= levels:
        return GLU_INVALID_VALUE
    size = width, height
    return _build(target, internalFormat, size, size, format, type, (level, base, max), data)


def _build(
    target: int, internal: int, size: tuple[int, int], scaled: tuple[int, int], format: int, type: int,
    levels: tuple[int, int, int], data: Any,
) -> int:  # fmt: skip
    """Define levels from an image of a `size`, `scaled` to another one.

    `levels`: that of the image, and the first and last one to define.
    """
    context, (level, base, last) = current(), levels
    image = image_source(context, data, *size, 0, format, type, "gluBuild2DMipmaps")
    if image is None:
        return 0
    if scaled != size:
        image = halve(image) if size == (2 * scaled[0], 2 * scaled[1]) else scale(image, *scaled)
    with packed_tightly(context):
        while True:
            if level >= base:
                shape = image.shape[1], image.shape[0]
                glTexImage2D(target, level, internal, *shape, 0, format, type, np.ascontiguousarray(image))
            if level == last or image.shape[:2] == (1, 1):
                return 0
            image, level = halve(image), level + 1


@contextmanager
def packed_tightly(context: Context) -> Iterator[None]:
    """Read images from memory without any padding, and restore the pixel store at the end."""
    store = context.unpack_store
    context.unpack_store = evolve(
        store, alignment=1, row_length=0, skip_rows=0, skip_pixels=0, image_height=0, skip_images=0, swap_bytes=False,
        buffer=0,
    )  # fmt: skip
    try:
        yield
    finally:
        context.unpack_store = store


def wrong_image(format: int, type: int) -> int:
    """Return an error code of GLU, 0 for a format and a type that images can have here."""
    packed = PACKED_COLORS.get(type)
    if format not in COMPONENTS or (type not in TYPES and packed is None):
        return GLU_INVALID_ENUM
    if packed is not None and packed.small_floats is not None:  # newer than GLU
        return GLU_INVALID_ENUM
    return GLU_INVALID_OPERATION if packed is not None else 0


def nearest_power(size: int) -> int:
    """Return the power of two that libGLU takes for nearest: 3 becomes 4, 5 becomes 4, 6 becomes 8."""
    power = 1
    while size not in (1, 3):
        size, power = size >> 1, power * 2
    return power * (4 if size == 3 else 1)


__all__ = spelled_like_gl(globals())
