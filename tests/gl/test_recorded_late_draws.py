"""Late draws in the recording: counted, dropped and forgotten without being made."""

import numpy as np
import pytest

from softshadow import gl
from softshadow.context import late_commands
from softshadow.pipeline.alike_draws import AlikeDraws
from softshadow.pipeline.commands import Clear

SIZE = 16, 16
CORNERS = (-1.0, -1.0, 0.5), (1.0, -1.0, 0.5), (0.0, 1.0, -0.5)


@pytest.fixture
def context():
    with gl.create_context(*SIZE) as context:
        yield context


def objects(count):
    for _x in range(count):
        gl.glTranslatef(1 / count, 0, 0)
        gl.glBegin(gl.GL_TRIANGLES)
        for corner in CORNERS:
            gl.glVertex3f(*corner)
        gl.glEnd()


def test_draws_of_many_objects_are_counted_before_they_are_made(context):
    objects(2 * late_commands.MANY)
    context.flush()
    frame = context.frame
    assert frame.n_commands == 2 * late_commands.MANY
    assert not frame.made
    gl.glClear(gl.GL_COLOR_BUFFER_BIT)
    gl.glFinish()
    assert frame.n_commands == len(frame.commands) == len(frame.made) == 2 * late_commands.MANY + 1
    assert [command.modelview[0, 3] for command in frame.commands[:2]] == [
        np.float32(1 / (2 * late_commands.MANY)),
        np.float32(1 / late_commands.MANY),
    ]
    assert type(frame.commands[-1]) is Clear


def test_a_recording_with_draws_that_are_not_made_can_be_forgotten(context):
    objects(2 * late_commands.MANY)
    context.flush()
    context.begin_recording()
    assert context.frame.commands == []
    assert context.frame.n_commands == 0
    objects(3)
    context.flush()
    assert len(context.frame.commands) == 3


def test_a_bounded_recording_drops_draws_that_are_not_made():
    with gl.create_context(*SIZE, history_mb=0.25) as context:
        for _ in range(40):
            objects(late_commands.MANY)
            gl.glFinish()
        frame = context.frame
        assert frame.dropped > 0
        assert frame.dropped + len(frame.commands) == 40 * late_commands.MANY
        assert frame.bytes <= 0.25 * 2**20


def test_draws_that_are_dropped_are_not_made(monkeypatch):
    made = []
    draws = AlikeDraws.__dict__["draws"]
    monkeypatch.setattr(draws, "func", lambda alike, make=draws.func: made.append(alike) or make(alike))
    with gl.create_context(*SIZE, history_mb=0.25) as context:
        for _ in range(40):
            objects(late_commands.MANY)
            gl.glFinish()
        assert context.frame.dropped > 0
        assert not made
        assert context.frame.commands
        assert made


@pytest.mark.parametrize("count", range(11))
def test_a_recording_may_be_cut_within_draws_that_are_not_made(context, count):
    objects(4)
    context.flush()
    assert len(context.frame.commands) == 4  # they are made
    for number in (2, 4):
        objects(number)
        context.flush()
    assert len(context.frame.following) == 2
    context.frame._drop(count)
    shifts = [command.modelview[0, 3] for command in context.frame.commands]
    assert shifts == [0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 2.25, 2.5, 2.75, 3.0][count:]
