"""Copies from the read framebuffer into textures."""

from __future__ import annotations

from typing import Any

from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.errors import fail, outside_begin
from softshadow.gl.framebuffers import framebuffer_status
from softshadow.gl.pixel_formats import Problem
from softshadow.gl.texture_mipmaps import follow_base_level
from softshadow.gl.texture_problems import (
    COMPONENT_NUMBERS,
    Shape,
    border_problem,
    compressed_problem,
    internal_problem,
    level_problem,
    missing_problem,
    region_problem,
    size_problem,
)
from softshadow.gl.textures import bound_texture, face_of, image_target_problem, note_defined
from softshadow.image import FORMATS, WITH_STENCIL, Format
from softshadow.pipeline.commands import CopyToTexture, DefineImage
from softshadow.pixel_transfer import PixelTransfer


def glCopyTexImage1D(target: int, level: int, internalformat: int, x: int, y: int, width: int, border: int) -> None:
    """Define a level of the bound 1-D texture from part of a row of the read framebuffer; see `glCopyTexImage2D`."""
    _copy_image("glCopyTexImage1D", 1, target, level, internalformat, (x, y), (width, 1, 1), border)


def glCopyTexImage2D(
    target: int, level: int, internalformat: int, x: int, y: int, width: int, height: int, border: int
) -> None:
    """Define a level of the bound texture from a rectangle of the read framebuffer.

    Texels outside the framebuffer become 0; if the level already had this format and size, they keep their values.
    Depths are looked up as GL_LUMINANCE, as on Mesa, until GL_DEPTH_TEXTURE_MODE changes after this call.
    """
    _copy_image("glCopyTexImage2D", 2, target, level, internalformat, (x, y), (width, height, 1), border)


def glCopyTexSubImage1D(target: int, level: int, xoffset: int, x: int, y: int, width: int) -> None:
    """Copy part of a row of the read framebuffer into a level of the bound 1-D texture."""
    _copy_part("glCopyTexSubImage1D", 1, target, level, (xoffset, 0, 0), (x, y), (width, 1, 1))


def glCopyTexSubImage2D(
    target: int, level: int, xoffset: int, yoffset: int, x: int, y: int, width: int, height: int
) -> None:
    """Copy a rectangle of the read framebuffer into a level of the bound texture."""
    _copy_part("glCopyTexSubImage2D", 2, target, level, (xoffset, yoffset, 0), (x, y), (width, height, 1))


def glCopyTexSubImage3D(
    target: int, level: int, xoffset: int, yoffset: int, zoffset: int, x: int, y: int, width: int, height: int
) -> None:
    """Copy a rectangle of the read framebuffer into a slice of a level of the bound 3-D texture."""
    _copy_part("glCopyTexSubImage3D", 3, target, level, (xoffset, yoffset, zoffset), (x, y), (width, height, 1))


@in_lists
def _copy_image(
    operation: str,
    dimensions: int,
    target: int,
    level: int,
    internalformat: int,
    origin: tuple[int, int],
    shape: Shape,
    border: int,
) -> None:
    if (context := outside_begin(operation)) is None:
        return None
    origin, shape = _whole(origin), _whole(shape)
    problem = (
        image_target_problem(target, dimensions)
        or level_problem(target, level)
        or _source_problem(context)
        or border_problem(target, border)
        or internal_problem(internalformat, gl.GL_INVALID_ENUM, exclude=COMPONENT_NUMBERS)
        or size_problem(target, level, shape, border)
        or _copy_problem(context, FORMATS[internalformat], internalformat in WITH_STENCIL)
    )
    if problem:
        return fail(problem[0], operation, problem[1])
    if border:  # which Mesa drops
        origin, shape = _without_border(dimensions, origin, shape)
    texture, face, (width, height, _) = bound_texture(context, target), face_of(target), shape
    before, stored = texture.images.get((face, level)), FORMATS[internalformat]
    layout = stored, internalformat, width, height
    if before is None or (before.format, before.internal_format, before.width, before.height) != layout:
        context.execute(DefineImage(texture.name, face, level, stored, internalformat, width, height))
        if stored.kind == "depth":
            note_defined(context, texture, level, depths_copied=True)
    place = (0, 0, *origin, width, height)
    context.execute(
        CopyToTexture(context.state.read_framebuffer, texture.name, face, level, *place, _transfer(context))
    )
    follow_base_level(context, texture, face, level)
    return None


@in_lists
def _copy_part(
    operation: str, dimensions: int, target: int, level: int, corner: Shape, origin: tuple[int, int], shape: Shape
) -> None:
    if (context := outside_begin(operation)) is None:
        return None
    corner, origin, shape = _whole(corner), _whole(origin), _whole(shape)
    problem = (
        image_target_problem(target, dimensions)
        or _source_problem(context)
        or level_problem(target, level)
        or missing_problem(context, target, level)
        or region_problem(context, target, level, corner, shape)
    )
    if problem:
        return fail(problem[0], operation, problem[1])
    texture, face = bound_texture(context, target), face_of(target)
    image = texture.images[face, level]
    if problem := _copy_problem(context, image.format, image.stencil is not None) or compressed_problem(image):
        return fail(problem[0], operation, problem[1])
    (x, y, z), (width, height, _) = corner, shape
    place = (x, y, *origin, width, height)
    framebuffer = context.state.read_framebuffer
    context.execute(CopyToTexture(framebuffer, texture.name, face, level, *place, _transfer(context), z))
    follow_base_level(context, texture, face, level)
    return None


def _without_border(dimensions: int, origin: tuple[int, int], shape: Shape) -> tuple[tuple[int, int], Shape]:
    """Return corner and sides of what is copied of a rectangle whose image would have a border."""
    (x, y), (width, height, _) = origin, shape
    if dimensions == 1:
        return (x + 1, y), (width - 2, height, 1)
    return (x + 1, y + 1), (width - 2, height - 2, 1)


def _whole(numbers: tuple[int, ...]) -> Any:
    """Return numbers without their fractions, as ctypes converts what PyOpenGL gets."""
    return tuple(int(number) for number in numbers)


def _transfer(context: Context) -> PixelTransfer | None:
    transfer = context.pixel_transfer
    return transfer if transfer.through_floats or transfer.changes_depth else None


def _source_problem(context: Context) -> Problem | None:
    name = context.state.read_framebuffer
    if framebuffer_status(context, name) == gl.GL_FRAMEBUFFER_COMPLETE:
        return None
    return gl.GL_INVALID_FRAMEBUFFER_OPERATION, f"framebuffer {name} is not complete"


def _copy_problem(context: Context, stored: Format, with_stencil: bool) -> Problem | None:
    source = context.objects.framebuffers[context.state.read_framebuffer]
    if stored.kind == "stencil":
        return gl.GL_INVALID_OPERATION, "this subset copies stencil values only into packed depth and stencil"
    missing = None
    if stored.kind == "depth" and source.depth is None:
        missing = "depth"
    elif with_stencil and source.stencil is None:
        missing = "stencil"
    elif stored.kind != "depth" and source.read_color is None:
        missing = "colour"
    return (gl.GL_INVALID_OPERATION, f"framebuffer {source.name} has no {missing} buffer to read") if missing else None


__all__ = spelled_like_gl(globals())
