"""The main loop of GLUT, with a clock of 60 frames in a second.

A turn does what a turn of freeglut's loop does: it tells windows their sizes, lets a key or click happen, calls the
timers that are due, shows the windows that ask for it, and destroys windows. Then the idle callback is called, or the
clock moves on to the next timer. A key or click happens after each frame. A program for which nothing is due has ended.
"""

from __future__ import annotations

import heapq

from softshadow import gl
from softshadow.errors import StateError
from softshadow.windows.desktop import FRAME_MS, ProgramEnded, desktop
from softshadow.windows.glut.program import Program
from softshadow.windows.glut.tokens import TOKENS
from softshadow.windows.glut.user_input import happen
from softshadow.windows.glut.window import Window

MOST_IDLE_TURNS = 10_000  # without a frame
EXIT = TOKENS["GLUT_ACTION_EXIT"]


class Loop:
    """The main loop of one program."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self._frame_of_event = 0  # after which the last key or click happened
        self._idle_turns, self._frame = 0, 0  # turns since the last frame, and its number

    def run(self) -> None:
        """Do what is due until the program ends.

        Raises
        ------
        StateError                   there is no window, or one without a display callback
        """
        program = self.program
        if not program.windows:
            raise StateError("glutMainLoop: the program has not opened a window")
        program.is_left = False
        while True:
            self._turn()
            if program.is_left:
                break
            self._idle()
        for window in list(program.windows.values()):
            self._destroy(window)
        if program.close_action == EXIT:
            raise ProgramEnded

    def run_once(self) -> None:
        """Do what is due; meanwhile, a tenth of a frame's time passes."""
        before = desktop().frame
        self._turn()
        if desktop().frame == before:
            desktop().clock_ms += FRAME_MS / 10

    def _turn(self) -> None:
        program = self.program
        for window in list(program.windows.values()):
            self._tell_size(window)
        self._next_event()
        due = [timer for timer in program.timers if timer[0] <= desktop().clock_ms]
        for _ in due:
            _, _, function, value = heapq.heappop(program.timers)
            function(value)
        for window in list(program.windows.values()):
            if window.is_posted and window.is_visible and window.number not in program.destroyed:
                self._display(window)
        while program.destroyed:
            number = program.destroyed.pop(0)
            if number in program.windows:
                self._destroy(program.windows[number])
        if not program.windows:
            program.is_left = True
        self._idle_turns = self._idle_turns + 1 if desktop().frame == self._frame else 0
        self._frame = desktop().frame
        if self._idle_turns > MOST_IDLE_TURNS:
            self._when_nothing_is_due()

    def _idle(self) -> None:
        """Call the idle callback, or wait for the next timer."""
        program, window = self.program, desktop()
        if program.idle is not None:
            window.clock_ms += FRAME_MS / 10
            program.idle()
        elif any((each.is_posted and each.is_visible) or each.due_size for each in program.windows.values()):
            return
        elif program.timers:
            window.clock_ms = max(window.clock_ms, program.timers[0][0])
        elif not self._event_is_due():
            self._when_nothing_is_due()

    def _event_is_due(self) -> bool:
        return bool(desktop().events) and desktop().frame > self._frame_of_event

    def _when_nothing_is_due(self) -> None:
        """Show the window though the program does not ask for it, if an event has happened since; else end."""
        shown = self.program.windows.get(desktop().shown)
        if shown is None or self._frame_of_event < desktop().frame or not shown.is_visible:
            raise ProgramEnded
        desktop().tell(
            "the program does not call glutPostRedisplay after a key or click: its window is drawn again here, but not "
            "on a screen"
        )
        shown.is_posted = True

    def _next_event(self) -> None:
        shown = self.program.windows.get(desktop().shown)
        if shown is None or not self._event_is_due():
            return
        event = desktop().next_event()
        self._frame_of_event = desktop().frame
        if event is not None:
            self.program.select(shown)
            happen(self.program, shown, event)

    # -- windows -------------------------------------------------------------------------------------------------------
    def _tell_size(self, window: Window) -> None:
        """Give a window its new size; call its callbacks for size and visibility."""
        size, window.due_size = window.due_size, None
        changed = size is not None and window.resize(size)
        if not window.is_new and not changed:
            window.is_posted |= size is not None and size != window.size  # the user keeps another size
            return
        self.program.select(window)
        window.is_posted = True
        if not window.call("Reshape", *window.size):
            gl.glViewport(0, 0, *window.size)
        if window.is_new:
            window.is_new = False
            window.call("WindowStatus", TOKENS["GLUT_FULLY_RETAINED"])
            window.call("Visibility", TOKENS["GLUT_VISIBLE"])

    def _display(self, window: Window) -> None:
        before = desktop().frame
        self.program.select(window)
        window.is_posted = False
        if not window.call("Display"):
            raise StateError(f"glutMainLoop: window {window.number} has no display callback")
        if window.is_shown and desktop().frame == before:
            window.tell_what_the_mode_lacks()
            if window.mode & TOKENS["GLUT_DOUBLE"]:
                desktop().tell(
                    "the display callback does not call glutSwapBuffers: on a screen nobody sees what it draws"
                )
            desktop().end_frame()

    def _destroy(self, window: Window) -> None:
        program = self.program
        for child in [each for each in program.windows.values() if each.parent == window.number]:
            self._destroy(child)
        before = program.window
        program.select(window)
        window.call("Close")
        del program.windows[window.number]
        program.select(None if before is window else before)
        if window.is_shown and program.windows and not program.is_left:
            desktop().tell(f"window {window.number}, which is shown, was destroyed")
            raise ProgramEnded
