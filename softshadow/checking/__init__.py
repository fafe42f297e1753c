"""Exercises: a student's program is run in its own process and compared with the buffers that a teacher expects.

`softshadow check` is the command. A run has a time and a memory limit, but the process is no sandbox.
"""

from softshadow.checking.exercise import Check, Exercise
from softshadow.checking.grading import Grade, Grader
from softshadow.checking.limits import Limits
from softshadow.checking.loading import exercise_for, load_exercise
from softshadow.checking.verdict import Verdict

__all__ = ["Check", "Exercise", "Grade", "Grader", "Limits", "Verdict", "exercise_for", "load_exercise"]
