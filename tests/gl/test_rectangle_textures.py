"""Rectangles of several sizes keep textures of their own: glDrawPixels and glCopyPixels define them only once."""

import numpy as np
import pytest

from softshadow import gl
from softshadow.context import Context
from softshadow.gl.window_quads import TEXTURES
from softshadow.pipeline.commands import DefineImage, UpdateImage


@pytest.fixture
def context() -> Context:
    with gl.create_context(16, 12) as context:
        gl.glWindowPos2i(0, 0)
        yield context


def draw_rectangle(side: int, value: int) -> None:
    gl.glDrawPixels(side, side, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, np.full((side, side, 4), value, np.uint8))


def commands_of(context: Context, kind: type) -> list[tuple[int, int]]:
    """Return texture and width of the commands of a kind."""
    return [
        (command.texture, getattr(command, "width", 0)) for command in context.frame.commands if type(command) is kind
    ]


def test_sizes_that_take_turns_are_defined_once(context: Context) -> None:
    for value in range(1, 4):
        draw_rectangle(3, value)
        draw_rectangle(2, 10 * value)
        gl.glCopyPixels(0, 0, 4, 4, gl.GL_COLOR)
    assert commands_of(context, DefineImage) == [(TEXTURES[0], 3), (TEXTURES[1], 2), (TEXTURES[2], 4)]
    assert [texture for texture, _ in commands_of(context, UpdateImage)] == [*TEXTURES[:2]] * 2
    assert gl.glReadPixels(0, 0, 3, 1, gl.GL_RED, gl.GL_UNSIGNED_BYTE).ravel().tolist() == [30, 30, 3]


def test_another_format_has_a_texture_of_its_own(context: Context) -> None:
    draw_rectangle(2, 200)
    gl.glDrawPixels(2, 2, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT, np.zeros((2, 2), np.float32))
    draw_rectangle(2, 100)
    assert len(commands_of(context, DefineImage)) == 2
    assert gl.glReadPixels(0, 0, 1, 1, gl.GL_RED, gl.GL_UNSIGNED_BYTE).item() == 100


def test_a_new_size_replaces_the_oldest_one(context: Context) -> None:
    for side in range(1, len(TEXTURES) + 1):
        draw_rectangle(side, side)
    draw_rectangle(1, 50)  # the second one is the oldest now
    draw_rectangle(10, 60)
    draw_rectangle(2, 70)
    defined = commands_of(context, DefineImage)
    assert defined[len(TEXTURES) :] == [(TEXTURES[1], 10), (TEXTURES[2], 2)]
    assert gl.glReadPixels(0, 0, 3, 1, gl.GL_RED, gl.GL_UNSIGNED_BYTE).ravel().tolist() == [70, 70, 60]
