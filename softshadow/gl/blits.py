"""glBlitFramebuffer: rectangles copied from the read framebuffer to the draw framebuffer."""

from __future__ import annotations

from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.framebuffer import DEFAULT, Framebuffer
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.errors import fail, outside_begin
from softshadow.gl.framebuffers import Problem, framebuffer_status
from softshadow.image import D24, FORMATS, WITH_STENCIL, Format
from softshadow.pipeline.commands import BlitFramebuffer
from softshadow.tokens import token_name

WITHOUT_FILTER = gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT
BLIT_BITS = gl.GL_COLOR_BUFFER_BIT | WITHOUT_FILTER


@in_lists
def glBlitFramebuffer(
    srcX0: int, srcY0: int, srcX1: int, srcY1: int, dstX0: int, dstY0: int, dstX1: int, dstY1: int,
    mask: int, filter: int,
) -> None:  # fmt: skip
    """Copy a rectangle of the read framebuffer to one of the draw framebuffer: scaled, mirrored, under the scissor.

    Tests, masks and blending do not count. Buffers that one of the two has not are passed over.
    """
    context = outside_begin("glBlitFramebuffer")
    if context is None:
        return
    if problem := _problem(context, int(mask), filter):
        fail(problem[0], "glBlitFramebuffer", problem[1])
        return
    state = context.state
    source, target = (int(srcX0), int(srcY0), int(srcX1), int(srcY1)), (int(dstX0), int(dstY0), int(dstX1), int(dstY1))
    command = BlitFramebuffer(
        state.read_framebuffer, state.draw_framebuffer, source, target, int(mask), int(filter), state.scissor
    )
    context.execute(command)


def _problem(context: Context, mask: int, filter: int) -> Problem | None:
    """Return (error code, why) where the blit cannot be, else None."""
    names = (context.state.read_framebuffer, context.state.draw_framebuffer)
    for name in names:
        if framebuffer_status(context, name) != gl.GL_FRAMEBUFFER_COMPLETE:
            return gl.GL_INVALID_FRAMEBUFFER_OPERATION, f"framebuffer {name} is not complete"
    if filter not in (gl.GL_NEAREST, gl.GL_LINEAR):
        return gl.GL_INVALID_ENUM, f"filter={token_name(filter)}: expected GL_NEAREST or GL_LINEAR"
    if mask & ~BLIT_BITS:
        return gl.GL_INVALID_VALUE, f"mask=0x{mask:X}: expected bits of colour, depth and stencil only"
    if mask & WITHOUT_FILTER and filter != gl.GL_NEAREST:
        return gl.GL_INVALID_OPERATION, "filter=GL_LINEAR: depth and stencil take GL_NEAREST"
    read, drawn = (context.storage.framebuffers[name] for name in names)
    depths = {each.depth.format for each in (read, drawn) if each.depth is not None}
    if mask & gl.GL_DEPTH_BUFFER_BIT and len(depths) > 1:
        return gl.GL_INVALID_OPERATION, "the two depth buffers have different formats"
    if mask & gl.GL_STENCIL_BUFFER_BIT and read.stencil is not None and drawn.stencil is not None:
        formats = {_depth_beside(read), _depth_beside(drawn)} - {None}
        if len(formats) > 1:
            return gl.GL_INVALID_OPERATION, "the depths beside the two stencil buffers have different formats"
    return None


def _depth_beside(target: Framebuffer) -> Format | None:
    """Return the format of the depths that are stored with the stencil values, whether attached or not."""
    if target.name == DEFAULT:
        return D24  # as on Mesa; what else the window's depth may be here does not lie with the stencil values
    assert target.stencil is not None
    internal_format = target.stencil.internal_format
    return FORMATS[internal_format] if internal_format in WITH_STENCIL else None


__all__ = spelled_like_gl(globals())
