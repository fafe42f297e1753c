"""A display list: the calls between glNewList and glEndList."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from softshadow import tokens as gl


@dataclass
class DisplayList:
    """The calls between glNewList and glEndList, in order; `mode` is GL_COMPILE or GL_COMPILE_AND_EXECUTE.

    `character` is a `softshadow.gl.list_characters.Character` if it is like one, else None.
    """

    name: int
    mode: int
    calls: list[Callable[[], Any]] = field(default_factory=list)
    character: Any = None

    @property
    def executes(self) -> bool:
        """Whether the calls are also carried out while the list is compiled."""
        return self.mode == gl.GL_COMPILE_AND_EXECUTE
