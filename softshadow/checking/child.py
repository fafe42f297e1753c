"""The process of a student's program: ``python -m softshadow.checking.child JOB.json``.

It writes `report.json` beside the job. If there is none, the process was ended before, and `process.py` finds out why.
A process that the program forks ends with the program, and writes nothing.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable
from contextlib import contextmanager, suppress
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from softshadow import gl
from softshadow.checking.exercise import Check, Exercise
from softshadow.checking.expected import buffers_of_run, read_buffers
from softshadow.checking.loading import load_exercise
from softshadow.checking.memory import limit_memory, unlimit_memory
from softshadow.checking.source import cut_traceback, execute, is_script, line_of
from softshadow.checking.verdict import Verdict
from softshadow.errors import SoftShadowError
from softshadow.inspection.explanation import explain
from softshadow.lessons.function_check import check_function
from softshadow.lessons.program_check import BUFFERS
from softshadow.testing import differences, history_of_first, run_here, run_recorded

if TYPE_CHECKING:
    from collections.abc import Iterator

    from softshadow.context import Frame
    from softshadow.runs import Run
    from softshadow.testing import BufferDifference
    from softshadow.testing.result import ProgramResult


def main(job_file: str) -> None:
    """Run a student's function, and write the verdict of each check."""
    job = json.loads(Path(job_file).read_text(encoding="utf-8"))
    folder = Path(job_file).parent
    exercise = load_exercise(job["exercise"])
    checks = [exercise.checks[index] for index in job["checks"]]
    expected = [
        None if check.cases is not None else folder / f"expected-{index}.npz"
        for check, index in zip(checks, job["checks"], strict=True)
    ]
    run_here(lambda gl: gl.glClear(gl.GL_COLOR_BUFFER_BIT), exercise.size)  # kernels are loaded before the time begins
    limit_memory(job["megabytes"])
    process = os.getpid()
    (folder / "ready").touch()
    verdicts = verdicts_of(Path(job["submission"]), exercise, checks, expected)
    unlimit_memory()
    if os.getpid() == process:
        text = json.dumps([each.to_dict() for each in verdicts], default=str)
        (folder / "report.part").write_text(text, encoding="utf-8")
        (folder / "report.part").replace(folder / "report.json")
    with suppress(BaseException):
        sys.stdout.flush()
    os._exit(0)  # whatever threads and exit handlers the program has left


def verdicts_of(path: Path, exercise: Exercise, checks: list[Check], expected: list[Path | None]) -> list[Verdict]:
    """Return the verdicts of checks of one function in a student's file."""
    caught: list[Verdict] = []
    with suppress_all(path, caught):
        if checks[0].cases is None and is_script(path, checks[0].program):
            run = run_of_script(path, exercise.size)
            return verdicts_on(buffers_of_run(run), run.frame, checks, [each for each in expected if each is not None])
        function = execute(path, "submission").get(checks[0].program)
        if not callable(function):
            name = checks[0].program
            caught.append(Verdict("no-program", f"The file has no function {name}."))
        elif checks[0].cases is None:
            return run_program(function, exercise, checks, [each for each in expected if each is not None])
        else:
            return [run_cases(function, check) for check in checks]
    return [caught[0]] * len(checks)


@contextmanager
def suppress_all(path: Path, caught: list[Verdict]) -> Iterator[None]:
    """Turn whatever a student's code raises into a verdict."""
    try:
        yield
    except BaseException as error:
        unlimit_memory()
        caught.append(verdict_of(error, path))


def verdict_of(error: BaseException, path: Path) -> Verdict:
    """Return the verdict on an error that a student's code raised."""
    line, told = line_of(error, path), cut_traceback(error, path)
    where = "" if line is None else f" in line {line}"
    if isinstance(error, MemoryError):
        return Verdict("memory", f"The program needs more memory than it may use{where}.", line, told)
    if isinstance(error, SystemExit):
        return Verdict("exited", f"The program ends its process{where}: {type(error).__name__}.", line, told)
    if isinstance(error, SoftShadowError) and not isinstance(error, gl.GLError) and line is None:
        return Verdict("no-program", f"{error}.", None, told)
    if isinstance(error, gl.GLError):
        return Verdict("gl-error", f"A GL call failed{where}: {error}", line, told)
    return Verdict("python-error", f"The program ended with {type(error).__name__}{where}.", line, told)


def run_cases(function: Callable[..., Any], check: Check) -> Verdict:
    """Return the verdict on a function that is called with arguments."""
    result = check_function(function, check.cases or (), check.within)
    return Verdict({None: "not-written", False: "wrong", True: "equal"}[result.passed], result.sentence)


def run_program(
    program: Callable[[Any], Any], exercise: Exercise, checks: list[Check], expected: list[Path]
) -> list[Verdict]:
    """Run ``program(gl)`` once, and return the verdicts of checks of its buffers."""
    result, frame = run_recorded(program, exercise.size)
    return verdicts_on(replace(result, returned=None), frame, checks, expected)


def run_of_script(path: Path, size: tuple[int, int]) -> Run:
    """Return the run of a program written for PyOpenGL that opens its own window, drawn in a window of this size.

    Raises
    ------
    BaseException                what the program raises; SoftShadowError if it opens no window
    """
    from softshadow.windows import run_script  # a program of gl does not need it

    try:
        return run_script(path, size=size)
    except SoftShadowError as error:
        if error.__cause__ is not None:
            raise error.__cause__ from None
        raise


def verdicts_on(result: ProgramResult, frame: Frame, checks: list[Check], expected: list[Path]) -> list[Verdict]:
    """Return the verdicts of checks of the buffers that a program has left; `frame` is its recording."""
    size = result.stencil.shape[1], result.stencil.shape[0]
    verdicts = []
    for check, file in zip(checks, expected, strict=True):
        ignored = {name: getattr(result, name) for name in BUFFERS if name not in check.buffers}
        wanted = replace(read_buffers(file, size), **ignored)
        found = tuple(each for each in differences(result, wanted) if each.count > check.allowed)
        history = history_of_first(frame, found)
        if history is None:
            verdicts.append(Verdict("equal", equal_sentence(check)))
            continue
        verdicts.append(
            Verdict(
                "differs", differ_sentence(found), differences=tuple(map(facts, found)),
                history=str(history), explanation=explain(history, None, False),
            )
        )  # fmt: skip
    return verdicts


def equal_sentence(check: Check) -> str:
    """Return the sentence for a check that passes."""
    if check.allowed:
        return f"Right: at most {check.allowed} pixels differ in {' and '.join(check.buffers)}."
    return f"Right: every pixel of {' and '.join(check.buffers)} is as expected."


def differ_sentence(found: tuple[BufferDifference, ...]) -> str:
    """Return the sentence for a check that fails."""
    return f"Not yet: {' and '.join(each.buffer for each in found)} {'differ' if found[1:] else 'differs'}."


def facts(each: BufferDifference) -> dict[str, Any]:
    """Return a difference for JSON, its pixel as in a picture: y from the top."""
    return {
        "buffer": each.buffer, "count": each.count, "x": each.x, "y": each.y_from_top, "gl_y": each.y,
        "value": each.ours, "expected": each.theirs,
    }  # fmt: skip


if __name__ == "__main__":
    main(sys.argv[1])
