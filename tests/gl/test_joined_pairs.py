"""glBegin ... glEnd pairs that are joined to one draw, and how the recording shows them."""

import numpy as np
import pytest

from softshadow import gl, matrices
from softshadow.inspection.history import pixel_history
from softshadow.inspection.replay import Replay
from softshadow.pipeline.geometry.clip import outcodes
from softshadow.pipeline.geometry.clip_planes import user_planes
from softshadow.pipeline.geometry.draw_primitives import assembled_triangles, joined_needs_clipping
from softshadow.pipeline.geometry.vertex import to_clip

SIDE = 8


@pytest.fixture(autouse=True)
def context():
    with gl.create_context(2 * SIDE, SIDE) as context:
        gl.glOrtho(0, 2 * SIDE, 0, SIDE, -1, 1)
        yield context


def dart(column, clipped=False):
    gl.glBegin(gl.GL_QUADS)
    for x, y in ((0, 0), (SIDE, 0), (0, SIDE), (2, 2)):
        gl.glVertex3f(x + SIDE * column, y, 1.5 if clipped and (x, y) == (2, 2) else 0)
    gl.glEnd()


def assembled(command):
    planes = user_planes(command)
    clip = to_clip(matrices.multiply(command.projection, command.modelview), command.vertices.position)
    codes = outcodes(clip, False, planes)
    return assembled_triangles(command, codes != 0, joined_needs_clipping(command, planes)).corners.tolist()


def test_consecutive_pairs_are_one_draw(context):
    dart(0)
    dart(1)
    (command,) = context.frame.commands
    assert len(command.vertices.position) == 8


def test_a_pair_is_drawn_at_the_next_flush(context):
    dart(0)
    assert not context.storage.window.color.view.any()
    gl.glFlush()
    assert context.storage.window.color.view.any()


def test_reading_the_window_draws_collected_pairs():
    dart(0)
    assert gl.glReadPixels(1, 1, 1, 1, gl.GL_RGB, gl.GL_UNSIGNED_BYTE).tolist() == [[[255, 255, 255]]]


def test_leaving_the_context_draws_collected_pairs():
    with gl.create_context(4, 4) as other:
        gl.glRectf(-1, -1, 1, 1)
    assert other.storage.window.color.view.all()


def test_the_end_of_a_step_draws_collected_pairs(context):
    dart(0)
    context.end_step("first")
    dart(1)
    context.end_step("second")
    assert context.frame.steps == [("first", 1), ("second", 2)]


def test_joined_pairs_of_two_debug_groups_are_two_draws_cut_as_one(context):
    dart(0)
    gl.glPushDebugGroup(gl.GL_DEBUG_SOURCE_APPLICATION, 0, -1, "clipped")
    dart(1, clipped=True)
    gl.glPopDebugGroup()
    plain, clipped = context.frame.commands
    assert (plain.label, clipped.label) == ("", "clipped")
    assert assembled(plain) == [[0, 1, 3], [1, 2, 3]]
    gl.glFlush()
    dart(0)
    assert assembled(context.frame.commands[-1]) == [[0, 1, 2], [0, 2, 3]]


def test_recorded_joined_pairs_draw_the_same_window_again(context):
    dart(0)
    gl.glPushDebugGroup(gl.GL_DEBUG_SOURCE_APPLICATION, 0, -1, "clipped")
    dart(1, clipped=True)
    frame = context.frame
    replayed = Replay(frame).storage_after(len(frame.commands))
    assert replayed.window.color.same_as(context.storage.window.color)
    y, x = np.argwhere(context.storage.window.color.view[:, SIDE:, 0])[0]
    row = pixel_history(frame, x + SIDE, y)[-1]
    assert (row.draw, row.object, row.verdict) == (1, "clipped", "passed")


def test_a_color_set_before_glBegin_is_constant_for_all_vertices(context):
    gl.glColor3f(1, 0, 0)
    dart(0)
    gl.glFlush()
    gl.glBegin(gl.GL_QUADS)
    gl.glColor3f(0, 1, 0)
    gl.glVertex2f(0, 0)
    gl.glEnd()
    constant, varying = (command.vertices.color for command in context.frame.commands)
    assert constant.strides[0] == 0
    assert np.array_equal(constant, [[1, 0, 0, 1]] * 4)
    assert varying.strides[0] != 0


def test_a_new_attribute_submits_the_quads_before_it(context):
    gl.glBegin(gl.GL_QUADS)
    for corner in range(6):
        if corner == 5:
            gl.glColor3f(1, 0, 0)
        gl.glVertex2f(corner, 0)
    gl.glEnd()
    first, rest = context.frame.commands
    assert (len(first.vertices.position), len(rest.vertices.position)) == (4, 2)
    assert rest.vertices.color.tolist() == [[1, 1, 1, 1], [1, 0, 0, 1]]


def test_setting_the_same_light_model_again_changes_no_state(context):
    before = context.state
    gl.glLightModelfv(gl.GL_LIGHT_MODEL_AMBIENT, (0.2, 0.2, 0.2, 1.0))
    assert context.state is before
