"""Submissions graded: every check of an exercise for every student's file."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from softshadow.checking.exercise import Check, Exercise
from softshadow.checking.expected import Expected, expected_of
from softshadow.checking.limits import Limits
from softshadow.checking.process import run_submission
from softshadow.checking.verdict import Verdict
from softshadow.inspection import pixel_history
from softshadow.inspection.explanation import explain


@dataclass(frozen=True)
class Grade:
    """The verdicts on one submission, one for each check of the exercise."""

    submission: str
    checks: tuple[Check, ...]
    verdicts: tuple[Verdict, ...]

    @property
    def passed(self) -> bool:
        """Whether all checks pass."""
        return all(each.passed for each in self.verdicts)

    @property
    def points(self) -> float:
        """The points of the checks that pass."""
        return sum(check.points for check, each in zip(self.checks, self.verdicts, strict=True) if each.passed)

    def to_dict(self) -> dict[str, Any]:
        """Return the grade for JSON."""
        rows = [
            {"title": check.title, "points": check.points if each.passed else 0, "of": check.points, **each.to_dict(),
             "hint": "" if each.passed else check.hint}
            for check, each in zip(self.checks, self.verdicts, strict=True)
        ]  # fmt: skip
        return {"file": self.submission, "passed": self.passed, "points": self.points, "checks": rows}


class Grader:
    """Grades submissions of one exercise; the solutions are run once, when the grader is made.

    Parameters
    ----------
    exercise : Exercise
    limits : Limits              of each student's program

    Raises
    ------
    SoftShadowError              a solution fails
    """

    def __init__(self, exercise: Exercise, limits: Limits | None = None) -> None:
        self.exercise, self.limits = exercise, limits or Limits()
        self._expected = {
            index: expected_of(exercise, check) for index, check in enumerate(exercise.checks) if check.cases is None
        }

    def grade(self, submission: str | os.PathLike[str]) -> Grade:
        """Return the grade of a student's file."""
        checks = self.exercise.checks
        path = Path(submission)
        if not _readable(path):
            refused = Verdict("unreadable", f"{path.name}: expected a readable Python file, of the kind name.py")
            return Grade(str(submission), checks, (refused,) * len(checks))
        verdicts = {index: each for group in self._groups() for index, each in self._run(path, group)}
        return Grade(str(submission), checks, tuple(verdicts[index] for index in range(len(checks))))

    def _groups(self) -> list[list[int]]:
        """Return the indices of checks, those together that need one run of the student's function."""
        groups: dict[tuple[str, bool], list[int]] = {}
        for index, check in enumerate(self.exercise.checks):
            groups.setdefault((check.program, check.cases is None), []).append(index)
        return list(groups.values())

    def _run(self, path: Path, group: list[int]) -> Iterator[tuple[int, Verdict]]:
        expected = {index: self._expected[index] for index in group if index in self._expected}
        for index, each in zip(group, run_submission(path, self.exercise, group, expected, self.limits), strict=True):
            yield index, each if index not in expected else _beside_solution(each, expected[index])


def _readable(path: Path) -> bool:
    try:
        return path.suffix == ".py" and path.is_file() and path.read_bytes() is not None
    except OSError:
        return False


def _beside_solution(verdict: Verdict, expected: Expected) -> Verdict:
    """Return a verdict with the history of the first differing pixel in the solution."""
    if not verdict.differences or expected.frame is None:
        return verdict
    first = verdict.differences[0]
    history = pixel_history(expected.frame, first["x"], first["y"])
    return replace(verdict, expected_history=str(history), expected_explanation=explain(history, None, False))
