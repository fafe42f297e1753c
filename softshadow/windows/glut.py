"""GLUT without a screen: callbacks are called as in glutMainLoop, with a clock of 60 frames in a second.

Each turn of the loop does the first of these that is due: show the window, call a timer, let a key or a click happen,
call the idle callback. A program for which nothing is due has ended.
"""

from __future__ import annotations

import heapq
import itertools
from collections.abc import Callable
from typing import Any

from softshadow import gl
from softshadow.windows.desktop import FRAME_MS, Click, Key, ProgramEnded, desktop
from softshadow.windows.shapes import SHAPES
from softshadow.windows.teapot import solid_teapot, wire_teapot

MOST_IDLE_CALLS = 10_000  # without a frame
TOKENS = {
    "GLUT_RGB": 0, "GLUT_RGBA": 0, "GLUT_INDEX": 1, "GLUT_SINGLE": 0, "GLUT_DOUBLE": 2, "GLUT_ACCUM": 4,
    "GLUT_ALPHA": 8, "GLUT_DEPTH": 16, "GLUT_STENCIL": 32, "GLUT_MULTISAMPLE": 128, "GLUT_LEFT_BUTTON": 0,
    "GLUT_MIDDLE_BUTTON": 1, "GLUT_RIGHT_BUTTON": 2, "GLUT_DOWN": 0, "GLUT_UP": 1, "GLUT_LEFT": 0, "GLUT_ENTERED": 1,
    "GLUT_KEY_LEFT": 100, "GLUT_KEY_UP": 101, "GLUT_KEY_RIGHT": 102, "GLUT_KEY_DOWN": 103, "GLUT_KEY_PAGE_UP": 104,
    "GLUT_KEY_PAGE_DOWN": 105, "GLUT_KEY_HOME": 106, "GLUT_KEY_END": 107, "GLUT_KEY_INSERT": 108,
    "GLUT_WINDOW_X": 100, "GLUT_WINDOW_Y": 101, "GLUT_WINDOW_WIDTH": 102, "GLUT_WINDOW_HEIGHT": 103,
    "GLUT_WINDOW_BUFFER_SIZE": 104, "GLUT_WINDOW_STENCIL_SIZE": 105, "GLUT_WINDOW_DEPTH_SIZE": 106,
    "GLUT_WINDOW_DOUBLEBUFFER": 115, "GLUT_SCREEN_WIDTH": 200, "GLUT_SCREEN_HEIGHT": 201, "GLUT_ELAPSED_TIME": 700,
    "GLUT_ACTIVE_SHIFT": 1, "GLUT_ACTIVE_CTRL": 2, "GLUT_ACTIVE_ALT": 4, "GLUT_NOT_VISIBLE": 0, "GLUT_VISIBLE": 1,
    "GLUT_ACTION_ON_WINDOW_CLOSE": 505, "GLUT_ACTION_EXIT": 0, "GLUT_ACTION_GLUTMAINLOOP_RETURNS": 1,
    "GLUT_ACTION_CONTINUE_EXECUTION": 2, "GLUT_CURSOR_NONE": 101, "GLUT_CURSOR_INHERIT": 100,
    **{f"GLUT_KEY_F{number}": number for number in range(1, 13)},
}  # fmt: skip
SPECIAL = {
    "Left": 100, "Up": 101, "Right": 102, "Down": 103, "PageUp": 104, "PageDown": 105, "Home": 106, "End": 107,
    "Insert": 108, **{f"F{number}": number for number in range(1, 13)},
}  # fmt: skip
FONTS = (
    "GLUT_BITMAP_9_BY_15", "GLUT_BITMAP_8_BY_13", "GLUT_BITMAP_TIMES_ROMAN_10", "GLUT_BITMAP_TIMES_ROMAN_24",
    "GLUT_BITMAP_HELVETICA_10", "GLUT_BITMAP_HELVETICA_12", "GLUT_BITMAP_HELVETICA_18", "GLUT_STROKE_ROMAN",
    "GLUT_STROKE_MONO_ROMAN",
)  # fmt: skip
CALLBACKS = (
    "Display", "Reshape", "Idle", "Keyboard", "KeyboardUp", "Special", "SpecialUp", "Mouse", "Motion", "PassiveMotion",
    "Visibility", "Entry", "MouseWheel", "Close", "WMClose", "WindowStatus",
)  # fmt: skip
# calls that change nothing here: the window has its size, and there are neither menus nor a pointer to be seen
WITHOUT_EFFECT = (
    "glutInitDisplayMode", "glutInitDisplayString", "glutInitWindowPosition", "glutPositionWindow",
    "glutSetWindowTitle", "glutSetIconTitle", "glutSetCursor", "glutWarpPointer", "glutShowWindow", "glutHideWindow",
    "glutPopWindow", "glutPushWindow", "glutIconifyWindow", "glutFullScreen", "glutFullScreenToggle",
    "glutLeaveFullScreen", "glutIgnoreKeyRepeat", "glutSetKeyRepeat", "glutSetOption", "glutAddMenuEntry",
    "glutAddSubMenu", "glutAttachMenu", "glutDetachMenu", "glutReshapeWindow", "glutInitContextVersion",
    "glutInitContextFlags", "glutInitContextProfile", "glutDestroyWindow", "glutSetWindow", "glutReportErrors",
)  # fmt: skip


class Glut:
    """The state of GLUT for one program: its callbacks, and what is due."""

    def __init__(self) -> None:
        self.callbacks: dict[str, Callable[..., Any] | None] = {}
        self.timers: list[tuple[float, int, Callable[..., Any], Any]] = []
        self._order = itertools.count()
        self.asked_size = (300, 300)
        self.is_posted = self.was_reshaped = False

    def names(self) -> dict[str, Any]:
        """Return all functions and tokens of this module, by the names that programs use."""
        named: dict[str, Any] = {**TOKENS, **{font: font for font in FONTS}, **SHAPES}
        named |= {name: lambda *_: 1 for name in WITHOUT_EFFECT}
        named |= {f"glut{name}Func": self._setter(name) for name in CALLBACKS}
        named |= {"glutSolidTeapot": solid_teapot, "glutWireTeapot": wire_teapot}
        return named | {
            "glutInit": lambda *arguments: list(arguments[-1]) if arguments else [],
            "glutInitWindowSize": self.init_window_size,
            "glutCreateWindow": self.create_window,
            "glutGetWindow": lambda: int(desktop().context is not None),
            "glutCreateMenu": lambda *_: 1,
            "glutTimerFunc": self.set_timer,
            "glutPostRedisplay": self.post_redisplay,
            "glutSwapBuffers": lambda: desktop().end_frame(),
            "glutMainLoop": self.main_loop,
            "glutMainLoopEvent": self.turn,
            "glutLeaveMainLoop": self.leave,
            "glutGet": self.get,
            "glutGetModifiers": lambda: 0,
            "glutExtensionSupported": lambda _: 0,
            "glutBitmapWidth": lambda *_: 8,
            "glutBitmapCharacter": lambda *_: desktop().leave_out("glutBitmapCharacter"),
            "glutBitmapString": lambda *_: desktop().leave_out("glutBitmapString"),
            "glutStrokeWidth": lambda *_: 105,
            "glutStrokeCharacter": lambda *_: desktop().leave_out("glutStrokeCharacter"),
            "glutStrokeString": lambda *_: desktop().leave_out("glutStrokeString"),
        }

    def _setter(self, name: str) -> Callable[..., None]:
        def set_callback(function: Callable[..., Any] | None = None) -> None:
            self.callbacks[name] = function

        return set_callback

    # -- calls ---------------------------------------------------------------------------------------------------------
    def init_window_size(self, width: int, height: int) -> None:
        """Note the size of the window that will be created."""
        self.asked_size = int(width), int(height)

    def create_window(self, *_: Any) -> int:
        """Open the window; a program has one."""
        desktop().open_window(*self.asked_size)
        self.is_posted = True
        return 1

    def set_timer(self, ms: int, function: Callable[[Any], Any], value: Any = 0) -> None:
        """Call a function once, after some milliseconds of the program's clock."""
        heapq.heappush(self.timers, (desktop().clock_ms + max(0, ms), next(self._order), function, value))

    def post_redisplay(self) -> None:
        """Let the window be drawn in the next turn."""
        self.is_posted = True

    def leave(self) -> None:
        """End the program."""
        raise ProgramEnded

    def get(self, token: int) -> int:
        """Return a number about the window or the clock; 0 for what there is not."""
        width, height = desktop().size or self.asked_size
        return {
            TOKENS["GLUT_WINDOW_WIDTH"]: width,
            TOKENS["GLUT_WINDOW_HEIGHT"]: height,
            TOKENS["GLUT_SCREEN_WIDTH"]: 1920,
            TOKENS["GLUT_SCREEN_HEIGHT"]: 1080,
            TOKENS["GLUT_WINDOW_DEPTH_SIZE"]: 24,
            TOKENS["GLUT_WINDOW_STENCIL_SIZE"]: 8,
            TOKENS["GLUT_WINDOW_BUFFER_SIZE"]: 32,
            TOKENS["GLUT_WINDOW_DOUBLEBUFFER"]: 1,
            TOKENS["GLUT_ELAPSED_TIME"]: int(desktop().clock_ms),
        }.get(token, 0)

    # -- the loop ------------------------------------------------------------------------------------------------------
    def main_loop(self) -> None:
        """Do what is due until the program ends."""
        idle_calls, frame = 0, desktop().frame
        while True:
            self.turn()
            idle_calls = idle_calls + 1 if desktop().frame == frame else 0
            frame = desktop().frame
            if idle_calls > MOST_IDLE_CALLS:
                raise ProgramEnded

    def turn(self) -> None:
        """Do what is due."""
        window = desktop()
        if not self.was_reshaped:
            self.was_reshaped = True
            self._reshape()
        if self.is_posted and self.callbacks.get("Display"):
            self.is_posted = False
            self._display()
        elif self.timers and (self.timers[0][0] <= window.clock_ms or not self._has_other_work()):
            due, _, function, value = heapq.heappop(self.timers)
            window.clock_ms = max(window.clock_ms, due)
            function(value)
        elif (event := window.next_event()) is not None:
            self._happen(event)
            self.is_posted = True
        elif self.callbacks.get("Idle"):
            window.clock_ms += FRAME_MS / 10
            self._call("Idle")
        else:
            raise ProgramEnded

    def _has_other_work(self) -> bool:
        return bool(desktop().events or self.callbacks.get("Idle"))

    def _reshape(self) -> None:
        width, height = desktop().size or self.asked_size
        if self.callbacks.get("Reshape"):
            self._call("Reshape", width, height)
        else:
            gl.glViewport(0, 0, width, height)

    def _display(self) -> None:
        window = desktop()
        before = window.frame
        self._call("Display")
        if window.frame == before:  # a program with a single buffer
            window.end_frame()
        if window.events:  # they happen between frames
            self._happen(window.next_event())
            self.is_posted = True

    def _happen(self, event: Key | Click | None) -> None:
        x, y = desktop().pointer
        if isinstance(event, Click):
            for state in (TOKENS["GLUT_DOWN"], TOKENS["GLUT_UP"]):
                self._call("Mouse", TOKENS["GLUT_LEFT_BUTTON"], state, x, y)
        elif event is not None and event.is_special:
            self._call("Special", SPECIAL[event.name], x, y)
            self._call("SpecialUp", SPECIAL[event.name], x, y)
        elif event is not None:
            self._call("Keyboard", event.name.encode(), x, y)
            self._call("KeyboardUp", event.name.encode(), x, y)

    def _call(self, name: str, *arguments: Any) -> None:
        function = self.callbacks.get(name)
        if function is not None:
            function(*arguments)
