"""Sessions: state persists between frames, and does not leak out of a session."""

from typing import Any

import numpy as np
import pytest

from softshadow import gl
from softshadow.context import current
from softshadow.pipeline import set_threads, threads
from softshadow.testing import MesaError
from softshadow.testing.sessions import MesaSession, OwnSession

SIZE = (6, 4)


def counting(on: Any) -> Any:
    """Return a frame function that adds 1 to the stencil buffer with a quad over the window."""
    on.glEnable(on.GL_STENCIL_TEST)
    on.glStencilOp(on.GL_KEEP, on.GL_KEEP, on.GL_INCR)

    def frame() -> None:
        on.glRectf(-1, -1, 1, 1)

    return frame


def test_frames_go_on_from_what_the_last_one_left() -> None:
    session = OwnSession(counting, SIZE)
    assert len(session.time(3)) == 3
    session.warm_up()
    assert (session.buffers()["stencil"] == 4).all()


@pytest.mark.mesa
def test_frames_on_mesa_go_on_from_what_the_last_one_left() -> None:
    session = MesaSession(counting, SIZE, draw_threads=2)
    try:
        timings = session.time(3)
        session.warm_up()
        assert (session.buffers()["stencil"] == 4).all()
        assert all(each.wall > 0 for each in [session.prepared, *timings])
    finally:
        session.close()


def test_session_leaves_the_current_context_and_the_threads_alone() -> None:
    before = threads()
    set_threads(2)
    try:
        with gl.create_context(3, 2) as own:
            session = OwnSession(counting, SIZE, draw_threads=1)
            session.time()
            assert current() is own
            assert threads() == 2
    finally:
        set_threads(before)


def test_recording_of_timed_frames_is_not_kept() -> None:
    session = OwnSession(counting, SIZE)
    session.time(5)
    assert session._context.frame.commands == []


@pytest.mark.mesa
def test_error_of_a_frame_on_mesa_is_raised_here() -> None:
    def broken(on: Any) -> Any:
        return lambda: on.glEnable(77)

    session = MesaSession(broken, SIZE)
    try:
        with pytest.raises(MesaError, match="glEnable: GL_INVALID_ENUM"):
            session.time()
    finally:
        session.close()


def test_unknown_driver_is_refused() -> None:
    with pytest.raises(ValueError, match="expected one of llvmpipe, softpipe"):
        MesaSession(counting, SIZE, "swr")


@pytest.mark.mesa
@pytest.mark.parametrize("internal_format", ["GL_DEPTH24_STENCIL8", "GL_DEPTH32F_STENCIL8"])
def test_depth_with_stencil_is_the_same_on_mesa(internal_format: str) -> None:
    def program(on: Any) -> Any:
        on.glBindFramebuffer(on.GL_FRAMEBUFFER, on.glGenFramebuffers(1))
        for point, stored in (
            (on.GL_COLOR_ATTACHMENT0, on.GL_RGBA8),
            (on.GL_DEPTH_STENCIL_ATTACHMENT, getattr(on, internal_format)),
        ):
            buffer = on.glGenRenderbuffers(1)
            on.glBindRenderbuffer(on.GL_RENDERBUFFER, buffer)
            on.glRenderbufferStorage(on.GL_RENDERBUFFER, stored, *SIZE)
            on.glFramebufferRenderbuffer(on.GL_FRAMEBUFFER, point, on.GL_RENDERBUFFER, buffer)
        on.glEnable(on.GL_DEPTH_TEST)
        on.glClear(on.GL_DEPTH_BUFFER_BIT)
        on.glRotatef(30, 1, 1, 0)
        return counting(on)

    here, there = OwnSession(program, SIZE), MesaSession(program, SIZE)
    try:
        here.time(2), there.time(2)
        for name, ours in here.buffers().items():
            np.testing.assert_array_equal(ours, there.buffers()[name], name)
        assert len(np.unique(here.buffers()["depth"])) > 2
    finally:
        there.close()
