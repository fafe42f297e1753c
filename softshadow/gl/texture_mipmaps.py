"""Mipmap levels of textures: computed by a call, or whenever the base level changes."""

from __future__ import annotations

from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.gl.calls import spelled_like_gl
from softshadow.gl.compressed_mipmaps import generate_compressed
from softshadow.gl.compression_problems import compression_problem
from softshadow.gl.errors import fail, outside_begin
from softshadow.gl.pixel_formats import Problem
from softshadow.gl.textures import bound_name, bound_texture, target_problem
from softshadow.pipeline.commands import GenerateMipmaps
from softshadow.texture import Texture


def glGenerateMipmap(target: int) -> None:
    """Compute all mipmap levels of the bound texture from its base level."""
    operation = "glGenerateMipmap"
    if (context := outside_begin(operation)) is None:
        return None
    if target == gl.GL_TEXTURE_RECTANGLE:
        return fail(gl.GL_INVALID_ENUM, operation, "target=GL_TEXTURE_RECTANGLE: rectangles have no mipmaps")
    if problem := target_problem(target) or _base_problem(context, target):
        return fail(problem[0], operation, problem[1])
    texture = bound_texture(context, target)
    base = texture.base(texture.faces[0])
    if base is not None and base.width and base.height and base.slices:  # as in Mesa, an empty image gets no levels
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
    return None if first.blocks is None else compression_problem(first.internal_format, gl.GL_INVALID_OPERATION)


def follow_base_level(context: Context, texture: Texture, face: int, level: int) -> None:
    """Compute the mipmaps of a face after a change of its base level, if GL_GENERATE_MIPMAP is on."""
    sampler = texture.sampler
    base = texture.base(face)
    if sampler.generate_mipmap and level == sampler.base_level and base is not None and base.stencil is None:
        if base.blocks is not None:
            problem = compression_problem(base.internal_format, gl.GL_INVALID_OPERATION)
            if problem:
                fail(problem[0], "GL_GENERATE_MIPMAP", problem[1])
                return
        _generate(context, texture, (face,))


def _generate(context: Context, texture: Texture, faces: tuple[int, ...]) -> None:
    base, last = texture.sampler.base_level, texture.last_level(faces[0])
    if last > base and texture.images[faces[0], base].blocks is not None:
        for face in faces:
            generate_compressed(context, texture, face, base, last)
    elif last > base:
        context.execute(GenerateMipmaps(texture.name, faces, base, last))


__all__ = spelled_like_gl(globals())
