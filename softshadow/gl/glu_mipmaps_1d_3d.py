"""GLU's mipmaps of 1-D and 3-D textures, made by box filters from one image."""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import current
from softshadow.framebuffer import LARGEST_SIDE
from softshadow.gl.box_scaling import halve_box, scale_box
from softshadow.gl.calls import spelled_like_gl
from softshadow.gl.glu_mipmaps import INDICES, nearest_power, packed_tightly, wrong_image
from softshadow.gl.glu_tokens import GLU_INVALID_VALUE
from softshadow.gl.image_scaling import from_shorts, scale_shorts, to_shorts
from softshadow.gl.pixel_memory import image_source
from softshadow.gl.texture_images import glTexImage1D, glTexImage3D
from softshadow.gl.texture_problems import LARGEST_3D

Levels = tuple[int, int, int]  # that of the image, and the first and last one to define
Sides = tuple[int, int, int]


def gluBuild1DMipmaps(target: int, internalFormat: int, width: int, format: int, type: int, data: Any) -> int:
    """Define all levels of a 1-D texture from a row of pixels; return 0, or an error code of GLU.

    The row is scaled to the nearest power of two first, in 16-bit numbers.
    """
    if (problem := wrong_image(format, type)) or width < 1:
        return problem or GLU_INVALID_VALUE
    scaled = min(nearest_power(width), LARGEST_SIDE)
    levels = 0, 0, scaled.bit_length() - 1
    return _build_1d(target, internalFormat, width, scaled, format, type, levels, data)


def gluBuild1DMipmapLevels(
    target: int, internalFormat: int, width: int, format: int, type: int, level: int, base: int, max: int, data: Any
) -> int:
    """Define levels `base` to `max` of a 1-D texture whose level `level` is a row of pixels; return 0 or an error."""
    if (problem := wrong_image(format, type)) or width < 1:
        return problem or GLU_INVALID_VALUE
    if not _are_levels(level, base, max, _logarithm(width)):
        return GLU_INVALID_VALUE
    return _build_1d(target, internalFormat, width, width, format, type, (level, base, max), data)


def gluBuild3DMipmaps(
    target: int, internalFormat: int, width: int, height: int, depth: int, format: int, type: int, data: Any
) -> int:
    """Define all levels of a 3-D texture from `depth` images; return 0, or an error code of GLU.

    They are scaled to the nearest powers of two first, in 16-bit numbers.
    """
    sides = width, height, depth
    if (problem := wrong_image(format, type)) or min(sides) < 1:
        return problem or GLU_INVALID_VALUE
    scaled = _powers(sides)
    levels = 0, 0, max(scaled).bit_length() - 1
    return _build_3d(target, internalFormat, sides, scaled, format, type, levels, data)


def gluBuild3DMipmapLevels(
    target: int, internalFormat: int, width: int, height: int, depth: int, format: int, type: int, level: int,
    base: int, max: int, data: Any,
) -> int:  # fmt: skip
    """Define levels `base` to `max` of a 3-D texture whose level `level` is `depth` images; return 0 or an error."""
    sides = width, height, depth
    if (problem := wrong_image(format, type)) or min(sides) < 1:
        return problem or GLU_INVALID_VALUE
    longest = sorted(_logarithm(side) for side in sides)[-1]
    if not _are_levels(level, base, max, longest):
        return GLU_INVALID_VALUE
    return _build_3d(target, internalFormat, sides, sides, format, type, (level, base, max), data)


def _build_1d(
    target: int, internal: int, width: int, scaled: int, format: int, type: int, levels: Levels, data: Any
) -> int:
    context, (level, base, last) = current(), levels
    image = image_source(context, data, width, 1, 0, format, type, "gluBuild1DMipmaps")
    if image is None:
        return 0
    shorts = to_shorts(image, format in INDICES)
    with packed_tightly(context):
        for number in range(level, level + _logarithm(scaled) + 1):
            if shorts.shape[1] != scaled:
                shorts = scale_shorts(shorts, scaled, 1)
            if base <= number <= last:
                pixels = np.ascontiguousarray(shorts)
                glTexImage1D(target, number, internal, scaled, 0, format, gl.GL_UNSIGNED_SHORT, pixels)
            scaled = max(scaled // 2, 1)
    return 0


def _build_3d(
    target: int, internal: int, sides: Sides, scaled: Sides, format: int, type: int, levels: Levels, data: Any
) -> int:
    context, (level, base, last) = current(), levels
    image = image_source(context, data, *sides, format, type, "gluBuild3DMipmaps")
    if image is None:
        return 0
    width, height, depth = sides
    image = image.reshape(depth, height, width, -1)
    if scaled != sides:
        is_index, dtype = format in INDICES, image.dtype
        image = from_shorts(scale_box(to_shorts(image, is_index), *scaled), dtype, is_index)
    with packed_tightly(context):
        while True:
            if base <= level <= last:
                shape = image.shape[2], image.shape[1], image.shape[0]
                glTexImage3D(target, level, internal, *shape, 0, format, type, np.ascontiguousarray(image))
            if image.shape[:3] == (1, 1, 1) or level >= last:
                return 0
            image, level = halve_box(image), level + 1


def _powers(sides: Sides) -> Sides:
    """Return the nearest powers of two, all of them smaller where one is too large, as libGLU tries with a proxy."""
    width, height, depth = (nearest_power(side) for side in sides)
    while max(width, height, depth) > LARGEST_3D:
        width, height, depth = max(width // 2, 1), max(height // 2, 1), max(depth // 2, 1)
    return width, height, depth


def _logarithm(side: int) -> int:
    """Return the logarithm of a power of two, -1 for any other number, as libGLU has it."""
    return side.bit_length() - 1 if side > 0 and not side & (side - 1) else -1


def _are_levels(level: int, base: int, last: int, longest: int) -> bool:
    return 0 <= level <= base <= last <= level + longest


__all__ = spelled_like_gl(globals())
