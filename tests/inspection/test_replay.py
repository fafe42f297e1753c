"""Replaying a recording."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from draws import same_window
from inspection.recorded_frames import random_frame
from softshadow.errors import StateError
from softshadow.inspection.replay import Replay, copy_window

pytestmark = pytest.mark.interpreted


@settings(max_examples=20)
@given(st.integers(0, 2**32 - 1), st.sampled_from(["d24", "d32f"]))
def test_replay_reproduces_every_buffer_bit_for_bit(seed, depth_format):
    context = random_frame(seed, depth_format=depth_format)
    played = Replay(context.frame).storage_after(len(context.frame.commands))
    for point, attachment in context.storage.window.attachments.items():
        assert attachment.image.same_as(played.window.attachments[point].image)


def test_a_shorter_recording_left_what_replay_to_its_end_gives():
    replay = Replay(random_frame(7, draws=5).frame)
    for draws in (5, 2, 3, 1):  # forwards and backwards
        expected = copy_window(random_frame(7, draws=draws).storage.window).buffers()
        for replayed, buffer in zip(replay.after_step(draws - 1), expected, strict=True):
            np.testing.assert_array_equal(replayed, buffer)


def test_buffers_beyond_the_budget_are_drawn_again():
    frame = random_frame(3).frame
    generous, poor = Replay(frame), Replay(frame, budget=1)
    for index in (4, 0, 2, 2, 1, 4):
        assert poor.after_step(index).stencil.tobytes() == generous.after_step(index).stencil.tobytes()
    assert len(poor._cache) == 1


def test_replay_leaves_the_recorded_context_alone():
    context, untouched = random_frame(11), random_frame(11)
    Replay(context.frame).after_step(1)
    assert same_window(context, untouched)


def test_buffers_are_read_only():
    with pytest.raises(ValueError, match="read-only"):
        Replay(random_frame(0).frame).after_step(0).stencil[0, 0] = 1


def test_a_command_that_was_not_recorded_is_refused():
    frame = random_frame(0).frame
    with pytest.raises(StateError, match="the recording has"):
        Replay(frame).storage_after(len(frame.commands) + 1)
