"""Search for the first GL call after which the pixels of two programs differ."""

import hashlib
import sys
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from softshadow.errors import nearest
from softshadow.testing.comparison import BufferDifference, GLProgram, differences, run_here
from softshadow.testing.mesa import run_on_mesa
from softshadow.testing.result import ProgramResult, read_result

SIDES = ("softshadow", "mesa")
# prefixes of all calls that can change a pixel of the window
DRAWING = ("glEnd", "glDraw", "glClear", "glRect", "glCopyPixels", "glBlitFramebuffer", "glAccum", "glCallList")
NOT_DRAWING = ("glDrawBuffer", "glDrawBuffers", "glClearColor", "glClearDepth", "glClearStencil", "glClearAccum")


@dataclass(frozen=True)
class TracedCall:
    """A call that changed the window: its number among all GL calls, text, line in the program, hash of the pixels."""

    number: int
    text: str
    line: str
    digest: str

    def __str__(self) -> str:
        return f"call {self.number}, {self.line}: {self.text}"


@dataclass(frozen=True, eq=False)
class Divergence:
    """The first calls of two programs after which their pixels differ; None for a program that has ended before."""

    a: TracedCall | None
    b: TracedCall | None
    differences: tuple[BufferDifference, ...]

    def __str__(self) -> str:
        lines = [f"{name}: {call or 'draws nothing more'}" for name, call in (("a", self.a), ("b", self.b))]
        return "\n".join(lines + [str(each) for each in self.differences])


class TracedProgram:
    """A program that runs another program and returns its traced calls, or the buffers after one of them.

    Parameters
    ----------
    program : callable           the program to run
    size : (width, height) of the window
    stop_at : int or None        stop after the traced call with this index and return the buffers
    """

    def __init__(self, program: GLProgram, size: tuple[int, int], stop_at: int | None = None) -> None:
        self.__wrapped__ = program  # the attribute that functools.wraps sets
        self.size = size
        self.stop_at = stop_at

    def __call__(self, gl: Any) -> Any:
        """Call the program with a traced `gl`."""
        window = TracedGL(gl, self.size, self.stop_at)
        try:
            self.__wrapped__(window)
        except StopReached as reached:
            return reached.buffers
        return window.calls if self.stop_at is None else window.buffers()


class StopReached(BaseException):  # not an Exception, so that a program does not catch it
    """The traced call to stop at has been made."""

    def __init__(self, buffers: ProgramResult) -> None:
        self.buffers = buffers


class TracedGL:
    """A GL namespace that reads the window after each call that can change it."""

    def __init__(self, gl: Any, size: tuple[int, int], stop_at: int | None) -> None:
        self._gl = gl
        self._size = size
        self._stop_at = stop_at
        self._number = 0
        self._digest = digest(self.buffers())
        self.calls: list[TracedCall] = []

    def __getattr__(self, name: str) -> Any:
        value = getattr(self._gl, name)
        if not callable(value) or not name.startswith(("gl", "glu")) or isinstance(value, type):
            return value
        return self._traced(name, value)

    def _traced(self, name: str, function: Callable[..., Any]) -> Callable[..., Any]:
        draws = name.startswith(DRAWING) and name not in NOT_DRAWING

        def call(*arguments: Any) -> Any:
            self._number += 1
            result = function(*arguments)
            if draws:
                self._record_change(name, arguments)
            return result

        return call

    def _record_change(self, name: str, arguments: tuple[Any, ...]) -> None:
        buffers = self.buffers()
        pixels = digest(buffers)
        if pixels == self._digest:
            return
        self._digest = pixels
        frame = sys._getframe(2)  # the program's stack frame, below `call`
        line = f"{frame.f_code.co_name} line {frame.f_lineno}"
        texts = ", ".join(f"{argument!r:.40}" for argument in arguments)
        self.calls.append(TracedCall(self._number, f"{name}({texts})", line, pixels))
        if self._stop_at == len(self.calls) - 1:
            raise StopReached(buffers)

    def buffers(self) -> ProgramResult:
        """Return the current buffers of the window; the bindings of framebuffers do not change."""
        gl = self._gl
        bound = {
            target: gl.glGetIntegerv(binding)
            for target, binding in (
                (gl.GL_DRAW_FRAMEBUFFER, gl.GL_DRAW_FRAMEBUFFER_BINDING),
                (gl.GL_READ_FRAMEBUFFER, gl.GL_READ_FRAMEBUFFER_BINDING),
            )
        }
        result = read_result(gl, self._size, None)
        for target, name in bound.items():
            gl.glBindFramebuffer(target, int(name))
        return result


def digest(buffers: ProgramResult) -> str:
    """Return a hash of the contents of the buffers."""
    content = hashlib.blake2b(digest_size=16)
    for buffer in (buffers.color, buffers.depth, buffers.stencil):
        content.update(buffer.tobytes())
    return content.hexdigest()


def diff_programs(
    a: GLProgram, b: GLProgram, size: tuple[int, int] = (640, 480), on: tuple[str, str] = ("softshadow", "softshadow")
) -> Divergence | None:
    """Return the first calls of two programs after which a pixel of their windows differs, or None.

    Only calls that change a pixel are compared, in order; calls that only set state may differ in number and order.

    Parameters
    ----------
    a, b : callables             ``program(gl)``; they must draw the same each time
    size : (width, height) of the window
    on : where a and b run       "softshadow" or "mesa"; ``diff_programs(p, p, size, on=("softshadow", "mesa"))`` finds
                                 the first call at which the two implementations differ
    """
    traces = [_run(TracedProgram(program, size), size, side) for program, side in zip((a, b), on, strict=True)]
    longest = max(map(len, traces))
    for index in range(longest):
        calls = [trace[index] if index < len(trace) else None for trace in traces]
        if calls[0] is None or calls[1] is None or calls[0].digest != calls[1].digest:
            buffers = [
                _run(TracedProgram(program, size, stop_at=index), size, side)
                for program, side in zip((a, b), on, strict=True)
            ]
            return Divergence(calls[0], calls[1], differences(buffers[0], buffers[1]))
    return None


def _run(program: TracedProgram, size: tuple[int, int], side: str) -> Any:
    if side not in SIDES:
        raise ValueError(f"on={side!r}: {nearest(side, SIDES)}")
    return (run_here if side == "softshadow" else run_on_mesa)(program, size).returned
