"""The desktop that a program sees: one window, a clock, keys and clicks, and an end after some frames."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

from softshadow.context import Context
from softshadow.errors import StateError
from softshadow.gl import create_context
from softshadow.pipeline.commands import Command

FRAME_MS = 1000 / 60
# names of keys for --keys that no single character spells
SPECIAL_KEYS = ("Up", "Down", "Left", "Right", "PageUp", "PageDown", "Home", "End", "Insert",
                *(f"F{number}" for number in range(1, 13)))  # fmt: skip
NAMED_CHARACTERS = {"Space": " ", "Enter": "\r", "Tab": "\t", "Esc": "\x1b", "Comma": ",", "Backspace": "\b"}


class ProgramEnded(BaseException):  # not an Exception, so that a program does not catch it
    """All frames have been drawn, or nothing more would happen."""


@dataclass(frozen=True)
class Key:
    """A key that is pressed: a character, or one of `SPECIAL_KEYS`."""

    name: str

    @property
    def is_special(self) -> bool:
        """Whether the key has no character."""
        return self.name in SPECIAL_KEYS


@dataclass(frozen=True)
class Click:
    """A click of the left button: x from the left, y from the top."""

    x: int
    y: int


@dataclass
class Desktop:
    """The only window of a program, and what happens to it.

    Attributes
    ----------
    size : (width, height)       of the window, whatever the program asks for; None until it does
    n_frames : int               after so many the program ends; the last one is recorded
    events : list                one happens after each frame
    frame : int                  frames that have ended
    left_out : dict              calls that could not be made: how often
    program : str                path of the program
    """

    size: tuple[int, int] | None = None
    n_frames: int = 1
    events: list[Key | Click] = field(default_factory=list)
    frame: int = 0
    clock_ms: float = 0.0
    context: Context | None = None
    left_out: dict[str, int] = field(default_factory=dict)
    pointer: tuple[int, int] = (0, 0)
    program: str = ""

    def open_window(self, width: int, height: int) -> Context:
        """Return the context of the window, which is created at the first call and made current.

        Raises
        ------
        StateError                   the program opens a second window
        """
        if self.context is not None:
            raise StateError("the program opens a second window; one is all there is here")
        self.size = self.size or (width, height)
        self.context = create_context(*self.size, history_mb=None)
        return self.context

    def end_frame(self) -> None:
        """End a frame; the last one ends the program."""
        if self.context is None:
            return
        self.frame += 1
        self.clock_ms += FRAME_MS
        if self.frame >= self.n_frames:
            raise ProgramEnded
        self.context.finish()
        self.context.gate = self._begin_frame

    def _begin_frame(self, _: Command) -> bool:
        """Let the recording begin with a frame's first command: what ends before it has drawn the last frame."""
        assert self.context is not None
        self.context.gate = None
        self.context.frame.begin(self.context.storage)
        return True

    def next_event(self) -> Key | Click | None:
        """Return what happens next, or None."""
        event = self.events.pop(0) if self.events else None
        if isinstance(event, Click):
            self.pointer = event.x, event.y
        return event

    def leave_out(self, name: str) -> None:
        """Count a call that could not be made."""
        self.left_out[name] = self.left_out.get(name, 0) + 1


_desktops: list[Desktop] = []


def desktop() -> Desktop:
    """Return the desktop of the program that is running."""
    return _desktops[-1]


@contextmanager
def running(program: Desktop) -> Iterator[None]:
    """Make a desktop the one that windows open on."""
    _desktops.append(program)
    try:
        yield
    finally:
        _desktops.pop()


def keys_of(text: str) -> list[Key | Click]:
    """Return the keys that a text such as "a,b,Up" names.

    Raises
    ------
    ValueError                   a name is neither a character nor that of a key

    Examples
    --------
    >>> keys_of("a,Up,Space")
    [Key(name='a'), Key(name='Up'), Key(name=' ')]
    """
    keys: list[Key | Click] = []
    for name in text.split(",") if text else []:
        spelled = NAMED_CHARACTERS.get(name, name)
        if len(spelled) != 1 and spelled not in SPECIAL_KEYS:
            names = ", ".join((*NAMED_CHARACTERS, *SPECIAL_KEYS))
            raise ValueError(f"keys={text!r}: {name!r} is no key; expected a character or one of {names}")
        keys.append(Key(spelled))
    return keys
