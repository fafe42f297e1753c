"""Replaying traces: the chosen frame, the state before it, and what cannot be done."""

from pathlib import Path

import numpy as np
import pytest

import softshadow as ss
from paths import TRACE
from recordings.traced_program import CONTEXT, TracedProgram
from softshadow import gl
from softshadow.errors import CallsLeftOut, DrawsLeftOut, StateError, TraceError
from softshadow.recordings.replaying import replay_frame

RED, GREEN, BLACK = (255, 0, 0), (0, 255, 0), (0, 0, 0)


def color_at(run: ss.Run, x: int = 8, y: int = 6) -> tuple[int, ...]:
    return tuple(run.image[y, x].tolist())


# -- frames ------------------------------------------------------------------------------------------------------------
def two_frames() -> TracedProgram:
    traced = TracedProgram()
    traced.glColor3f(1.0, 0.0, 0.0)
    for _ in range(2):
        traced.glClear(gl.GL_COLOR_BUFFER_BIT)
        traced.triangle((-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0))
        traced.swap()
        traced.glColor3f(0.0, 1.0, 0.0)
    return traced


@pytest.mark.parametrize(("frame", "color"), [(0, RED), (1, GREEN), (-1, GREEN), (-2, RED)])
def test_a_frame_has_the_state_that_earlier_ones_left(tmp_path: Path, frame: int, color: tuple[int, ...]) -> None:
    run = ss.replay(two_frames().save(tmp_path), frame)
    assert color_at(run, 2, 9) == color
    assert color_at(run, 15, 0) == BLACK
    assert run.steps.titles[0] == "clear colour"
    assert len(run.steps) == 2
    assert run.options["frame"] == frame % 2


def test_a_history_names_the_recorded_call(tmp_path: Path) -> None:
    traced = TracedProgram()
    first = traced.triangle()
    second = traced.triangle()
    run = ss.replay(traced.save(tmp_path))
    assert [row.object for row in run.pixel(8, 6)] == [f"call {first}", f"call {second}"]
    assert run.explain(8, 6).startswith(f"pixel x=8 y=6 (GL y=5) shows what was drawn in step 'call {second}: GL_TRI")


def test_until_stops_after_a_call(tmp_path: Path) -> None:
    traced = TracedProgram()
    traced.glColor3f(1.0, 0.0, 0.0)
    traced.triangle()
    stop = traced.glColor3f(0.0, 1.0, 0.0)
    traced.triangle()
    traced.swap()
    path = traced.save(tmp_path)
    assert color_at(ss.replay(path)) == GREEN
    assert color_at(ss.replay(path, until=stop)) == RED
    with pytest.raises(ValueError, match=r"until=99: .* has calls 0 to"):
        ss.replay(path, until=99)


@pytest.mark.parametrize("frame", [2, -3])
def test_a_missing_frame_is_an_error_with_the_number_of_frames(tmp_path: Path, frame: int) -> None:
    with pytest.raises(ValueError, match=rf"frame={frame}: .* has 2 frames, 0 to 1"):
        ss.replay(two_frames().save(tmp_path), frame)


def test_without_swaps_glFlush_ends_a_frame(tmp_path: Path) -> None:
    traced = TracedProgram()
    for red in (1.0, 0.0):
        traced.glColor3f(red, 1.0 - red, 0.0)
        traced.triangle()
        traced.glFlush()
    path = traced.save(tmp_path)
    assert [color_at(ss.replay(path, frame)) for frame in (0, 1)] == [RED, GREEN]


def test_glFlush_ends_no_frame_of_a_program_that_swaps(tmp_path: Path) -> None:
    traced = TracedProgram()
    traced.triangle()
    traced.glFlush()
    traced.triangle((-1.0, -1.0), (0.0, -1.0), (0.0, 0.0))
    traced.glFlush()
    traced.swap()
    run = ss.replay(traced.save(tmp_path))
    assert len(run.steps) == 2


def test_what_an_earlier_frame_drew_shows_where_the_chosen_one_does_not_clear(tmp_path: Path) -> None:
    traced = TracedProgram()
    traced.glColor3f(1.0, 0.0, 0.0)
    traced.triangle()
    traced.swap()
    traced.glColor3f(0.0, 1.0, 0.0)
    traced.triangle((0.0, -1.0), (1.0, -1.0), (1.0, 1.0))
    traced.swap()
    run = ss.replay(traced.save(tmp_path), 1)
    assert (color_at(run, 1), color_at(run, 14)) == (RED, GREEN)
    assert len(run.pixel(1, 6)) == 0


def test_a_window_grows_and_shrinks_with_the_viewports_it_is_drawn_in(tmp_path: Path) -> None:
    traced = TracedProgram(16, 12)
    for width, height in ((16, 12), (20, 15), (8, 6)):
        traced.glViewport(0, 0, width, height)
        traced.triangle()
        traced.swap()
    path = traced.save(tmp_path)
    assert [ss.replay(path, frame).size for frame in range(3)] == [(16, 12), (20, 15), (8, 6)]
    assert ss.replay(path, 2, size=(10, 10)).size == (10, 10)


def test_viewports_side_by_side_are_one_window(tmp_path: Path) -> None:
    traced = TracedProgram(16, 12)
    for x in (0, 8):
        traced.glViewport(x, 0, 8, 12)
        traced.triangle()
    assert ss.replay(traced.save(tmp_path)).size == (16, 12)


# -- steps -------------------------------------------------------------------------------------------------------------
def grouped() -> TracedProgram:
    traced = TracedProgram()
    traced.glClear(gl.GL_COLOR_BUFFER_BIT)
    for name in ("floor", "walls"):
        traced.glPushDebugGroup(gl.GL_DEBUG_SOURCE_APPLICATION, 0, -1, name)
        traced.triangle()
        traced.triangle()
        traced.glPopDebugGroup()
    traced.glClear(gl.GL_DEPTH_BUFFER_BIT)
    traced.triangle()
    return traced


@pytest.mark.parametrize(
    ("steps", "titles"),
    [
        ("auto", ["floor", "walls", "outside of debug groups"]),
        ("groups", ["floor", "walls", "outside of debug groups"]),
        ("clears", ["clear colour", "clear depth"]),
    ],
)
def test_a_frame_is_divided(tmp_path: Path, steps: str, titles: list[str]) -> None:
    run = ss.replay(grouped().save(tmp_path), steps=steps)
    assert run.steps.titles == titles
    assert run.frame.steps[-1][1] == len(run.frame.commands)


def test_every_draw_can_be_a_step(tmp_path: Path) -> None:
    run = ss.replay(grouped().save(tmp_path), steps="draws")
    assert len(run.steps) == 7
    assert run.pixel(8, 6).rows[1].object.startswith("floor, call ")


def test_draws_under_one_state_are_a_step(tmp_path: Path) -> None:
    traced = TracedProgram()
    for enabled in (False, False, True):
        (traced.glEnable if enabled else traced.glDisable)(gl.GL_BLEND)
        traced.triangle()
    run = ss.replay(traced.save(tmp_path), steps="groups")
    assert [step.title.partition(":")[0] for step in run.steps] == ["calls 3 to 9", "call 15"]


def test_an_unknown_way_to_divide_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"steps='draw': did you mean 'draws'"):
        ss.replay(two_frames().save(tmp_path), steps="draw")


# -- what cannot be done -----------------------------------------------------------------------------------------------
def test_draws_of_a_glsl_program_are_left_out_and_named(tmp_path: Path) -> None:
    traced = TracedProgram()
    traced.glColor3f(1.0, 0.0, 0.0)
    traced.triangle()
    traced.glUseProgram(3)
    traced.glColor3f(0.0, 1.0, 0.0)
    traced.triangle()
    traced.glUseProgram(0)
    with pytest.warns(ss.Warning) as caught:
        run = ss.replay(traced.save(tmp_path))
    assert color_at(run) == RED
    assert [type(each.message) for each in caught] == [CallsLeftOut, DrawsLeftOut]
    assert run.warnings[0].args[0].startswith("glBegin (call 10), draw of a GLSL program")


def test_a_missing_call_and_an_error_are_counted(tmp_path: Path) -> None:
    traced = TracedProgram()
    for _ in range(3):
        traced.glNoSuchCall(1)
    traced.glEnable(1)
    traced.glGetError(result=gl.GL_INVALID_ENUM)
    traced.glEnable(2)
    traced.glGetError(result=0)
    traced.triangle()
    missing, own, ours = replay_frame(traced.save(tmp_path)).left_out
    assert (missing.call, missing.kind, missing.count, missing.first, missing.last) == (
        "glNoSuchCall", "missing call", 3, 2, 4,
    )  # fmt: skip
    assert str(own).endswith("the recorded program got this error, too")
    assert (own.kind, ours.kind) == ("GL error", "GL error")
    assert not ours.of_program


def test_wild_arguments_do_not_stop_a_replay(tmp_path: Path) -> None:
    traced = TracedProgram()
    traced.glLightfv(gl.GL_LIGHT0, gl.GL_POSITION, None)
    traced.glVertexPointer(7, gl.GL_FLOAT, 0, b"")
    traced.glColor3f(1.0, 0.0, 0.0)
    traced.triangle()
    replayed = replay_frame(traced.save(tmp_path))
    assert color_at(replayed.run) == RED
    assert [entry.kind for entry in replayed.left_out] == ["refused", "GL error"]


def test_an_incomplete_frame_of_a_truncated_file_is_shown_with_until(tmp_path: Path) -> None:
    traced = TracedProgram()
    traced.glColor3f(1.0, 0.0, 0.0)
    traced.triangle()
    traced.content += b"\0"
    path = traced.save(tmp_path)
    with pytest.raises(TraceError, match=r"ends within a call.*frame 0 is not complete: until=7 shows it"):
        ss.replay(path)
    assert color_at(ss.replay(path, until=7)) == RED


def test_questions_about_a_scene_are_errors(tmp_path: Path) -> None:
    run = ss.replay(two_frames().save(tmp_path))
    for ask in (
        lambda: run.visibility,
        lambda: run.lights,
        lambda: run.cross_section(1, 1),
        lambda: run.compare(truth="hard"),
    ):
        with pytest.raises(StateError, match="a replay of a program: it has no scene"):
            ask()


# -- contexts ----------------------------------------------------------------------------------------------------------
def test_the_context_that_swaps_is_shown_and_others_are_named(tmp_path: Path) -> None:
    traced = TracedProgram()
    traced.make_current(0x2000, 10, 10)
    traced.glColor3f(0.0, 1.0, 0.0)
    traced.triangle()
    traced.make_current(CONTEXT)
    traced.triangle()
    traced.swap()
    run = ss.replay(traced.save(tmp_path))
    assert run.size == (16, 12)
    assert color_at(run) == (255, 255, 255)
    assert "context 0x1000; there are also 0x2000" in str(run.warnings[-1])


@pytest.mark.parametrize("shares", [True, False])
def test_contexts_share_lists_and_textures(tmp_path: Path, shares: bool) -> None:
    traced = TracedProgram()
    traced.glNewList(5, gl.GL_COMPILE)
    traced.glColor3f(1.0, 0.0, 0.0)
    traced.glEndList()
    traced.call("glXCreateContext", 1, None, CONTEXT if shares else None, True, result=0x2000)
    traced.make_current(0x2000, 16, 12)
    traced.glCallList(5)
    traced.triangle()
    traced.swap()
    run = ss.replay(traced.save(tmp_path))
    assert color_at(run) == (RED if shares else (255, 255, 255))


@pytest.mark.parametrize("shares", [True, False])
def test_contexts_share_objects_also_if_the_newer_one_is_used_first(tmp_path: Path, shares: bool) -> None:
    traced = TracedProgram()
    traced.call("glXCreateContext", 1, None, None, True, result=0x3000)
    traced.call("glXCreateContext", 1, None, 0x3000 if shares else None, True, result=0x2000)
    traced.make_current(0x2000, 16, 12)
    traced.glNewList(5, gl.GL_COMPILE)
    traced.glColor3f(1.0, 0.0, 0.0)
    traced.glEndList()
    traced.make_current(0x3000, 16, 12)
    traced.glCallList(5)
    traced.triangle()
    traced.swap()
    assert color_at(ss.replay(traced.save(tmp_path))) == (RED if shares else (255, 255, 255))


def test_a_texture_of_an_unrelated_context_does_not_matter(tmp_path: Path) -> None:
    traced = TracedProgram()
    traced.triangle()
    traced.swap()
    traced.make_current(0x2000, 16, 12)
    traced.glBindTexture(gl.GL_TEXTURE_2D, 1)
    image = [gl.GL_RGB, gl.GL_UNSIGNED_BYTE, bytes(12)]
    traced.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1)
    traced.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGB, 2, 2, 0, *image)
    traced.glTexSubImage2D(gl.GL_TEXTURE_2D, 0, 0, 0, 2, 2, *image)
    traced.make_current(CONTEXT)
    traced.glColor3f(0.0, 1.0, 0.0)
    traced.triangle()
    traced.swap()
    run = ss.replay(traced.save(tmp_path), 1)
    assert color_at(run) == GREEN
    assert run.steps[-1].image[6, 8].tolist() == list(GREEN)


def test_threads_have_their_own_contexts(tmp_path: Path) -> None:
    traced = TracedProgram()
    traced.make_current(0x2000, 16, 12, thread=1)
    traced.glColor3f(1.0, 0.0, 0.0)
    traced.glColor3f(0.0, 1.0, 0.0, thread=1)
    traced.triangle()
    traced.swap()
    assert color_at(ss.replay(traced.save(tmp_path))) == RED


# -- files -------------------------------------------------------------------------------------------------------------
def test_a_saved_replay_answers_as_before(tmp_path: Path) -> None:
    run = ss.replay(two_frames().save(tmp_path), 1)
    run.save(tmp_path / "run.npz")
    loaded = ss.load_run(tmp_path / "run.npz")
    assert loaded.scene is None
    assert loaded.explain(2, 9) == run.explain(2, 9)
    assert str(loaded.ledger) == str(run.ledger)
    np.testing.assert_array_equal(loaded.image, run.image)
    assert repr(loaded) == "Run('replay', program.trace, 16 x 12, 2 steps)"


def test_the_report_names_the_program_and_how_to_ask(tmp_path: Path) -> None:
    run = ss.replay(two_frames().save(tmp_path), 1)
    text = run.save(tmp_path / "run.html").read_text(encoding="utf-8")
    assert "<h1>replay of program.trace</h1>" in text
    assert "softshadow replay program.trace --frame 1 --pixel X Y" in text


def test_the_recorded_c_program_is_replayed_without_losses() -> None:
    for frame, size in enumerate([(64, 48), (64, 48), (64, 48), (80, 64)]):
        replayed = replay_frame(TRACE, frame)
        assert replayed.run.size == size
        assert replayed.left_out == ()
        assert len(replayed.run.steps) == 5
