"""``softshadow check``: verdicts as text, JSON and CSV, exit codes, tasks of exercises."""

import json
from pathlib import Path

import pytest

from checking.exercises import EXERCISE, RIGHT
from cli.invocation import error_of, invoke, invoke_ok, json_of, usage_error_of


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("exercise.py").write_text(EXERCISE)
    Path("right.py").write_text(RIGHT)
    Path("small.py").write_text(RIGHT.replace("0.5, 0.5)", "0.5, 0.25)"))


def test_a_wrong_program_gets_the_first_pixel_with_its_history_in_both_programs() -> None:
    answer = invoke("check", "exercise.py", "small.py")
    assert answer.exit_code == 1
    assert "picture: differs (0 of 3 points)" in answer.stdout
    assert "color: 8 pixels differ, first at x=4 y=2 (GL y=5): [0, 0, 255, 255], expected [255, 0, 0, 255]" in (
        answer.stdout
    )
    assert "Your program: pixel x=4 y=2 (GL y=5) is background" in answer.stdout
    assert "The solution: pixel x=4 y=2 (GL y=5) shows what was drawn" in answer.stdout
    assert "Hint: Is the colour set before glRectf?" in answer.stdout
    assert "depth: equal (1 of 1 points)" in answer.stdout
    assert answer.stdout.endswith("small.py: 1 of 4 points\n")


@pytest.mark.slow
def test_a_class_is_graded_in_a_table_and_as_csv() -> None:
    answer = invoke("check", "exercise.py", "right.py", "small.py")
    assert answer.exit_code == 1
    assert [line.split() for line in answer.stdout.splitlines()[-2:]] == [
        ["right.py", "4", "equal", "equal"],
        ["small.py", "1", "differs", "equal"],
    ]
    assert invoke("check", "exercise.py", "right.py", "small.py", "--csv").stdout == (
        "file,points,passed,picture,depth\nright.py,4,true,equal,equal\nsmall.py,1,false,differs,equal\n"
    )


@pytest.mark.slow
def test_json_has_all_verdicts() -> None:
    answer = invoke("check", "exercise.py", "small.py", "--json")
    assert answer.exit_code == 1
    (row,) = json.loads(answer.stdout)["submissions"]
    picture, depth = row["checks"]
    assert (row["points"], row["passed"], picture["kind"], depth["passed"]) == (1, False, "differs", True)
    assert picture["differences"] == [
        {"buffer": "color", "count": 8, "x": 4, "y": 2, "gl_y": 5,
         "value": [0, 0, 255, 255], "expected": [255, 0, 0, 255]}
    ]  # fmt: skip
    assert json_of("check", "exercise.py", "right.py")["submissions"][0]["passed"] is True


def test_a_file_that_names_its_exercise_is_checked_alone() -> None:
    Path("named.py").write_text(f'exercise = "exercise.py"\n{RIGHT}')
    assert invoke_ok("check", "named.py").stdout.endswith("named.py: 4 of 4 points\n")


@pytest.mark.slow
def test_a_file_with_its_own_solution_is_checked_alone() -> None:
    Path("both.py").write_text(f"{EXERCISE}\n{RIGHT.replace('0.5, 0.5)', '0.5, 0.25)')}")
    answer = invoke("check", "both.py")
    assert answer.exit_code == 1
    assert answer.stdout.endswith("both.py: 1 of 4 points\n")


def test_without_a_program_the_task_is_printed_as_a_python_file() -> None:
    text = invoke_ok("check", "lesson:08").stdout
    assert "# Write step 2" in text
    names: dict[str, object] = {}
    exec(text, names)
    assert {"program", "receiver"} <= names.keys()
    assert "solution" not in names
    assert json_of("check", "exercise.py")["points"] == 4
    assert len(json_of("check", "--list")["exercises"]) == 24
    assert "lesson:05_stencil_buffer" in invoke_ok("check", "--list").stdout


def test_wrong_usage_is_told() -> None:
    assert "expected an EXERCISE" in usage_error_of("check")
    assert "--time=-1" in usage_error_of("check", "exercise.py", "right.py", "--time", "-1")
    assert "--memory=0" in usage_error_of("check", "exercise.py", "right.py", "--memory", "0")
    assert "only one of them" in usage_error_of("check", "exercise.py", "--csv", "--json")
    assert "there is no such lesson" in usage_error_of("check", "lesson:99")
    assert "missing.py" in error_of("check", "missing.py", "right.py")
    Path("exercise.py").write_text("def expected(gl):\n    gl.glEnable(gl.GL_KEEP)\n")
    assert "exercise.py: the solution fails" in invoke("check", "exercise.py", "right.py").stderr.replace(
        str(Path.cwd()) + "/", ""
    )
