"""Traces of small programs, written call by call."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from softshadow import gl
from traces.trace_writer import TraceWriter

WINDOW, CONTEXT = 7, 0x1000


class TracedProgram(TraceWriter):
    """A writer that makes its context current first, and whose attributes are calls: ``traced.glEnd()``."""

    def __init__(self, width: int = 16, height: int = 12) -> None:
        super().__init__()
        self.make_current(CONTEXT, width, height)

    def make_current(self, context: int, width: int = 0, height: int = 0, thread: int = 0) -> None:
        """Make a context current; for the first time, its window has a size."""
        self.call("glXMakeCurrent", 1, WINDOW, context, result=True, thread=thread)
        if width:
            self.call("glViewport", 0, 0, width, height, fake=True, thread=thread)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return lambda *arguments, **named: self.call(name, *arguments, **named)

    def triangle(self, *corners: tuple[float, float]) -> int:
        """Draw a triangle, and return the number of its first call."""
        first = self.call("glBegin", gl.GL_TRIANGLES)
        for x, y in corners or ((-1.0, -1.0), (3.0, -1.0), (-1.0, 3.0)):
            self.call("glVertex2f", x, y)
        self.call("glEnd")
        return first

    def swap(self) -> int:
        """End the frame."""
        return self.call("glXSwapBuffers", 1, WINDOW)

    def save(self, folder: Path) -> Path:
        """Write the trace to a folder."""
        path = folder / "program.trace"
        path.write_bytes(self.snappy())
        return path
