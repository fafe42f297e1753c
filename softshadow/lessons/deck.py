"""Slides of a lesson: its goal, the listing, the steps of its run, the question and the exercise.

Of the lesson's code only as much is run as its clickable report needs; what only shows something is left out, so
neither Jupyter nor matplotlib is needed.
"""

from __future__ import annotations

import ast
import re
import warnings
from collections.abc import Iterator
from contextlib import redirect_stdout
from dataclasses import dataclass
from html import escape
from io import StringIO
from itertools import pairwise
from pathlib import Path
from typing import Any

from softshadow.errors import nearest
from softshadow.lessons.code_beside_slide import Row, code_beside_slide
from softshadow.lessons.copies import lesson_files, title_of
from softshadow.report import Slide, Slides, step_slides

LISTING_LINES, COLUMN_WIDTH = 30, 66  # that fit on a slide: lines, characters in one of two columns
ASKED = ("Predict, then run", "Exercise")  # sections that are put to the room; their answers stay in the notebook


@dataclass(frozen=True)
class Cell:
    """A cell of a lesson: text in Markdown, or code."""

    text: str
    is_code: bool


def lesson_slides(number: int | str) -> Slides:
    """Return the slides of a lesson.

    Parameters
    ----------
    number : int or str          8, "08" or "08_planar_with_stencil"

    Raises
    ------
    ValueError                   there is no such lesson

    Examples
    --------
    >>> from softshadow.lessons import lesson_slides
    >>> lesson_slides(8)
    Slides('8. Projected shadows with the stencil buffer', 10 slides)
    """
    path = lesson_file(number)
    cells = list(cells_of(path))
    run = shown_run(cells)
    notes = notes_of(cells, len(run.steps))
    described = len(notes) == len(run.steps)
    slides = [
        Slide(title_of(path), rendered(re.sub(r"^# .*\n", "", cells[0].text).strip())),
        *listing_slides(cells),
        *([] if described or not notes else [Slide("What to notice", rendered("\n\n".join(notes)))]),
        *step_slides(run, notes=[rendered(note, inline=True) for note in notes] if described else ()),
    ]
    sections = {name: text for cell in cells if not cell.is_code for name, text in sections_of(cell.text)}
    slides += [Slide(name, rendered(sections[name])) for name in ASKED if name in sections]
    return Slides(title_of(path), tuple(slides))


def lesson_file(number: int | str) -> Path:
    """Return the file of a lesson.

    Raises
    ------
    ValueError                   there is no such lesson
    """
    files = {file.stem: file for file in lesson_files()}
    text = str(number)
    for stem, file in files.items():
        if text == stem or (text.isdigit() and int(text) == int(stem[:2])):
            return file
    raise ValueError(f"lesson {number!r}: {nearest(text, list(files))}")


def cells_of(lesson: Path) -> Iterator[Cell]:
    """Yield the cells of a lesson (py:percent)."""
    _, *parts = re.split(r"^# %%(.*)\n", lesson.read_text(encoding="utf-8"), flags=re.MULTILINE)
    for kind, text in zip(parts[::2], parts[1::2], strict=True):
        if "[markdown]" in kind:
            yield Cell(re.sub(r"^# ?", "", text, flags=re.MULTILINE).strip(), False)
        else:
            yield Cell(text, True)


def sections_of(text: str) -> list[tuple[str, str]]:
    r"""Return the sections (heading, text) that begin in a cell.

    Examples
    --------
    >>> sections_of("before\n## One\na\n## Two\nb")
    [('One', 'a'), ('Two', 'b')]
    """
    _, *parts = re.split(r"^## (.*)\n?", text, flags=re.MULTILINE)
    return [(name.strip(), words.strip()) for name, words in zip(parts[::2], parts[1::2], strict=True)]


def shown_run(cells: list[Cell]) -> Any:
    """Return the run of the lesson's clickable report: the code up to there is run, without what only displays."""
    names: dict[str, Any] = {"display": lambda *shown: None}
    for cell in cells:
        if not cell.is_code:
            continue
        tree = ast.parse(cell.text)
        asked = next(
            (each.args[0] for each in ast.walk(tree) if isinstance(each, ast.Call) and _is_clickable(each)), None
        )
        body = [statement for statement in tree.body if not _displays(statement)]
        with warnings.catch_warnings(), redirect_stdout(StringIO()):
            warnings.simplefilter("ignore")  # lessons tell them in their text
            exec(compile(ast.Module(body, []), "<lesson>", "exec"), names)
            if asked is not None:
                return eval(compile(ast.Expression(asked), "<lesson>", "eval"), names)
    raise AssertionError("a lesson has a clickable report")


def _is_clickable(call: ast.Call) -> bool:
    return isinstance(call.func, ast.Attribute) and call.func.attr == "clickable"


def _displays(statement: ast.stmt) -> bool:
    """Return whether a statement only shows something: an expression, a picture of matplotlib, or `display` itself."""
    if isinstance(statement, ast.Expr):
        return True
    if isinstance(statement, ast.ImportFrom):
        return statement.module == "IPython.display"
    return isinstance(statement, ast.Assign) and ast.unparse(statement.value).startswith("ss.notebook.show_")


def notes_of(cells: list[Cell], steps: int) -> list[str]:
    """Return what the lesson says about its buffers: one text for each step if it numbers them, else paragraphs."""
    for cell, following in pairwise(cells):
        if cell.is_code and "notebook.show_steps(" in cell.text and not following.is_code:
            text = re.split(r"^## ", following.text, flags=re.MULTILINE)[0].strip()
            items = [" ".join(item.split()) for item in re.split(r"^\d+\. ", text, flags=re.MULTILINE)[1:]]
            return items if len(items) == steps else [text] if text else []
    return []


def listing_slides(cells: list[Cell]) -> list[Slide]:
    """Return the listings that the lesson shows beside the slide, as printed and as they run."""
    slides = []
    for cell in cells:
        shown = re.findall(r"code_beside_slide\(\"([\w-]+)\"(?:, step=(\d+))?", cell.text) if cell.is_code else []
        for name, step in shown:
            beside = code_beside_slide(name, int(step) if step else None)
            for function, rows in beside.functions:
                parts = list(_fitting(rows))
                for number, part in enumerate(parts, 1):
                    of = f" ({number} of {len(parts)})" if len(parts) > 1 else ""
                    slides.append(Slide(f"{name}, {beside.slide}{of}", _table(function, part)))
    return slides


def _fitting(rows: tuple[Row, ...]) -> Iterator[list[Row]]:
    """Yield the rows in parts that fit on a slide."""
    part, lines = list[Row](), 0
    for row in rows:
        needed = max(1, -(-max(len(row.printed), len(row.running)) // COLUMN_WIDTH))
        if part and lines + needed > LISTING_LINES:
            yield part
            part, lines = [], 0
        part.append(row)
        lines += needed
    if part:
        yield part


def _table(function: str, rows: list[Row]) -> str:
    """Return rows as a table: in two columns if a correction changes one of them, else in one."""
    two = any(row.printed != row.running for row in rows)
    heads = ("step", "as printed", f"{function} as it runs") if two else ("step", function)
    head = "".join(f'<th scope="col">{escape(each)}</th>' for each in heads)
    body = "".join(
        f"<tr{' class=changed' if row.printed != row.running else ''}><td>{' '.join(map(str, row.steps))}</td>"
        + (f"<td>{escape(row.printed)}</td>" if two else "")
        + f"<td>{escape(row.running)}</td></tr>"
        for row in rows
    )
    return f'<table class="listing"><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>'


def rendered(text: str, inline: bool = False) -> str:
    """Return Markdown as HTML."""
    from markdown_it import MarkdownIt  # rich needs it, so it is there

    markdown = MarkdownIt("commonmark", {"html": False}).enable("table")
    return str(markdown.renderInline(text) if inline else markdown.render(text))
