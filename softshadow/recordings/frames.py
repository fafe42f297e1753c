"""The frames of a trace: where each begins and ends, how much it draws, and how large its window is.

A trace does not say how large windows are. As apitrace does, their size is taken from the viewports: that of a frame is
the smallest that holds all viewports in which the frame draws.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from softshadow.errors import TraceError
from softshadow.framebuffer import LARGEST_SIDE
from softshadow.recordings.draw_calls import is_draw
from softshadow.recordings.window_systems import MadeCurrent, Swapped, event_of
from softshadow.traces import Call

BIND_FRAMEBUFFER = ("glBindFramebuffer", "glBindFramebufferEXT")
DRAWN_TO = (0x8D40, 0x8CA9)  # GL_FRAMEBUFFER, GL_DRAW_FRAMEBUFFER
FLUSHES = ("glFlush", "glFinish")  # they end the frames of programs with a single buffer
COMPILE = 0x1300  # GL_COMPILE: the list is not carried out


@dataclass
class TracedFrame:
    """A frame of a trace.

    Attributes
    ----------
    first, last : int            numbers of its calls; the last one ends it
    draws : int                  calls that draw, each list as one
    context : int                the address of the context that is current at its end
    sizes : dict                 (width, height) of the window of each context that draws in it
    is_complete : bool           whether a call ended it; else the program ended first
    """

    first: int
    last: int
    draws: int = 0
    context: int = 0
    sizes: dict[int, tuple[int, int]] = field(default_factory=dict)
    is_complete: bool = True


@dataclass
class Frames:
    """The frames of a trace, up to the one that was asked for; `damage` says where the file could not be read on."""

    frames: list[TracedFrame]
    contexts: dict[int, int]  # address: calls
    damage: TraceError | None = None


@dataclass
class Viewports:
    """The viewports of a context: the present one, and how large a window those need that draws used in this frame."""

    present: tuple[int, int] = (0, 0)  # its upper right corner
    used: tuple[int, int] = (0, 0)
    framebuffer: int = 0
    compiles_list: bool = False

    def draw(self) -> None:
        """Count the present viewport, if it is the window's."""
        if self.framebuffer == 0:
            self.used = max(self.used[0], self.present[0]), max(self.used[1], self.present[1])

    def bind(self, call: Call) -> None:
        """Note which framebuffer is drawn to."""
        target, framebuffer = (*call.arguments, 0, 0)[:2]
        if target in DRAWN_TO and isinstance(framebuffer, int):
            self.framebuffer = framebuffer

    def set(self, call: Call) -> None:
        """Note a viewport."""
        numbers = [number for number in call.arguments if isinstance(number, int)]
        if len(numbers) == 4 and self.framebuffer == 0:
            corner = numbers[0] + numbers[2], numbers[1] + numbers[3]
            if all(1 <= side <= LARGEST_SIDE for side in corner):
                self.present = corner


def find_frames(calls: Iterable[Call], frame: int | None = None, until: int | None = None) -> Frames:
    """Return the frames of a trace, all, or up to the one with a number or a call."""
    search = _Search()
    try:
        for call in calls:
            search.read(call)
            if until is not None:
                if search.swaps and search.swaps[-1].last >= until:
                    break
            elif frame is not None and 0 <= frame < len(search.swaps):
                break
        else:
            search.end()
    except TraceError as error:
        search.end(is_complete=False)
        return Frames(search.frames, search.contexts, error)
    return Frames(search.frames, search.contexts)


class _Search:
    def __init__(self) -> None:
        self.swaps: list[TracedFrame] = []
        self.flushes: list[TracedFrame] = []
        self.contexts: dict[int, int] = {}
        self._current: dict[int, int] = {}  # by thread
        self._last_context = 0
        self._viewports: dict[int, Viewports] = {}
        self._sizes: dict[int, tuple[int, int]] = {}
        self._begin(0)

    @property
    def frames(self) -> list[TracedFrame]:
        """Those that swaps end; without any swap, those that glFlush and glFinish end."""
        return self.swaps or self.flushes

    def _begin(self, first: int) -> None:
        self._frame = TracedFrame(first, first)
        for viewports in self._viewports.values():
            viewports.used = (0, 0)

    def read(self, call: Call) -> None:
        """Note what a call means for the frames."""
        name, frame = call.name, self._frame
        frame.last = max(frame.last, call.number)
        event = event_of(call)
        if isinstance(event, MadeCurrent):
            self._current[call.thread] = event.context
        context = self._current.get(call.thread, 0)
        if event is not None:
            if isinstance(event, Swapped):
                self._end_frame(self.swaps, call, context)
                self._join_flushes()
            return
        if not name.startswith("gl") or name.startswith("glX"):
            return
        self.contexts[context] = self.contexts.get(context, 0) + 1
        viewports = self._viewports.get(context)
        if viewports is None:
            viewports = self._viewports[context] = Viewports()
        self._last_context = context
        if name == "glViewport":
            viewports.set(call)
        elif is_draw(name):
            if not viewports.compiles_list:
                frame.draws += 1
                viewports.draw()
        elif name == "glNewList":
            viewports.compiles_list = call.arguments[1:2] == [COMPILE]
        elif name == "glEndList":
            viewports.compiles_list = False
        elif name in BIND_FRAMEBUFFER:
            viewports.bind(call)
        elif name in FLUSHES and frame.draws and not self.swaps:
            self._end_frame(self.flushes, call, context)

    def _end_frame(self, frames: list[TracedFrame], call: Call, context: int) -> None:
        self._frame.context = context
        for address, viewports in self._viewports.items():
            size = viewports.used if all(viewports.used) else self._sizes.get(address, viewports.present)
            if all(size):
                self._sizes[address] = self._frame.sizes[address] = size
        frames.append(self._frame)
        self._begin(call.number + 1)

    def _join_flushes(self) -> None:
        """Make what glFlush seemed to end a part of the first frame, since the program does swap."""
        frame = self.swaps[0]
        for part in self.flushes:
            frame.first = min(frame.first, part.first)
            frame.draws += part.draws
            for address, (width, height) in part.sizes.items():
                used = frame.sizes.get(address, (0, 0))
                frame.sizes[address] = self._sizes[address] = max(width, used[0]), max(height, used[1])
        self.flushes.clear()

    def end(self, is_complete: bool = True) -> None:
        """End the last frame, if it draws anything: the program, or the file, ended before its swap."""
        if self._frame.draws or not self.frames:
            self._frame.is_complete = is_complete
            self._end_frame(self.frames, Call(self._frame.last, "", []), self._last_context)
