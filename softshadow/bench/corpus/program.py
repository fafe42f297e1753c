"""An ordinary program: a function that prepares what it draws, and returns the function that draws one frame.

It uses only the GL namespace that it is given, so it runs unchanged on softshadow and on Mesa. Unlike a workload, it
moves: frame number k of a program is another picture than frame number k + 1.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

VGA = (640, 480)
DrawNumberedFrame = Callable[[int], Any]


@dataclass(frozen=True)
class Program:
    """A named program with its window size.

    Attributes
    ----------
    name, title : str
    prepare : (gl, size) -> function of the number of a frame
    size : (width, height) in pixels
    """

    name: str
    title: str
    prepare: Callable[[Any, tuple[int, int]], DrawNumberedFrame]
    size: tuple[int, int] = VGA

    def resized(self, size: tuple[int, int]) -> Program:
        """Return the program with another window size."""
        return replace(self, size=size)

    def frames(self, gl: Any, count: int) -> None:
        """Draw the first frames, one after the other."""
        frame = self.prepare(gl, self.size)
        for number in range(count):
            frame(number)


def program(prepare: Callable[[Any, tuple[int, int]], DrawNumberedFrame], size: tuple[int, int] = VGA) -> Program:
    """Return the program of a function: its name with dashes, and the first sentence of its docstring.

    Examples
    --------
    >>> def two_quads(gl, size):
    ...     '''Two quads, one behind the other.'''
    >>> program(two_quads).name, program(two_quads).title
    ('two-quads', 'Two quads, one behind the other')
    """
    title = (prepare.__doc__ or "").partition(".")[0]
    return Program(prepare.__name__.replace("_", "-"), title, prepare, size)
