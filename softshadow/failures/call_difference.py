"""What two recorded programs do differently, as a diff of GL calls: - with the failure, + with the cure."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from difflib import SequenceMatcher
from itertools import groupby

from softshadow.failures.calls import Call

# what changes no pixel: the switches of vertex arrays around every draw, and questions
UNTOLD = ("glEnableClientState", "glDisableClientState", "glGet", "glReadPixels")
MOST_PLACES = 6  # where the cure is another technique, there is no end of them
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
    for step, hunks in groupby(list(places.items())[:MOST_PLACES], key=lambda item: item[0][0]):
        text.append(f"@@ {step}")
        for (_, lines), count in hunks:
            text += lines if count == 1 else (*lines, f"  ({count} times)")
    if len(places) > MOST_PLACES:
        text.append(f"@@ and in {len(places) - MOST_PLACES} more places")
    return "\n".join(text)


def told(calls: Sequence[Call]) -> list[Call]:
    """Return the calls that a difference tells of, none of `UNTOLD`.

    glBegin to glEnd is one call, and so is a draw with the pointers to its arrays.
    """
    kept: list[Call] = []
    inside: list[Call] = []
    for call in calls:
        if inside or call.name == "glBegin" or call.name.endswith("Pointer"):
            inside.append(call)
            if call.name == "glEnd":
                vertices = sum(each.name.startswith("glVertex") for each in inside)
                kept.append(_as_one(inside, f"{inside[0].text}, {vertices} vertices, glEnd()"))
                inside = []
            elif call.name.startswith("glDraw"):
                kept.append(_as_one(inside, call.text))
                inside = []
        elif not call.name.startswith(UNTOLD):
            kept.append(call)
    return kept


def _as_one(calls: Sequence[Call], text: str) -> Call:
    return Call(calls[0].step, calls[-1].name, text, "".join(call.key for call in calls))


def _lines(sign: str, calls: Sequence[Call], others: Iterable[str] = ()) -> list[str]:
    lines = [f"{sign} {call.text}" + (", other values" if call.text in others else "") for call in calls]
    if len(lines) <= MOST_LINES + 1:
        return lines
    return [*lines[:MOST_LINES], f"{sign} ... {len(lines) - MOST_LINES} more calls of gl"]
