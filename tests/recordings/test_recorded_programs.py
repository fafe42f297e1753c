"""`gl.record`: any program on `softshadow.gl` as a run."""

from pathlib import Path

import numpy as np
import pytest

import softshadow as ss
from softshadow import gl
from softshadow.errors import StateError


def draw_square(size: float) -> None:
    gl.glRectf(-size, -size, size, size)


def test_a_recording_is_a_run_with_histories_of_pixels() -> None:
    with gl.record(16, 12) as recording:
        gl.glColor3f(1, 0, 0)
        draw_square(0.5)
    assert recording.run.image[6, 8].tolist() == [255, 0, 0]
    assert [row.verdict for row in recording.pixel(8, 6)] == ["passed"]
    assert "shows what was drawn in step 'draw 0: GL_" in recording.explain(8, 6)
    assert recording.run.ledger.total.draws == 1


def test_gl_record_is_ss_record() -> None:
    assert gl.record is ss.record


def test_the_context_before_is_current_again() -> None:
    with gl.create_context(4, 4) as outer:
        with gl.record(16, 12):
            draw_square(1)
        assert gl.current() is outer


def test_steps_begin_where_the_program_says() -> None:
    with gl.record(16, 12) as recording:
        gl.glClear(gl.GL_COLOR_BUFFER_BIT)
        gl.step("large")
        draw_square(1)
        gl.step("small")
        draw_square(0.1)
    assert recording.steps.titles == ["before 'large'", "large", "small"]
    assert [len(step.draws) for step in recording.steps] == [0, 1, 1]


def test_debug_groups_are_steps() -> None:
    with gl.record(16, 12) as recording:
        for name in ("one", "two"):
            gl.glPushDebugGroup(gl.GL_DEBUG_SOURCE_APPLICATION, 0, -1, name)
            draw_square(0.5)
            gl.glPopDebugGroup()
    assert recording.steps.titles == ["one", "two"]
    assert [row.object for row in recording.pixel(8, 6)] == ["one", "two"]


@pytest.mark.parametrize(("steps", "n_steps"), [("draws", 4), ("clears", 2), ("groups", 4), ("auto", 4)])
def test_a_program_without_names_is_divided(steps: str, n_steps: int) -> None:
    with gl.record(16, 12, steps=steps) as recording:
        for size in (1.0, 0.5):
            gl.glClear(gl.GL_COLOR_BUFFER_BIT)
            draw_square(size)
    assert len(recording.steps) == n_steps


def test_a_recording_can_be_saved_and_loaded(tmp_path: Path) -> None:
    with gl.record(16, 12, program="squares.py") as recording:
        draw_square(0.5)
    recording.run.save(tmp_path / "run.npz")
    loaded = ss.load_run(tmp_path / "run.npz")
    assert repr(loaded) == "Run('recording', squares.py, 16 x 12, 1 steps)"
    np.testing.assert_array_equal(loaded.image, recording.run.image)
    assert "run.pixel(X, Y)" in recording.run.save(tmp_path / "run.html").read_text(encoding="utf-8")


def test_a_run_exists_when_the_statement_has_ended_without_an_error() -> None:
    with gl.record(16, 12) as recording, pytest.raises(StateError, match="when its with statement has ended"):
        recording.run  # noqa: B018
    with pytest.raises(RuntimeError), gl.record(16, 12) as failed:
        raise RuntimeError
    with pytest.raises(StateError):
        failed.run  # noqa: B018


def test_nothing_drawn_is_one_step() -> None:
    with gl.record(16, 12) as recording:
        pass
    assert recording.steps.titles == ["nothing is drawn"]
