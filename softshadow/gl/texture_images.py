"""Texture images: uploads, mipmaps and read-outs."""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, current
from softshadow.framebuffer import LARGEST_SIDE
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.errors import fail, outside_begin
from softshadow.gl.pixel_formats import Problem, format_problem, kind_of, upload_problem
from softshadow.gl.pixel_memory import image_for_list, image_source
from softshadow.gl.proxy_textures import PROXIES, define_proxy
from softshadow.gl.textures import FACES, bound_name, bound_texture, target_problem
from softshadow.image import FORMATS, WITH_STENCIL, Format, Image, storage_format
from softshadow.pipeline.commands import DefineImage, GenerateMipmaps, UpdateImage
from softshadow.pixels import (
    unpack_color,
    unpack_depth,
    unpack_packed_depth,
    unpack_packed_stencil,
    unpack_stencil,
)
from softshadow.texture import Texture
from softshadow.tokens import token_name

LARGEST_LEVEL = LARGEST_SIDE.bit_length() - 1
COMPONENT_NUMBERS = (1, 2, 3, 4)  # internal formats of GL 1.0, which glCopyTexImage2D does not take


def face_of(target: int) -> int:
    """Return the index of a cube map's face, 0 for GL_TEXTURE_2D."""
    return FACES.index(target) if target in FACES else 0


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

    For a proxy texture only what glGetTexLevelParameter returns is set, to 0 if there cannot be such a texture, even
    while a display list is compiled.
    """
    shape = (width, height)
    pixels = image_for_list(current(), pixels, *shape, format, type, "glTexImage2D")
    define = _tex_image.__wrapped__ if target in PROXIES else _tex_image  # type: ignore[attr-defined]
    define(target, level, internalformat, *shape, border, format, type, pixels)


@in_lists
def _tex_image(
    target: int,
    level: int,
    internalformat: int,
    width: int,
    height: int,
    border: int,
    format: int,
    type: int,
    pixels: Any,
) -> None:
    operation = "glTexImage2D"
    if (context := outside_begin(operation)) is None:
        return None
    is_proxy = target in PROXIES
    problem = (
        (None if is_proxy else target_problem(context, target, faces=True))
        or (level_problem(level) if is_proxy else size_problem(target, level, width, height, border))
        or (border_problem(border) or _negative_problem(width, height) if is_proxy else None)
        or format_problem(format, type)
        or internal_problem(internalformat, gl.GL_INVALID_VALUE)
        or upload_problem(format, FORMATS[internalformat], internalformat in WITH_STENCIL)
    )
    if problem:
        return fail(problem[0], operation, problem[1])
    stored = storage_format(internalformat, type)
    if is_proxy:
        define_proxy(context, target, level, stored, internalformat, width, height)
        return None
    parts = _cells(context, pixels, width, height, format, type, stored, operation)
    if parts is None:
        return None
    texture = bound_texture(context, target)
    context.execute(DefineImage(texture.name, face_of(target), level, stored, internalformat, width, height, *parts))
    follow_base_level(context, texture, face_of(target), level)
    return None


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
    pixels = image_for_list(current(), pixels, width, height, format, type, "glTexSubImage2D")
    _tex_sub_image(target, level, xoffset, yoffset, width, height, format, type, pixels)


@in_lists
def _tex_sub_image(
    target: int,
    level: int,
    xoffset: int,
    yoffset: int,
    width: int,
    height: int,
    format: int,
    type: int,
    pixels: Any,
) -> None:
    operation = "glTexSubImage2D"
    if (context := outside_begin(operation)) is None:
        return None
    problem = (
        target_problem(context, target, faces=True)
        or level_problem(level)
        or _negative_problem(width, height)
        or missing_problem(context, target, level)
        or format_problem(format, type)
    )
    if problem:
        return fail(problem[0], operation, problem[1])
    image = bound_texture(context, target).images[face_of(target), level]
    problem = upload_problem(format, image.format, image.stencil is not None) or region_problem(
        context, target, level, xoffset, yoffset, width, height
    )
    if problem:
        return fail(problem[0], operation, problem[1])
    parts = _cells(context, pixels, width, height, format, type, image.format, operation)
    if parts is not None and any(part is not None for part in parts):
        texture = bound_texture(context, target)
        context.execute(UpdateImage(texture.name, face_of(target), level, xoffset, yoffset, *parts))
        follow_base_level(context, texture, face_of(target), level)
    return None


def _cells(
    context: Context, pixels: Any, width: int, height: int, format: int, type: int, stored: Format, operation: str
) -> tuple[np.ndarray | None, np.ndarray | None] | None:
    """Return client pixels as (cells, stencil values) to be stored; None for a part that the format does not have.

    None after an error of GL.
    """
    if pixels is None and (not context.unpack_store.buffer or context.executes_list or context.list_depth):
        return None, None
    image = image_source(context, pixels, width, height, format, type, operation)
    if image is None:
        return None
    kind, transfer = kind_of(format), context.pixel_transfer
    if kind == "color":
        return unpack_color(image, format, stored, type, transfer).copy(), None
    elements = image[..., 0]
    if kind == "depth-stencil":
        return unpack_packed_depth(elements, stored, transfer), unpack_packed_stencil(elements, transfer)
    if kind == "depth":
        return unpack_depth(elements, stored, transfer), None
    values = unpack_stencil(elements, transfer)
    return (values, None) if stored.kind == "stencil" else (None, values)


# -- mipmaps -----------------------------------------------------------------------------------------------------------
def glGenerateMipmap(target: int) -> None:
    """Compute all mipmap levels of the bound texture from its base level."""
    operation = "glGenerateMipmap"
    if (context := outside_begin(operation)) is None:
        return None
    if problem := target_problem(context, target) or _base_problem(context, target):
        return fail(problem[0], operation, problem[1])
    texture = bound_texture(context, target)
    base = texture.base(texture.faces[0])
    if base is not None and base.width and base.height:  # as in Mesa, an empty image gets no levels
        _generate(context, texture, texture.faces)
    return None


def _base_problem(context: Context, target: int) -> Problem | None:
    texture = context.objects.textures.get(bound_name(context, target))
    bases = [texture.base(face) for face in texture.faces] if texture is not None else [None]
    first = bases[0]
    if first is None or any(base is None or base.view.shape != first.view.shape for base in bases):
        cube = target == gl.GL_TEXTURE_CUBE_MAP
        missing = "the base level of every face, all of one size" if cube else "a base level"
        return gl.GL_INVALID_OPERATION, f"the bound texture needs {missing}: call glTexImage2D first"
    if first.stencil is not None or first.format.kind == "stencil":
        return gl.GL_INVALID_OPERATION, "the bound texture has stencil values, which cannot have mipmaps"
    return None


def follow_base_level(context: Context, texture: Texture, face: int, level: int) -> None:
    """Compute the mipmaps of a face after a change of its base level, if GL_GENERATE_MIPMAP is on."""
    sampler = texture.sampler
    base = texture.base(face)
    if sampler.generate_mipmap and level == sampler.base_level and base is not None and base.stencil is None:
        _generate(context, texture, (face,))


def _generate(context: Context, texture: Texture, faces: tuple[int, ...]) -> None:
    base, last = texture.sampler.base_level, texture.last_level(faces[0])
    if last > base:
        context.execute(GenerateMipmaps(texture.name, faces, base, last))


def image_at(context: Context, target: int, level: int) -> Image | None:
    """Return the image of a level of the bound texture, or None if it is not defined."""
    texture = context.objects.textures.get(bound_name(context, target))
    return texture.images.get((face_of(target), level)) if texture is not None else None


# -- wrong arguments ---------------------------------------------------------------------------------------------------
def level_problem(level: int) -> Problem | None:
    """Return (error code, message) if a level is out of range, else None."""
    if 0 <= level <= LARGEST_LEVEL:
        return None
    return gl.GL_INVALID_VALUE, f"level={level}: expected 0 to {LARGEST_LEVEL}"


def size_problem(target: int, level: int, width: int, height: int, border: int) -> Problem | None:
    """Return (error code, message) if a level cannot have this size, else None."""
    if problem := level_problem(level):
        return problem
    if problem := border_problem(border):
        return problem
    largest = LARGEST_SIDE >> level
    if not (0 <= width <= largest and 0 <= height <= largest):
        return gl.GL_INVALID_VALUE, f"width={width}, height={height}: expected 0 to {largest} at level {level}"
    if target in FACES and width != height:
        return gl.GL_INVALID_VALUE, f"width={width}, height={height}: expected a square face of a cube map"
    return None


def border_problem(border: int) -> Problem | None:
    """Return (error code, message) if a border is asked for, else None."""
    if border == 0:
        return None
    return gl.GL_INVALID_VALUE, f"border={border}: expected 0 (texel borders are not part of this subset)"


def internal_problem(internalformat: int, code: int, exclude: tuple[int, ...] = ()) -> Problem | None:
    if internalformat in FORMATS and internalformat not in exclude:
        return None
    known = ", ".join(token_name(f) for f in FORMATS if f not in COMPONENT_NUMBERS)
    return code, f"internalformat={token_name(internalformat)}: expected one of {known}"


def missing_problem(context: Context, target: int, level: int) -> Problem | None:
    """Return (error code, message) if the level is not defined, else None."""
    if image_at(context, target, level) is not None:
        return None
    return gl.GL_INVALID_OPERATION, f"level {level} of the bound texture is not defined: call glTexImage2D first"


def _negative_problem(width: int, height: int) -> Problem | None:
    if width >= 0 and height >= 0:
        return None
    return gl.GL_INVALID_VALUE, f"width={width}, height={height}: expected 0 or more"


def region_problem(
    context: Context, target: int, level: int, x: int, y: int, width: int, height: int
) -> Problem | None:
    """Return (error code, message) if a rectangle is not inside the image, else None."""
    if problem := _negative_problem(width, height):
        return problem
    image = image_at(context, target, level)
    assert image is not None
    if x < 0 or y < 0 or x + width > image.width or y + height > image.height:
        return gl.GL_INVALID_VALUE, (
            f"the rectangle of {width} x {height} at ({x}, {y}) leaves the image of {image.width} x {image.height}"
        )
    return None


__all__ = spelled_like_gl(globals())
