"""GLUT without a screen: the functions and tokens that programs import from OpenGL.GLUT."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial
from typing import Any

from softshadow import gl
from softshadow.context import thread
from softshadow.windows.desktop import ProgramEnded, desktop
from softshadow.windows.glut import fonts, queries
from softshadow.windows.glut.loop import Loop
from softshadow.windows.glut.program import Program
from softshadow.windows.glut.shapes import shape_calls
from softshadow.windows.glut.tokens import TOKENS
from softshadow.windows.glut.user_input import move_pointer
from softshadow.windows.glut.window import SCREEN, Window

CALLBACKS = (
    "Display", "Reshape", "Keyboard", "KeyboardUp", "Special", "SpecialUp", "Mouse", "Motion", "PassiveMotion",
    "Visibility", "Entry", "MouseWheel", "Close", "WindowStatus",
    # of devices that are not there, of overlays, and of a window manager that closes windows: nothing calls them
    "WMClose", "OverlayDisplay", "Joystick", "SpaceballMotion", "SpaceballRotate", "SpaceballButton", "ButtonBox",
    "Dials", "TabletMotion", "TabletButton", "MenuDestroy",
)  # fmt: skip
# calls that change neither a pixel nor what is called: titles, places on the screen, the look of the pointer, keys that
# are held down, errors (which are raised at once), devices that are not there
WITHOUT_EFFECT = (
    "glutSetWindowTitle", "glutSetIconTitle", "glutPopWindow", "glutPushWindow", "glutIgnoreKeyRepeat",
    "glutSetKeyRepeat", "glutReportErrors", "glutForceJoystickFunc", "glutCheckLoop", "glutPostOverlayRedisplay",
    "glutPostWindowOverlayRedisplay",
)  # fmt: skip
MODE_WORDS = {
    "double": "DOUBLE", "single": "SINGLE", "depth": "DEPTH", "stencil": "STENCIL", "alpha": "ALPHA", "acc": "ACCUM",
    "acca": "ACCUM", "samples": "MULTISAMPLE", "index": "INDEX", "stereo": "STEREO",
}  # fmt: skip
NOT_HERE = {
    "MULTISAMPLE": "edges are not smoothed here", "STEREO": "there is one picture here",
    "INDEX": "colours are RGBA here", "SRGB": "colours are written as they are here",
}  # fmt: skip


class Glut:
    """GLUT for one program."""

    def __init__(self) -> None:
        self.program = Program()
        self.loop = Loop(self.program)
        self._last_window = 0

    def names(self) -> dict[str, Any]:
        """Return all functions and tokens of this module, by the names that programs use."""
        program = self.program
        named: dict[str, Any] = {**TOKENS, **fonts.FONTS, **fonts.CALLS, **shape_calls(), **program.menus.calls()}
        named |= {name: lambda *_: None for name in WITHOUT_EFFECT}
        named |= {f"glut{name}Func": partial(self.set_callback, name) for name in CALLBACKS}
        return named | {
            "glutInit": lambda *arguments: list(arguments[-1]) if arguments else [],
            "glutInitWindowSize": lambda width, height: self.set_option("asked_size", (int(width), int(height))),
            "glutInitWindowPosition": lambda x, y: self.set_option("asked_position", (int(x), int(y))),
            "glutInitDisplayMode": self.init_display_mode,
            "glutInitDisplayString": self.init_display_string,
            "glutInitContextVersion": self.init_context_version,
            "glutInitContextFlags": lambda *_: None,
            "glutInitContextProfile": self.init_context_profile,
            "glutSetOption": self.set_glut_option,
            "glutCreateWindow": self.create_window,
            "glutCreateSubWindow": self.create_subwindow,
            "glutDestroyWindow": self.destroy_window,
            "glutSetWindow": self.set_window,
            "glutGetWindow": lambda: program.window.number if program.window else 0,
            "glutSetWindowData": lambda data: self._set("data", data),
            "glutGetWindowData": lambda: program.window.data if program.window else None,
            "glutSetCursor": lambda cursor: self._set("cursor", int(cursor)),
            "glutReshapeWindow": lambda width, height: self._set("due_size", (int(width), int(height))),
            "glutPositionWindow": lambda x, y: self._set("position", (int(x), int(y))),
            "glutFullScreen": partial(self.fill_screen, True),
            "glutLeaveFullScreen": partial(self.fill_screen, False),
            "glutFullScreenToggle": self.fill_screen,
            "glutShowWindow": self.show_window,
            "glutHideWindow": lambda: self._set("is_visible", False),
            "glutIconifyWindow": lambda: self._set("is_visible", False),
            "glutGameModeString": self.set_game_mode,
            "glutEnterGameMode": self.enter_game_mode,
            "glutLeaveGameMode": lambda: self.destroy_window(program.game_window),
            "glutGameModeGet": partial(queries.game_mode_get, program),
            "glutAttachMenu": self.attach_menu,
            "glutDetachMenu": self.detach_menu,
            "glutMenuStateFunc": lambda function=None: self.set_option("menu_state", function),
            "glutMenuStatusFunc": lambda function=None: self.set_option("menu_status", function),
            "glutIdleFunc": lambda function=None: self.set_option("idle", function),
            "glutTimerFunc": program.set_timer,
            "glutPostRedisplay": lambda: self.post_redisplay(self._current("glutPostRedisplay").number),
            "glutPostWindowRedisplay": self.post_redisplay,
            "glutSwapBuffers": self.swap_buffers,
            "glutMainLoop": self.loop.run,
            "glutMainLoopEvent": self.loop.run_once,
            "glutLeaveMainLoop": lambda: self.set_option("is_left", True),
            "glutWarpPointer": self.warp_pointer,
            "glutGetModifiers": self.modifiers,
            "glutGet": partial(queries.get, program),
            "glutDeviceGet": queries.device_get,
            "glutLayerGet": queries.layer_get,
            "glutExtensionSupported": queries.extension_supported,
        }

    def set_option(self, name: str, value: Any) -> None:
        """Set a value of the program."""
        setattr(self.program, name, value)

    def _set(self, name: str, value: Any) -> None:
        """Set a value of the current window."""
        if self.program.window is not None:
            setattr(self.program.window, name, value)

    def _current(self, call: str) -> Window:
        """Return the current window; without one, end the program, as freeglut does."""
        if self.program.window is None:
            desktop().tell(f"{call} is called without a current window, which ends the program")
            raise ProgramEnded
        return self.program.window

    def set_callback(self, name: str, function: Callable[..., Any] | None = None, *_: Any) -> None:
        """Set a callback of the current window."""
        if self.program.window is None:
            desktop().tell(f"glut{name}Func does nothing before glutCreateWindow")
        else:
            self.program.window.callbacks[name] = function

    # -- what windows shall be like ------------------------------------------------------------------------------------
    def init_display_mode(self, mode: int) -> None:
        """Note which buffers a window shall have; say which of them are not here."""
        self.program.mode = int(mode)
        for name, instead in NOT_HERE.items():
            if self.program.mode & TOKENS[f"GLUT_{name}"]:
                desktop().tell(f"glutInitDisplayMode asks for GLUT_{name}: {instead}")

    def init_display_string(self, text: str | bytes) -> None:
        """Note which buffers a window shall have, from words like "rgb double depth>=16"."""
        words = (text.decode() if isinstance(text, bytes) else text).replace(",", " ").split()
        names = [MODE_WORDS.get(re.split("[~!=<>]", word)[0]) for word in words]
        modes = {TOKENS[f"GLUT_{name}"] for name in names if name is not None}
        self.init_display_mode(sum(modes))

    def init_context_version(self, major: int, minor: int) -> None:
        """Note the version of OpenGL; say that it is 2.1 here."""
        self.program.version = int(major), int(minor)
        if self.program.version > (2, 1):
            desktop().tell(f"glutInitContextVersion asks for OpenGL {major}.{minor}: the context is one of OpenGL 2.1")

    def init_context_profile(self, profile: int) -> None:
        """Say that there is no core profile."""
        if int(profile) & TOKENS["GLUT_CORE_PROFILE"]:
            desktop().tell("glutInitContextProfile asks for the core profile: all of OpenGL 2.1 is there")

    def set_glut_option(self, what: int, value: int) -> None:
        """Set one of freeglut's options."""
        program, value = self.program, int(value)
        (x, y), (width, height) = program.asked_position, program.asked_size
        options = {
            "GLUT_INIT_WINDOW_X": ("asked_position", (value, y)),
            "GLUT_INIT_WINDOW_Y": ("asked_position", (x, value)),
            "GLUT_INIT_WINDOW_WIDTH": ("asked_size", (value, height)),
            "GLUT_INIT_WINDOW_HEIGHT": ("asked_size", (width, value)),
            "GLUT_INIT_DISPLAY_MODE": ("mode", value),
            "GLUT_ACTION_ON_WINDOW_CLOSE": ("close_action", value),
        }
        for name, (attribute, new) in options.items():
            if int(what) == TOKENS[name]:
                setattr(program, attribute, new)
                return
        desktop().tell(f"glutSetOption({what}, {value}) has no effect here")

    # -- windows -------------------------------------------------------------------------------------------------------
    def create_window(self, *_: Any) -> int:
        """Open a window and make it the current one; return its number."""
        return self._open(self.program.asked_size, self.program.asked_position, 0)

    def create_subwindow(self, parent: int, x: int, y: int, width: int, height: int) -> int:
        """Open a window within another one; return its number, or 0 if there is no such window."""
        above = self.program.windows.get(parent)
        if above is None:
            return 0
        whole = (0, 0) if above.is_new else above.size  # freeglut does not know sizes before the main loop
        x, width = _placed(x, width, whole[0])
        y, height = _placed(y, height, whole[1])
        return self._open((width, height), (x, y), parent)

    def _open(self, size: tuple[int, int], position: tuple[int, int], parent: int) -> int:
        program, size = self.program, (max(1, size[0]), max(1, size[1]))
        self._last_window += 1
        number = self._last_window
        desktop().has_menus = True
        if number == desktop().shown:
            context = desktop().open_window(*size)
            size = desktop().size or size
        else:
            context = gl.create_context(*size)
            desktop().tell(f"the program opens window {number}, too: --window {number} shows it")
        window = Window(number, size, program.mode, position, parent, context)
        program.windows[number] = window
        program.select(window)
        return number

    def set_window(self, number: int) -> None:
        """Make a window the current one."""
        if number in self.program.windows:
            self.program.select(self.program.windows[number])
        else:
            desktop().tell(f"glutSetWindow({number}) does nothing: there is no such window")

    def destroy_window(self, number: int) -> None:
        """Destroy a window at the end of the turn; from now on it has no callbacks, and there is no current window."""
        window = self.program.windows.get(number)
        if window is not None:
            window.callbacks = {name: each for name, each in window.callbacks.items() if name == "Close"}
            self.program.destroyed.append(number)
            self.program.select(None)

    def show_window(self) -> None:
        """Let the current window be seen, and be drawn in the next turn."""
        self._set("is_visible", True)
        self._set("is_posted", True)

    def fill_screen(self, fills: bool | None = None) -> None:
        """Let the current window fill the screen, or have its size from before; None changes which."""
        window = self.program.window
        if window is None or window.parent or fills == (window.size_before is not None):
            return
        if window.size_before is None:
            window.size_before, window.due_size = window.size, SCREEN
        else:
            window.size_before, window.due_size = None, window.size_before

    def post_redisplay(self, number: int) -> None:
        """Let a window be drawn in the next turn."""
        if number in self.program.windows:
            self.program.windows[number].is_posted = True

    def swap_buffers(self) -> None:
        """End the frame, if the current window is the one that is shown."""
        window = self._current("glutSwapBuffers")
        if window.is_shown:
            window.tell_what_the_mode_lacks()
            desktop().end_frame()
        elif thread.context is not None:
            thread.context.finish()

    # -- game mode -----------------------------------------------------------------------------------------------------
    def set_game_mode(self, text: str | bytes) -> None:
        """Note the screen's size, bits per pixel and refresh rate, from a text like "800x600:32@60"."""
        spelled = text.decode() if isinstance(text, bytes) else text
        found = re.match(r"(?:(\d+)x(\d+))?(?::(\d+))?(?:@(\d+))?", spelled)
        parts = found.groups("-1") if found else ("-1",) * 4
        self.program.game_mode = int(parts[0]), int(parts[1]), int(parts[2]), int(parts[3])

    def enter_game_mode(self) -> int:
        """Open a window that fills the screen; return its number."""
        program = self.program
        width, height = program.game_mode[:2]
        program.game_window = self._open((width, height) if width > 0 and height > 0 else SCREEN, (0, 0), 0)
        return program.game_window

    # -- menus, pointer and keys ---------------------------------------------------------------------------------------
    def attach_menu(self, button: int) -> None:
        """Open the current menu by a button in the current window."""
        if self.program.window is not None and self.program.menus.current:
            self.program.window.menus[int(button)] = self.program.menus.current

    def detach_menu(self, button: int) -> None:
        """Take the menu off a button in the current window."""
        if self.program.window is not None:
            self.program.window.menus.pop(int(button), None)

    def warp_pointer(self, x: int, y: int) -> None:
        """Move the pointer; the program is told in the next turn."""
        window = self.program.window
        if window is not None and desktop().pointer != (x, y):
            self.program.set_timer(0, lambda _: self._moved(window, (int(x), int(y))))

    def _moved(self, window: Window, place: tuple[int, int]) -> None:
        self.program.select(window)
        move_pointer(self.program, window, place)

    def modifiers(self) -> int:
        """Return which of Shift, Ctrl and Alt are held during a callback for input."""
        if self.program.modifiers is None:
            desktop().tell("glutGetModifiers is called outside of a callback for keys or the mouse: it returns 0 there")
            return 0
        return self.program.modifiers


def _placed(start: int, length: int, whole: int) -> tuple[int, int]:
    """Return start and length of a window within another one: negative numbers count from the far side."""
    if start < 0:
        start += whole - max(length, 0)
    if length < 0:
        length += whole - start
    return (start + length, -length) if length < 0 else (start, length)
