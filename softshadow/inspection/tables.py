"""Tables as text and HTML. Text can be fitted to the width of a terminal: cells are wrapped, none is cut."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from html import escape
from typing import NamedTuple

NARROWEST = 22  # characters: a text column that would be narrower stands under its row instead,
TALLEST = 3  # lines: and so does one whose cells would be longer
BETWEEN, INDENT = "  ", "    "  # columns; what stands under a row
Styled = Callable[[str, bool], str]  # (padded text of a cell, whether it is a head) -> the text with colours


class Page(NamedTuple):
    """Where a table is printed: how many characters a line has (None: any number), and what colours a cell."""

    width: int | None
    styled: Styled


PIPE = Page(None, lambda text, head: text)
_page: ContextVar[Page | None] = ContextVar("page", default=None)


@contextmanager
def printed_on(width: int | None, styled: Styled) -> Iterator[None]:
    """Fit all text tables inside the block to lines of `width` characters, with cells coloured by `styled`."""
    before = _page.set(Page(width, styled))
    try:
        yield
    finally:
        _page.reset(before)


def text_table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Return aligned columns under their heads: text to the left, numbers to the right.

    On a page that is too narrow (`printed_on`) the cells of text columns are wrapped. Columns that still do not fit
    stand under each row, every cell after the head of its column.

    Examples
    --------
    >>> print(text_table(["draw", "verdict"], [["0", "passed"], ["12", "culled"]]))
    draw  verdict
       0  passed
      12  culled
    >>> with printed_on(18, lambda text, head: text):
    ...     print(text_table(["draw", "verdict", "z"], [["0", "depth failed", "0.25"]]))
    draw  verdict
       0  depth failed
        z 0.25
    """
    page = _page.get() or PIPE
    numeric = [bool(rows) and all(_is_number(row[column]) for row in rows) for column in range(len(heads))]
    widths = _fitted([max(len(row[column]) for row in (heads, *rows)) for column in range(len(heads))], numeric, page)
    beside = len(widths)
    lines = []
    for row in (heads, *rows):
        wrapped = [_wrapped(cell, width) for cell, width in zip(row, widths, strict=False)]
        for part in range(max(map(len, wrapped))):
            cells = [parts[part] if part < len(parts) else "" for parts in wrapped]
            lines.append(_line(cells, widths, numeric, row is heads, page.styled))
        if row is not heads and beside < len(heads):
            lines += _under(heads[beside:], row[beside:], page)
    return "\n".join(lines)


def _fitted(widths: list[int], numeric: list[bool], page: Page) -> list[int]:
    """Return the widths of the columns that stand beside each other on a page; the others stand under their row."""
    for beside in range(len(widths), 0, -1):
        chosen = widths[:beside]
        excess = sum(chosen) + len(BETWEEN) * (beside - 1) - (page.width or 1 << 30)
        while excess > 0:  # take from the widest text column
            column = max(range(beside), key=lambda index: 0 if numeric[index] else chosen[index])
            narrowest = max(NARROWEST, -(-widths[column] // TALLEST))
            room = 0 if numeric[column] else chosen[column] - narrowest
            if room <= 0:
                break
            others = sorted(chosen[index] for index in range(beside) if not numeric[index] and index != column)
            taken = min(excess, room, max(1, chosen[column] - (others[-1] if others else 0)))
            chosen[column] -= taken
            excess -= taken
        if excess <= 0:
            return chosen
    return [min(widths[0], max(page.width or widths[0], 1))]


def _wrapped(cell: str, width: int) -> list[str]:
    """Return a cell as lines of at most `width` characters; pairs of spaces separate what stays together."""
    if len(cell) <= width:
        return [cell]
    together = "\0"  # stands for single spaces in a cell of several parts, as in "0: 8  1: 3"
    parts = re.sub(r"(?<! ) (?! )", together, cell) if BETWEEN in cell else cell
    if any(len(part) > width for part in parts.split()):
        parts = cell
    lines = textwrap.wrap(parts, width, break_on_hyphens=False, drop_whitespace=True)
    return [line.replace(together, " ") for line in lines]


def _line(cells: list[str], widths: list[int], numeric: list[bool], head: bool, styled: Styled) -> str:
    padded = [
        cell.rjust(width) if right else cell.ljust(width)
        for cell, width, right in zip(cells, widths, numeric, strict=False)
    ]
    padded[-1] = padded[-1].rstrip()
    while padded and not padded[-1].strip():
        padded.pop()
        padded[-1:] = [padded[-1].rstrip()] if padded else []
    return BETWEEN.join(styled(cell, head) if cell.strip() else cell for cell in padded)


def _under(heads: Sequence[str], cells: Sequence[str], page: Page) -> list[str]:
    """Return cells one after the other, each after its head, in lines that are indented."""
    lines, used = [INDENT], len(INDENT)
    for head, cell in zip(heads, cells, strict=True):
        separator = "" if lines[-1] == INDENT else BETWEEN
        named = f"{head} {cell}"
        width = page.width or 1 << 30
        if used + len(separator) + len(named) <= width or (separator == "" and len(INDENT + named) <= width):
            lines[-1] += separator + page.styled(head, True) + " " + page.styled(cell, False)
            used += len(separator) + len(named)
            continue
        first, *others = _wrapped(named, max(width - len(INDENT), NARROWEST))
        start = INDENT + page.styled(first[: len(head)], True) + first[len(head) :]
        lines = [*lines[: -1 if separator == "" else None], start, *(INDENT + each for each in others)]
        used = len(lines[-1]) if others else len(INDENT + first)
    return lines


def _is_number(cell: str) -> bool:
    return cell in ("", "-") or cell.replace(".", "", 1).isdigit()


def html_table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Return a plain HTML table; the text of the cells is escaped."""
    head = "".join(f"<th>{escape(cell)}</th>" for cell in heads)
    body = "".join("<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>" for row in rows)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"
