"""GLFW's window without a screen, as the Python package glfw names it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from softshadow.windows.desktop import desktop
from softshadow.windows.events import SHIFTED, Click, Drag, Key, Wheel

PRESS, RELEASE, REPEAT = 1, 0, 2
SPECIAL = {
    "Right": 262, "Left": 263, "Down": 264, "Up": 265, "PageUp": 266, "PageDown": 267, "Home": 268, "End": 269,
    "Insert": 260, **{f"F{number}": 289 + number for number in range(1, 13)},
}  # fmt: skip
NAMED = {"\x1b": 256, "\r": 257, "\t": 258, "\b": 259}
SPELLED = {  # names of keys in the package
    "ESCAPE": 256, "ENTER": 257, "TAB": 258, "BACKSPACE": 259, "INSERT": 260, "RIGHT": 262, "LEFT": 263, "DOWN": 264,
    "UP": 265, "PAGE_UP": 266, "PAGE_DOWN": 267, "HOME": 268, "END": 269, "SPACE": 32,
    **{f"F{number}": 289 + number for number in range(1, 13)}, **{chr(code): code for code in range(65, 91)},
    **{chr(code): code for code in range(48, 58)},
}  # fmt: skip
BUTTONS = {"left": 0, "right": 1, "middle": 2}
HELD = {"Shift": 1, "Ctrl": 2, "Alt": 4}
UNSHIFTED = {shifted: key for key, shifted in SHIFTED.items()}
CALLBACKS = (
    "key", "char", "mouse_button", "cursor_pos", "scroll", "framebuffer_size", "window_size", "error", "window_close",
    "window_refresh", "cursor_enter", "window_focus",
)  # fmt: skip
WITHOUT_EFFECT = (
    "terminate", "window_hint", "default_window_hints", "swap_interval", "set_input_mode", "destroy_window",
    "set_window_title", "set_window_pos", "show_window", "make_context_current", "set_cursor_pos",
)  # fmt: skip
HINTS = (
    "CONTEXT_VERSION_MAJOR", "CONTEXT_VERSION_MINOR", "OPENGL_PROFILE", "OPENGL_ANY_PROFILE", "OPENGL_COMPAT_PROFILE",
    "OPENGL_CORE_PROFILE", "OPENGL_FORWARD_COMPAT", "RESIZABLE", "VISIBLE", "SAMPLES", "DEPTH_BITS", "STENCIL_BITS",
    "DOUBLEBUFFER", "STICKY_KEYS", "CURSOR", "CURSOR_DISABLED", "CURSOR_NORMAL", "CURSOR_HIDDEN", "FOCUSED",
)  # fmt: skip


class Glfw:
    """The state of GLFW for one program."""

    def __init__(self) -> None:
        self.callbacks: dict[str, Callable[..., Any] | None] = {}
        self.pressed: set[int] = set()
        self.closes = False

    def names(self) -> dict[str, Any]:
        """Return all functions and tokens, by the names that programs use."""
        named: dict[str, Any] = {f"KEY_{name}": code for name, code in SPELLED.items()}
        named |= {hint: 0x20000 + number for number, hint in enumerate(HINTS)}
        named |= {"PRESS": PRESS, "RELEASE": RELEASE, "REPEAT": REPEAT, "TRUE": 1, "FALSE": 0}
        named |= {"MOD_SHIFT": 1, "MOD_CONTROL": 2, "MOD_ALT": 4}
        named |= {"MOUSE_BUTTON_LEFT": 0, "MOUSE_BUTTON_RIGHT": 1, "MOUSE_BUTTON_MIDDLE": 2}
        named |= {name: lambda *_: None for name in WITHOUT_EFFECT}
        named |= {f"set_{name}_callback": self._setter(name) for name in CALLBACKS}
        return named | {
            "init": lambda: 1,
            "create_window": self.create_window,
            "window_should_close": lambda _: self.closes,
            "set_window_should_close": self.close,
            "swap_buffers": lambda _: desktop().end_frame(),
            "poll_events": self.poll_events,
            "wait_events": self.poll_events,
            "wait_events_timeout": lambda _: self.poll_events(),
            "post_empty_event": lambda: None,
            "get_framebuffer_size": lambda _: desktop().size,
            "get_window_size": lambda _: desktop().size,
            "get_cursor_pos": lambda _: tuple(map(float, desktop().pointer)),
            "get_key": lambda _, key: PRESS if key in self.pressed else RELEASE,
            "get_mouse_button": lambda *_: RELEASE,
            "get_time": lambda: desktop().clock_ms / 1000,
            "get_primary_monitor": lambda: None,
            "get_current_context": lambda: 1,
        }

    def _setter(self, name: str) -> Callable[..., None]:
        def set_callback(*arguments: Any) -> None:  # (window, function), or (function) for errors
            self.callbacks[name] = arguments[-1]

        return set_callback

    def create_window(self, width: int, height: int, *_: Any) -> int:
        """Open the window."""
        desktop().open_window(int(width), int(height))
        return 1

    def close(self, _: Any, value: Any) -> None:
        """Note whether the window shall close."""
        self.closes = bool(value)

    def poll_events(self) -> None:
        """Let one event happen, if there is one."""
        self.pressed.clear()
        if desktop().frame == 0:
            return
        event = desktop().next_event()
        if isinstance(event, Key):
            plain = UNSHIFTED.get(event.name, event.name.upper())
            code = SPECIAL.get(event.name) or NAMED.get(event.name) or ord(plain)
            self.pressed.add(code)
            held = sum(HELD[name] for name in event.modifiers)
            for action in (PRESS, RELEASE):
                self._call("key", 1, code, 0, action, held)
            if not event.is_special and not {"Ctrl", "Alt"} & set(event.modifiers):
                self._call("char", 1, ord(event.name))
        elif isinstance(event, Wheel):
            self._call("scroll", 1, 0.0, float(event.direction))
        elif isinstance(event, Click | Drag):
            self._move((event.x, event.y))
            self._call("mouse_button", 1, BUTTONS[event.button], PRESS, 0)
            if isinstance(event, Drag):
                self._move((event.to_x, event.to_y))
            self._call("mouse_button", 1, BUTTONS[event.button], RELEASE, 0)

    def _move(self, place: tuple[int, int]) -> None:
        desktop().pointer = place
        self._call("cursor_pos", 1, float(place[0]), float(place[1]))

    def _call(self, name: str, *arguments: Any) -> None:
        function = self.callbacks.get(name)
        if function is not None:
            function(*arguments)
