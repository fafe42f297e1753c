"""The difference of two recorded programs as a diff of GL calls: - with the failure, + with the cure."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from difflib import SequenceMatcher
from itertools import groupby

from softshadow.gallery.calls import Call

# calls that change no pixel: queries, and the switches of vertex arrays around every draw
IGNORED = ("glEnableClientState", "glDisableClientState", "glGet", "glReadPixels")
MOST_PLACES = 6  # a cure by another technique differs nearly everywhere
MOST_LINES = 6  # of one side in one place: a longer one is a whole pass, which its first calls identify


def call_difference(wrong: Sequence[Call], cured: Sequence[Call], most_places: int = MOST_PLACES) -> str:
    """Return the calls that only one of two programs makes, under the titles of their steps.

    The same difference in several places of a step, as for each object, is listed once with the number of places. Calls
    that differ in the contents of an array only are marked "other values".
    """
    before, after = condensed(wrong), condensed(cured)
    places: dict[tuple[str, tuple[str, ...]], int] = {}
    matcher = SequenceMatcher(None, [call.key for call in before], [call.key for call in after], autojunk=False)
    for tag, i, i_end, j, j_end in matcher.get_opcodes():
        if tag != "equal":
            removed, added = before[i:i_end], after[j:j_end]
            lines = (*_lines("-", removed), *_lines("+", added, {call.text for call in removed}))
            hunk = (added or removed)[0].step, lines
            places[hunk] = places.get(hunk, 0) + 1
    text: list[str] = []
    for step, hunks in groupby(list(places.items())[:most_places], key=lambda item: item[0][0]):
        text.append(f"@@ {step}")
        for (_, lines), times in hunks:
            text += lines if times == 1 else (*lines, f"  ({times} times)")
    if len(places) > most_places:
        text.append(f"@@ and in {len(places) - most_places} more places")
    return "\n".join(text)


def condensed(calls: Sequence[Call]) -> list[Call]:
    """Return the calls without `IGNORED`; glBegin to glEnd, or a draw with its array pointers, becomes one call."""
    result: list[Call] = []
    inside: list[Call] = []
    for call in calls:
        if inside or call.name == "glBegin" or call.name.endswith("Pointer"):
            inside.append(call)
            if call.name == "glEnd":
                vertices = sum(each.name.startswith("glVertex") for each in inside)
                result.append(_as_one(inside, f"{inside[0].text}, {vertices} vertices, glEnd()"))
                inside = []
            elif call.name.startswith("glDraw"):
                result.append(_as_one(inside, call.text))
                inside = []
        elif not call.name.startswith(IGNORED):
            result.append(call)
    return result


def _as_one(calls: Sequence[Call], text: str) -> Call:
    return Call(calls[0].step, calls[-1].name, text, "".join(call.key for call in calls))


def _lines(sign: str, calls: Sequence[Call], others: Iterable[str] = ()) -> list[str]:
    lines = [f"{sign} {call.text}" + (", other values" if call.text in others else "") for call in calls]
    if len(lines) <= MOST_LINES + 1:
        return lines
    return [*lines[:MOST_LINES], f"{sign} ... {len(lines) - MOST_LINES} more calls of gl"]
