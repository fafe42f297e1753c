"""Frames of a trace on Mesa: its calls are made as they were recorded, with the C arguments that they had.

Contexts and windows follow the same rules as in `softshadow.replay`: windows have the sizes of the viewports, a context
is made when its first call comes, and a window is cleared when its size changes.
"""

from __future__ import annotations

import ctypes
import os
from collections.abc import Iterable
from contextlib import suppress
from functools import partial
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.recordings.draw_calls import is_query, is_shading
from softshadow.recordings.frames import TracedFrame, find_frames
from softshadow.recordings.window_systems import MadeCurrent, NewContext, Shared, ShareGroups, event_of
from softshadow.testing.c_calls import CCalls
from softshadow.testing.mesa import run_on_mesa
from softshadow.testing.result import ProgramResult
from softshadow.traces import Call, Trace

ALL_GROUPS = 0xFFFFFFFF  # of glPushAttrib and glPushClientAttrib
SCALES = (0x0D14, 0x0D18, 0x0D1A, 0x0D1C, 0x0D1E)  # GL_RED_SCALE, of green, blue, alpha and depth
MAPS_AND_INDICES = (0x0D10, 0x0D11, 0x0D12, 0x0D13)  # GL_MAP_COLOR, GL_MAP_STENCIL, GL_INDEX_SHIFT, GL_INDEX_OFFSET
PACK_BUFFER, PACK_BUFFER_BINDING = 0x88EB, 0x88ED  # GL_PIXEL_PACK_BUFFER
WHOLE_WINDOW = gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT | gl.GL_ACCUM_BUFFER_BIT
# GL lets programs choose the names of their objects, so what these calls return does not matter
GENERATORS = ("glGenTextures", "glGenBuffers", "glGenFramebuffers", "glGenRenderbuffers", "glGenQueries", "glGenLists")
NAMES = {f"{name}{suffix}" for name in GENERATORS for suffix in ("", "ARB", "EXT")}
# OSMesa's window has one buffer, which it calls the front buffer
FRONTS = {gl.GL_BACK: gl.GL_FRONT, gl.GL_BACK_LEFT: gl.GL_FRONT_LEFT, gl.GL_BACK_RIGHT: gl.GL_FRONT_RIGHT}
SELECTIONS = ("glDrawBuffer", "glReadBuffer")
MAPS, UNMAPS = ("glMapBuffer", "glMapBufferARB", "glMapBufferRange"), ("glUnmapBuffer", "glUnmapBufferARB")
FILLED = {"glSelectBuffer": (0, 1), "glFeedbackBuffer": (0, 2)}  # the arguments with the size, and with the memory


def trace_on_mesa(path: str | os.PathLike[str], frames: Iterable[int], timeout: float = 60.0) -> list[ProgramResult]:
    """Return the window of a recorded program at the end of some of its frames, drawn by Mesa.

    Queries, and calls of programs in a shading language, are left out.

    Parameters
    ----------
    path : path of a .trace file
    frames : int                 numbers of frames, from 0
    timeout : float              seconds

    Raises
    ------
    SoftShadowError              the file cannot be read
    MesaError                    Mesa is missing, crashed, or took too long
    """
    program = partial(play_on_mesa, os.path.abspath(path), tuple(frames))  # its process has another working folder
    windows: list[ProgramResult] = run_on_mesa(program, (1, 1), raise_errors=False, timeout=timeout).returned
    return windows


def play_on_mesa(path: str, frames: tuple[int, ...], _: Any) -> list[ProgramResult]:
    """Return the windows at the end of some frames, in Mesa's process."""
    player = MesaPlayer(find_frames(Trace(path), max(frames)).frames)
    windows: dict[int, ProgramResult] = {}
    for call in Trace(path):
        player.play(call)
        if call.number == player.frame.last:
            if player.index in frames:
                windows[player.index] = player.window()
            if player.index == max(frames):
                break
            player.next_frame()
    return [windows[frame] for frame in frames]


_kept: list[np.ndarray] = []  # contexts are never destroyed (`mesa_worker`), and write to the memory of their windows


def _window_memory(size: tuple[int, int]) -> np.ndarray:
    _kept.append(np.zeros((size[1], size[0], 4), np.uint8))
    return _kept[-1]


class MesaContext:
    """A context of OSMesa and the memory of its window."""

    def __init__(self, size: tuple[int, int], shared: MesaContext | None) -> None:
        from OpenGL import osmesa

        self._osmesa, self.size = osmesa, size
        self._context: Any = osmesa.OSMesaCreateContextExt(osmesa.OSMESA_RGBA, 24, 8, 16, shared and shared._context)
        self._pixels = _window_memory(size)

    def resize(self, size: tuple[int, int]) -> None:
        """Give the window another size; the context must be made current again."""
        self.size, self._pixels = size, _window_memory(size)

    def make_current(self) -> None:
        """Make the context current."""
        width, height = self.size
        if not self._osmesa.OSMesaMakeCurrent(self._context, self._pixels, gl.GL_UNSIGNED_BYTE, width, height):
            raise RuntimeError(f"OSMesa cannot make a window of {width} x {height} pixels current")


class MesaPlayer:
    """Makes the calls of a trace on contexts of OSMesa.

    Parameters
    ----------
    frames : list of TracedFrame from the first one on
    """

    def __init__(self, frames: list[TracedFrame]) -> None:
        self._frames, self.index = frames, 0
        self._groups = ShareGroups()
        self._contexts: dict[int, MesaContext] = {}
        self._current: dict[int, int] = {}  # by thread
        self._active: MesaContext | None = None
        self._calls = CCalls()
        self._memory: list[Any] = []  # that GL may still read, or fill
        self._mapped: dict[int, tuple[int, int]] = {}  # target: where the recorded program and Mesa have mapped it

    @property
    def frame(self) -> TracedFrame:
        """The frame that is being drawn."""
        return self._frames[self.index]

    def play(self, call: Call) -> None:
        """Make a call, if it is one that draws or changes state."""
        name, event = call.name, event_of(call)
        if isinstance(event, NewContext | Shared):
            self._groups.note(event)
        elif isinstance(event, MadeCurrent):
            self._current[call.thread] = event.context
        elif name == "memcpy":
            self._copy(call)
        elif event is None and name.startswith("gl") and not name.startswith("glX"):
            self._activate(self._current.get(call.thread, 0))
            if not (name in NAMES or is_query(name) or is_shading(name)):
                with suppress(LookupError, TypeError):  # what a replay here lists as left out
                    self._make(call)

    def next_frame(self) -> None:
        """Begin the next frame: windows get the sizes that it needs."""
        self.index += 1
        for address, size in self.frame.sizes.items():
            context = self._contexts.get(address)
            if context is not None and context.size != size:
                context.resize(size)
                self._switch(context)
                self._clear()

    def window(self) -> ProgramResult:
        """Return the window of the context that draws the present frame."""
        self._activate(self.frame.context)
        assert self._active is not None
        gl_calls, (width, height) = self._calls, self._active.size
        read, packed = (self._integer(name) for name in (gl.GL_READ_FRAMEBUFFER_BINDING, PACK_BUFFER_BINDING))
        gl_calls.glPushClientAttrib(ALL_GROUPS)
        gl_calls.glPushAttrib(ALL_GROUPS)
        gl_calls.glBindFramebufferEXT(gl.GL_READ_FRAMEBUFFER, 0)
        gl_calls.glBindBuffer(PACK_BUFFER, 0)
        self._reset_transfer()
        color = np.zeros((height, width, 4), np.uint8)
        depths = np.zeros((height, width), np.uint32)
        for format, type, out in (
            (gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, color),
            (gl.GL_DEPTH_STENCIL, gl.GL_UNSIGNED_INT_24_8, depths),
        ):
            gl_calls.glReadPixels(0, 0, width, height, format, type, out.ctypes.data)
        gl_calls.glPopAttrib()
        gl_calls.glPopClientAttrib()
        gl_calls.glBindFramebufferEXT(gl.GL_READ_FRAMEBUFFER, read)
        gl_calls.glBindBuffer(PACK_BUFFER, packed)
        return ProgramResult(color, depths >> np.uint32(8), (depths & np.uint32(255)).astype(np.uint8))

    # -- contexts ------------------------------------------------------------------------------------------------------
    def _activate(self, address: int) -> None:
        context = self._contexts.get(address)
        if context is None:
            partner = self._groups.partner(address, self._contexts)
            shared = None if partner is None else self._contexts[partner]
            context = self._contexts[address] = MesaContext(self._size_of(address), shared)
            self._switch(context)
            self._clear()
        elif context is not self._active:
            self._switch(context)

    def _switch(self, context: MesaContext) -> None:
        if self._active is not None:
            self._calls.glFinish()
        context.make_current()
        self._active = context

    def _size_of(self, address: int) -> tuple[int, int]:
        sizes = (frame.sizes[address] for frame in self._frames[self.index :] if address in frame.sizes)
        return next(sizes, (1, 1))

    def _clear(self) -> None:
        """Clear the window to colour 0, depth 1 and stencil 0, under any state."""
        calls, drawn = self._calls, self._integer(gl.GL_DRAW_FRAMEBUFFER_BINDING)
        calls.glBindFramebufferEXT(gl.GL_DRAW_FRAMEBUFFER, 0)
        calls.glPushAttrib(ALL_GROUPS)
        calls.glDisable(gl.GL_SCISSOR_TEST)
        calls.glDrawBuffer(gl.GL_FRONT)
        calls.glColorMask(1, 1, 1, 1)
        calls.glDepthMask(1)
        calls.glStencilMask(0xFF)
        calls.glClearColor(0, 0, 0, 0)
        calls.glClearDepth(1)
        calls.glClearStencil(0)
        calls.glClearAccum(0, 0, 0, 0)
        calls.glClear(WHOLE_WINDOW)
        calls.glPopAttrib()
        calls.glBindFramebufferEXT(gl.GL_DRAW_FRAMEBUFFER, drawn)

    def _integer(self, name: int) -> int:
        value = ctypes.c_int(0)
        self._calls.glGetIntegerv(name, ctypes.addressof(value))
        return value.value

    def _reset_transfer(self) -> None:
        """Let glReadPixels return pixels as they are."""
        calls = self._calls
        calls.glReadBuffer(gl.GL_FRONT)
        for name in (gl.GL_PACK_ROW_LENGTH, gl.GL_PACK_SKIP_ROWS, gl.GL_PACK_SKIP_PIXELS, gl.GL_PACK_SWAP_BYTES):
            calls.glPixelStorei(name, 0)
        calls.glPixelStorei(gl.GL_PACK_ALIGNMENT, 1)
        for scale in SCALES:
            calls.glPixelTransferf(scale, 1)
            calls.glPixelTransferf(scale + 1, 0)  # the bias of the same value
        for name in MAPS_AND_INDICES:
            calls.glPixelTransferi(name, 0)

    # -- calls ---------------------------------------------------------------------------------------------------------
    def _make(self, call: Call) -> None:
        name, arguments = call.name, list(call.arguments)
        if name in SELECTIONS and self._integer(gl.GL_FRAMEBUFFER_BINDING) == 0:
            arguments = [FRONTS.get(arguments[0], arguments[0])]
        if name in FILLED:
            size, memory = FILLED[name]
            arguments[memory] = bytes(4 * max(0, arguments[size]))
        result, given = self._calls.call(name, arguments)
        if any(isinstance(value, ctypes.Array) for value in given) and ("Pointer" in name or name in FILLED):
            self._memory.append(given)
        if name in MAPS and isinstance(call.result, int) and result:
            # a buffer that was deleted while it was mapped may have left another one at this address
            self._mapped = {target: known for target, known in self._mapped.items() if known[0] != call.result}
            self._mapped[call.arguments[0]] = call.result, result
        elif name in UNMAPS:
            self._mapped.pop(call.arguments[0], None)

    def _copy(self, call: Call) -> None:
        """Write to mapped memory what the recorded program has written there."""
        address, content, _ = call.arguments
        below = [(theirs, ours) for theirs, ours in self._mapped.values() if theirs <= address]
        if below:
            theirs, ours = max(below)
            ctypes.memmove(ours + address - theirs, content, len(content))
