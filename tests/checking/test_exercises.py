"""Exercises: files of teachers, exercises of lessons, grades."""

from pathlib import Path

import numpy as np
import pytest

from checking.exercises import EXERCISE
from softshadow.checking import Check, Grader, load_exercise
from softshadow.errors import SoftShadowError
from softshadow.lessons.copies import lesson_files
from softshadow.testing import run_here


def written(folder: Path, name: str, code: str) -> Path:
    (folder / name).write_text(code)
    return folder / name


def test_an_exercise_has_title_task_size_and_checks(tmp_path: Path) -> None:
    exercise = load_exercise(written(tmp_path, "exercise.py", EXERCISE))
    assert (exercise.title, exercise.size, exercise.points) == ("A red square", (16, 8), 4)
    assert exercise.task.startswith("Draw a red square")
    assert [(check.title, check.buffers) for check in exercise.checks] == [
        ("picture", ("color",)),
        ("depth", ("depth",)),
    ]


@pytest.mark.parametrize(
    ("code", "said"),
    [
        ("x = 1", "has no solution"),
        ("def expected(gl): pass\nchecks = 3", "not iterable"),
        ("def expected(gl): pass\nchecks = [3]", "softshadow.checking.Check"),
        ("def expected(gl): pass\nsize = (0, 1)", "size"),
        ("expected = 'a.jpg'", "listing:NAME or a file"),
        ("1 / 0", "line 1"),
        ("from softshadow.checking import Check\nchecks = [Check(buffers='color')]", "buffers='color'"),
        ("from softshadow.checking import Check\nchecks = [Check(cases=()), Check(cases=())]", "different titles"),
    ],
)
def test_a_broken_exercise_says_what_is_wrong(code: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(SoftShadowError, match=r"exercise\.py") as error:
        load_exercise(written(tmp_path, "exercise.py", code))
    assert said in str(error.value)


@pytest.mark.parametrize("lesson", lesson_files(), ids=lambda file: file.stem)
def test_every_lesson_has_an_exercise_by_its_name(lesson: Path) -> None:
    exercise = load_exercise(f"lesson:{lesson.stem}")
    assert load_exercise(f"lesson:{lesson.stem[:2]}").source == exercise.source == f"lesson:{lesson.stem}"
    assert exercise.task
    assert exercise.checks
    assert "solution" not in exercise.start
    names: dict[str, object] = {}
    exec(compile(exercise.start, lesson.name, "exec"), names)
    for check in exercise.checks:
        assert callable(names[check.program])
        assert check.cases or callable(check.expected)


def test_an_unknown_lesson_gets_the_nearest_name() -> None:
    with pytest.raises(ValueError, match="did you mean '05_stencil_buffer'"):
        load_exercise("lesson:05_stencil_bufer")


def red(gl):
    gl.glClearColor(1, 0, 0, 1)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT)


def test_a_file_of_buffers_is_expected_and_some_pixels_may_differ(tmp_path: Path) -> None:
    color = run_here(red, (8, 8)).color.copy()
    color[2, 3] = 7
    np.savez(tmp_path / "buffers.npz", color=color)
    head = "from softshadow.checking import Check\nsize = (8, 8)\nexpected = 'buffers.npz'\n"
    code = f"{head}checks = [Check('exact', points=2), Check('nearly', allowed=1, points=5)]"
    exercise = load_exercise(written(tmp_path, "exercise.py", code))
    student = written(
        tmp_path,
        "student.py",
        "def program(gl):\n    gl.glClearColor(1, 0, 0, 1)\n    gl.glClear(gl.GL_COLOR_BUFFER_BIT)\n    return 3\n",
    )
    grade = Grader(exercise).grade(student)
    exact, nearly = grade.verdicts
    assert (exact.kind, nearly.kind, grade.points) == ("differs", "equal", 5)
    (found,) = exact.differences
    assert (found["count"], found["x"], found["gl_y"], found["y"]) == (1, 3, 2, 5)
    assert (found["value"], found["expected"]) == ([255, 0, 0, 255], [7, 7, 7, 7])
    assert "glClear" in exact.history
    assert exact.expected_history == ""  # a file has no recording


def test_a_file_of_buffers_of_another_size_is_refused(tmp_path: Path) -> None:
    np.savez(tmp_path / "buffers.npz", color=np.zeros((2, 2, 4)))
    exercise = load_exercise(written(tmp_path, "exercise.py", "size = (8, 8)\nexpected = 'buffers.npz'\n"))
    with pytest.raises(SoftShadowError, match=r"color has the shape \(2, 2, 4\); expected \(8, 8, 4\)"):
        Grader(exercise)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("body", "kind"),
    [("...", "not-written"), ("0", "wrong"), ("1 / 0", "wrong"), ("s * (d_r - d_b) / d_b", "equal")],
)
def test_a_function_of_a_lesson_is_checked(body: str, kind: str, tmp_path: Path) -> None:
    student = written(tmp_path, "student.py", f"def penumbra_width(s, d_b, d_r):\n    return {body}\n")
    (verdict,) = Grader(load_exercise("lesson:02")).grade(student).verdicts
    assert verdict.kind == kind, str(verdict)


@pytest.mark.slow
def test_a_listing_is_a_solution_and_checks_of_other_functions_are_independent(tmp_path: Path) -> None:
    head = "from softshadow.checking import Check\nsize = (16, 16)\nexpected = 'listing:stencil-quads'\n"
    checks = "checks = [Check('quads'), Check('sum', program='add', cases=(((1, 2), 3),))]"
    exercise = load_exercise(written(tmp_path, "exercise.py", head + checks))
    code = "def add(a, b): return a + b\ndef program(gl):\n    import os; os._exit(0)\n"
    assert [each.kind for each in Grader(exercise).grade(written(tmp_path, "student.py", code)).verdicts] == [
        "exited",
        "equal",
    ]


def test_a_check_with_impossible_values_is_refused() -> None:
    for wrong in ({"allowed": -1}, {"points": -1}, {"buffers": ("colour",)}):
        with pytest.raises(ValueError, match="expected"):
            Check(**wrong)
