"""One window of a GLUT program: its context, size, callbacks and menus."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from softshadow import gl
from softshadow.context import Context, make_current
from softshadow.windows.desktop import desktop
from softshadow.windows.glut.tokens import TOKENS

SCREEN = 1920, 1080


@dataclass
class Window:
    """A window.

    Attributes
    ----------
    number : int                 from 1; `desktop().shown` is the one that is shown
    size : (width, height)
    mode : int                   what glutInitDisplayMode has asked for
    position : (x, y)            as the program asks
    parent : int                 number of the window in which it lies, or 0
    context : Context
    callbacks : dict             by name, such as "Display"
    menus : dict                 numbers of the attached menus, by button
    due_size : (width, height)   at the next turn of the main loop; None keeps the size
    size_before : (width, height)  while it fills the screen
    """

    number: int
    size: tuple[int, int]
    mode: int
    position: tuple[int, int]
    parent: int
    context: Context
    callbacks: dict[str, Callable[..., Any] | None] = field(default_factory=dict)
    menus: dict[int, int] = field(default_factory=dict)
    due_size: tuple[int, int] | None = None
    size_before: tuple[int, int] | None = None
    is_new: bool = True
    is_posted: bool = True
    is_visible: bool = True
    is_entered: bool = False  # by the pointer
    cursor: int = TOKENS["GLUT_CURSOR_INHERIT"]
    data: Any = None

    @property
    def is_shown(self) -> bool:
        """Whether its frames are those of the program."""
        return self.number == desktop().shown

    def make_current(self) -> None:
        """Let GL calls draw here."""
        make_current(self.context)

    def resize(self, size: tuple[int, int]) -> bool:
        """Give it another size; return whether it has changed, which it has not if the user chose one."""
        if self.is_shown:
            if not desktop().resize(*size):
                return False
        elif size == self.size:
            return False
        else:
            self.context.resize(*size)
        self.size = size
        return True

    def call(self, name: str, *arguments: Any) -> bool:
        """Call a callback with the window as current one; return whether there is one."""
        function = self.callbacks.get(name)
        if function is not None:
            function(*arguments)
        return function is not None

    def tell_what_the_mode_lacks(self) -> None:
        """Note which tests and factors a program uses though it has not asked for their buffers."""
        if self.context.primitive is not None:
            return
        for buffer, test in (("DEPTH", gl.GL_DEPTH_TEST), ("STENCIL", gl.GL_STENCIL_TEST)):
            if not self.mode & TOKENS[f"GLUT_{buffer}"] and gl.glIsEnabled(test):
                desktop().tell(
                    f"GL_{buffer}_TEST is enabled, but glutInitDisplayMode does not ask for GLUT_{buffer}: here the "
                    f"window has a {buffer.lower()} buffer, on many systems it has none, and all fragments pass"
                )
        factors = {int(gl.glGetIntegerv(pname)) for pname in (gl.GL_BLEND_SRC, gl.GL_BLEND_DST)}
        uses_alpha = factors & {gl.GL_DST_ALPHA, gl.GL_ONE_MINUS_DST_ALPHA}
        if uses_alpha and gl.glIsEnabled(gl.GL_BLEND) and not self.mode & TOKENS["GLUT_ALPHA"]:
            desktop().tell(
                "glBlendFunc has a factor of GL_DST_ALPHA, but glutInitDisplayMode does not ask for GLUT_ALPHA: here "
                "the window stores alpha, on many systems it is always 1"
            )
