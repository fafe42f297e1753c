"""glBlitFramebuffer: which pixels are copied where, and which calls are refused."""

import numpy as np
import pytest

from softshadow import gl
from softshadow.inspection.replay import Replay

COLOR = gl.GL_COLOR_BUFFER_BIT


@pytest.fixture(autouse=True)
def context():
    with gl.create_context(4, 2) as context:
        gl.glEnable(gl.GL_SCISSOR_TEST)
        for x in range(4):
            gl.glScissor(x, 0, 1, 1)
            gl.glClearColor(x / 4, 1, 0, 1)
            gl.glClear(COLOR)
        gl.glDisable(gl.GL_SCISSOR_TEST)
        yield context


def reds(y):
    return gl.glReadPixels(0, y, 4, 1, gl.GL_RED, gl.GL_UNSIGNED_BYTE)[0].tolist()


def test_a_row_is_copied_mirrored():
    gl.glBlitFramebuffer(0, 0, 4, 1, 4, 1, 0, 2, COLOR, gl.GL_NEAREST)
    assert reds(1) == [191, 128, 64, 0]
    assert reds(0) == [0, 64, 128, 191]


def test_a_pixel_is_spread_over_a_rectangle():
    gl.glBlitFramebuffer(3, 0, 4, 1, 0, 1, 4, 2, COLOR, gl.GL_NEAREST)
    assert reds(1) == [191] * 4


def test_the_scissor_box_cuts_a_blit():
    gl.glEnable(gl.GL_SCISSOR_TEST)
    gl.glScissor(1, 1, 2, 1)
    gl.glBlitFramebuffer(0, 0, 4, 1, 0, 1, 4, 2, COLOR, gl.GL_NEAREST)
    assert reds(1) == [0, 64, 128, 0]


def test_masks_do_not_count():
    gl.glColorMask(False, False, False, False)
    gl.glBlitFramebuffer(0, 0, 4, 1, 0, 1, 4, 2, COLOR, gl.GL_NEAREST)
    assert reds(1) == [0, 64, 128, 191]


def test_a_recorded_blit_gives_the_same_window_again(context):
    gl.glBlitFramebuffer(0, 0, 3, 1, 0, 1, 4, 2, COLOR, gl.GL_LINEAR)
    played = Replay(context.frame).storage_after(len(context.frame.commands))
    assert np.array_equal(played.window.color.view, context.storage.window.color.view)


@pytest.mark.parametrize(
    ("mask", "texture_filter", "code"),
    [
        (gl.GL_DEPTH_BUFFER_BIT, gl.GL_LINEAR, gl.GL_INVALID_OPERATION),
        (gl.GL_ACCUM_BUFFER_BIT, gl.GL_NEAREST, gl.GL_INVALID_VALUE),
        (COLOR, gl.GL_REPEAT, gl.GL_INVALID_ENUM),
    ],
)
def test_what_is_no_blit_is_refused(mask, texture_filter, code):
    with pytest.raises(gl.GLError) as caught:
        gl.glBlitFramebuffer(0, 0, 4, 1, 0, 1, 4, 2, mask, texture_filter)
    assert caught.value.err == code
    assert reds(1) == [0, 0, 0, 0]
