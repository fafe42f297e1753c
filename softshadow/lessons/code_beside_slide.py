"""A listing of the course in two columns: as its slide prints it, and as it runs, with the lines of one step marked."""

from __future__ import annotations

import ast
import re
import textwrap
from dataclasses import dataclass
from functools import cache
from html import escape

from softshadow.listings import get
from softshadow.listings.source import Excerpt, code_of, titles_of

STYLE = """<style>
.beside-slide{overflow-x:auto}
.beside-slide table{border-collapse:collapse;font:0.78em/1.4 ui-monospace,monospace;display:table;width:100%;
  min-width:44em;table-layout:fixed;margin:0 0 0.6em}
.beside-slide th,.beside-slide td{text-align:left;vertical-align:top;padding:0 0.5em;border:0;white-space:pre-wrap;
  overflow-wrap:anywhere}
.beside-slide th:first-child,.beside-slide td:first-child{text-align:right;width:5em;white-space:pre}
.beside-slide tr.now td{background:#f5a62333}
.beside-slide tr.now td:first-child::before{content:"▶ "}
.beside-slide tr.changed td:nth-child(2){box-shadow:inset 3px 0 #d33}
.beside-slide tr.changed td:nth-child(3){box-shadow:inset 3px 0 #0a7}
</style>"""


@dataclass(frozen=True)
class Row:
    """One line: its text as printed and as it runs ("" where one has no such line), and the steps that execute it."""

    printed: str
    running: str
    steps: tuple[int, ...]


Functions = tuple[tuple[str, tuple[Row, ...]], ...]  # (file and name, rows)


@dataclass(frozen=True)
class CodeBesideSlide:
    """The functions of a listing with their rows; `step` is the index of the marked step, or None."""

    name: str
    slide: str
    titles: tuple[str, ...]
    step: int | None
    functions: Functions

    def __str__(self) -> str:
        lines = [self._heading]
        for function, rows in self.functions:
            width = max((len(row.printed) for row in rows), default=0)
            lines += ["", f"   {function}"]
            lines += [
                f"{'>' if self._marked(row) else ' '}{'*' if row.printed != row.running else ' '} "
                f"{row.printed:{width}}  |  {row.running}".rstrip()
                for row in rows
            ]
        return "\n".join(lines)

    def __repr__(self) -> str:
        return str(self)

    def _repr_html_(self) -> str:
        tables = "".join(self._html_table(function, rows) for function, rows in self.functions)
        label = escape(f"listing {self.name}")
        return (
            f'{STYLE}<div class="beside-slide" tabindex="0" role="region" aria-label="{label}">'
            f"<p>{escape(self._heading)}</p>{tables}</div>"
        )

    @property
    def _heading(self) -> str:
        step = "all steps" if self.step is None else f"step {self.step}: {self.titles[self.step]}"
        return f"{self.name} ({self.slide}), {step}"

    def _marked(self, row: Row) -> bool:
        return self.step is not None and self.step in row.steps

    def _html_table(self, function: str, rows: tuple[Row, ...]) -> str:
        """Return one function: in two columns if a correction changes it, else in one."""
        changed = any(row.printed != row.running for row in rows)
        heads = [f"{self.slide} as printed", f"{function} as it runs"] if changed else [f"{self.slide}, {function}"]
        head = "".join(f'<th scope="col">{escape(each)}</th>' for each in ("step", *heads))
        body = "".join(self._html_row(row, [row.printed, row.running] if changed else [row.running]) for row in rows)
        return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"

    def _html_row(self, row: Row, columns: list[str]) -> str:
        kinds = ["now"] * self._marked(row) + ["changed"] * (row.printed != row.running)
        cells = (" ".join(map(str, row.steps)), *columns)
        return f'<tr class="{" ".join(kinds)}">' + "".join(f"<td>{escape(cell)}</td>" for cell in cells) + "</tr>"


def code_beside_slide(name: str, step: int | None = None) -> CodeBesideSlide:
    """Return a listing as its slide prints it beside the listing as it runs, with the lines of a step marked.

    Parameters
    ----------
    name : str                   of the listing, see `softshadow.listings.names`
    step : int | None            the step whose lines are marked; by default all functions are shown, without marks

    Raises
    ------
    ValueError                   an unknown name, or a step that the listing does not have

    Examples
    --------
    >>> print(code_beside_slide("stencil-quads", 1))
    stencil-quads (CA:262-286), step 1: ...
    """
    slide, titles, functions = side_by_side(name)
    if step is not None and step not in range(len(titles)):
        raise ValueError(f"listing {name}: step={step}: expected 0 to {len(titles) - 1}")
    shown = tuple(each for each in functions if step is None or any(step in row.steps for row in each[1]))
    return CodeBesideSlide(name, slide, titles, step, shown)


@cache
def side_by_side(name: str) -> tuple[str, tuple[str, ...], Functions]:
    """Return the slide of a listing, the titles of its steps, and its functions with the rows of both versions."""
    listing = get(name)
    printed = {(each.file, each.function): each for each in code_of(listing, ())}
    functions = tuple(
        (f"{each.file}: {each.function}", rows_of(printed.get((each.file, each.function)), each))
        for each in code_of(listing)
    )
    return listing.slide, tuple(titles_of(listing)), functions


def rows_of(printed: Excerpt | None, running: Excerpt) -> tuple[Row, ...]:
    """Return the statements of two versions of a function side by side: lines of one number belong together."""
    left = statements(printed) if printed else {}
    right = statements(running)
    steps = {line.number: line.steps for line in running.lines}
    return tuple(
        Row(left.get(number, ""), right.get(number, ""), steps.get(number, ())) for number in sorted({*left, *right})
    )


def statements(excerpt: Excerpt) -> dict[int, str]:
    """Return the lines of a function by number as on a slide: no signature, docstring or `yield`, no prefix ``gl.``."""
    function = ast.parse(textwrap.dedent("\n".join(line.text for line in excerpt.lines))).body[0]
    assert isinstance(function, ast.FunctionDef)
    body = function.body[1:] if ast.get_docstring(function) else function.body
    first = body[0].lineno - 1
    return {
        line.number: re.sub(r"\bgl\.(?=gl|GL_)", "", line.text[4:])
        for line in excerpt.lines[first:]
        if not re.match(r"\s*yield [\"(]", line.text)
    }
