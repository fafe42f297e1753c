"""Exercises read from a teacher's file, or from a lesson by its name."""

from __future__ import annotations

import ast
import os
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from softshadow.checking.exercise import Check, Exercise
from softshadow.checking.lesson_exercises import LESSON, lesson_exercise
from softshadow.checking.source import cut_traceback, execute
from softshadow.errors import SoftShadowError
from softshadow.runs.perform import checked_size

SIZE = (64, 64)


def load_exercise(source: str | os.PathLike[str]) -> Exercise:
    """Return an exercise.

    Parameters
    ----------
    source : path of a Python file, or "lesson:NAME"

    Raises
    ------
    SoftShadowError              the file cannot be read, fails, or describes no exercise
    ValueError                   there is no such lesson
    """
    if str(source).startswith(LESSON):
        return lesson_exercise(str(source))
    path = Path(source).resolve()
    try:
        names = execute(path, "exercise")
    except OSError as error:
        raise SoftShadowError(f"{source}: the exercise cannot be read ({error.strerror})") from None
    except Exception as error:  # a teacher's file may fail in any way
        raise SoftShadowError(f"{source}: the exercise fails\n{cut_traceback(error, path)}") from error
    try:
        return exercise_of(path, names)
    except (TypeError, ValueError) as error:
        raise SoftShadowError(f"{source}: {error}") from None


def exercise_for(submission: str | os.PathLike[str]) -> str | None:
    """Return the exercise that a student's file is for; the file is read, not run.

    That is what a line like ``exercise = "lesson:05"`` names, a file relative to the student's; or the file itself, if
    it has both functions, `program` and `expected`. None if it has neither, or cannot be read.
    """
    path = Path(submission)
    try:
        body = ast.parse(path.read_bytes()).body
    except (OSError, SyntaxError, ValueError, RecursionError, MemoryError):
        return None
    for statement in body:
        match statement:
            case ast.Assign(targets=[ast.Name(id="exercise")], value=ast.Constant(value=str(named))):
                return named if named.startswith(LESSON) else str(path.parent / named)
    functions = {statement.name for statement in body if isinstance(statement, ast.FunctionDef)}
    return str(submission) if {"program", "expected"} <= functions else None


def exercise_of(path: Path, names: Mapping[str, Any]) -> Exercise:
    """Return the exercise that the names of a teacher's file describe.

    Raises
    ------
    ValueError, TypeError        what it describes is no exercise; the message has the name and what was expected
    """
    expected = names.get("expected")
    checks = tuple(names.get("checks", (Check(),)))
    if not checks or not all(isinstance(check, Check) for check in checks):
        raise ValueError("checks: expected a list of softshadow.checking.Check")
    checks = tuple(_completed(check, expected, path.parent) for check in checks)
    titles = [check.title for check in checks]
    if len(set(titles)) < len(titles):
        raise ValueError(f"checks: expected different titles, got {', '.join(titles)}")
    title, _, task = (names.get("__doc__") or path.stem).strip().partition("\n")
    size = checked_size(names.get("size", SIZE))
    return Exercise(str(path), title, task.strip(), size, checks, str(names.get("start", "")))


def _completed(check: Check, expected: Any, folder: Path) -> Check:
    """Return a check with its solution: the exercise's own by default, files relative to the exercise."""
    if check.cases is not None:
        return check
    solution = expected if check.expected is None else check.expected
    if isinstance(solution, str) and solution.endswith(".npz"):
        solution = str(folder / solution)
    elif isinstance(solution, str) and not solution.startswith("listing:"):
        raise ValueError(f"check {check.title!r}: expected={solution!r}: expected listing:NAME or a file .npz")
    elif not isinstance(solution, str) and not callable(solution):
        raise ValueError(f"check {check.title!r} has no solution: expected a function `expected(gl)` in the file")
    return replace(check, expected=solution)
