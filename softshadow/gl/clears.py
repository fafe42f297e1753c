"""Clear values, glClear, and the end of a frame."""

from __future__ import annotations

from ctypes import c_int

from softshadow import tokens as gl
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.errors import fail, outside_begin
from softshadow.gl.fragment_state import change, clamp01, rounded
from softshadow.gl.framebuffers import framebuffer_status
from softshadow.pipeline.commands import Clear

BUFFER_BITS = gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT | gl.GL_ACCUM_BUFFER_BIT


@in_lists
def glClearColor(red: float, green: float, blue: float, alpha: float) -> None:
    """Set the colour that glClear writes."""
    context = outside_begin("glClearColor")
    if context is not None:
        context.touched |= gl.GL_COLOR_BUFFER_BIT
        change(context, "color", clear=rounded(context, red, green, blue, alpha))


@in_lists
def glClearDepth(depth: float) -> None:
    """Set the depth that glClear writes, clamped to [0, 1]."""
    context = outside_begin("glClearDepth")
    if context is not None:
        context.touched |= gl.GL_DEPTH_BUFFER_BIT
        change(context, "depth", clear=clamp01(depth))


glClearDepthf = glClearDepth


@in_lists
def glClearStencil(s: int) -> None:
    """Set the stencil value that glClear writes."""
    context = outside_begin("glClearStencil")
    if context is not None:
        context.touched |= gl.GL_STENCIL_BUFFER_BIT
        change(context, "stencil", clear=c_int(int(s)).value)


@in_lists
def glClear(mask: int) -> None:
    """Clear buffers: under scissor and write masks, whatever the tests are set to."""
    context = outside_begin("glClear")
    if context is None:
        return
    if mask & ~BUFFER_BITS:
        fail(gl.GL_INVALID_VALUE, "glClear", f"mask=0x{mask:X}: expected buffer bits only")
    elif framebuffer_status(context, context.state.draw_framebuffer) != gl.GL_FRAMEBUFFER_COMPLETE:
        name = context.state.draw_framebuffer
        fail(gl.GL_INVALID_FRAMEBUFFER_OPERATION, "glClear", f"framebuffer {name} is not complete")
    else:
        context.execute(Clear(context.state, int(mask)))


def glFlush() -> None:
    """Draw triangles and quads that wait for more; everything else has been carried out when its call returned."""
    context = outside_begin("glFlush")
    if context is not None:
        context.settle()


def glFinish() -> None:
    """Draw triangles and quads that wait for more, and write what is known of buffers but not written."""
    context = outside_begin("glFinish")
    if context is not None:
        context.settle()
        context.storage.settle()


__all__ = spelled_like_gl(globals())
