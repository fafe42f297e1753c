"""The accumulation buffer, which only the window has."""

from __future__ import annotations

from softshadow import tokens as gl
from softshadow.framebuffer import DEFAULT
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.errors import fail, is_one_of, outside_begin
from softshadow.gl.fragment_state import rounded, rounded_number
from softshadow.pipeline.commands import Accumulate

OPERATIONS = (gl.GL_ACCUM, gl.GL_LOAD, gl.GL_ADD, gl.GL_MULT, gl.GL_RETURN)
AN_OPERATION = "GL_ACCUM, GL_LOAD, GL_ADD, GL_MULT or GL_RETURN"


@in_lists
def glClearAccum(red: float, green: float, blue: float, alpha: float) -> None:
    """Set the clear colour of the accumulation buffer, clamped to [-1, 1]."""
    context = outside_begin("glClearAccum")
    if context is not None:
        context.touched |= gl.GL_ACCUM_BUFFER_BIT
        clamped = [min(max(-1.0, float(c)), 1.0) for c in (red, green, blue, alpha)]
        context.change("color", clear_accum=rounded(context, *clamped))


@in_lists
def glAccum(op: int, value: float) -> None:
    """Add colours to the accumulation buffer, scale it, or copy it to the colour buffer, inside the scissor box."""
    context = outside_begin("glAccum")
    if context is None or not is_one_of("glAccum", "op", op, OPERATIONS, AN_OPERATION):
        return
    state = context.state
    if not (state.draw_framebuffer == state.read_framebuffer == DEFAULT):
        fail(gl.GL_INVALID_OPERATION, "glAccum", "a framebuffer object has no accumulation buffer")
    else:
        context.execute(Accumulate(state, int(op), rounded_number(context, value)))


__all__ = spelled_like_gl(globals())
