"""A pixel history as a table: a column appears only where some row has a value, and reasons stand below their rows."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Sequence

from softshadow.inspection.history_row import Color, HistoryRow
from softshadow.inspection.lookup_words import lookup_words
from softshadow.inspection.tables import html_table, text_table

WIDTH = 100  # columns of the text


def heads_and_cells(rows: Sequence[HistoryRow]) -> tuple[list[str], list[list[str]], list[str]]:
    """Return the heads, the cells and the reasons of a history; columns without a value are left out."""
    columns = {head: [cell(row) for row in rows] for head, cell in COLUMNS.items()}
    kept = [head for head, cells in columns.items() if head in ALWAYS or any(cell != "-" for cell in cells)]
    cells = [[columns[head][n] for head in kept] for n in range(len(rows))]
    return kept, cells, [reason_of(row) for row in rows]


def reason_of(row: HistoryRow) -> str:
    """Return what the row's triangle was made from, its tests and its lookups, in words."""
    made = f"{row.name}: " if row.part else ""
    offset = f"z was {row.z_before_offset:.6f} before the polygon offset; " if row.z_before_offset is not None else ""
    return made + offset + "; ".join([row.reason, *(lookup_words(lookup) for lookup in row.lookups)])


def text_of(heads: list[str], cells: list[list[str]], reasons: list[str]) -> str:
    """Return the table as text, the reason of each row below it."""
    head, *lines = text_table(heads, cells).split("\n")
    indent = " " * 6
    wrapped = [textwrap.fill(reason, WIDTH, initial_indent=indent, subsequent_indent=indent) for reason in reasons]
    return "\n".join([head, *(part for pair in zip(lines, wrapped, strict=False) for part in pair)])


def html_of(heads: list[str], cells: list[list[str]], reasons: list[str]) -> str:
    """Return the table as HTML, with the reasons as its last column."""
    return html_table([*heads, "reason"], [[*row, reason] for row, reason in zip(cells, reasons, strict=True)])


def _number(value: float | None) -> str:
    return "-" if value is None else f"{value:.6f}"


def _whole(value: int | None) -> str:
    return "-" if value is None else str(value)


def _triangle(row: HistoryRow) -> str:
    facing = {True: " front", False: " back", None: ""}[row.front_facing]
    return f"{_whole(row.triangle)}{facing}"


def color_text(color: Color | None) -> str:
    """Return a colour as #rrggbb, or the floats of a float buffer."""
    if not color:
        return "-"
    if all(isinstance(channel, int) for channel in color):
        return "#" + "".join(f"{int(channel):02x}" for channel in color)
    return " ".join(f"{channel:.3g}" for channel in color)


def _changed(before: str, after: str) -> str:
    return f"{before} -> {after}" if before != after else after


COLUMNS: dict[str, Callable[[HistoryRow], str]] = {
    "step": lambda row: str(row.step),
    "draw": lambda row: _whole(row.draw),
    "object": lambda row: row.object or "-",
    "triangle": _triangle,
    "z": lambda row: _number(row.z),
    "stored z": lambda row: _number(row.stored_z),
    "stencil": lambda row: _changed(str(row.stencil_before), str(row.stencil_after)),
    "source": lambda row: "-" if row.color_source == row.color_after else color_text(row.color_source),
    "colour": lambda row: color_text(row.color_after),
    "verdict": lambda row: row.verdict,
}
ALWAYS = ("step", "draw", "object", "triangle", "z", "stored z", "stencil", "colour", "verdict")
