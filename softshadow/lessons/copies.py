"""The files of the lessons, and copies of them to work in."""

from __future__ import annotations

import os
from dataclasses import dataclass
from functools import partial
from importlib.util import find_spec
from pathlib import Path

from softshadow.errors import SoftShadowError
from softshadow.inspection.files import write_whole

INSTALLED = Path(__file__).parent / "notebooks"
CHECKOUT = Path(__file__).parents[2] / "docs" / "lessons"


@dataclass(frozen=True)
class Copies:
    """The files that were written, and those that were there already and have been left as they are."""

    written: tuple[Path, ...]
    kept: tuple[Path, ...]


def lesson_files() -> list[Path]:
    """Return the lessons in the order of the course: Python files with cells (py:percent)."""
    return sorted((INSTALLED if INSTALLED.is_dir() else CHECKOUT).glob("[0-9][0-9]_*.py"))


def title_of(lesson: Path) -> str:
    """Return the title of a lesson, with its number."""
    lines = lesson.read_text(encoding="utf-8").splitlines()
    return next(line.removeprefix("# # ") for line in lines if line.startswith("# # "))


def copy_lessons(folder: str | os.PathLike[str]) -> Copies:
    """Copy all lessons into a folder, as notebooks, or as Python files where jupytext is missing.

    A file that is there already is kept: it may have somebody's answers.

    Parameters
    ----------
    folder : path                is created if it is missing

    Raises
    ------
    SoftShadowError              the folder cannot be written
    """
    target = Path(folder)
    try:
        target.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise SoftShadowError(f"{folder}: the folder cannot be made ({error.strerror})") from None
    written, kept = [], []
    for lesson in lesson_files():
        text, suffix = content_of(lesson)
        copy = target / f"{lesson.stem}{suffix}"
        if copy.exists():
            kept.append(copy)
        else:
            written.append(write_whole(copy, partial(Path.write_text, data=text, encoding="utf-8")))
    return Copies(tuple(written), tuple(kept))


def content_of(lesson: Path) -> tuple[str, str]:
    """Return a lesson as the text of a notebook, or of a Python file without jupytext, and the file name extension."""
    text = lesson.read_text(encoding="utf-8")
    if find_spec("jupytext") is None:
        return text, ".py"
    import jupytext

    notebook = jupytext.reads(text, fmt="py:percent")
    for index, cell in enumerate(notebook.cells):
        cell["id"] = f"{lesson.stem}-{index}"  # else they are random, and two copies differ
    return jupytext.writes(notebook, fmt="ipynb"), ".ipynb"
