"""Debug groups, which name the draws inside them; descriptions of primitives; the steps of a recording."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from softshadow import tokens as gl
from softshadow.context import current
from softshadow.gl.calls import spelled_like_gl
from softshadow.gl.errors import fail, is_one_of, outside_begin
from softshadow.pipeline.commands import Origin

LONGEST_NAME = 4096  # Mesa's GL_MAX_DEBUG_MESSAGE_LENGTH
DEEPEST_GROUP = 63  # of GL's 64 groups the first is the default one
SOURCES = (gl.GL_DEBUG_SOURCE_APPLICATION, gl.GL_DEBUG_SOURCE_THIRD_PARTY)


def glPushDebugGroup(source: int, id: int, length: int, message: str | bytes) -> None:
    """Name the draws until the matching pop; pixel histories show the name. Negative `length`: the whole message."""
    context = outside_begin("glPushDebugGroup")
    expected = "GL_DEBUG_SOURCE_APPLICATION or GL_DEBUG_SOURCE_THIRD_PARTY"
    if context is None or not is_one_of("glPushDebugGroup", "source", source, SOURCES, expected):
        return
    text = message.decode() if isinstance(message, bytes) else message
    if max(length, len(text) if length < 0 else 0) >= LONGEST_NAME:
        fail(gl.GL_INVALID_VALUE, "glPushDebugGroup", f"length={length}: expected less than {LONGEST_NAME} characters")
        return
    if len(context.labels) == DEEPEST_GROUP:
        fail(gl.GL_STACK_OVERFLOW, "glPushDebugGroup", f"{DEEPEST_GROUP} groups are open already")
        return
    context.labels.append(text if length < 0 else text[:length])


def glPopDebugGroup() -> None:
    """End the group of the last push."""
    context = outside_begin("glPopDebugGroup")
    if context is None:
        return
    if not context.labels:
        fail(gl.GL_STACK_UNDERFLOW, "glPopDebugGroup", "there was no glPushDebugGroup before it")
    else:
        context.labels.pop()


def describe_primitives(
    part: str,
    feature: str = "",
    numbers: np.ndarray | None = None,
    casters: Sequence[str] = (),
    owners: np.ndarray | None = None,
) -> None:
    """Say what the primitives of the next draws were made from; pixel histories show it. Not a function of OpenGL.

    Parameters
    ----------
    part : str                   what they are, for example "volume side"; "" ends the description
    feature : "face" or "edge"   what `numbers` count
    numbers : (P,) int           the face or edge of a mesh that each primitive (triangle or quad) was made from
    casters : list of str        the objects that the meshes belong to, by their names
    owners : (P,) int            the place in `casters` for each primitive; the first if missing
    """
    arrays = [None if array is None else np.array(array, np.int32) for array in (numbers, owners)]
    for array in arrays:
        if array is not None:
            array.setflags(write=False)
    current().origin = Origin(part, feature, arrays[0], tuple(casters), arrays[1]) if part else None


def step(title: str) -> None:
    """Begin a step of the recording; it ends where the next one begins. Not part of GL: see `record`."""
    context = outside_begin("step")
    if context is not None:
        context.begin_step(str(title))


__all__ = [*spelled_like_gl(globals()), "describe_primitives", "step"]
