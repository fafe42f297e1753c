"""Wrong arguments of the calls for compressed texture images.

All functions return (error code, message), or None if nothing is wrong.

References: teximage.c of Mesa 22.3 (`_mesa_target_can_be_compressed`, `compressed_texture_error_check`,
`compressed_subtexture_error_check`).
"""

from __future__ import annotations

from softshadow import tokens as gl
from softshadow.compression import COMPRESSED
from softshadow.gl.pixel_formats import Problem
from softshadow.gl.texture_problems import ONE_DIMENSION, RECTANGLES, VOLUMES, Shape
from softshadow.gl.textures import FACES
from softshadow.image import BLOCK_SIDE, Image
from softshadow.tokens import token_name

GENERIC = (
    gl.GL_COMPRESSED_ALPHA, gl.GL_COMPRESSED_LUMINANCE, gl.GL_COMPRESSED_LUMINANCE_ALPHA, gl.GL_COMPRESSED_INTENSITY,
    gl.GL_COMPRESSED_RED, gl.GL_COMPRESSED_RG, gl.GL_COMPRESSED_RGB, gl.GL_COMPRESSED_RGBA, gl.GL_COMPRESSED_SRGB,
    gl.GL_COMPRESSED_SRGB_ALPHA, gl.GL_COMPRESSED_SLUMINANCE, gl.GL_COMPRESSED_SLUMINANCE_ALPHA,
)  # fmt: skip


def compressible_problem(target: int, internalformat: int) -> Problem | None:
    """Return what is wrong with a target or format of glCompressedTexImage."""
    if target in (*ONE_DIMENSION, *RECTANGLES, *VOLUMES):
        return gl.GL_INVALID_ENUM, f"target={token_name(target)}: no format compresses such textures"
    if internalformat not in COMPRESSED:
        return gl.GL_INVALID_ENUM, f"internalformat={token_name(internalformat)}: {_expected()}"
    return None


def _expected() -> str:
    return f"expected one of {', '.join(map(token_name, COMPRESSED))}"


def whole_border_problem(border: int) -> Problem | None:
    """Return what is wrong with the width of a border."""
    return None if border == 0 else (gl.GL_INVALID_OPERATION, f"border={border}: expected 0")


def content_problem(format: int, shape: Shape, n_bytes: int) -> Problem | None:
    """Return what is wrong with the number of bytes of an image."""
    needed = COMPRESSED[format].size(*shape[:2])
    if n_bytes == needed:
        return None
    return gl.GL_INVALID_VALUE, f"imageSize={n_bytes}: expected {needed} for {' x '.join(map(str, shape))} texels"


def target_to_update_problem(target: int, dimensions: int) -> Problem | None:
    """Return what is wrong with the target of glCompressedTexSubImage."""
    if dimensions == 2 and target in (gl.GL_TEXTURE_2D, *FACES):
        return None
    message = f"target={token_name(target)}: expected GL_TEXTURE_2D or a face of GL_TEXTURE_CUBE_MAP"
    is_volume = dimensions == 3 and target == gl.GL_TEXTURE_3D
    return gl.GL_INVALID_OPERATION if is_volume else gl.GL_INVALID_ENUM, message


def format_to_update_problem(format: int) -> Problem | None:
    """Return what is wrong with the format of glCompressedTexSubImage."""
    if format in COMPRESSED:
        return None
    code = gl.GL_INVALID_ENUM if format in GENERIC else gl.GL_INVALID_OPERATION
    return code, f"format={token_name(format)}: {_expected()}"


def same_format_problem(image: Image | None, format: int) -> Problem | None:
    """Return what is wrong if an image has another format."""
    assert image is not None
    if image.internal_format == format:
        return None
    return gl.GL_INVALID_OPERATION, f"format={token_name(format)}: the image is {token_name(image.internal_format)}"


def alignment_problem(image: Image | None, corner: Shape, shape: Shape) -> Problem | None:
    """Return what is wrong if a rectangle does not consist of whole blocks; at the border of the image, blocks end."""
    assert image is not None
    for at, side, length in zip(corner, shape, (image.width, image.height), strict=False):
        if at % BLOCK_SIDE or (side % BLOCK_SIDE and at + side != length):
            place, sides = (" x ".join(map(str, numbers[:2])) for numbers in (corner, shape))
            return gl.GL_INVALID_OPERATION, f"{sides} texels at {place}: expected blocks of {BLOCK_SIDE} x {BLOCK_SIDE}"
    return None


def compression_problem(internalformat: int, code: int) -> Problem | None:
    """Return what is wrong with a format that pixels are to be compressed to."""
    if COMPRESSED[internalformat].encode is not None:
        return None
    return code, f"internalformat={token_name(internalformat)}: this package does not compress pixels to it"


def to_compress_problem(target: int, border: int) -> Problem | None:
    """Return what is wrong with the target or border of glTexImage with a compressed format."""
    if target in (*ONE_DIMENSION, *RECTANGLES, *VOLUMES):
        return gl.GL_INVALID_ENUM, f"target={token_name(target)}: no format compresses such textures"
    return whole_border_problem(border)


def to_update_problem(image: Image, corner: Shape, shape: Shape) -> Problem | None:
    """Return what is wrong with a rectangle of pixels that replace some of a compressed image."""
    problem = compression_problem(image.internal_format, gl.GL_INVALID_OPERATION)
    return alignment_problem(image, corner, shape) or problem


def not_compressed_problem(image: Image | None) -> Problem | None:
    """Return what is wrong if there is no image, or one that is not compressed."""
    if image is None:
        return gl.GL_INVALID_VALUE, "the level of the bound texture is not defined"
    if image.blocks is not None:
        return None
    return gl.GL_INVALID_OPERATION, "the level of the bound texture is not compressed"
