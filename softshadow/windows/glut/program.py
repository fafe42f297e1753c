"""What GLUT knows of a program: its windows and menus, and what is due."""

from __future__ import annotations

import heapq
import itertools
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from softshadow.windows.desktop import desktop
from softshadow.windows.glut.menus import Menus
from softshadow.windows.glut.tokens import TOKENS
from softshadow.windows.glut.window import Window


@dataclass
class Program:
    """The state of GLUT, as glutInit leaves it.

    Attributes
    ----------
    window : Window              the current one, or None
    timers : list                a heap of (time in milliseconds, number, function, value)
    modifiers : int              during a callback for input, None otherwise
    destroyed : list             numbers of windows that are destroyed at the end of the turn
    is_left : bool               the main loop ends after the turn
    game_mode : tuple            width, height, bits per pixel and refresh rate, -1 for those that are not given
    """

    windows: dict[int, Window] = field(default_factory=dict)
    window: Window | None = None
    menus: Menus = field(default_factory=Menus)
    idle: Callable[[], Any] | None = None
    menu_state: Callable[..., Any] | None = None
    menu_status: Callable[..., Any] | None = None
    timers: list[tuple[float, int, Callable[..., Any], Any]] = field(default_factory=list)
    modifiers: int | None = None
    destroyed: list[int] = field(default_factory=list)
    is_left: bool = False
    mode: int = TOKENS["GLUT_DEPTH"]
    asked_size: tuple[int, int] = (300, 300)
    asked_position: tuple[int, int] = (-1, -1)
    close_action: int = TOKENS["GLUT_ACTION_EXIT"]
    version: tuple[int, int] = (1, 0)
    game_mode: tuple[int, int, int, int] = (-1, -1, -1, -1)
    game_window: int = 0

    def __post_init__(self) -> None:
        self._order = itertools.count()

    def select(self, window: Window | None) -> None:
        """Make a window the current one."""
        self.window = window
        if window is not None:
            window.make_current()

    def set_timer(self, ms: int, function: Callable[[Any], Any], value: Any = 0) -> None:
        """Call a function once, after some milliseconds of the program's clock."""
        heapq.heappush(self.timers, (desktop().clock_ms + max(0, ms), next(self._order), function, value))
