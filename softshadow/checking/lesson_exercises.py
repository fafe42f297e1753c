"""The exercises of the lessons: their cells are executed, and the checks in them are collected instead of run.

So a lesson and the command line have the same expected buffers and results, which stand in the lesson.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterable
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path
from typing import Any

from softshadow.checking.exercise import Check, Exercise
from softshadow.errors import nearest
from softshadow.lessons.copies import lesson_files, title_of

LESSON = "lesson:"
HEADING = "# ## Exercise"
HIDDEN = re.compile(r"\bcheck_(?:program|function)\(|^def solution\b", re.MULTILINE)  # not for students
CELL = re.compile(r"^# %%(.*)$", re.MULTILINE)


class Collector:
    """Stands in for `softshadow.lessons` in the cells of an exercise; its checks only note what they are given."""

    def __init__(self) -> None:
        self.checks: list[Check] = []
        self.size = (64, 64)

    def check_program(
        self, program: Callable[[Any], Any], solution: Callable[[Any], Any], size: tuple[int, int] = (64, 64),
        buffers: tuple[str, ...] = ("color",),
    ) -> None:  # fmt: skip
        """Note the check of a program."""
        self.size = size
        self.checks.append(Check(program.__name__, program.__name__, solution, tuple(buffers)))

    def check_function(self, function: Callable[..., Any], cases: Iterable[Any], within: float = 0) -> None:
        """Note the check of a function."""
        self.checks.append(Check(function.__name__, function.__name__, cases=tuple(cases), within=within))


def lesson_exercise(source: str) -> Exercise:
    """Return the exercise of a lesson, "lesson:NAME"; its number is enough, as in "lesson:05".

    Raises
    ------
    ValueError                   there is no such lesson
    """
    name = source.removeprefix(LESSON)
    files = {file.stem: file for file in lesson_files()}
    lesson = next((file for stem, file in files.items() if name in (stem, stem.partition("_")[0])), None)
    if lesson is None:
        raise ValueError(f"{source}: there is no such lesson; {nearest(name, files)}")
    cells = exercise_cells(lesson)
    codes = [text for kind, text in cells if kind == "code"]
    needed = needed_statements(lesson, codes)
    collector = Collector()
    names: dict[str, Any] = {"__name__": "exercise", "display": lambda *_: None}
    with redirect_stdout(StringIO()):  # a cell prints the result of its check, which is not run
        for code in [*needed, *codes]:
            exec(compile(code, str(lesson), "exec", dont_inherit=True), names)
            if "lessons" in names:
                names["lessons"] = collector
    task = "\n\n".join(text for kind, text in cells if kind == "text").partition("\n")[2].strip()
    given = [code for code in codes if not HIDDEN.search(code)]
    start = "\n\n\n".join(["\n".join(needed_statements(lesson, given)), *given]).strip()
    return Exercise(
        f"{LESSON}{lesson.stem}", title_of(lesson), task, collector.size, tuple(collector.checks), f"{start}\n"
    )


def exercise_cells(lesson: Path) -> list[tuple[str, str]]:
    """Return the cells of the section *Exercise*: "text" without comment signs, or "code"."""
    after = lesson.read_text(encoding="utf-8").split(HEADING, 1)[1]
    section = re.split(r"^# ## ", after, maxsplit=1, flags=re.MULTILINE)[0]
    parts = CELL.split(f"# %% [markdown]\n{HEADING}{section}")[1:]
    cells = [
        ("text", re.sub(r"^# ?", "", body, flags=re.MULTILINE).strip())
        if "[markdown]" in head
        else ("code", body.strip())
        for head, body in zip(parts[::2], parts[1::2], strict=True)
    ]
    return [(kind, body) for kind, body in cells if body]


def needed_statements(lesson: Path, codes: list[str]) -> list[str]:
    """Return the statements before the exercise that define the names which code of the exercise uses, in order."""
    before = lesson.read_text(encoding="utf-8").split(HEADING, 1)[0]
    used = set().union(*(names_used(ast.parse(code)) for code in codes))
    needed: list[str] = []
    for statement in reversed(ast.parse(before).body):
        defined = names_defined(statement)
        if defined & used:
            needed.insert(0, ast.unparse(statement))
            used |= names_used(statement)
    return needed


def names_used(tree: ast.AST) -> set[str]:
    """Return the names that code reads."""
    return {node.id for node in ast.walk(tree) if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load)}


def names_defined(statement: ast.stmt) -> set[str]:
    """Return the names that an import, a function or an assignment defines; others define none."""
    if isinstance(statement, ast.Import | ast.ImportFrom):
        return {(each.asname or each.name).partition(".")[0] for each in statement.names}
    if isinstance(statement, ast.FunctionDef):
        return {statement.name}
    if isinstance(statement, ast.Assign):
        return {node.id for target in statement.targets for node in ast.walk(target) if isinstance(node, ast.Name)}
    return set()
