"""Conditional rendering: draws that depend on the result of an occlusion query.

Results are known at once here, so the modes that need not wait draw as those that wait.

References: GL 3.0, sec. 2.14; NV_conditional_render, ARB_conditional_render_inverted; condrender.c of Mesa 22.3.
"""

from __future__ import annotations

from softshadow import tokens as gl
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.errors import fail, is_one_of, outside_begin
from softshadow.gl.render_modes import install_gate

MODES = (gl.GL_QUERY_WAIT, gl.GL_QUERY_NO_WAIT, gl.GL_QUERY_BY_REGION_WAIT, gl.GL_QUERY_BY_REGION_NO_WAIT)
INVERTED = (
    gl.GL_QUERY_WAIT_INVERTED, gl.GL_QUERY_NO_WAIT_INVERTED, gl.GL_QUERY_BY_REGION_WAIT_INVERTED,
    gl.GL_QUERY_BY_REGION_NO_WAIT_INVERTED,
)  # fmt: skip
A_MODE = "GL_QUERY_WAIT … GL_QUERY_BY_REGION_NO_WAIT_INVERTED"


@in_lists
def glBeginConditionalRender(id: int, mode: int) -> None:
    """Draw, clear and blit only if fragments have passed in a query; with an inverted mode, only if none have.

    Raises
    ------
    GLError
        GL_INVALID_VALUE for an unknown query; GL_INVALID_ENUM for another mode; GL_INVALID_OPERATION for a query that
        was never begun or has not been ended, and within conditional rendering.
    """
    operation, context, name = "glBeginConditionalRender", outside_begin("glBeginConditionalRender"), int(id)
    if context is None:
        return
    context.flush()
    if context.render_mode.condition is not None:
        fail(gl.GL_INVALID_OPERATION, operation, "there was no glEndConditionalRender before it")
    elif not (0 < name <= context.names["query"]):
        fail(gl.GL_INVALID_VALUE, operation, f"id={id}: expected a query")
    elif not is_one_of(operation, "mode", mode, (*MODES, *INVERTED), A_MODE):
        return
    elif name not in context.query_targets or name == context.objects.active_query:
        fail(gl.GL_INVALID_OPERATION, operation, f"id={id}: expected a query that has been ended")
    else:
        context.render_mode.condition = name, mode in INVERTED
        install_gate(context)


@in_lists
def glEndConditionalRender() -> None:
    """Draw unconditionally again."""
    context = outside_begin("glEndConditionalRender")
    if context is None:
        return
    if context.render_mode.condition is None:
        fail(gl.GL_INVALID_OPERATION, "glEndConditionalRender", "there was no glBeginConditionalRender before it")
        return
    context.flush()
    context.render_mode.condition = None


__all__ = spelled_like_gl(globals())
