"""What a replay could not do, with the numbers of the calls."""

from __future__ import annotations

from dataclasses import dataclass, field

SHADING, MISSING, DRAWN_BY_SHADER, ERROR, REFUSED = (
    "shading language", "missing call", "draw of a GLSL program", "GL error", "refused"
)  # fmt: skip
MOST_MESSAGES = 200  # a program can make as many different errors as it likes


@dataclass
class LeftOut:
    """Calls of one name that could not be carried out for one reason.

    Attributes
    ----------
    kind : str                   "shading language", "missing call", "draw of a GLSL program", "GL error" (the call
                                 failed, as GL specifies) or "refused" (this package cannot carry it out)
    call : str                   its name
    reason : str                 the error message of the first of them
    count, first, last : int     how many, and numbers of the first and the last one
    in_frame : int               how many of them in the chosen frame
    of_program : int             how many of these errors the recorded program got as well, from its own GL
    """

    kind: str
    call: str
    reason: str
    count: int = 0
    first: int = 0
    last: int = 0
    in_frame: int = 0
    of_program: int = 0

    def __str__(self) -> str:
        if self.count == 1:
            where = f"call {self.first}"
        else:
            where = f"{self.count} calls, {self.first} to {self.last}"
        reason = f": {self.reason}" if self.reason else ""
        own = "; the recorded program got this error, too" if self.of_program else ""
        return f"{self.call} ({where}), {self.kind}{reason}{own}"


@dataclass
class LeftOutCalls:
    """All that could not be done, by kind, call and reason, in the order of the first calls."""

    entries: dict[tuple[str, str, str], LeftOut] = field(default_factory=dict)
    _unanswered: list[tuple[LeftOut, int]] = field(default_factory=list)  # errors since the last glGetError

    def add(self, kind: str, call: str, number: int, reason: str, in_frame: bool, error: int = 0) -> None:
        """Count a call; `error` is GL's code."""
        key = kind, call, reason
        if key not in self.entries and len(self.entries) >= MOST_MESSAGES:
            reason = "other reasons"
            key = kind, call, reason
        entry = self.entries.setdefault(key, LeftOut(kind, call, reason, 0, number))
        entry.count += 1
        entry.last = number
        entry.in_frame += in_frame
        if error and len(self._unanswered) < MOST_MESSAGES:
            self._unanswered.append((entry, error))

    def answer(self, error: int) -> None:
        """Note what glGetError answered in the recorded program: which errors it got as well."""
        for entry, code in self._unanswered:
            if code == error:
                entry.of_program += 1
                break
        self._unanswered.clear()

    def __iter__(self):  # type: ignore[no-untyped-def]
        return iter(self.entries.values())
