"""Copies from the read framebuffer into textures."""

from __future__ import annotations

from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.errors import fail, outside_begin
from softshadow.gl.framebuffers import framebuffer_status
from softshadow.gl.pixel_formats import Problem
from softshadow.gl.texture_images import (
    COMPONENT_NUMBERS,
    border_problem,
    face_of,
    follow_base_level,
    internal_problem,
    level_problem,
    missing_problem,
    region_problem,
    size_problem,
)
from softshadow.gl.textures import bound_name, bound_texture, target_problem
from softshadow.image import FORMATS, WITH_STENCIL, Format
from softshadow.pipeline.commands import CopyToTexture, DefineImage
from softshadow.pixel_transfer import PixelTransfer


@in_lists
def glCopyTexImage2D(
    target: int, level: int, internalformat: int, x: int, y: int, width: int, height: int, border: int
) -> None:
    """Define a level of the bound texture from a rectangle of the read framebuffer.

    Texels outside the framebuffer become 0; if the level already had this format and size, they keep their values.
    """
    operation = "glCopyTexImage2D"
    if (context := outside_begin(operation)) is None:
        return None
    problem = (
        target_problem(context, target, faces=True)
        or level_problem(level)
        or _source_problem(context)
        or border_problem(border)
        or internal_problem(internalformat, gl.GL_INVALID_ENUM, exclude=COMPONENT_NUMBERS)
        or size_problem(target, level, width, height, border)
        or _copy_problem(context, FORMATS[internalformat], internalformat in WITH_STENCIL)
    )
    if problem:
        return fail(problem[0], operation, problem[1])
    texture, face = bound_texture(context, target), face_of(target)
    before = texture.images.get((face, level))
    if before is None or (before.internal_format, before.width, before.height) != (internalformat, width, height):
        stored = FORMATS[internalformat]
        context.execute(DefineImage(texture.name, face, level, stored, internalformat, width, height))
    place = (0, 0, x, y, width, height)
    context.execute(
        CopyToTexture(context.state.read_framebuffer, texture.name, face, level, *place, _transfer(context))
    )
    follow_base_level(context, texture, face, level)
    return None


@in_lists
def glCopyTexSubImage2D(
    target: int, level: int, xoffset: int, yoffset: int, x: int, y: int, width: int, height: int
) -> None:
    """Copy a rectangle of the read framebuffer into a level of the bound texture."""
    operation = "glCopyTexSubImage2D"
    if (context := outside_begin(operation)) is None:
        return None
    problem = (
        target_problem(context, target, faces=True)
        or _source_problem(context)
        or level_problem(level)
        or missing_problem(context, target, level)
        or region_problem(context, target, level, xoffset, yoffset, width, height)
    )
    if problem:
        return fail(problem[0], operation, problem[1])
    image = bound_texture(context, target).images[face_of(target), level]
    if problem := _copy_problem(context, image.format, image.stencil is not None):
        return fail(problem[0], operation, problem[1])
    framebuffer, name = context.state.read_framebuffer, bound_name(context, target)
    place = (xoffset, yoffset, x, y, width, height)
    context.execute(CopyToTexture(framebuffer, name, face_of(target), level, *place, _transfer(context)))
    follow_base_level(context, bound_texture(context, target), face_of(target), level)
    return None


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
