"""What two recorded programs do differently, as a diff of GL calls: - with the failure, + with the cure."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from difflib import SequenceMatcher
from itertools import groupby

from softshadow.failures.calls import Call

SWITCHES = ("glEnableClientState", "glDisableClientState")  # around every draw; told nowhere
MOST_LINES = 6  # of one side in one place: what is more is a pass of its own, and its beginning tells it


def call_difference(wrong: Sequence[Call], cured: Sequence[Call]) -> str:
    """Return the calls that one program makes and the other does not, under the titles of their steps.

    What stands in several places of a step, as for each object, is told once with the number of places. An array that
    has other numbers in the same form is "other values".
    """
    before, after = told(wrong), told(cured)
    places: dict[tuple[str, tuple[str, ...]], int] = {}
    matcher = SequenceMatcher(None, [call.key for call in before], [call.key for call in after], autojunk=False)
    for tag, i, i_end, j, j_end in matcher.get_opcodes():
        if tag != "equal":
            gone, come = before[i:i_end], after[j:j_end]
            lines = (*_lines("-", gone), *_lines("+", come, {call.text for call in gone}))
            hunk = (come or gone)[0].step, lines
            places[hunk] = places.get(hunk, 0) + 1
    text: list[str] = []
    for step, hunks in groupby(places.items(), key=lambda item: item[0][0]):
        text.append(f"@@ {step}")
        for (_, lines), count in hunks:
            text += lines if count == 1 else (*lines, f"  ({count} times)")
    return "\n".join(text)


def told(calls: Sequence[Call]) -> list[Call]:
    """Return the calls that a difference tells of: without switches, glBegin to glEnd as one."""
    kept: list[Call] = []
    inside: list[Call] = []
    for call in calls:
        if inside or call.name == "glBegin":
            inside.append(call)
            if call.name == "glEnd":
                kept.append(_as_one(inside))
                inside = []
        elif call.name not in SWITCHES:
            kept.append(call)
    return kept


def _as_one(calls: Sequence[Call]) -> Call:
    vertices = sum(call.name.startswith("glVertex") for call in calls)
    text = f"{calls[0].text}, {vertices} vertices, glEnd()"
    return Call(calls[0].step, "glBegin", text, "".join(call.key for call in calls))


def _lines(sign: str, calls: Sequence[Call], others: Iterable[str] = ()) -> list[str]:
    lines = [f"{sign} {call.text}" + (", other values" if call.text in others else "") for call in calls]
    if len(lines) <= MOST_LINES + 1:
        return lines
    return [*lines[:MOST_LINES], f"{sign} ... {len(lines) - MOST_LINES} more calls of gl"]
