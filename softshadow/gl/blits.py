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
    """Copy a rectangle of the read framebuffer to the draw framebuffer, scaled or mirrored, inside the scissor box.

    Tests, masks and blending do not apply. Buffers that only one of the framebuffers has are skipped.
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
    """Return (error code, message) if the blit is not allowed, else None."""
    names = (context.state.read_framebuffer, context.state.draw_framebuffer)
    for name in names:
        if framebuffer_status(context, name) != gl.GL_FRAMEBUFFER_COMPLETE:
            return gl.GL_INVALID_FRAMEBUFFER_OPERATION, f"framebuffer {name} is not complete"
    if filter not in (gl.GL_NEAREST, gl.GL_LINEAR):
        return gl.GL_INVALID_ENUM, f"filter={token_name(filter)}: expected GL_NEAREST or GL_LINEAR"
    if mask & ~BLIT_BITS:
        return gl.GL_INVALID_VALUE, f"mask=0x{mask:X}: expected only colour, depth and stencil bits"
    if mask & WITHOUT_FILTER and filter != gl.GL_NEAREST:
        return gl.GL_INVALID_OPERATION, "filter=GL_LINEAR: expected GL_NEAREST for depth and stencil"
    source, target = (context.objects.framebuffers[name] for name in names)
    depths = {each.depth.format for each in (source, target) if each.depth is not None}
    if mask & gl.GL_DEPTH_BUFFER_BIT and len(depths) > 1:
        return gl.GL_INVALID_OPERATION, "the two depth buffers have different formats"
    if mask & gl.GL_STENCIL_BUFFER_BIT and source.stencil is not None and target.stencil is not None:
        formats = {_packed_depth(source), _packed_depth(target)} - {None}
        if len(formats) > 1:
            return gl.GL_INVALID_OPERATION, "the depth formats packed with the two stencil buffers differ"
    return None


def _packed_depth(target: Framebuffer) -> Format | None:
    """Return the depth format packed with the stencil buffer, attached or not; None for stencil alone."""
    if target.name == DEFAULT:
        return D24  # as in Mesa; another depth format of the window is not packed with its stencil buffer
    assert target.stencil is not None
    internal_format = target.stencil.internal_format
    return FORMATS[internal_format] if internal_format in WITH_STENCIL else None


__all__ = spelled_like_gl(globals())
