"""The desktop that a program sees: a window, a clock, and an end after some frames."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

from softshadow.context import Context
from softshadow.errors import StateError
from softshadow.gl import create_context
from softshadow.pipeline.commands import Command
from softshadow.windows.events import Choice, Event

FRAME_MS = 1000 / 60


class ProgramEnded(BaseException):  # not an Exception, so that a program does not catch it
    """All frames have been drawn, or nothing more would happen."""


@dataclass
class Desktop:
    """The window of a program that is shown, and what happens to it.

    Attributes
    ----------
    size : (width, height)       of the window, whatever the program asks for; None until it does
    n_frames : int               after so many the program ends; the last one is recorded
    events : list                one happens after each frame
    shown : int                  which window of a GLUT program, from 1
    frame : int                  frames that have ended
    left_out : dict              calls that could not be made: how often
    notes : dict                 what is otherwise than on a screen, in the order in which it was told
    program : str                path of the program
    has_menus : bool             menus can be chosen from
    """

    size: tuple[int, int] | None = None
    n_frames: int = 1
    events: list[Event] = field(default_factory=list)
    shown: int = 1
    frame: int = 0
    clock_ms: float = 0.0
    context: Context | None = None
    left_out: dict[str, int] = field(default_factory=dict)
    notes: dict[str, None] = field(default_factory=dict)
    pointer: tuple[int, int] = (0, 0)
    program: str = ""
    has_menus: bool = False

    def __post_init__(self) -> None:
        self.keeps_size = self.size is not None

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
        self.context.stream.gate = self._begin_frame

    def _begin_frame(self, _: Command) -> bool:
        """Let the recording begin with a frame's first command: what ends before it has drawn the last frame."""
        assert self.context is not None
        self.context.stream.gate = None
        self.context.frame.begin(self.context.storage)
        return True

    def resize(self, width: int, height: int) -> bool:
        """Give the window another size, unless the user has chosen one; return whether it has changed."""
        if self.context is None or self.keeps_size or self.size == (width, height):
            return False
        self.size = width, height
        self.context.resize(width, height)
        return True

    def next_event(self) -> Event | None:
        """Return what happens next, or None.

        Raises
        ------
        StateError                   it is the choice of a menu's entry, and the program has no menus of GLUT
        """
        event = self.events.pop(0) if self.events else None
        if isinstance(event, Choice) and not self.has_menus:
            raise StateError(f"Menu:{event.label}: the program has no menus of GLUT")
        return event

    def leave_out(self, name: str) -> None:
        """Count a call that could not be made."""
        self.left_out[name] = self.left_out.get(name, 0) + 1

    def tell(self, note: str) -> None:
        """Note once what the picture or the program lacks, for the user."""
        self.notes[note] = None


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
