"""Texture images read back, and the properties of their levels."""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.compression import COMPRESSED, UNCOMPRESSED
from softshadow.frozen import evolve
from softshadow.gl.calls import spelled_like_gl
from softshadow.gl.compressed_reading import compressed_pixels
from softshadow.gl.errors import fail, outside_begin
from softshadow.gl.pixel_formats import format_problem, kind_of, readout_problem
from softshadow.gl.pixel_memory import image_destination
from softshadow.gl.texture_problems import PROXIES, level_problem
from softshadow.gl.textures import image_at, image_target_problem
from softshadow.image import Image
from softshadow.pixel_store import TYPES
from softshadow.pixel_transfer import PixelTransfer
from softshadow.pixels import client_kind, pack_color, pack_depth, pack_depth_stencil, pack_stencil
from softshadow.tokens import token_name

SIZES: dict[int, tuple[int, ...]] = {  # the base formats that have the channel
    gl.GL_TEXTURE_RED_SIZE: (gl.GL_RED, gl.GL_RG, gl.GL_RGB, gl.GL_RGBA),
    gl.GL_TEXTURE_GREEN_SIZE: (gl.GL_RG, gl.GL_RGB, gl.GL_RGBA),
    gl.GL_TEXTURE_BLUE_SIZE: (gl.GL_RGB, gl.GL_RGBA),
    gl.GL_TEXTURE_ALPHA_SIZE: (gl.GL_RGBA, gl.GL_ALPHA, gl.GL_LUMINANCE_ALPHA),
    gl.GL_TEXTURE_LUMINANCE_SIZE: (gl.GL_LUMINANCE, gl.GL_LUMINANCE_ALPHA),
    gl.GL_TEXTURE_INTENSITY_SIZE: (gl.GL_INTENSITY,),
    gl.GL_TEXTURE_DEPTH_SIZE: (gl.GL_DEPTH_COMPONENT,),
    gl.GL_TEXTURE_STENCIL_SIZE: (gl.GL_STENCIL_INDEX,),
}
SYNONYMS = {gl.GL_COMPRESSED_LUMINANCE_ALPHA_3DC_ATI: gl.GL_COMPRESSED_LUMINANCE_ALPHA_LATC2_EXT}
CHANNEL_OF = {gl.GL_TEXTURE_GREEN_SIZE: 1, gl.GL_TEXTURE_BLUE_SIZE: 2, gl.GL_TEXTURE_ALPHA_SIZE: 3}
MEMORY = {  # largest depth: the type of the texture's own memory
    2**16 - 1: gl.GL_UNSIGNED_SHORT,
    2**32 - 1: gl.GL_UNSIGNED_INT,
    0: gl.GL_FLOAT,
}


def glGetTexImage(target: int, level: int, format: int, type: int, array: Any = None) -> Any:
    """Return a level of the bound texture, (h, w) or (h, w, components), bottom row first; an `array` is filled.

    Images of 3-D textures have one more dimension, the first; those of 1-D textures have one row.
    """
    operation = "glGetTexImage"
    if (context := outside_begin(operation)) is None:
        return None
    problem = image_target_problem(target) or level_problem(target, level) or format_problem(format, type)
    if problem:
        return fail(problem[0], operation, problem[1])
    context.finish()
    image = image_at(context, target, level)
    if image is not None and (problem := readout_problem(format, image)):
        return fail(problem[0], operation, problem[1])
    width, height = (image.width, image.height) if image is not None else (0, 0)
    slices = image.slices if image is not None and target == gl.GL_TEXTURE_3D else 0
    where = image_destination(context, array, width, height, slices, format, type, operation)
    if where is None:
        return None
    answer, view = where
    if image is not None:
        view[...] = texture_pixels(image, format, type, context.pixel_transfer).reshape(view.shape)
    return answer


def texture_pixels(image: Image, format: int, type: int, transfer: PixelTransfer) -> np.ndarray:
    """Return a texture's image as client pixels (h, w, components); as in Mesa, colours are not transferred."""
    kind = kind_of(format)
    if kind == "depth-stencil":
        assert image.stencil is not None
        return pack_depth_stencil(image.view, image.stencil.view, image.format, type)[..., None]
    if kind == "color":
        if image.blocks is not None:
            return compressed_pixels(image, format, type)
        return pack_color(image.view, image.format, format, client_kind(type))
    if kind == "depth":
        if MEMORY.get(image.format.largest) == type:  # which Mesa copies as it is
            transfer = evolve(transfer, depth=(1.0, 0.0))
        return pack_depth(image.view, image.format, TYPES[type], through_float=True, transfer=transfer)[..., None]
    stencil = image.stencil.view if image.stencil is not None else image.view
    return pack_stencil(stencil, TYPES[type], transfer)[..., None]


def glGetTexLevelParameteriv(target: int, level: int, pname: int, params: Any = None) -> Any:
    """Return a property of a level of the bound texture, an int."""
    operation = "glGetTexLevelParameteriv"
    if (context := outside_begin(operation)) is None:
        return None
    is_proxy = target in PROXIES
    if problem := (None if is_proxy else image_target_problem(target)) or level_problem(target, level):
        return fail(problem[0], operation, problem[1])
    image = context.proxies.get((target, level)) if is_proxy else image_at(context, target, level)
    simple = {
        gl.GL_TEXTURE_WIDTH: image.width if image else 0,
        gl.GL_TEXTURE_HEIGHT: image.height if image else 0,
        gl.GL_TEXTURE_DEPTH: image.slices if image else 0,
        gl.GL_TEXTURE_BORDER: 0,
        gl.GL_TEXTURE_COMPRESSED: int(image is not None and image.internal_format in COMPRESSED),
        gl.GL_TEXTURE_INTERNAL_FORMAT: _internal_format(image) if image else gl.GL_RGBA,
    }
    if pname in simple:
        answer = simple[pname]
    elif pname in SIZES:
        answer = channel_bits(image, pname) if image else 0
    elif pname == gl.GL_TEXTURE_COMPRESSED_IMAGE_SIZE:
        if is_proxy or image is None or image.internal_format not in COMPRESSED:
            return fail(gl.GL_INVALID_OPERATION, operation, f"pname={token_name(pname)}: expected a compressed image")
        answer = COMPRESSED[image.internal_format].size(image.width, image.height)
    else:
        return fail(gl.GL_INVALID_ENUM, operation, f"pname={token_name(pname)}: expected a property of a texture level")
    if params is not None:
        np.asarray(params)[:1] = answer
    return answer


def glGetTexLevelParameterfv(target: int, level: int, pname: int, params: Any = None) -> Any:
    """Return a property of a level of the bound texture, a float."""
    answer = glGetTexLevelParameteriv(target, level, pname, params)
    return None if answer is None else float(answer)


def _internal_format(image: Image) -> int:
    """Return what queries return as the internal format: the base format of images that were to be compressed."""
    wanted = image.internal_format
    return image.format.base if wanted in UNCOMPRESSED else SYNONYMS.get(wanted, wanted)


def channel_bits(image: Image, size: int) -> int:
    """Return the number of bits of the channel of a GL_TEXTURE_*_SIZE, 0 if the format does not have it."""
    if size == gl.GL_TEXTURE_STENCIL_SIZE:
        return 8 if image.stencil is not None or image.format.kind == "stencil" else 0
    if image.format.base not in SIZES[size]:
        return 0
    if image.internal_format in COMPRESSED:
        return COMPRESSED[image.internal_format].approximate_bits
    if image.format.bits:
        return image.format.bits[CHANNEL_OF.get(size, 0)]
    if image.format.kind == "unorm8":
        return 8
    return int(image.format.largest).bit_length() or 32


__all__ = spelled_like_gl(globals())
