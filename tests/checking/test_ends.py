"""However a student's program ends, its verdict is right, and nothing that it does by accident passes."""

import sys
from pathlib import Path

import pytest

from softshadow.checking import Check, Exercise, Grader, Limits, Verdict


def red(gl):
    gl.glClearColor(1, 0, 0, 1)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT)


SECONDS = 8  # the endless programs take all of it; the others need less than one
EXERCISE = '''"""Red"""
size = (8, 8)

def expected(gl):
    gl.glClearColor(1, 0, 0, 1)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT)
'''
CLEAR = "    gl.glClearColor(1, 0, 0, 1); gl.glClear(gl.GL_COLOR_BUFFER_BIT)\n"
linux = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the memory limit is one of Linux")
long = pytest.mark.slow


def verdict_on(folder: Path, code: str) -> Verdict:
    (folder / "exercise.py").write_text(EXERCISE)
    (folder / "student.py").write_text(code)
    exercise = Exercise(str(folder / "exercise.py"), "Red", "", (8, 8), (Check(expected=red),))
    (verdict,) = Grader(exercise, Limits(SECONDS, 512)).grade(folder / "student.py").verdicts
    assert "softshadow/checking" not in str(verdict)
    return verdict


@pytest.mark.parametrize(
    ("body", "kind"),
    [
        pytest.param("    import sys; sys.exit(0)", "exited", marks=long, id="sys.exit"),
        pytest.param("    import os; os._exit(0)", "exited", id="os._exit"),
        pytest.param("    raise KeyboardInterrupt", "python-error", marks=long, id="KeyboardInterrupt"),
        pytest.param("    raise GeneratorExit", "python-error", marks=long, id="GeneratorExit"),
        pytest.param("    program(gl)", "python-error", marks=long, id="recursion"),
        pytest.param("    import ctypes; ctypes.string_at(0)", "signal", marks=long, id="segmentation fault"),
        pytest.param("    import os; os.abort()", "signal", marks=long, id="abort"),
        pytest.param("    while True: pass", "time", marks=long, id="endless loop"),
        pytest.param("    sum(iter(int, 1))", "time", marks=long, id="endless loop in C"),
        pytest.param("    import threading; threading.Lock().acquire(); threading.Event().wait()", "time", marks=long,
                     id="waits"),
        pytest.param("    try:\n        while True: pass\n    finally:\n        program(gl)", "time", marks=long,
                     id="endless loop with a finally"),
        pytest.param("    import signal\n    for each in (2, 15): signal.signal(each, signal.SIG_IGN)\n"
                     "    while True: pass", "time", marks=long, id="ignores signals"),
        pytest.param("    import numpy; numpy.ones(10**10, numpy.uint8)", "memory", marks=[long, linux],
                     id="array of 10 GB"),
        pytest.param("    kept = []\n    while True: kept.append('x' * 10**6)", "memory", marks=[long, linux],
                     id="growing list"),
        pytest.param("    gl.glEnable(gl.GL_KEEP)", "gl-error", marks=long, id="GL error"),
        pytest.param("    pass", "differs", marks=long, id="nothing drawn"),
    ],
)  # fmt: skip
def test_a_program_that_fails_does_not_pass(body: str, kind: str, tmp_path: Path) -> None:
    verdict = verdict_on(tmp_path, f"def program(gl):\n{body}\n")
    assert verdict.kind == kind, str(verdict)
    assert not verdict.passed


@pytest.mark.parametrize(
    "body",
    [
        pytest.param("    import sys; sys.stdout.close(); sys.stderr.close()", id="closes stdout"),
        pytest.param("    import os; os.closerange(0, 200)", marks=long, id="closes all files"),
        pytest.param("    import os; os.chdir('/')", marks=long, id="changes the folder"),
        pytest.param("    open('report.json', 'w').write('[]'); open('ready', 'w')", marks=long, id="writes files"),
        pytest.param("    print('{\"passed\": false}' * 3)", marks=long, id="prints JSON"),
        pytest.param("    for _ in range(1000): print('x' * 10**6)", marks=long, id="prints 1 GB"),
        pytest.param("    import os; os.fork()", marks=long, id="forks"),
        pytest.param("    import os, time\n    if os.fork() == 0: time.sleep(600)", marks=long, id="leaves a process"),
        pytest.param("    import threading, time\n    threading.Thread(target=time.sleep, args=(600,)).start()",
                     marks=long, id="leaves a thread"),
        pytest.param("    import atexit, os; atexit.register(os._exit, 1)", marks=long, id="registers an exit handler"),
    ],
)  # fmt: skip
def test_a_right_program_passes_whatever_else_it_does(body: str, tmp_path: Path) -> None:
    verdict = verdict_on(tmp_path, f"def program(gl):\n{CLEAR}{body}\n")
    assert verdict.kind == "equal", str(verdict)
    assert len(verdict.output) <= 2000
    assert sorted(path.name for path in tmp_path.iterdir() if path.suffix) == ["exercise.py", "student.py"]


@pytest.mark.slow
@pytest.mark.parametrize(
    "body",
    [
        "    import os\n    if os.fork() == 0: return\n    os.wait(); os._exit(0)",
        "    print('equal'); import sys; sys.exit(0)",
        "    import os\n    if os.fork(): os._exit(0)\n    gl.glClearColor(1, 0, 0, 1)\n"
        "    gl.glClear(gl.GL_COLOR_BUFFER_BIT)",
    ],
)
def test_nothing_passes_that_ends_before_its_function_returns(body: str, tmp_path: Path) -> None:
    assert verdict_on(tmp_path, f"def program(gl):\n{body}\n").kind == "exited"


@pytest.mark.parametrize(
    ("code", "kind", "line", "said"),
    [
        pytest.param("def program(gl):\n    gl.glClear(\n", "python-error", 2, "was never closed", marks=long),
        pytest.param("import numpy as np\nnp.ones(3).reshape(2)\n", "python-error", 2, "cannot reshape", id="line"),
        pytest.param("def main(gl): pass\n", "no-program", None, "no function program", marks=long),
        pytest.param("x = '\\0'\n\0", "python-error", None, "null bytes", marks=long),
    ],
)
def test_a_traceback_has_only_the_lines_of_the_student(
    code: str, kind: str, line: int | None, said: str, tmp_path: Path
) -> None:
    verdict = verdict_on(tmp_path, code)
    assert (verdict.kind, verdict.line) == (kind, line)
    assert said in str(verdict)
    assert "site-packages" not in str(verdict)
    assert str(tmp_path) not in str(verdict)
    assert [text for text in verdict.traceback.splitlines() if "File" in text and "student.py" not in text] == []


def test_a_file_that_is_no_readable_python_file_is_refused(tmp_path: Path) -> None:
    exercise = Exercise("", "Red", "", (8, 8), (Check(cases=(((1,), 1),)),))
    (tmp_path / "essay.txt").write_text("def program(x): return x")
    for name in ("missing.py", "essay.txt"):
        assert Grader(exercise).grade(tmp_path / name).verdicts[0].kind == "unreadable"
