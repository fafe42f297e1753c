"""Programs for PyOpenGL get the same verdicts as functions of gl, and a saved run is a solution like any other."""

from pathlib import Path

import numpy as np
import pytest

import softshadow as ss
from checking.exercises import EXERCISE, RIGHT, SCRIPT
from softshadow.checking import Grader, load_exercise
from softshadow.checking.child import verdicts_of
from softshadow.checking.expected import DEEPEST, buffers_of_run, expected_of, save_buffers
from softshadow.checking.source import is_script
from softshadow.checking.verdict import Verdict
from softshadow.errors import SoftShadowError
from softshadow.testing import run_here
from softshadow.windows import run_script

SIZE = (16, 8)


def verdicts(folder: Path, code: str) -> list[Verdict]:
    """The verdicts of both checks of the exercise, in this process."""
    (folder / "exercise.py").write_text(EXERCISE)
    (folder / "student.py").write_text(code)
    exercise = load_exercise(folder / "exercise.py")
    files = [folder / f"{index}.npz" for index in range(2)]
    for file, check in zip(files, exercise.checks, strict=True):
        save_buffers(file, expected_of(exercise, check).buffers)
    return verdicts_of(folder / "student.py", exercise, list(exercise.checks), list(files))


@pytest.mark.parametrize(("before", "after"), [("", ""), ("0.5, 0.5)", "0.5, 0.25)"), ("(1, 0, 0)", "(0, 1, 0)")])
def test_a_script_gets_the_verdict_of_the_same_function(before: str, after: str, tmp_path: Path) -> None:
    of_script = verdicts(tmp_path, SCRIPT.replace(before, after) if before else SCRIPT)
    of_function = verdicts(tmp_path, RIGHT.replace(before, after) if before else RIGHT)
    for ours, theirs in zip(of_script, of_function, strict=True):
        assert (ours.kind, ours.message, ours.differences) == (theirs.kind, theirs.message, theirs.differences)
        assert bool(ours.history) == bool(theirs.history)
    assert of_script[0].passed == (not before)


@pytest.mark.parametrize(
    ("code", "kind", "line"),
    [
        (SCRIPT.replace("glRectf(", "glEnable(GL_QUADS); glRectf("), "gl-error", 8),
        (SCRIPT.replace("glutSwapBuffers()", "1 / 0"), "python-error", 9),
        ("from OpenGL.GL import *\nx = 1\n", "no-program", None),
        ("def other(gl): pass\n", "no-program", None),
        (SCRIPT.replace("glutInit()", "glutInit("), "python-error", None),
    ],
    ids=["gl-error", "exception", "no window", "no function", "no Python"],
)
def test_a_script_that_fails_gets_the_verdict_with_its_line(
    code: str, kind: str, line: int | None, tmp_path: Path
) -> None:
    for verdict in verdicts(tmp_path, code):
        assert verdict.kind == kind, verdict.message
        assert line is None or verdict.line == line


def test_a_file_is_a_script_if_it_imports_opengl_and_has_no_program(tmp_path: Path) -> None:
    file = tmp_path / "file.py"
    for code, expected in (
        (SCRIPT, True),
        ("import OpenGL.GL as gl", True),
        (RIGHT, False),
        (f"from OpenGL.GL import *\n{RIGHT}", False),
        ("from softshadow.gl import *", False),
        ("def", False),
    ):
        file.write_text(code)
        assert is_script(file, "program") == expected, code
    assert not is_script(tmp_path / "missing.py", "program")


def test_a_saved_run_is_a_solution(tmp_path: Path) -> None:
    (tmp_path / "solution.py").write_text(SCRIPT)
    run_script(tmp_path / "solution.py", size=SIZE).save(tmp_path / "run.npz")
    of_run = EXERCISE.partition("\n\ndef expected")[0] + '\nexpected = "run.npz"\n'
    solutions = []
    for name, code in (("function", EXERCISE), ("saved", of_run)):
        (tmp_path / f"{name}.py").write_text(code)
        exercise = load_exercise(tmp_path / f"{name}.py")
        solutions.append(expected_of(exercise, exercise.checks[0]))
    function, run = solutions
    assert run.frame is not None
    for buffer in ("color", "depth", "stencil"):
        assert np.array_equal(getattr(function.buffers, buffer), getattr(run.buffers, buffer))


@pytest.mark.slow
def test_a_submission_beside_a_saved_run_is_graded_with_both_histories(tmp_path: Path) -> None:
    (tmp_path / "solution.py").write_text(SCRIPT)
    run_script(tmp_path / "solution.py", size=SIZE).save(tmp_path / "run.npz")
    (tmp_path / "exercise.py").write_text(EXERCISE.partition("\n\ndef expected")[0] + '\nexpected = "run.npz"\n')
    (tmp_path / "script.py").write_text(SCRIPT)
    (tmp_path / "small.py").write_text(SCRIPT.replace("0.5, 0.5)", "0.5, 0.25)"))
    grader = Grader(load_exercise(tmp_path / "exercise.py"))
    assert grader.grade(tmp_path / "script.py").points == 4
    wrong = grader.grade(tmp_path / "small.py").verdicts[0]
    assert (wrong.kind, wrong.differences[0]["count"]) == ("differs", 8)
    assert wrong.history
    assert wrong.expected_history


@pytest.mark.parametrize(("options", "said"), [({}, "16 x 8"), ({"depth_format": "d32f"}, "d32f")])
def test_a_saved_run_of_another_size_or_depth_is_refused(options: dict[str, str], said: str, tmp_path: Path) -> None:
    size = (20, 10) if not options else SIZE
    ss.run("planar", "boxes", size, **options).save(tmp_path / "run.npz")
    (tmp_path / "exercise.py").write_text('expected = "run.npz"\nsize = (16, 8)\n')
    exercise = load_exercise(tmp_path / "exercise.py")
    with pytest.raises(SoftShadowError, match=said):
        expected_of(exercise, exercise.checks[0])


def test_depths_of_runs_are_those_of_the_window() -> None:
    every = np.arange(DEEPEST + 1, dtype=np.uint32)
    as_read = (every / np.float64(DEEPEST)).astype(np.float32)
    assert np.array_equal(np.rint(as_read.astype(np.float64) * DEEPEST).astype(np.uint32), every)

    def program(gl: object) -> None:
        for _ in ss.techniques.get("volume-zfail").steps(gl, ss.Scene.named("torus"), size=(32, 24), **options):
            pass

    options = ss.techniques.get("volume-zfail").validate_options({})
    run, direct = ss.run("volume-zfail", "torus", (32, 24)), run_here(program, (32, 24))
    for buffer in ("color", "depth", "stencil"):
        assert np.array_equal(getattr(buffers_of_run(run), buffer), getattr(direct, buffer))
