"""Clear values, glClear, glFlush and glFinish."""

from __future__ import annotations

from ctypes import c_int

from softshadow import tokens as gl
from softshadow.context import thread
from softshadow.gl.calls import is_allowed, spelled_like_gl
from softshadow.gl.errors import fail, outside_begin
from softshadow.gl.fragment_state import clamp01, rounded
from softshadow.gl.framebuffers import can_draw
from softshadow.pipeline.commands import Clear

BUFFER_BITS = gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT | gl.GL_ACCUM_BUFFER_BIT
OTHER_BITS = ~BUFFER_BITS


def glClearColor(red: float, green: float, blue: float, alpha: float) -> None:
    """Set the clear colour."""
    context = thread.context
    if context.ready or is_allowed(context, glClearColor, red, green, blue, alpha):
        context.touched |= gl.GL_COLOR_BUFFER_BIT
        context.change_field("color", "clear", rounded(context, red, green, blue, alpha))


def glClearDepth(depth: float) -> None:
    """Set the clear depth, clamped to [0, 1]."""
    context = thread.context
    if context.ready or is_allowed(context, glClearDepth, depth):
        context.touched |= gl.GL_DEPTH_BUFFER_BIT
        context.change_field("depth", "clear", clamp01(depth))


glClearDepthf = glClearDepth


def glClearStencil(s: int) -> None:
    """Set the clear value of the stencil buffer."""
    context = thread.context
    if context.ready or is_allowed(context, glClearStencil, s):
        context.touched |= gl.GL_STENCIL_BUFFER_BIT
        context.change_field("stencil", "clear", c_int(int(s)).value)


def glClear(mask: int) -> None:
    """Clear buffers; scissor box and write masks apply, the fragment tests do not."""
    context = thread.context
    if not (context.ready or is_allowed(context, glClear, mask)):
        return
    if mask & OTHER_BITS:
        fail(gl.GL_INVALID_VALUE, "glClear", f"mask=0x{mask:X}: expected only buffer bits")
        return
    if can_draw(context, "glClear"):
        context.execute(Clear(context.state, int(mask)))


def glFlush() -> None:
    """Draw the collected vertices; everything else has already been carried out."""
    context = outside_begin("glFlush")
    if context is not None:
        context.flush()


def glFinish() -> None:
    """Draw the collected vertices, and write the pending rows of all buffers."""
    context = outside_begin("glFinish")
    if context is not None:
        context.finish()
        context.objects.write_pending()


__all__ = spelled_like_gl(globals())
