"""Selection and feedback: draws go to a buffer of hit records or of vertices, not into the framebuffer.

References: GL 2.1, sec. 5.2 and 5.3; feedback.c and st_cb_feedback.c of Mesa 22.3.
"""

from __future__ import annotations

from collections.abc import Callable
from ctypes import c_uint
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, current
from softshadow.context.render_mode import MOST_NAMES
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.errors import fail, is_one_of, outside_begin
from softshadow.gl.hit_records import feedback_tokens, select_records
from softshadow.pipeline.commands import Accumulate, BlitFramebuffer, Clear, Command, Draw, DrawDepths
from softshadow.pipeline.geometry.window_primitives import window_primitives

MODES = (gl.GL_RENDER, gl.GL_SELECT, gl.GL_FEEDBACK)
FEEDBACK_TYPES = (gl.GL_2D, gl.GL_3D, gl.GL_3D_COLOR, gl.GL_3D_COLOR_TEXTURE, gl.GL_4D_COLOR_TEXTURE)
TOKENS = {1: gl.GL_POINT_TOKEN, 2: gl.GL_LINE_TOKEN, 3: gl.GL_POLYGON_TOKEN}


def install_gate(context: Context) -> None:
    """Let a context ask before each command what becomes of it."""
    if context.render_mode.has_gate:
        return
    context.render_mode.has_gate = True
    before, modes = context.stream.gate, context.render_mode

    def is_carried_out(command: Command) -> bool:
        if isinstance(command, Draw | Clear | Accumulate) and modes.mode != gl.GL_RENDER:
            if isinstance(command, Draw):
                _take(context, command)
            return False
        if isinstance(command, Draw | DrawDepths | Clear | BlitFramebuffer) and modes.condition is not None:
            query, draws_if_none = modes.condition
            if (context.storage.queries.get(query, 0) == 0) != draws_if_none:
                return False
        return before is None or before(command)

    context.stream.gate = is_carried_out


def _take(context: Context, command: Draw) -> None:
    """Write a draw to the buffer of the mode."""
    modes = context.render_mode
    window, colors, texcoords, primitives = window_primitives(command, context.objects)
    if modes.mode == gl.GL_SELECT:
        modes.selection.hit(window[[vertex for vertices in primitives for vertex in vertices], 2])
        return
    feedback = modes.feedback
    for vertices in primitives:
        if not vertices:
            feedback.resets_line = True
            continue
        token = TOKENS[len(vertices)]
        if token == gl.GL_LINE_TOKEN and feedback.resets_line:
            token, feedback.resets_line = gl.GL_LINE_RESET_TOKEN, False
        feedback.write(token, *((len(vertices),) if token == gl.GL_POLYGON_TOKEN else ()))
        for vertex in vertices:
            feedback.write_vertex(window[vertex], colors[vertex], texcoords[vertex])


def is_rendered(context: Context, token: int) -> bool:
    """Return whether pixels are drawn at the raster position; in feedback mode, write it after a token."""
    if context.render_mode.mode == gl.GL_FEEDBACK:
        raster, feedback = context.current.raster, context.render_mode.feedback
        feedback.write(token)
        feedback.write_vertex(
            *(np.array(row, np.float32) for row in (raster.window, raster.color, raster.texcoords[0]))
        )
    return context.render_mode.mode == gl.GL_RENDER


def note_raster_position(context: Context) -> None:
    """Count the raster position as a hit in selection mode."""
    if context.render_mode.mode == gl.GL_SELECT:
        context.render_mode.selection.hit(np.array([context.current.raster.window[2]], np.float32))


# -- modes and buffers -------------------------------------------------------------------------------------------------
def glRenderMode(mode: int) -> Any:
    """Choose GL_RENDER, GL_SELECT or GL_FEEDBACK.

    Returns
    -------
    int or list
        As in PyOpenGL: after GL_RENDER 0, after GL_SELECT a list of hit records, after GL_FEEDBACK a list of tuples.

    Raises
    ------
    GLError
        GL_INVALID_ENUM for another mode; GL_INVALID_OPERATION for a mode whose buffer has not been given;
        GL_STACK_OVERFLOW if the buffer of the last mode was too small.
    """
    context = outside_begin("glRenderMode")
    if context is None:
        return None
    context.flush()
    modes = context.render_mode
    left, result = modes.mode, _end_mode(context)
    if not is_one_of("glRenderMode", "mode", mode, MODES, "GL_RENDER, GL_SELECT or GL_FEEDBACK"):
        return None
    buffers: dict[int, Any] = {gl.GL_SELECT: modes.selection, gl.GL_FEEDBACK: modes.feedback}
    modes.mode = int(mode)  # Mesa changes the mode also where it reports an error
    if mode != gl.GL_RENDER:
        install_gate(context)
        if buffers[mode].size == 0:
            call = "glSelectBuffer" if mode == gl.GL_SELECT else "glFeedbackBuffer"
            return fail(gl.GL_INVALID_OPERATION, "glRenderMode", f"there was no {call} before it")
    if left == gl.GL_RENDER:
        return 0
    if result < 0:
        return fail(gl.GL_STACK_OVERFLOW, "glRenderMode", "the buffer is too small for the results")
    buffer = buffers[left].buffer
    return (
        select_records(buffer, result) if left == gl.GL_SELECT else feedback_tokens(buffer, result, modes.feedback.kind)
    )


def _end_mode(context: Context) -> int:
    """Return the number of hits or values of the mode that ends, -1 if the buffer is too small for them."""
    selection, feedback = context.render_mode.selection, context.render_mode.feedback
    if context.render_mode.mode == gl.GL_SELECT:
        selection.end_record()
        result = -1 if selection.count > selection.size else selection.hits
        selection.count = selection.hits = 0
        selection.names.clear()
        selection.forget_hits()
        return result
    if context.render_mode.mode == gl.GL_FEEDBACK:
        result = -1 if feedback.count > feedback.size else feedback.count
        feedback.count = 0
        return result
    return 0


def glSelectBuffer(size: int, buffer: Any = None) -> Any:
    """Return the array uint32 of `size` numbers that hit records are written to: `buffer`, or a new one."""
    context = outside_begin("glSelectBuffer")
    if context is None:
        return None
    if size < 0:
        return fail(gl.GL_INVALID_VALUE, "glSelectBuffer", f"size={size}: expected 0 or more")
    if context.render_mode.mode == gl.GL_SELECT:
        return fail(gl.GL_INVALID_OPERATION, "glSelectBuffer", "not allowed in selection mode")
    context.flush()
    array = _buffer("glSelectBuffer", buffer, int(size), np.uint32)
    selection = context.render_mode.selection
    selection.buffer, selection.size, selection.count = array, int(size), 0
    selection.forget_hits()
    return array


def glFeedbackBuffer(size: int, type: int, buffer: Any = None) -> Any:
    """Return the array float32 of `size` values that vertices are written to: `buffer`, or a new one."""
    context = outside_begin("glFeedbackBuffer")
    if context is None:
        return None
    if context.render_mode.mode == gl.GL_FEEDBACK:
        return fail(gl.GL_INVALID_OPERATION, "glFeedbackBuffer", "not allowed in feedback mode")
    if size < 0:
        return fail(gl.GL_INVALID_VALUE, "glFeedbackBuffer", f"size={size}: expected 0 or more")
    if not is_one_of("glFeedbackBuffer", "type", type, FEEDBACK_TYPES, "GL_2D … GL_4D_COLOR_TEXTURE"):
        return None
    context.flush()
    array = _buffer("glFeedbackBuffer", buffer, int(size), np.float32)
    feedback = context.render_mode.feedback
    feedback.buffer, feedback.size, feedback.kind, feedback.count = array, int(size), int(type), 0
    return array


def _buffer(operation: str, buffer: Any, size: int, dtype: type[np.generic]) -> np.ndarray:
    if buffer is None:
        return np.zeros(size, dtype)
    array = np.asarray(buffer)
    if array.dtype.itemsize != 4 or array.size < size or not array.flags.writeable or not array.flags.c_contiguous:
        expected = f"a writeable array of {size} numbers {np.dtype(dtype)}"
        raise ValueError(f"{operation}(buffer): expected {expected}, got {array.dtype} {array.shape}")
    return array.reshape(-1).view(dtype)


# -- names and markers -------------------------------------------------------------------------------------------------
def _changes_names(call: Callable[..., None]) -> Callable[..., None]:
    """Write the hit record of the names before they change; outside selection mode do nothing (decorator)."""

    def changed(*arguments: Any) -> None:
        context = outside_begin(call.__name__)
        if context is None or context.render_mode.mode != gl.GL_SELECT:
            return
        context.flush()
        call(*arguments)

    changed.__name__, changed.__qualname__, changed.__doc__ = call.__name__, call.__name__, call.__doc__
    return in_lists(changed)


@_changes_names
def glInitNames() -> None:
    """Empty the name stack."""
    selection = current().render_mode.selection
    selection.end_record()
    selection.names.clear()
    selection.forget_hits()


@_changes_names
def glLoadName(name: int) -> None:
    """Replace the topmost name."""
    selection = current().render_mode.selection
    if not selection.names:
        fail(gl.GL_INVALID_OPERATION, "glLoadName", "the name stack is empty")
        return
    selection.end_record()
    selection.names[-1] = c_uint(int(name)).value


@_changes_names
def glPushName(name: int) -> None:
    """Push a name."""
    selection = current().render_mode.selection
    if len(selection.names) >= MOST_NAMES:
        fail(gl.GL_STACK_OVERFLOW, "glPushName", f"more than {MOST_NAMES} names")
        return
    selection.end_record()
    selection.names.append(c_uint(int(name)).value)


@_changes_names
def glPopName() -> None:
    """Remove the topmost name."""
    selection = current().render_mode.selection
    if not selection.names:
        fail(gl.GL_STACK_UNDERFLOW, "glPopName", "the name stack is empty")
        return
    selection.end_record()
    selection.names.pop()


@in_lists
def glPassThrough(token: float) -> None:
    """Write a marker to the feedback buffer."""
    context = outside_begin("glPassThrough")
    if context is not None and context.render_mode.mode == gl.GL_FEEDBACK:
        context.flush()
        context.render_mode.feedback.write(gl.GL_PASS_THROUGH_TOKEN, float(np.float32(token)))


__all__ = spelled_like_gl(globals())
