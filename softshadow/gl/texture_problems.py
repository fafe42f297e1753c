"""Wrong arguments of the calls that define and change texture images.

All functions return (error code, message), or None if nothing is wrong. A shape is (width, height, depth); sides that
an image does not have are 1.

References: teximage.c of Mesa 22.3, for the order of the checks.
"""

from __future__ import annotations

from math import prod

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.framebuffer import LARGEST_SIDE
from softshadow.gl.pixel_formats import Problem
from softshadow.gl.textures import FACES, image_at
from softshadow.image import FORMATS, Format, Image
from softshadow.tokens import token_name

LARGEST_LEVEL = LARGEST_SIDE.bit_length() - 1
LARGEST_3D = 2048
LARGEST_BYTES = 1 << 30  # of a texture, in llvmpipe
COMPONENT_NUMBERS = (1, 2, 3, 4)  # internal formats of GL 1.0, which glCopyTexImage does not take
RECTANGLES = (gl.GL_TEXTURE_RECTANGLE, gl.GL_PROXY_TEXTURE_RECTANGLE)
VOLUMES = (gl.GL_TEXTURE_3D, gl.GL_PROXY_TEXTURE_3D)
ONE_DIMENSION = (gl.GL_TEXTURE_1D, gl.GL_PROXY_TEXTURE_1D)
CUBE_MAPS = (*FACES, gl.GL_PROXY_TEXTURE_CUBE_MAP)
PROXIES = {
    gl.GL_PROXY_TEXTURE_1D: 1,
    gl.GL_PROXY_TEXTURE_2D: 2,
    gl.GL_PROXY_TEXTURE_RECTANGLE: 2,
    gl.GL_PROXY_TEXTURE_CUBE_MAP: 2,
    gl.GL_PROXY_TEXTURE_3D: 3,
}
Shape = tuple[int, int, int]


def largest_side(target: int) -> int:
    """Return the largest side of an image of level 0."""
    return LARGEST_3D if target in VOLUMES else LARGEST_SIDE


def level_problem(target: int, level: int) -> Problem | None:
    """Return what is wrong with the number of a level."""
    largest = 0 if target in RECTANGLES else largest_side(target).bit_length() - 1
    if 0 <= level <= largest:
        return None
    return gl.GL_INVALID_VALUE, f"level={level}: expected {f'0 to {largest}' if largest else '0'}"


def border_problem(target: int, border: int) -> Problem | None:
    """Return what is wrong with the width of a border."""
    if border == 0 or (border == 1 and target not in RECTANGLES):
        return None
    return gl.GL_INVALID_VALUE, f"border={border}: expected {'0' if target in RECTANGLES else '0 or 1'}"


def negative_problem(shape: Shape) -> Problem | None:
    """Return what is wrong with sides below 0."""
    if min(shape) >= 0:
        return None
    return gl.GL_INVALID_VALUE, f"{sides(shape)}: expected 0 or more"


def sides(shape: Shape) -> str:
    """Return the sides for a message, without a depth of 1."""
    width, height, depth = shape
    return f"width={width}, height={height}" + (f", depth={depth}" if depth != 1 else "")


def size_problem(target: int, level: int, shape: Shape, border: int = 0) -> Problem | None:
    """Return what is wrong with the sides of an image, its border included."""
    if problem := negative_problem(shape):
        return problem
    least, largest = 2 * border, (largest_side(target) >> level) + 2 * border
    lengths = shape[: 3 if target in VOLUMES else 1 if target in ONE_DIMENSION else 2]
    if not least <= min(lengths) <= max(lengths) <= largest:
        return gl.GL_INVALID_VALUE, f"{sides(shape)}: expected {least} to {largest} at level {level}"
    if target in CUBE_MAPS and shape[0] != shape[1]:
        return gl.GL_INVALID_VALUE, f"{sides(shape)}: expected a square face of a cube map"
    return None


def memory_problem(target: int, shape: Shape, stored: Format) -> Problem | None:
    """Return what is wrong with an image that would need more memory than a texture of llvmpipe can have."""
    faces = 6 if target in CUBE_MAPS else 1
    if faces * prod(shape) * np.dtype(stored.dtype).itemsize * stored.channels <= LARGEST_BYTES:
        return None
    return gl.GL_OUT_OF_MEMORY, f"{sides(shape)}: a texture has {LARGEST_BYTES >> 20} MiB at most"


def internal_problem(internalformat: int, code: int, exclude: tuple[int, ...] = ()) -> Problem | None:
    """Return what is wrong with an internal format; the error code differs from call to call."""
    if internalformat in FORMATS and internalformat not in exclude:
        return None
    if token_name(internalformat).startswith("GL_COMPRESSED"):
        return code, f"internalformat={token_name(internalformat)}: this package does not compress to it here"
    known = ", ".join(token_name(f) for f in FORMATS if f not in COMPONENT_NUMBERS)
    return code, f"internalformat={token_name(internalformat)}: expected one of {known}"


def base_format_problem(target: int, internalformat: int) -> Problem | None:
    """Return what is wrong with depths or stencil values in a texture of three dimensions."""
    if target not in VOLUMES or FORMATS[internalformat].kind not in ("depth", "stencil"):
        return None
    return gl.GL_INVALID_OPERATION, f"internalformat={token_name(internalformat)}: 3-D textures hold colours only"


def missing_problem(context: Context, target: int, level: int) -> Problem | None:
    """Return what is wrong if the level is not defined."""
    if image_at(context, target, level) is not None:
        return None
    return gl.GL_INVALID_OPERATION, f"level {level} of the bound texture is not defined: call glTexImage first"


def compressed_problem(image: Image | None) -> Problem | None:
    """Return what is wrong with an image that a framebuffer would be copied to."""
    if image is None or image.blocks is None:
        return None
    reason = f"the image is {token_name(image.internal_format)}: this package does not compress copies"
    return gl.GL_INVALID_OPERATION, reason


def region_problem(context: Context, target: int, level: int, corner: Shape, shape: Shape) -> Problem | None:
    """Return what is wrong if a rectangle or box is not inside the image."""
    if problem := negative_problem(shape):
        return problem
    image = image_at(context, target, level)
    assert image is not None
    whole = image.width, image.height, image.slices
    if all(at >= 0 and at + side <= length for at, side, length in zip(corner, shape, whole, strict=True)):
        return None
    n = 3 if target in VOLUMES else 2
    region, place, total = (
        " x ".join(map(str, shape[:n])), ", ".join(map(str, corner[:n])), " x ".join(map(str, whole[:n])),
    )  # fmt: skip
    figure = "box" if n == 3 else "rectangle"
    return gl.GL_INVALID_VALUE, f"the {figure} of {region} at ({place}) leaves the image of {total}"
